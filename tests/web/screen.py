"""The page as somebody uses it on one screen."""

import os
import time

import npm_packages
from selenium.common.exceptions import JavascriptException

HERE = os.path.dirname(os.path.abspath(__file__))
PATIENCE_S = 30
JUDGE = """
const done = arguments[0];
axe.run(document, { resultTypes: ["violations"] }).then((found) => done(found.violations.map((each) =>
  ({ impact: each.impact, rule: each.id, where: each.nodes.map((node) => node.html.slice(0, 160) + " | " + node.failureSummary) }))),
  (fault) => done([{ impact: "critical", rule: String(fault), where: [] }]));
"""
STILL = """
const [name, done] = arguments;
const end = performance.now() + 2000;
let before = "";
function look() {
  const node = document.getElementById(name);
  node.scrollIntoView({ block: "nearest" });
  const box = node.getBoundingClientRect();
  const middle = [box.left + box.width / 2, box.top + box.height / 2];
  const top = document.elementFromPoint(...middle);
  if ((String(middle) === before && (node.contains(top) || top?.contains(node))) || performance.now() > end) return done(middle);
  before = String(middle);
  setTimeout(look, 50);
}
look();
"""
# What a browser says when a server is gone, or when a screen is not paired yet: these a test may have caused.
CAUSED = ("net::ERR_CONNECTION_REFUSED", "net::ERR_CONNECTION_RESET", "net::ERR_INTERNET_DISCONNECTED", "net::ERR_EMPTY_RESPONSE",
          "net::ERR_SOCKET_NOT_CONNECTED", "Unexpected response code: 403", "responded with a status of 403", "ERR_NETWORK_CHANGED", "Connection closed before",
          "responded with a status of 404")


class Screen:
    def __init__(self, test, browser, name):
        self.test = test
        self.browser = browser
        self.name = name
        test.addCleanup(self.check_logs)

    def check_logs(self):
        """Nothing was asked of another address, and nothing was complained of but what the test caused."""
        self.browser.read_logs()
        self.browser.driver.get("about:blank")
        places = {url.split("/")[2] for url in self.browser.requests if url.split(":")[0] in ("http", "https", "ws", "wss")}
        assert places == {f"127.0.0.1:{self.test.port}"}, places
        others = [entry for entry in self.browser.complaints if not any(cause in entry["message"] for cause in CAUSED)]
        assert not others, others

    def open(self):
        self.browser.driver.get(f"http://127.0.0.1:{self.test.port}/")

    def js(self, script, *values):
        return self.browser.driver.execute_script(script, *values)

    def wait(self, condition, *values, patience_s=PATIENCE_S):
        """`condition` is an expression of JavaScript; its value when it is true."""
        end = time.monotonic() + patience_s
        while time.monotonic() < end:
            try:
                found = self.js(f"return {condition}", *values)
            except JavascriptException:
                found = None  # an element that is not there yet
            if found:
                return found
            time.sleep(0.05)
        self.browser.picture(f"failed-{self.test.id().split('.')[-1]}")
        raise AssertionError(f"{self.name}: {condition} did not come; it shows {self.words()}")

    def words(self):
        return self.js("""const text = (id) => document.getElementById(id)?.textContent ?? null;
            return { ...document.body.dataset, state: text("state"), operator: text("link-operator"), why: text("act-why"), toast: text("toast"),
              title: text("now-title"), pause: text("pause-text"), stale: text("stale") }""")

    def text(self, name):
        return self.js("return document.getElementById(arguments[0]).textContent", name)

    def wait_text(self, name, part):
        return self.wait("document.getElementById(arguments[0]).textContent.includes(arguments[1])", name, part)

    def wait_stage(self, stage):
        self.wait("document.body.dataset.stage === arguments[0]", stage)

    def wait_state(self, state):
        self.wait("document.getElementById('head').dataset.state === arguments[0]", state)

    def wait_act(self, act):
        """The next step is that one, and can be taken."""
        self.wait("document.body.dataset.act === arguments[0] && document.getElementById(arguments[0]).ariaDisabled !== 'true'", act)

    def pair(self, code):
        self.wait("!document.getElementById('pairing').hidden")
        self.type("pairing-code", code)
        self.type("pairing-name", self.name)
        self.press("pairing-send")
        self.wait("document.getElementById('pairing').hidden && document.querySelector('[data-grid=map]')")

    def type(self, name, text):
        field = self.browser.driver.find_element("id", name)
        field.clear()
        field.send_keys(text)

    def keys(self, name, *keys):
        self.wait("(document.getElementById(arguments[0]).focus(), document.activeElement.id === arguments[0])", name)
        self.browser.driver.switch_to.active_element.send_keys(*keys)

    def middle(self, name):
        """Of an element, brought in sight, when it lies still and nothing lies over it."""
        return self.browser.driver.execute_async_script(STILL, name)

    def press(self, name):
        self.wait("document.getElementById(arguments[0]).checkVisibility() && document.getElementById(arguments[0]).ariaDisabled !== 'true'", name)
        self.browser.tap(self.middle(name))

    def press_until(self, name, condition, *values):
        """A button that has just come counts no press yet: it is pressed again until it has counted."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if self.js("const node = document.getElementById(arguments[0]); return node.checkVisibility() && node.ariaDisabled !== 'true'", name):
                self.browser.tap(self.middle(name))
            again = time.monotonic() + 0.7
            while time.monotonic() < again:
                if self.js(f"return {condition}", *values):
                    return
                time.sleep(0.05)
        raise AssertionError(f"{self.name}: {name} was pressed and {condition} did not come; it shows {self.words()}")

    def act(self, name, until):
        self.wait_act(name)
        self.press_until(name, until)

    def take_controls(self):
        self.act("take-control", "document.getElementById('control-text').textContent === 'You hold the controls.'")

    def hold_start(self, on_the_way=lambda: None):
        """Until its ring is full."""
        self.wait_act("hold-start")
        place = self.middle("hold-start")
        self.browser.press(place)
        self.wait("document.getElementById('hold-start').classList.contains('held')")
        on_the_way()
        self.wait("!document.getElementById('hold-start').classList.contains('held')")
        self.browser.release(place)

    def place(self, x_m, y_m):
        """Of the map, in pixels."""
        return self.js("""const box = document.querySelector("[data-grid=map]").getBoundingClientRect();
            return [box.left + arguments[0] / 21 * box.width, box.bottom - arguments[1] / 27 * box.height]""", x_m, y_m)

    def start(self):
        """From a plan that is ready, or was accepted already, to a robot that searches; who holds the controls does."""
        if self.wait("['accept', 'hold-start'].find((act) => act === document.body.dataset.act)") == "accept":
            self.act("accept", "document.body.dataset.act === 'hold-start'")
        self.hold_start()
        self.wait_stage("search")

    def judge(self, name):
        """A picture, and what axe says of the page in this state: nothing serious."""
        self.browser.picture(name)
        with open(os.path.join(npm_packages.install(os.path.join(HERE, "page_judge")), "node_modules", "axe-core", "axe.min.js"), encoding="utf-8") as file:
            self.js(file.read())
        found = self.browser.driver.execute_async_script(JUDGE)
        self.test.assertEqual([each for each in found if each["impact"] in ("serious", "critical")], [], name)

    def press_details(self):
        self.js("document.getElementById('details').open = true")
