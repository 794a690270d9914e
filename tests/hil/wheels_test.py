#!/usr/bin/env python3
"""`ivo wheels` on a real bus: it reads what is there, and leaves a controller that is running alone."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))

from mission_files import BUILD_DIR  # noqa: E402

VCAN = os.path.join(SOURCE_DIR, "toolchain", "vcan")


def frames(path):
    """(id, data) of a candump log."""
    with open(path, encoding="ascii") as file:
        return [(int(m[1], 16), bytes.fromhex(m[2])) for m in re.finditer(r" ([0-9A-F]{3})#([0-9A-F]*)", file.read())]


class Wheels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp")
        cls.addClassCleanup(scratch.cleanup)
        cls.out = scratch.name
        done = subprocess.run([VCAN, os.path.join(HERE, "wheels_on_vcan"), BUILD_DIR, cls.out], capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, check=False)
        cls.statuses = dict(line.split("|") for line in done.stdout.splitlines() if "|" in line)
        cls.errors = done.stderr

    def said(self, name):
        with open(os.path.join(self.out, name), encoding="utf-8") as file:
            return file.read()

    def test_list_finds_the_four_drives(self):
        self.assertEqual(self.statuses.get("list"), "0", self.said("list") + self.errors)
        for node, wheel in enumerate(("front left", "front right", "rear left", "rear right"), start=1):
            self.assertRegex(self.said("list"), rf"(?m)^ +{node}  {wheel} .*402.*CSV\*")

    def test_list_only_reads(self):
        seen = frames(os.path.join(self.out, "alone.log"))
        requests = [data for id, data in seen if 0x600 < id <= 0x67F]
        self.assertGreaterEqual(len(requests), 127)
        for data in requests:
            self.assertIn(data[0], (0x40, 0x60, 0x70, 0x80), data.hex())
        self.assertFalse([id for id, _ in seen if id in (0x000, 0x080) or 0x200 <= id < 0x280])

    def test_beside_a_controller_nobody_is_asked_anything(self):
        self.assertIn("a controller is running on this bus (heard a heartbeat of node 127)", self.said("list_beside"))
        self.assertFalse([id for id, _ in frames(os.path.join(self.out, "beside.log")) if 0x600 < id <= 0x67F or id == 0])

    def test_watch_says_what_happens(self):
        self.assertEqual(self.statuses.get("watch"), "0", self.said("watch"))
        self.assertRegex(self.said("watch"), r"controller: its heartbeat is heard\n")
        self.assertRegex(self.said("watch"), r"front right: emergency 7330h, sensor \(error register 00h")
        self.assertRegex(self.said("watch"), r"rear left: NMT pre-operational\n")

    def test_turn_refuses_to_be_a_second_controller(self):
        self.assertEqual(self.statuses.get("turn"), "1", self.said("turn"))
        self.assertIn("a controller is running on this bus: heard a heartbeat of node 127", self.said("turn"))


if __name__ == "__main__":
    unittest.main()
