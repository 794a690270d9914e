#!/usr/bin/env python3
"""`ivo doctor` from outside, on this machine, whatever it is: what it says holds together, and wrong input is refused."""

import os
import re
import resource
import subprocess
import tempfile
import unittest

from json_schema import schema_faults
from mission_files import IVO, ivo, read_json
from terminals import open_terminal

LINE = re.compile(r"^  (ok|warning|fault|not checked) +(\S.*?)  +(\S.*)$", re.MULTILINE)
REMEDY = re.compile(r"^ {32}-> \S.*$", re.MULTILINE)
SUM = re.compile(r"\((\d+) ok, (\d+) warnings?, (\d+) faults?, (\d+) not checked\)\n$")


class Doctor(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def examine(self, *arguments):
        done = ivo("doctor", "--out", self.folder, *arguments)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertEqual(done.stderr, "")
        return done

    def test_every_check_has_a_state_and_what_is_wrong_a_remedy(self):
        done = self.examine("--latency", "0")
        checks = LINE.findall(done.stdout)
        wrong = [check for check in checks if check[0] in ("warning", "fault")]
        self.assertEqual(len(REMEDY.findall(done.stdout)), len(wrong), done.stdout)
        ok, warnings, faults, not_checked = map(int, SUM.search(done.stdout).groups())
        self.assertEqual(ok + warnings + faults + not_checked, len(checks), done.stdout)
        self.assertEqual(done.returncode, 1 if faults else 0)
        names = [check[1] for check in checks]
        for name in ("real-time kernel", "clock source", "real-time priority", "memory lock limit", "swap", "interface", "device",
                     "write and sync", "late by"):
            self.assertIn(name, names)
        self.assertEqual(os.listdir(self.folder), [])

    def test_without_an_interface_bus_and_drives_are_not_checked(self):
        done = self.examine("--latency", "0")
        for check in ("interface", "answer"):
            self.assertRegex(done.stdout, rf"(?m)^  not checked  {check} +no interface was named: --can can0$")

    def test_an_interface_that_is_missing_is_a_fault(self):
        done = self.examine("--latency", "0", "--can", "can77")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"(?m)^  fault +interface +can77 is not there$")
        self.assertRegex(done.stdout, r"(?m)^  not checked  answer +can77 cannot be used")

    def test_wake_ups_are_measured_and_drawn(self):
        path = os.path.join(self.folder, "doctor.json")
        done = self.examine("--latency", "0.2", "--json", path)
        document = read_json(path)
        self.assertEqual(schema_faults(path, "doctor"), [])
        latency = document["latency"]
        self.assertEqual(latency["period_us"], 2000)
        self.assertLessEqual(latency["wake_ups"], 100)
        self.assertGreaterEqual(latency["wake_ups"] + latency["lost_periods"], 99)
        order = [latency[name + "_us"] for name in ("least", "median", "p99", "p999", "most")]
        self.assertEqual(order, sorted(order))
        self.assertEqual(sum(bin["count"] for bin in latency["histogram"]), latency["wake_ups"])
        drawn = re.findall(r"(?m)^ +(\d+) +(\d+) +(\d+)  [#!]*$", done.stdout)
        self.assertEqual([tuple(map(int, bar)) for bar in drawn],
                         [(bin["from_us"], bin["to_us"], bin["count"]) for bin in latency["histogram"]])
        self.assertIn("on CLOCK_MONOTONIC of this host", done.stdout)

    def test_the_file_says_what_the_screen_says(self):
        path = os.path.join(self.folder, "doctor.json")
        done = self.examine("--latency", "0", "--json", path)
        document = read_json(path)
        self.assertEqual(schema_faults(path, "doctor"), [])
        self.assertIsNone(document["latency"])
        self.assertEqual(LINE.findall(done.stdout), [(c["state"], c["check"], c["found"]) for c in document["checks"]])
        for check in document["checks"]:
            self.assertEqual(check["remedy"] is not None, check["state"] in ("warning", "fault"), check)

    def test_without_privileges_an_ordinary_thread_is_measured_and_that_is_said(self):
        # Only who is privileged can give a privilege up.
        lowered = ["setpriv", "--bounding-set=-sys_nice,-ipc_lock"]
        may = subprocess.run([*lowered, "true"], capture_output=True, check=False).returncode == 0
        done = subprocess.run([*(lowered if may else []), IVO, "doctor", "--latency", "0.1", "--out", self.folder], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, check=False, preexec_fn=little_allowed)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, r"(?m)^  fault +real-time priority +SCHED_FIFO priority 80 is not granted: .*RLIMIT_RTPRIO 0")
        self.assertRegex(done.stdout, r"(?m)^  fault +memory lock limit +\d MiB; expected at least")
        self.assertIn("an ordinary thread, for SCHED_FIFO was refused, without locked memory", done.stdout)

    def test_colours_are_for_terminals_alone(self):
        self.assertNotIn("\033", self.examine("--latency", "0").stdout)
        for settings, coloured in (({"TERM": "xterm"}, True), ({"TERM": "xterm", "NO_COLOR": "1"}, False), ({"TERM": "dumb"}, False)):
            near_end, far_end = open_terminal()
            with open(near_end, "rb", buffering=0) as near:
                process = subprocess.Popen([IVO, "doctor", "--latency", "0", "--out", self.folder], stdout=far_end,
                                           stdin=subprocess.DEVNULL, env=settings)
                os.close(far_end)
                shown = b""
                try:
                    while piece := near.read(65536):
                        shown += piece
                except OSError:  # the far end is closed
                    pass
                self.assertIn(process.wait(), (0, 1))
            self.assertEqual(b"\033[32mok" in shown, coloured, settings)
            self.assertIn(b"Kernel", shown)

    def test_what_makes_no_sense_is_refused_in_one_line(self):
        a_file = os.path.join(self.folder, "file")
        with open(a_file, "w", encoding="utf-8"):
            pass
        for arguments, words in (
            (("--robot", "/no/such/file.toml"), "/no/such/file.toml"),
            (("--priority", "0"), "expected a whole number, 1 to 99"),
            (("--priority", "100"), "expected a whole number, 1 to 99"),
            (("--cpu", "-1"), "expected a whole number, 0 to 8191"),
            (("--cpu", "one"), "expected a whole number, 0 to 8191"),
            (("--latency", "-1"), "expected a number, 0 to 86400"),
            (("--latency", "nan"), "expected a number, 0 to 86400"),
            (("--can", ""), "is empty; expected a name"),
            (("--out", a_file), "is no folder"),
            (("--out", os.path.join(a_file, "below")), "is no folder"),
            (("--json", "/no/such/folder/x.json"), "/no/such/folder/x.json"),
            (("now",), "now"),
        ):
            done = ivo("doctor", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertRegex(done.stderr, rf"^ivo: .*({re.escape(words)}).*\n$", arguments)
            self.assertEqual(done.stdout, "")


def little_allowed():
    """As an ordinary user has it: no real-time priority, 8 MiB of locked memory."""
    for limit, value in ((resource.RLIMIT_RTPRIO, 0), (resource.RLIMIT_MEMLOCK, 8 << 20)):
        most = resource.getrlimit(limit)[1]
        value = value if most == resource.RLIM_INFINITY else min(value, most)
        resource.setrlimit(limit, (value, value))


if __name__ == "__main__":
    unittest.main()
