#!/usr/bin/python3
"""An area that is closed after a plan was made: nobody sets off into it, and a robot on its way stands before it."""

import unittest

from console_rig import ConsoleTest


class NoGo(ConsoleTest):
    def setUp(self):
        super().setUp()
        self.begin()
        self.ana = self.operator("Ana's desk")

    def close_the_end_of_the_robots_way(self):
        x_m, y_m = self.ana.model("model.documents.plan.agents[0].waypoints_m")[-1]
        self.ana.press("tab-areas")
        self.ana.put_area("no_go-", x=x_m - 0.3, y=y_m - 0.3, width=0.6, height=0.6)
        self.ana.wait("document.querySelector('.area[data-slot=\"0\"]')")
        self.ana.press("tab-search")

    def plan_anew(self):
        """By the one button that is offered now."""
        self.ana.act("plan-anew", "document.body.dataset.act !== 'plan-anew'")
        self.ana.wait_act("accept")

    def test_nobody_sets_off_into_it(self):
        self.close_the_end_of_the_robots_way()
        self.ana.wait_text("act-why", "The plan leads IVO into a no-go area that was drawn later.")
        self.assertEqual(self.ana.js("return document.body.dataset.act"), "plan-anew")
        self.ana.judge("no-go-drawn-later")
        self.plan_anew()
        self.assertEqual(self.ana.text("act-why"), "")
        self.ana.start()

    def test_a_robot_stands_before_it(self):
        self.ana.start()
        self.close_the_end_of_the_robots_way()
        self.ana.wait_text("pause-text", "A no-go area was drawn on the robot's way")
        self.ana.wait_text("act-why", "The plan leads IVO into a no-go area that was drawn later.")
        self.ana.judge("no-go-ahead")
        self.plan_anew()
        self.ana.start()


if __name__ == "__main__":
    unittest.main()
