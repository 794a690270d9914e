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


# Function code of CiA 301's predefined connection set, as tshark has it, to the size of its frames.
SIZES = {0x0: {2}, 0x1: {0}, 0x3: {6}, 0x4: {6}, 0xB: {8}, 0xC: {8}, 0xE: {1}}


def faults(log):
    """(number of frames, what is wrong with each that is not valid CANopen of this robot) by tshark."""
    fields = ["frame.number", "can.len", "canopen.function_code", "_ws.malformed", "_ws.expert.severity", "_ws.col.Info"]
    done = subprocess.run(
        ["tshark", "-r", log, "-d", "can.subdissector,canopen", "-T", "fields", "-E", "separator=|",
         *sum((["-e", field] for field in fields), [])],
        capture_output=True, text=True, stdin=subprocess.DEVNULL, check=True,
    )
    count, wrong, kinds = 0, [], set()
    for line in done.stdout.splitlines():
        number, size, function, malformed, severity, info = line.split("|", 5)
        count += 1
        code = int(function, 16) if function else None
        kinds.add(code)
        if malformed or severity or code not in SIZES or int(size) not in SIZES[code] or "Unknown" in info:
            wrong.append(f"frame {number}: {info} ({size} bytes)")
    return count, wrong, kinds


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
            self.assertEqual(read_json(self.on_vcan, name), read_json(self.in_process, name))

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

    def contents_by_id(self, name):
        """For each COB-ID the data of its frames, in order."""
        data = collections.defaultdict(list)
        with open(os.path.join(self.on_vcan, name), encoding="ascii") as file:
            for line in file:
                frame_id, content = line.split()[2].split("#")
                data[frame_id].append(content)
        return data

    def test_the_controllers_own_record_holds_what_candump_saw(self):
        recorded, seen = self.contents_by_id("record.log"), self.contents_by_id("bus.log")
        self.assertEqual(sum(map(len, recorded.values())), self.frames())
        self.assertEqual(set(recorded), set(seen))
        for frame_id, data in recorded.items():
            # The drives' first boot-up message comes before the controller is there.
            before = len(seen[frame_id]) > len(data) and frame_id in ("701", "702", "703", "704")
            self.assertEqual(data, seen[frame_id][before:before + len(data)], frame_id)

    def test_tshark_decodes_every_frame_as_valid_canopen(self):
        count, wrong, kinds = faults(os.path.join(self.on_vcan, "bus.log"))
        self.assertGreaterEqual(count, self.frames())
        self.assertEqual(wrong[:5], [])
        self.assertEqual(kinds, set(SIZES), "NMT, SYNC, TPDO1, RPDO1, SDO both ways and heartbeats all occur")


class FixedMappingOnVcan(unittest.TestCase):
    """Drives whose PDO mappings cannot be written: they are taken as they are, and the robot drives the same way."""

    def test_the_search_ends_as_with_drives_that_are_mapped(self):
        with tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp") as scratch:
            on_vcan, in_process = os.path.join(scratch, "vcan"), os.path.join(scratch, "process")
            eds = os.path.join(SOURCE_DIR, "config", "eds", "fixed_mapping_drive.eds")
            done = subprocess.run(
                [VCAN, os.path.join(HERE, "search_on_vcan"), BUILD_DIR, on_vcan, COURTYARD, "--eds", eds],
                capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
            )
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(ivo("run", COURTYARD, "--yes", "--speed", "max", "--out", in_process).returncode, 0)
            self.assertEqual(read_json(on_vcan, "report.json"), read_json(in_process, "report.json"))
            with open(os.path.join(on_vcan, "bus.log"), encoding="ascii") as file:
                log = file.read()
            self.assertIn(" 501#", log)
            self.assertIn(" 381#", log)
            self.assertNotIn(" 201#", log)


class TheCheckItself(unittest.TestCase):
    def test_refuses_what_is_no_valid_canopen(self):
        for frame in ("7FF#11", "6E0#1122", "001#1122", "181#0102", "701#", "601#FF", "080#01"):
            with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
                log.write(f"(1.000000) vcan0 080#\n(1.001000) vcan0 {frame}\n")
                log.flush()
                count, wrong, _ = faults(log.name)
                self.assertEqual((count, len(wrong)), (2, 1), f"{frame}: {wrong}")


if __name__ == "__main__":
    unittest.main()
