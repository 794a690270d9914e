#!/usr/bin/env python3
"""The chain from the loop's counter by the supervisor, and from systemd, to the machine's watchdog: each link is broken once, and the machine is
reset in time.

The machine is toolchain/rt's, with an emulated i6300esb; its clock counts instructions, so times are those of a model. The drives' own watch
on the controller's heartbeat, which stops the wheels long before, is real_time_test.py's; systemd's on the supervisor is systemd_test.py's.
"""

import os
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))

from mission_files import BUILD_DIR, MISSION, write_mission  # noqa: E402

RT = os.path.join(SOURCE_DIR, "toolchain", "rt")
RT_PARTS = os.path.join(SOURCE_DIR, "tests", "rt")
LINKS = ("loop", "supervisor", "process", "death", "order")
EXAMPLE = os.path.join(SOURCE_DIR, "toolchain", "packaging", "controller", "watchdog.conf")
RESET = 125  # toolchain/rt: the guest stopped before its command ended


class Guest:
    def __init__(self, brought, script, *arguments):
        """`brought`: where each file goes in /given, and where it is here."""
        brought = brought | {"script": f"{RT_PARTS}/{script}", "signs_of_life": f"{RT_PARTS}/signs_of_life"}
        files = sum((["-f", f"{path}:/given/{name}"] for name, path in brought.items()), [])
        done = subprocess.run([RT, "-d", "watchdog", "-t", "2400", *files, "sh", "/given/script", *arguments],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
        self.status, self.output = done.returncode, done.stdout + done.stderr
        self.said = []
        for line in done.stdout.splitlines():
            time, _, what = line.partition(" ")
            if what and time.replace(".", "", 1).isdigit():
                self.said.append((float(time), what))

    def when(self, begin):
        """When it was said last."""
        return max((time for time, what in self.said if what.startswith(begin)), default=None)

    def timeout(self):
        return next(int(what.split()[1]) for _, what in self.said if what.startswith("timeout "))


class Watchdog(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp")
        cls.addClassCleanup(scratch.cleanup)
        # Nobody finds the object: the wheels turn until something happens.
        write_mission(scratch.name, MISSION.replace(f"{SOURCE_DIR}/config/robots/", "").replace('"drawn"', '"unknown"').replace("generations = 5", "generations = 1"))
        with open(os.path.join(SOURCE_DIR, "config", "robots", "ivo.toml"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(scratch.name, "ivo.toml"), "w", encoding="utf-8") as file:
            file.write(text)
        programs = {name: os.path.join(BUILD_DIR, name) for name in ("ivo", "ivo-drives")}
        with ThreadPoolExecutor(2) as pool:
            cls.guests = {link: pool.submit(Guest, programs | {"mission": scratch.name}, "watchdog_in_guest", link) for link in LINKS}
            cls.guests["systemd"] = pool.submit(Guest, {"systemd": "/lib/systemd/systemd", "watchdog.conf": EXAMPLE}, "systemd_in_guest")
        cls.guests = {link: guest.result() for link, guest in cls.guests.items()}

    def lived(self, link):
        """How long after it broke, and the watchdog's patience, both in seconds."""
        guest = self.guests[link]
        self.assertEqual(guest.status, RESET, guest.output)
        broken, timeout = guest.when(f"breaks {link}"), guest.timeout()
        self.assertIsNotNone(broken, guest.output)
        self.assertIsNone(guest.when("survived"))
        lived = guest.when("alive") - broken
        print(f"{link}: reset {lived:.1f} s after it broke, of {timeout} s (a model of time)", file=sys.stderr)
        return lived, timeout

    def check_reset(self, link):
        # Looked at four times in a timeout: fed for the last time up to a look before it broke, or, where only the loop hangs, up to one after.
        lived, timeout = self.lived(link)
        self.assertGreater(lived, 0.75 * timeout - 0.3)
        self.assertLess(lived, 1.25 * timeout + 0.5)

    def test_a_loop_that_hangs_alone_resets_the_machine(self):
        self.check_reset("loop")

    def test_a_supervisor_that_hangs_alone_resets_the_machine(self):
        self.check_reset("supervisor")

    def test_a_controller_that_is_stopped_resets_the_machine(self):
        self.check_reset("process")

    def test_a_controller_that_is_killed_resets_the_machine(self):
        self.check_reset("death")

    def test_a_systemd_that_hangs_resets_the_machine(self):
        lived, timeout = self.lived("systemd")
        self.assertEqual(timeout, 10, "as the package's example says")
        self.assertGreater(lived, 0.5 * timeout - 0.3, "fed twice in that time")
        self.assertLess(lived, timeout + 0.5)

    def test_a_refused_run_leaves_the_watchdog_alone(self):
        self.assertRegex(self.guests["order"].output, r"refused 2 inactive .*/proc/nowhere")

    def test_a_short_hang_and_an_orderly_end_leave_the_machine_alone(self):
        guest = self.guests["order"]
        self.assertEqual(guest.status, 0, guest.output)
        self.assertIsNotNone(guest.when("ended 1"), guest.output)
        self.assertGreater(guest.when("ended 1") - guest.when("breaks order"), guest.timeout() + 1, "as long as it was fed")
        self.assertGreater(guest.when("survived") - guest.when("ended 1"), 2 * guest.timeout())


if __name__ == "__main__":
    unittest.main()
