#!/usr/bin/env python3
"""The whole courtyard mission over a real vcan0: controller and drives are two processes, candump records, tshark decodes.

In lock step, so that no time is judged by the clock of a host or guest.
"""

import collections
import os
import re
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))

from mission_files import BUILD_DIR, COURTYARD, ivo, read_json  # noqa: E402

VCAN = os.path.join(SOURCE_DIR, "toolchain", "vcan")


def decoded(log):
    """What tshark makes of each frame: a list of (COB-ID, CANopen function or None, is malformed)."""
    fields = ["can.id", "canopen.cob_id", "canopen.function_code", "_ws.malformed", "_ws.expert.severity"]
    done = subprocess.run(
        ["tshark", "-r", log, "-d", "can.subdissector,canopen", "-T", "fields", "-E", "separator=,", *sum((["-e", f] for f in fields), [])],
        capture_output=True, text=True, stdin=subprocess.DEVNULL, check=True,
    )
    return [line.split(",") for line in done.stdout.splitlines()]


class MissionOnVcan(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp")
        cls.addClassCleanup(scratch.cleanup)
        cls.on_vcan = os.path.join(scratch.name, "vcan")
        cls.in_process = os.path.join(scratch.name, "process")
        cls.done = subprocess.run(
            [VCAN, os.path.join(HERE, "search_on_vcan"), BUILD_DIR, cls.on_vcan, COURTYARD],
            capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
        )
        reference = ivo("run", COURTYARD, "--yes", "--speed", "max", "--out", cls.in_process)
        assert reference.returncode == 0, reference.stderr

    def test_the_search_ends_as_in_process(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout + self.done.stderr)
        for name in ("plan.json", "report.json"):
            over_can, in_process = read_json(self.on_vcan, name), read_json(self.in_process, name)
            for document in (over_can, in_process):
                document.pop("map", None)  # as the mission was given
            self.assertEqual(over_can, in_process)

    def frames(self):
        """What the controller says it sent and received."""
        with open(os.path.join(self.on_vcan, "ivo.txt"), encoding="utf-8") as file:
            sent, received = re.search(r"(\d+) frames sent, (\d+) received", file.read()).groups()
        return int(sent) + int(received)

    def test_candump_saw_every_frame(self):
        with open(os.path.join(self.on_vcan, "bus.log"), encoding="ascii") as file:
            recorded = sum(1 for _ in file)
        # Frames that the drives send after the controller has left are in the log alone.
        self.assertGreaterEqual(recorded, self.frames())

    def test_tshark_decodes_every_frame_as_valid_canopen(self):
        frames = decoded(os.path.join(self.on_vcan, "bus.log"))
        self.assertGreaterEqual(len(frames), self.frames())
        kinds = collections.Counter()
        for number, (can_id, cob_id, function, malformed, severity) in enumerate(frames, 1):
            self.assertTrue(cob_id, f"frame {number} (id {can_id}) is not CANopen")
            self.assertFalse(malformed, f"frame {number} (id {can_id}) is malformed")
            self.assertFalse(severity, f"frame {number} (id {can_id}): tshark warns")
            kinds[function] += 1
        # NMT, SYNC, RPDO1, TPDO1, SDO both ways and heartbeats all occur.
        self.assertGreaterEqual(len(kinds), 7, kinds)


if __name__ == "__main__":
    unittest.main()
