#!/usr/bin/env python3
"""On a kernel that has CAN: interfaces that cannot be used are refused by name, and the socket's own tests run."""

import os
import re
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))

from mission_files import BUILD_DIR, COURTYARD  # noqa: E402

VCAN = os.path.join(SOURCE_DIR, "toolchain", "vcan")


def on_vcan(*command):
    return subprocess.run([VCAN, *command], capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)


class Interfaces(unittest.TestCase):
    def test_what_is_missing_down_or_no_can_is_refused_in_one_line(self):
        with tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp") as folder:
            out = os.path.join(folder, "out")
            done = on_vcan(os.path.join(HERE, "interfaces_on_vcan"), BUILD_DIR, COURTYARD, out)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertFalse(os.path.exists(out), "something was written")
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 6, done.stdout)
        says = {"can77": "no CAN interface", "vcan1": "is down", "lo": "not a CAN interface"}
        for line in lines:
            interface, status, text = line.split("|", 2)
            self.assertEqual(status, "2", line)
            self.assertIn(interface, text)
            self.assertRegex(text, says[interface])

    def test_the_sockets_own_tests_pass_on_a_real_bus(self):
        done = on_vcan(os.path.join(BUILD_DIR, "tests", "unit_hal"), "--gtest_color=no")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"\[  PASSED  \] [1-9]\d+ tests")
        skipped = set(re.findall(r"\[  SKIPPED \] (\w+\.\S+)", done.stdout))
        # The message for kernels without CAN cannot be provoked here, nor may the host's own clock be set.
        cannot = {"SocketCanBus.RefusesAKernelWithoutCanInOneLine"}
        if on_vcan("--which").stdout.strip() == "netns":
            cannot |= {"SocketCanBusOnVcan.StampsStayBetweenTwoCallsWhenTheWallClockIsSet"}
        self.assertLessEqual(skipped, cannot)

    def test_a_cycle_is_two_system_calls_and_a_sleep(self):
        cycles = 200
        with tempfile.NamedTemporaryFile(prefix="ivo-hil.", dir="/var/tmp") as trace:
            program = os.path.join(BUILD_DIR, "bus_cycles")
            done = on_vcan("strace", "-f", "-o", trace.name, program, "vcan0", str(cycles))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            calls = re.findall(r"^\d+ +(\w+)\(", trace.read().decode(), re.MULTILINE)
        self.assertIn(f"{5 * cycles} frames taken", done.stdout)
        marks = [i for i, call in enumerate(calls) if call == "write"]
        # A guest of user-mode Linux asks its kernel for the time; elsewhere that is no call.
        between = [call for call in calls[marks[0] + 1:marks[1]] if call != "clock_gettime"]
        # A cycle that ends after its deadline, on a busy host, does not sleep.
        self.assertRegex(" ".join(between) + " ", f"^(recvmmsg sendmmsg (clock_nanosleep )?){{{cycles}}}$")
        self.assertIn("clock_nanosleep", between)


if __name__ == "__main__":
    unittest.main()
