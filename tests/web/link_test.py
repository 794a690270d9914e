#!/usr/bin/python3
"""What happens when a link breaks: pages, server and controller go and come back; the robot does not move on without an eye on it."""

import signal
import unittest

from console_rig import ConsoleTest

BEAT_TIMEOUT_S = 2.0  # of config/robots/ivo.toml
RAMP_S = 1.5          # from the plan's speed to rest, with room
STANDING = "awaiting consent"


class Link(ConsoleTest):
    def setUp(self):
        super().setUp()
        self.begin()
        self.ana = self.screen("Ana's tablet", "tablet")
        self.ana.take_controls()
        self.ana.wait_act("accept")

    def modes(self):
        return [(each["t_s"], each["mode"]) for each in self.events() if each["event"] == "mode"]

    def moving(self):
        self.ana.wait("Number(document.getElementById('agent-progress-0').value) > 0.02")

    def wait_standing(self):
        self.until(lambda: self.modes()[-1][1] == STANDING, "a robot that stands")

    def goes_on(self):
        self.ana.start()
        self.ana.wait_state("searching")

    def test_a_reload_in_mid_search_comes_back_with_the_controls_and_what_is_true(self):
        self.ana.start()
        self.moving()
        luis = self.screen("Luis's phone", "phone")
        self.ana.browser.driver.refresh()
        self.ana.wait("document.getElementById('link-operator').textContent === 'You hold the controls'")
        self.until(lambda: self.ana.text("state") == luis.text("state") and self.ana.text("agent-words-0") == luis.text("agent-words-0"), "the same on both")
        self.ana.wait("document.querySelectorAll('.path-left').length === 2")

    def test_a_server_that_was_killed_is_found_again_and_the_robot_stood_meanwhile(self):
        self.ana.start()
        self.moving()
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
        self.goes_on()

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
        ana.press("replan-areas")
        ana.wait_stage("plan")
        ana.wait_act("accept")
        ana.start()
        self.moving()
        length = ana.js("return document.getElementById('agent-words-0').textContent.split(' of ')[1]")
        self.controller.kill()
        self.controller.wait()
        ana.wait_state("absent")
        ana.judge("absent")
        self.start_controller(None, "--resume")
        ana.wait_state("paused")
        ana.wait("document.querySelector('.area[data-slot=\"0\"]') && document.querySelectorAll('.path-left').length === 2")
        ana.wait_text("agent-words-0", length)
        ana.judge("resumed")
        ana.wait("document.getElementById('link-operator').textContent === 'You hold the controls'")
        self.goes_on()

    def test_a_silent_network_ramps_the_robot_down_within_two_seconds_of_its_clock(self):
        self.ana.start()
        self.moving()
        before = self.events()[-1]["t_s"]
        self.server.send_signal(signal.SIGSTOP)
        self.ana.wait("document.body.dataset.old === 'yes' && !document.getElementById('stale').hidden")
        self.ana.browser.picture("silent")
        self.wait_standing()
        at = dict((mode, t_s) for t_s, mode in self.modes())
        self.assertLess(at["pausing"] - before, BEAT_TIMEOUT_S + 1.0)
        self.assertLess(at[STANDING] - at["pausing"], RAMP_S)
        self.assertRegex(self.ana.text("stale"), r"What you see is from \d")
        self.server.send_signal(signal.SIGCONT)
        self.ana.wait_state("beat_lost")
        self.ana.wait("document.body.dataset.old === 'no'")

    def stops_while(self, happens, ends):
        luis = self.screen("Luis's phone", "phone")
        self.ana.start()
        luis.wait_state("searching")
        happens()
        luis.wait_state("beat_lost")  # that somebody watches is not enough
        ends()
        self.ana.wait_state("beat_lost")
        self.goes_on()

    def test_a_page_that_hangs_is_no_eye_on_the_robot(self):
        self.stops_while(lambda: self.ana.js("setTimeout(() => { const end = performance.now() + 4000; while (performance.now() < end); }, 0)"), lambda: None)

    def test_a_page_that_is_frozen_is_no_eye_on_the_robot(self):
        """As a browser does with a page on a tablet that sleeps."""
        state = lambda name: self.ana.browser.tell("Page.setWebLifecycleState", state=name)
        self.stops_while(lambda: state("frozen"), lambda: state("active"))

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
