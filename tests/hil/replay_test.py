#!/usr/bin/env python3
"""A record of the virtual bus, played by canplayer onto a real vcan, is seen there by candump frame by frame."""

import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))

from mission_files import ivo, write_mission  # noqa: E402

FRAMES = 5000  # of start-up and the beginning of the search


def lines_of(path):
    with open(path, encoding="ascii") as file:
        return file.read().splitlines()


class Replay(unittest.TestCase):
    def test_candump_sees_what_canplayer_reads_from_a_record(self):
        with tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp") as folder:
            log, seen = os.path.join(folder, "bus.log"), os.path.join(folder, "seen.log")
            done = ivo("run", write_mission(folder), "--yes", "--speed", "max", "--out", os.path.join(folder, "out"), "--record", log)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines = lines_of(log)[:FRAMES]
            self.assertEqual(len(lines), FRAMES)
            with open(log, "w", encoding="ascii") as file:
                file.write("\n".join(lines) + "\n")
            done = subprocess.run([os.path.join(SOURCE_DIR, "toolchain", "vcan"), os.path.join(HERE, "replay_on_vcan"), log, seen],
                                  capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            played = [line.split()[1:] for line in lines_of(seen)]
            self.assertEqual(played, [["vcan1", line.split()[2]] for line in lines])


if __name__ == "__main__":
    unittest.main()
