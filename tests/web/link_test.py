#!/usr/bin/python3
"""What happens when a link breaks: pages, server and controller go and come back; the robot does not move on without an eye on it."""

import json
import signal
import unittest

from console_rig import SHIPPED_TIMEOUT_S, ConsoleTest

RAMP_S = 1.5  # from the plan's speed to rest, with room
STANDING = "awaiting consent"
SEARCHING = "document.getElementById('head').dataset.state === 'searching'"
MOVING = f"({SEARCHING} && Number(document.getElementById('agent-progress-0').value) > 0.02)"
# What every screen must agree on.
SHOWN = """{ state: document.getElementById("state").textContent, title: document.getElementById("now-title").textContent,
  plan: document.getElementById("detail-plan").textContent, numbers: [model.status.plan.number, model.documents.plan.number, model.status.areas_revision],
  areas: model.documents.areas.areas, drawn: document.querySelectorAll(".area").length, list: document.getElementById("area-list").textContent }"""


class Link(ConsoleTest):
    def setUp(self):
        super().setUp()
        self.begin(operator_timeout_s=SHIPPED_TIMEOUT_S)
        self.ana = self.operator("Ana's tablet", "tablet")

    def modes(self):
        return [(each["t_s"], each["mode"]) for each in self.events() if each["event"] == "mode"]

    def sets_off(self, until=SEARCHING, watcher=None):
        """Until Ana's screen shows that, and the watcher's the search. A page that gets no time for two seconds makes the robot stand, as it should:
        that is not what the test is about, and the robot is set off again."""
        for _ in range(10):
            question = self.ana.set_off()
            stands = "(model.status.asks === 'consent' && model.status.question !== arguments[0])"
            seen = self.ana.wait_model(f"{until} ? 'yes' : {stands} ? 'no' : null", question) == "yes"
            if seen and (watcher is None or watcher.comes(SEARCHING, patience_s=5)):
                return
            self.ana.wait_model(stands, question)
        raise AssertionError("it stood each time before that was seen")

    def wait_standing(self):
        self.until(lambda: self.modes()[-1][1] == STANDING, "a robot that stands")

    def test_a_reload_in_mid_search_comes_back_with_the_controls_and_what_is_true(self):
        self.sets_off(MOVING)
        luis = self.screen("Luis's phone", "phone")
        self.ana.browser.driver.refresh()
        self.ana.wait("document.getElementById('link-operator').textContent === 'You hold the controls'")
        self.until(lambda: self.ana.text("state") == luis.text("state") and self.ana.text("agent-words-0") == luis.text("agent-words-0"), "the same on both")
        self.ana.wait("document.querySelectorAll('.path-left').length === 2")

    def test_a_server_that_was_killed_is_found_again_and_the_robot_stood_meanwhile(self):
        self.sets_off(MOVING)
        self.server.kill()
        self.server.wait()
        self.ana.wait_state("no_server")
        self.assertEqual(self.ana.js("return document.body.dataset.old"), "yes")
        self.ana.judge("no-server")
        self.wait_standing()
        self.start_server()
        self.ana.wait_state("beat_lost")
        self.ana.wait("document.getElementById('pairing').hidden && document.body.dataset.old === 'no'")
        self.ana.wait_text("pause-text", "The link to the operator was lost")
        self.ana.judge("beat-lost")
        self.ana.wait("document.getElementById('link-operator').textContent === 'You hold the controls'")
        self.sets_off()

    def test_the_old_servers_last_word_is_not_the_new_ones_first(self):
        """A frame is drawn between the new server's hello, with the same number of the screen, and its first status."""
        self.ana.js("window.requestAnimationFrame = (draw) => { queueMicrotask(() => draw(performance.now())); return 0; }")
        self.server.kill()
        self.server.wait()
        self.ana.wait_state("no_server")
        self.start_server()
        self.ana.wait("document.body.dataset.old === 'no'")
        self.ana.wait("document.getElementById('link-operator').textContent === 'You hold the controls'")

    def test_a_controller_that_was_killed_comes_back_with_plan_and_areas(self):
        ana = self.ana
        ana.press("tab-areas")
        ana.press("draw-rectangle")
        ana.wait("document.body.dataset.tool === 'rectangle'")
        ana.browser.drag(ana.place(4, 17), ana.place(20, 26))
        ana.wait("document.querySelector('.area[data-slot=\"0\"]')")
        number = ana.plan_number()
        ana.press("replan-areas")
        ana.wait_plan_after(number)
        self.sets_off(MOVING)
        length = ana.js("return document.getElementById('agent-words-0').textContent.split(' of ')[1]")
        self.controller.kill()
        self.controller.wait()
        ana.wait_state("absent")
        ana.judge("absent")
        self.start_controller(None, "--resume")
        ana.wait_state("taken_up")
        ana.wait("document.querySelector('.area[data-slot=\"0\"]') && document.querySelectorAll('.path-left').length === 2")
        ana.wait_text("agent-words-0", length)
        ana.judge("resumed")
        ana.wait("document.getElementById('link-operator').textContent === 'You hold the controls'")
        self.sets_off()

    def test_three_screens_show_the_same(self):
        ana = self.ana
        others = [self.screen("Luis's phone", "phone"), self.screen("Eva's desk", "desk")]
        screens = [ana, *others]
        for screen in screens:
            screen.press_details()
            screen.wait("document.getElementById('detail-plan')")

        def same():
            return len({json.dumps(screen.model(SHOWN), sort_keys=True) for screen in screens}) == 1

        for screen in others:
            screen.wait_model("model.status.plan.ready && model.documents.areas.areas.length === 0")
        self.until(same, "the same on all before")
        number = ana.plan_number()
        ana.press("tab-areas")
        ana.press("draw-rectangle")
        ana.wait("document.body.dataset.tool === 'rectangle'")
        ana.browser.drag(ana.place(4, 17), ana.place(20, 26))
        for screen in screens:
            screen.wait("document.querySelector('.area[data-slot=\"0\"]')")
        self.until(same, "the same on all after she drew")
        ana.press("replan-areas")
        for screen in screens:
            screen.wait_model("model.status.plan.number === arguments[0] && model.status.plan.ready && model.status.plan.with_preferences", number + 1)
            screen.wait("document.getElementById('detail-plan').textContent === arguments[0]", str(number + 1))
        self.until(same, "the same on all after she planned anew")

    def test_a_silent_network_ramps_the_robot_down_within_two_seconds_of_its_clock(self):
        self.sets_off(MOVING)
        # No beat comes through from here on. What the controller wrote last, by then, is hardly older; however long it takes to look, no beat is later.
        self.server.send_signal(signal.SIGSTOP)
        before = self.events()[-1]["t_s"]
        self.ana.wait("document.body.dataset.old === 'yes' && !document.getElementById('stale').hidden")
        self.ana.browser.picture("silent")
        self.wait_standing()
        at = dict((mode, t_s) for t_s, mode in self.modes())
        self.assertLess(at["pausing"] - before, SHIPPED_TIMEOUT_S + 1.0)
        self.assertLess(at[STANDING] - at["pausing"], RAMP_S)
        self.assertRegex(self.ana.text("stale"), r"What you see is from \d")
        self.server.send_signal(signal.SIGCONT)
        self.ana.wait_state("beat_lost")
        self.ana.wait("document.body.dataset.old === 'no'")

    def stops_while(self, happens, ends):
        luis = self.screen("Luis's phone", "phone")
        self.sets_off(watcher=luis)
        happens()
        luis.wait_state("beat_lost")  # that somebody watches is not enough
        ends()
        self.ana.wait_state("beat_lost")
        self.sets_off()

    def test_a_page_that_hangs_is_no_eye_on_the_robot(self):
        self.stops_while(lambda: self.ana.js("setTimeout(() => { const end = performance.now() + 4000; while (performance.now() < end); }, 0)"), lambda: None)

    def test_a_page_that_is_frozen_is_no_eye_on_the_robot(self):
        """As a browser does with a page on a tablet that sleeps."""
        tell = self.ana.browser.tell

        def wake():
            tell("Page.setWebLifecycleState", state="active")
            window = tell("Browser.getWindowForTarget")["windowId"]
            while not self.ana.comes("document.visibilityState === 'visible'", patience_s=1):  # it stays hidden until its window is raised
                for state in ("minimized", "normal"):
                    tell("Browser.setWindowBounds", windowId=window, bounds={"windowState": state})

        self.stops_while(lambda: tell("Page.setWebLifecycleState", state="frozen"), wake)

    def test_a_tablet_out_of_reach_is_no_eye_on_the_robot_and_comes_back_by_itself(self):
        def reach(offline):
            self.ana.browser.tell("Network.enable")
            self.ana.browser.tell("Network.emulateNetworkConditions", offline=offline, latency=0, downloadThroughput=-1, uploadThroughput=-1)

        self.stops_while(lambda: reach(True), lambda: reach(False))

    def test_a_page_behind_another_is_no_eye_on_the_robot(self):
        driver = self.ana.browser.driver
        ours = driver.current_window_handle

        def back():
            driver.close()
            driver.switch_to.window(ours)

        self.stops_while(lambda: driver.switch_to.new_window("tab"), back)


if __name__ == "__main__":
    unittest.main()
