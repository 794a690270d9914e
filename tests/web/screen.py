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
# An expression of JavaScript over `model`, the newest state as the page has it.
OF_MODEL = "import('/model.js').then(({ model }) => (%s))"
SOME_GENERATIONS = 10  # after which a plan is no chance find
# What a browser says when a server is gone, or when a screen is not paired yet: these a test may have caused.
CAUSED = ("net::ERR_CONNECTION_REFUSED", "net::ERR_CONNECTION_RESET", "net::ERR_INTERNET_DISCONNECTED", "net::ERR_EMPTY_RESPONSE",
          "net::ERR_SOCKET_NOT_CONNECTED", "Unexpected response code: 403", "responded with a status of 403", "ERR_NETWORK_CHANGED", "Connection closed before",
          "responded with a status of 404", "Page entered Back-Forward Cache")


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

    def comes(self, condition, *values, patience_s=PATIENCE_S):
        """`condition` is an expression of JavaScript; its value when it is true, or None when that did not come."""
        end = time.monotonic() + patience_s
        while True:
            try:
                found = self.js(f"return {condition}", *values)
            except JavascriptException:
                found = None  # an element that is not there yet
            if found:
                return found
            if time.monotonic() > end:
                return None
            time.sleep(0.05)

    def wait(self, condition, *values, patience_s=PATIENCE_S):
        """As above, and it must come."""
        found = self.comes(condition, *values, patience_s=patience_s)
        if found is None:
            self.browser.picture(f"failed-{self.test.id().split('.')[-1]}")
            raise AssertionError(f"{self.name}: {condition} did not come; it shows {self.words()}")
        return found

    def model(self, value):
        """What the page's own modules say: `model` is what the server said last."""
        return self.js(f"return {OF_MODEL % value}")

    def wait_model(self, condition, *values, patience_s=PATIENCE_S):
        return self.wait(OF_MODEL % condition, *values, patience_s=patience_s)

    def words(self):
        return self.js("""const text = (id) => document.getElementById(id)?.textContent ?? null;
            return { ...document.body.dataset, state: text("state"), operator: text("link-operator"), why: text("act-why"), toast: text("toast"),
              title: text("now-title"), pause: text("pause-text"), stale: text("stale") }""")

    def text(self, name):
        return self.js("return document.getElementById(arguments[0]).textContent", name)

    def wait_text(self, name, part):
        return self.wait("document.getElementById(arguments[0]).textContent.includes(arguments[1])", name, part)

    def wait_words(self, name, key):
        """A sentence of words_en.js, whatever stands in it."""
        self.wait("""import("/words_en.js").then(({ words }) =>
            words[arguments[1]].split(/\\{\\w+\\}/).every((part) => document.getElementById(arguments[0]).textContent.includes(part)))""", name, key)

    def wait_stage(self, stage, patience_s=PATIENCE_S):
        self.wait("document.body.dataset.stage === arguments[0]", stage, patience_s=patience_s)

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

    def put_area(self, purpose="prefer-1", **box):
        """By numbers: x, y, width and height."""
        self.press(f"purpose-{purpose}")
        self.press("area-numbers")
        for name, value in box.items():
            self.type(f"form-{name}", f"{value:g}")
        self.press("form-save")

    def act(self, name, until):
        self.wait_act(name)
        self.press_until(name, until)

    def take_controls(self):
        self.act("take-control", "document.getElementById('control-text').textContent === 'You hold the controls.'")

    def plan_number(self):
        return self.model("model.status.plan.number")

    def wait_plan_after(self, number):
        """Another plan than that one is ready to be accepted: its making may have been too short to be seen. Its number."""
        self.wait_model("model.status.plan.number > arguments[0] && model.status.plan.ready && "
                        "model.documents.plan.number === model.status.plan.number", number)
        self.wait_act("accept")
        return self.plan_number()

    def wait_planning_after(self, number):
        """Another plan than that one is being made, and the best so far is good for something; it lasts until somebody has enough."""
        self.wait_model("model.status.plan.number > arguments[0] && model.status.mode === 'planning' && model.status.plan.generation >= arguments[1] && "
                        "model.documents.plan.number === model.status.plan.number", number, SOME_GENERATIONS)
        self.wait_stage("plan")

    def enough(self):
        """The best plan so far is taken."""
        self.act("enough", "document.body.dataset.stage === 'agree'")
        self.wait_act("accept")

    def hold_start(self, on_the_way=lambda: None):
        """Until its ring is full, and that has counted. A page whose link is not steady meanwhile counts nothing as held: then it is held again. The
        number of the question that was answered."""
        held = "document.getElementById('hold-start').classList.contains('held')"
        ready = "document.body.dataset.act === 'hold-start' && document.getElementById('hold-start').ariaDisabled !== 'true'"
        taken = "(model.status.question !== arguments[0] || model.status.asks !== 'consent')"
        self.wait_act("hold-start")
        question = self.model("model.status.question")
        end = time.monotonic() + PATIENCE_S
        while self.wait_model(f"{taken} ? 'taken' : {ready} ? 'ready' : null", question) == "ready":
            if time.monotonic() > end:
                raise AssertionError(f"{self.name}: Start was held and did not count; it shows {self.words()}")
            place = self.middle("hold-start")
            self.browser.press(place)
            if self.comes(held, patience_s=1):
                on_the_way()
            self.comes(f"!{held}", patience_s=PATIENCE_S)
            self.browser.release(place)
            self.comes(OF_MODEL % taken, question, patience_s=2)
        return question

    def place(self, x_m, y_m):
        """Of the map, in pixels."""
        return self.js("""const box = document.querySelector("[data-grid=map]").getBoundingClientRect();
            return [box.left + arguments[0] / 21 * box.width, box.bottom - arguments[1] / 27 * box.height]""", x_m, y_m)

    def set_off(self):
        """From a plan that is ready, or was accepted already, to consent that has counted; who holds the controls does. The question's number."""
        if self.wait("['accept', 'hold-start'].find((act) => act === document.body.dataset.act)") == "accept":
            self.act("accept", "document.body.dataset.act === 'hold-start'")
        return self.hold_start()

    def start(self):
        """To a robot that searches."""
        self.set_off()
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
