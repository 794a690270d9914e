#!/usr/bin/env python3
"""The bus is lost in mid-search: the run ends as a fault, says so and still writes its report."""

import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))

from mission_files import BUILD_DIR, COURTYARD, events, read_json  # noqa: E402


class BusLost(unittest.TestCase):
    def test_an_interface_that_goes_down_ends_the_search_as_a_fault(self):
        with tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp") as out:
            done = subprocess.run(
                [os.path.join(SOURCE_DIR, "toolchain", "vcan"), os.path.join(HERE, "bus_lost_on_vcan"), BUILD_DIR, out, COURTYARD],
                capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
            )
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            report = read_json(out, "report.json")
            self.assertEqual(report["end"], "fault")
            self.assertEqual(report["reason"], "bus lost: the interface is down")
            self.assertEqual([e["mode"] for e in events(out) if e["event"] == "mode"][-1], "fault")


if __name__ == "__main__":
    unittest.main()
