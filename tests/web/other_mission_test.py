#!/usr/bin/python3
"""A page that stays open while the robot is given another mission: what it shows is of the new one."""

import os
import unittest

from console_rig import ConsoleTest, courtyard
from mission_files import SOURCE_DIR

SHOWN = """const box = document.querySelector("[data-grid=map]").getBoundingClientRect();
return [box.width / box.height, document.querySelectorAll(".agent").length, document.querySelectorAll(".area").length]"""


def other():
    with open(os.path.join(SOURCE_DIR, "config", "missions", "m1.toml"), encoding="utf-8") as file:
        return file.read().replace('"../', f'"{SOURCE_DIR}/config/')


class OtherMission(ConsoleTest):
    def setUp(self):
        super().setUp()
        self.begin()
        self.ana = self.operator("Ana's desk")
        self.ana.press("tab-areas")
        self.ana.put_area(x=5, y=18, width=6, height=4)
        self.ana.wait("document.querySelector('.area')")
        self.pixel = self.colours()

    def colours(self):
        """Of the ground, wherever there is some."""
        return self.ana.js("""const canvas = document.querySelector("[data-grid=map]");
            const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
            let sum = 0; for (let i = 0; i < data.length; i += 4) sum = (31 * sum + data[i] + 7 * data[i + 1] + 3 * data[i + 2]) % 1000003;
            return [canvas.width, canvas.height, sum]""")

    def changes(self):
        self.controller.kill()
        self.controller.wait()
        self.out = os.path.join(self.folder, "other")
        self.start_controller(other())

    def is_the_others(self):
        self.ana.wait("document.body.dataset.old === 'no'")
        self.until(lambda: self.colours() != self.pixel, "another map")
        width, height, _ = self.colours()
        self.until(lambda: abs(self.ana.js(SHOWN)[0] - width / height) < 0.02, "the map in its own shape")
        self.until(lambda: self.ana.js(SHOWN)[1] == self.ana.js("return document.querySelectorAll('#agents > li').length"), "its agents")
        self.until(lambda: self.ana.js("""const [map, ground] = ["#map", "[data-grid=map]"].map((name) => document.querySelector(name).getBoundingClientRect());
            return ground.top >= map.top && ground.bottom <= map.bottom && ground.left >= map.left && ground.right <= map.right"""), "the whole of it in sight")
        self.assertEqual(self.ana.js("return document.getElementById('undo').ariaDisabled"), "true", "nothing to undo of the other's areas")
        self.ana.judge("other-mission")

    def test_with_the_same_server(self):
        self.changes()
        self.is_the_others()

    def test_with_another_server(self):
        self.server.kill()
        self.server.wait()
        self.changes()
        self.start_server()
        self.is_the_others()


if __name__ == "__main__":
    unittest.main()
