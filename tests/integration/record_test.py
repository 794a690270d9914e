#!/usr/bin/env python3
"""`ivo run --record`: every frame of a search on the virtual bus, read back by tshark and by ivo load."""

import os
import re
import resource
import signal
import subprocess
import tempfile
import time
import unittest

from mission_files import IVO, MISSION, SOURCE_DIR, ivo, read_json, write_mission

LINE = re.compile(r"^\((\d{10}\.\d{6})\) vcan0 ([0-9A-F]{3})#((?:[0-9A-F]{2}){0,8})$")
ROBOT = os.path.join(SOURCE_DIR, "config", "robots", "ivo.toml")


def lines_of(path):
    with open(path, encoding="ascii") as file:
        return file.read().splitlines()


class Record(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.out = os.path.join(self.folder, "out")
        self.log = os.path.join(self.folder, "bus.log")

    def search(self, *args, log=None):
        return ivo("run", write_mission(self.folder), "--yes", "--speed", "max", "--out", self.out,
                   "--record", log or self.log, *args)

    def test_holds_each_frame_that_was_sent_or_received_once_and_in_order(self):
        done = self.search()
        self.assertEqual(done.returncode, 0, done.stderr)
        sent, received = map(int, re.search(r"(\d+) frames sent, (\d+) received", done.stdout).groups())
        lines = lines_of(self.log)
        self.assertEqual(len(lines), sent + received)
        self.assertIn(f"recorded    {sent + received} frames in {self.log}\n", done.stdout)
        before = "0000000000.000000"
        self.assertEqual(LINE.match(lines[0])[1], before, "simulated time begins at 0")
        for line in lines:
            match = LINE.match(line)
            self.assertTrue(match, line)
            self.assertLessEqual(before, match[1])
            before = match[1]

    def test_tshark_finds_no_fault_in_any_frame(self):
        self.assertEqual(self.search().returncode, 0)
        done = subprocess.run(
            ["tshark", "-r", self.log, "-d", "can.subdissector,canopen", "-T", "fields", "-E", "separator=|",
             "-e", "canopen.function_code", "-e", "_ws.malformed", "-e", "_ws.expert.severity"],
            capture_output=True, text=True, stdin=subprocess.DEVNULL, check=True)
        decoded = [line.split("|") for line in done.stdout.splitlines()]
        self.assertEqual(len(decoded), len(lines_of(self.log)))
        self.assertEqual([fields for fields in decoded if not fields[0] or fields[1] or fields[2]], [])

    def test_is_the_same_every_time_and_at_every_speed(self):
        records = []
        for speed in ("max", "max", "10"):
            done = ivo("run", write_mission(self.folder), "--yes", "--speed", speed, "--out", self.out, "--record", self.log)
            self.assertEqual(done.returncode, 0, done.stderr)
            records.append(lines_of(self.log))
        self.assertEqual(records[0], records[1])
        # A slower clock moves when an observer consents, not what a search then does.
        self.assertEqual(len({LINE.match(line)[2] for line in records[2]} ^ {LINE.match(line)[2] for line in records[0]}), 0)

    def test_changes_nothing_about_the_search(self):
        self.assertEqual(self.search().returncode, 0)
        other = os.path.join(self.folder, "other")
        self.assertEqual(ivo("run", write_mission(self.folder), "--yes", "--speed", "max", "--out", other).returncode, 0)
        self.assertEqual(read_json(self.out, "report.json"), read_json(other, "report.json"))

    def test_replaces_an_earlier_record(self):
        with open(self.log, "w", encoding="ascii") as file:
            file.write("(0000000000.000000) old 7FF#\n" * 100_000)
        self.assertEqual(self.search().returncode, 0)
        self.assertFalse([line for line in lines_of(self.log) if "old" in line])

    def test_a_place_that_cannot_be_written_is_refused_before_anything_moves(self):
        for log in (os.path.join(self.folder, "none", "bus.log"), self.folder, "/dev/full"):
            done = self.search(log=log)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertRegex(done.stderr, rf"^ivo: {re.escape(log)}: cannot be written: .*\n$")
            self.assertNotIn("searching", done.stdout)
            self.assertFalse(os.path.exists(os.path.join(self.out, "plan.json")))

    def test_a_file_that_is_no_record_is_left_alone(self):
        mission = write_mission(self.folder)
        done = self.search(log=mission)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^ivo: .*is no record of frames; expected .*\n$")
        self.assertEqual(ivo("run", mission, "--yes", "--speed", "max", "--out", self.out).returncode, 0)

    def test_a_disk_that_is_full_is_told_in_one_line_and_the_search_goes_on(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1_000_000, 1_000_000))

        done = subprocess.run([IVO, "run", write_mission(self.folder), "--yes", "--speed", "max", "--out", self.out,
                               "--record", self.log], capture_output=True, text=True, stdin=subprocess.DEVNULL, preexec_fn=limit,
                              check=False)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stderr, r"^ivo: .*bus\.log: the record ends early, \d+ frames are missing: File too large\n$")
        self.assertIn(read_json(self.out, "report.json")["end"], ("found", "paths_ended"))
        lines = lines_of(self.log)
        missing = int(re.search(r"(\d+) frames are missing", done.stderr)[1])
        sent, received = map(int, re.search(r"(\d+) frames sent, (\d+) received", done.stdout).groups())
        self.assertEqual(len(lines) + missing, sent + received)
        self.assertTrue(LINE.match(lines[-1]), "the last line is whole")

    def test_a_program_that_is_killed_leaves_whole_lines(self):
        mission = MISSION.replace('object = "drawn"', 'object = "unknown"')
        process = subprocess.Popen(
            [IVO, "run", write_mission(self.folder, mission), "--yes", "--speed", "1", "--out", self.out, "--record", self.log],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        for line in process.stdout:
            if line.startswith("searching"):
                break
        enabled = " 201#0F0000000000"  # the record is written every few hundredths of a second
        while process.poll() is None and not any(line.endswith(enabled) for line in lines_of(self.log)):
            time.sleep(0.01)
        process.kill()
        process.communicate()
        lines = lines_of(self.log)
        self.assertTrue(all(LINE.match(line) for line in lines))
        self.assertTrue(any(line.endswith(enabled) for line in lines), "enabled drives are in it")

    def test_ivo_load_finds_the_load_that_was_computed(self):
        self.assertEqual(self.search().returncode, 0)
        done = ivo("load", ROBOT, self.log)
        self.assertEqual(done.returncode, 0, done.stderr)
        worst = float(re.search(r"([\d.]+) % at worst", done.stdout)[1])
        mean, _, longest = map(float, re.search(
            r"([\d.]+) % on average, ([\d.]+) % in the worst 10 ms, ([\d.]+) % in the worst 100 ms", done.stdout).groups())
        frames = int(re.search(r"record +(\d+) frames of vcan0", done.stdout)[1])
        self.assertEqual(frames, len(lines_of(self.log)))
        self.assertLessEqual(mean, longest)
        self.assertLess(worst, 50.0)

    def test_while_it_drives_there_is_no_sdo_and_the_load_is_below_the_computed_one(self):
        self.assertEqual(self.search().returncode, 0)
        lines = lines_of(self.log)
        enabled = [number for number, line in enumerate(lines) if " 201#0F00" in line]
        driving = lines[enabled[0]:enabled[-1] + 1]
        self.assertGreater(len(driving), len(lines) / 2)
        sdo = re.compile(r" (58|60)[1-4]#")
        self.assertTrue(any(sdo.search(line) for line in lines[:enabled[0]]), "start-up is by SDO")
        self.assertEqual([line for line in driving if sdo.search(line)], [])
        log = os.path.join(self.folder, "driving.log")
        with open(log, "w", encoding="ascii") as file:
            file.write("\n".join(driving) + "\n")
        done = ivo("load", ROBOT, log)
        self.assertEqual(done.returncode, 0, done.stderr)
        least, worst = map(float, re.search(r"([\d.]+) % without stuff bits, ([\d.]+) % at worst", done.stdout).groups())
        longest = float(re.search(r"([\d.]+) % in the worst 100 ms", done.stdout)[1])
        self.assertGreater(longest, least, "every cycle is full")
        self.assertLess(longest, worst)

    def test_ivo_load_refuses_what_is_no_robot_and_no_record(self):
        empty = os.path.join(self.folder, "empty.log")
        with open(empty, "w", encoding="ascii"):
            pass
        for args, complaint in (((self.folder,), "ivo: .*"), ((ROBOT, ROBOT), "ivo: .*:1: no line of a record of frames; .*"),
                                ((ROBOT, empty), "ivo: .*empty.log: holds no frame; .*"),
                                ((ROBOT, os.path.join(self.folder, "none")), "ivo: .*none: cannot be read: .*")):
            done = ivo("load", *args)
            self.assertEqual(done.returncode, 2, args)
            self.assertRegex(done.stderr, rf"^{complaint}\n$")


if __name__ == "__main__":
    unittest.main()
