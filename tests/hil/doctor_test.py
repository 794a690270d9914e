#!/usr/bin/env python3
"""`ivo doctor` on a PREEMPT_RT kernel with a CAN controller and a watchdog: what is well is found to be, and the commands that it proposes
mend what is not. Times are those of toolchain/rt, a model of time."""

import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))

from json_schema import schema_faults  # noqa: E402
from mission_files import BUILD_DIR, read_json  # noqa: E402

RT = os.path.join(SOURCE_DIR, "toolchain", "rt")
CAN = ("interface", "link", "bit rate", "queue length", "after bus-off", "controller state", "error counters")


class Doctor(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp")
        cls.addClassCleanup(scratch.cleanup)
        cls.out = scratch.name
        brought = [f"{BUILD_DIR}/ivo:/ivo", f"{BUILD_DIR}/ivo-drives:/ivo-drives", f"{HERE}/doctor_in_guest:/doctor_in_guest"]
        files = [word for name in brought for word in ("-f", name)]
        done = subprocess.run([RT, "-d", "kvaser", "-d", "watchdog", "-o", cls.out, *files, "sh", "/doctor_in_guest"], capture_output=True,
                              text=True, stdin=subprocess.DEVNULL, check=False)
        cls.statuses = dict(line.split("|") for line in done.stdout.splitlines() if "|" in line)
        cls.errors = done.stderr

    def path(self, name):
        return os.path.join(self.out, name)

    def said(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def states(self, name):
        self.assertIn(name, self.statuses, self.errors)
        return {check["check"]: check["state"] for check in read_json(self.path(name + ".json"))["checks"]}

    def test_the_kernel_and_what_it_grants_are_well(self):
        states = self.states("good")
        for check in ("real-time kernel", "clock source", "real-time priority", "real-time share", "memory lock limit", "free memory",
                      "swap", "device", "write and sync", "measured", "late by", "too late", "page faults"):
            self.assertEqual(states[check], "ok", self.said("good"))
        self.assertEqual(self.statuses["good"], "0", self.said("good"))

    def test_a_real_time_thread_wakes_in_time_without_a_page_fault(self):
        self.states("good")
        self.assertEqual(schema_faults(self.path("good.json"), "doctor"), [])
        latency = read_json(self.path("good.json"))["latency"]
        self.assertTrue(latency["real_time"] and latency["locked_memory"], latency)
        self.assertEqual([latency[key] for key in ("wake_ups", "lost_periods", "over_budget", "page_faults")], [999, 0, 0, 0])

    def test_an_interface_that_is_set_up_badly_is_mended_by_typing_the_remedies(self):
        bad = self.states("bad")
        self.assertEqual(self.statuses["bad"], "1", self.said("bad"))
        self.assertEqual({bad["link"], bad["bit rate"]}, {"fault"})
        self.assertEqual({bad["queue length"], bad["after bus-off"]}, {"warning"})
        self.assertEqual(bad["answer"], "not checked")
        self.assertEqual(len(self.said("commands").splitlines()), 4)
        self.assertNotIn("RTNETLINK", self.said("typed"))
        good = self.states("good")
        self.assertEqual({good[check] for check in CAN}, {"ok"}, self.said("good"))
        self.assertEqual(good["answer"], "ok", self.said("good"))

    def test_beside_a_controller_it_listens(self):
        self.assertEqual(self.states("beside")["controller"], "ok")
        self.assertIn("one is running (heard a heartbeat of node 127): nobody was asked anything", self.said("beside"))

    def test_a_bus_without_drives_is_a_fault(self):
        self.assertEqual(self.states("empty")["answer"], "fault", self.said("empty"))
        self.assertEqual(self.statuses["empty"], "1")
        self.assertIn("none of the four: node-ids 1, 2, 3, 4", self.said("empty"))


if __name__ == "__main__":
    unittest.main()
