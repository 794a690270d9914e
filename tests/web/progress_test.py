#!/usr/bin/python3
"""The best plan so far gets better before the eyes, for as long as somebody wants to look."""

import unittest

from console_rig import ENDLESS, ConsoleTest

# The heights of the line's steps, from the first best plan to the newest: down is sooner.
STEPS = """(document.getElementById("progress-line").hasAttribute("hidden") ? "" : document.querySelector("#progress-line .line").getAttribute("d"))
.match(/(?<=M\\S+ |V)[-\\d.e]+/g)?.map(Number) ?? []"""
EXPECTED_S = "parseFloat(document.querySelector('#fact-et td').textContent)"


class Progress(ConsoleTest):
    def expected_s(self, screen):
        """As the page shows it."""
        return screen.wait(f"Number.isFinite({EXPECTED_S}) && {EXPECTED_S}")

    def test_a_plan_gets_better_until_it_is_good_enough(self):
        self.begin(generations=ENDLESS)
        screen = self.screen("Ana's tablet", "tablet")
        screen.take_controls()
        screen.enough()
        number = screen.plan_number()
        screen.press("init")
        screen.wait_planning_after(number)
        first_s = self.expected_s(screen)
        steps = screen.wait(f"(({STEPS}).length > 1) && ({STEPS})")
        self.assertTrue(all(before < after for before, after in zip(steps, steps[1:])), f"it went up: {steps}")
        later_s = self.expected_s(screen)
        self.assertLessEqual(later_s, first_s)
        self.assertGreater(later_s, 0.0)
        self.assertEqual(screen.model("model.status.mode"), "planning")
        screen.browser.picture("progress")
        screen.enough()
        self.assertEqual(screen.plan_number(), number + 1)
        self.assertLessEqual(self.expected_s(screen), later_s)
        self.assertEqual(screen.model("[model.status.mode, model.documents.plan.done]"), ["awaiting consent", True])
        screen.wait("document.getElementById('progress').hidden")


if __name__ == "__main__":
    unittest.main()
