#!/usr/bin/python3
"""One screen holds the controls; the others watch, may stop, and may ask."""

import unittest

from console_rig import ConsoleTest

YOU = "document.getElementById('control-text').textContent === 'You hold the controls.'"
ASKS = "document.getElementById('act-why').textContent.includes(' is asked.')"
IS_ASKED = "!document.getElementById('request').hidden"


class Control(ConsoleTest):
    def setUp(self):
        super().setUp()
        self.begin()
        self.ana = self.screen("Ana's tablet", "tablet")
        self.luis = self.screen("Luis's phone", "phone")
        self.ana.take_controls()

    def test_who_watches_cannot_plan_or_start_but_can_stop(self):
        ana, luis = self.ana, self.luis
        luis.wait("document.body.dataset.act === 'take-control'")
        for name in ("init", "replan"):
            self.assertEqual(luis.js("return document.getElementById(arguments[0]).ariaDisabled", name), "true", name)
        self.assertEqual(luis.js("return ['accept', 'hold-start', 'enough'].filter((id) => !document.getElementById(id).hidden)"), [])
        ana.start()
        luis.wait_state("searching")
        luis.press("stop")
        for screen in (ana, luis):
            screen.wait_state("paused")
        ana.wait_text("pause-text", "Somebody pressed Stop")
        ana.judge("stopped")
        self.assertEqual([each["mode"] for each in self.events() if each["event"] == "mode"][-1], "awaiting consent")
        # By the keyboard it stops too, and what was agreed goes on after consent anew.
        ana.start()
        luis.wait_state("searching")
        luis.keys("stop", " ")
        ana.wait_state("paused")

    def test_the_controls_are_asked_for_kept_and_given(self):
        ana, luis = self.ana, self.luis
        luis.act("take-control", ASKS)
        ana.wait(IS_ASKED)
        self.assertIn("Luis's phone asks for the controls", ana.text("request-text"))
        ana.press("control-keep")
        luis.wait(f"!{ASKS}")
        ana.wait(YOU)
        luis.act("take-control", ASKS)
        ana.wait(IS_ASKED)
        ana.press("control-give")
        luis.wait(YOU)
        ana.wait_text("link-operator", "Luis's phone holds the controls")
        ana.press("tab-screens")
        self.assertEqual(ana.js("return document.querySelectorAll('#screen-list li').length"), 2)
        ana.judge("screens")

    def judge_while_asked(self, screen, name, still):
        """Who does not answer within ten seconds has given the controls: what was judged until then was another page. Then it is asked again."""
        ana, luis = self.ana, self.luis
        for _ in range(5):
            luis.act("take-control", ASKS)
            ana.wait(IS_ASKED)
            screen.judge(name)
            if screen.js(f"return {still}"):
                ana.press_until("control-keep", f"!({IS_ASKED})")
                if luis.wait(f"!({ASKS})") and ana.js(f"return {YOU}"):
                    return
            ana.act("take-control", YOU)
        raise AssertionError(f"{name}: the ten seconds were over each time before it was judged")

    def test_the_page_is_sound_while_one_asks(self):
        self.judge_while_asked(self.ana, "asked", IS_ASKED)
        self.judge_while_asked(self.luis, "asking", ASKS)

    def test_they_are_free_after_the_holder_has_gone(self):
        self.ana.browser.driver.get("about:blank")
        self.luis.wait_text("act-why", "Nobody holds the controls")
        self.luis.act("take-control", YOU)

    def test_they_go_over_when_the_holder_does_not_answer(self):
        self.luis.act("take-control", ASKS)
        self.luis.wait(YOU)
        self.ana.wait_text("link-operator", "Luis's phone holds the controls")


class Pairing(ConsoleTest):
    def test_a_wrong_code_pairs_nobody_and_five_lock(self):
        self.begin()
        stranger = self.screen("A stranger", "phone", paired=False)
        stranger.wait("!document.getElementById('pairing').hidden")
        stranger.judge("pairing")
        wrong = "000000" if self.new_code() != "000000" else "111111"
        stranger.type("pairing-code", wrong)
        for left in ("4 tries left", "3 tries left", "2 tries left", "1 try left", "Too many tries"):
            stranger.press("pairing-send")
            stranger.wait_text("pairing-fault", left)
        stranger.judge("locked")


if __name__ == "__main__":
    unittest.main()
