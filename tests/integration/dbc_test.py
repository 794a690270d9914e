#!/usr/bin/python3
"""`ivo dbc`: canmatrix reads it without a complaint and decodes with it what a search did to its wheels.

By Debian's python3, for which canmatrix is packaged.
"""

import collections
import contextlib
import io
import logging
import math
import os
import tempfile
import unittest

logging.disable(logging.CRITICAL)  # of formats that canmatrix cannot read
import canmatrix.formats  # noqa: E402

logging.disable(logging.NOTSET)

from mission_files import MISSION, SOURCE_DIR, ivo, read_json, write_mission  # noqa: E402

ROBOT = os.path.join(SOURCE_DIR, "config", "robots", "ivo.toml")
WHEELS = ("FrontLeft", "FrontRight", "RearLeft", "RearRight")
RADIUS_M = 0.10  # of config/robots/ivo.toml


class Complaints(logging.Handler):
    def __init__(self):
        super().__init__(logging.WARNING)
        self.said = []

    def emit(self, record):
        self.said.append(record.getMessage())


def read_dbc(path):
    """The database, and whatever canmatrix had to say against it."""
    complaints = Complaints()
    logging.getLogger().addHandler(complaints)
    printed = io.StringIO()
    try:
        with contextlib.redirect_stdout(printed):
            database = canmatrix.formats.loadp_flat(path)
    finally:
        logging.getLogger().removeHandler(complaints)
    return database, complaints.said + printed.getvalue().splitlines() + [str(error) for error in database.load_errors]


class Dbc(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.folder = scratch.name
        cls.dbc = os.path.join(cls.folder, "ivo.dbc")
        done = ivo("dbc", ROBOT, "--out", cls.dbc)
        assert done.returncode == 0, done.stderr
        cls.database, cls.complaints = read_dbc(cls.dbc)
        cls.log = os.path.join(cls.folder, "bus.log")
        mission = MISSION.replace('object = "drawn"', 'object = "unknown"')
        done = ivo("run", write_mission(cls.folder, mission), "--yes", "--speed", "max", "--out", os.path.join(cls.folder, "out"),
                   "--record", cls.log)
        assert done.returncode == 0, done.stderr
        cls.report = read_json(cls.folder, "out", "report.json")

    def frames(self):
        """(seconds, description, data) of each frame of the record; the description is none for an unknown frame."""
        with open(self.log, encoding="ascii") as file:
            for line in file:
                stamp, _, content = line.split()
                frame_id, data = content.split("#")
                described = self.database.frame_by_id(canmatrix.ArbitrationId(int(frame_id, 16), extended=False))
                yield float(stamp.strip("()")), described, bytes.fromhex(data)

    def test_is_read_without_a_complaint(self):
        self.assertEqual(self.complaints, [])
        self.assertEqual(len(self.database.frames), 27)
        self.assertEqual([node.name for node in self.database.ecus], ["Controller", *WHEELS])

    def test_names_every_frame_of_a_search_and_its_size(self):
        seen = collections.Counter()
        for _, described, data in self.frames():
            self.assertIsNotNone(described)
            self.assertEqual(described.size, len(data), described.name)
            seen[described.name] += 1
        # Emergencies do not occur; all else does.
        self.assertEqual({frame.name for frame in self.database.frames} - set(seen), {f"EMCY_{wheel}" for wheel in WHEELS})

    def test_periods_are_those_of_the_record(self):
        stamps = collections.defaultdict(list)
        for at, described, _ in self.frames():
            stamps[described.name].append(at)
        for frame in self.database.frames:
            if frame.cycle_time:
                gaps = sorted(after - before for before, after in zip(stamps[frame.name], stamps[frame.name][1:]))
                self.assertAlmostEqual(1000 * gaps[len(gaps) // 2], frame.cycle_time, places=3, msg=frame.name)

    def wheel_speeds(self):
        """For each SYNC of the search the four target speeds before it, in rad/s."""
        speeds, cycles = {}, []
        for _, described, data in self.frames():
            if described.name == "SYNC":
                cycles.append(dict(speeds))
            elif described.name.startswith("RPDO1_"):
                speeds[described.name[len("RPDO1_"):]] = float(described.decode(data)["TargetWheelSpeed"].phys_value)
        return cycles

    def test_decoded_wheel_speeds_add_up_to_the_way_that_was_driven(self):
        distance = 0.0
        for speeds in self.wheel_speeds():
            if len(speeds) == 4:
                fl, fr, rl, rr = (speeds[wheel] for wheel in WHEELS)
                vx = RADIUS_M / 4 * (fl + fr + rl + rr)
                vy = RADIUS_M / 4 * (-fl + fr + rl - rr)
                distance += math.hypot(vx, vy) * 0.002
        driven = self.report["agents"][0]["distance_m"]
        self.assertGreater(driven, 5.0)
        self.assertAlmostEqual(distance, driven, delta=0.02 * driven + 0.05)

    def test_decoded_wheel_angles_end_where_the_report_does(self):
        first, last = {}, {}
        for _, described, data in self.frames():
            if described.name.startswith("TPDO1_"):
                angle = float(described.decode(data)["WheelAngle"].phys_value)
                first.setdefault(described.name[len("TPDO1_"):], angle)
                last[described.name[len("TPDO1_"):]] = angle
        fl, fr, rl, rr = (last[wheel] - first[wheel] for wheel in WHEELS)
        moved = (RADIUS_M / 4 * (fl + fr + rl + rr), RADIUS_M / 4 * (-fl + fr + rl - rr))
        x, y = self.report["agents"][0]["final_position_m"]
        self.assertAlmostEqual(moved[0], x - 1.5, delta=0.02)  # the robot starts at (1.5, 1.5), heading along x
        self.assertAlmostEqual(moved[1], y - 1.5, delta=0.02)

    def test_words_say_what_the_drives_went_through(self):
        states, commands, enabled = [], [], collections.Counter()
        for _, described, data in self.frames():
            values = described.decode(data)
            if described.name == "Heartbeat_RearRight":
                state = values["NmtState"].named_value
                if states[-1:] != [state]:
                    states.append(state)
            elif described.name == "NMT":
                commands.append(values["Command"].named_value)
            elif described.name.startswith("TPDO1_"):
                enabled[described.name] += values["OperationEnabled"].raw_value
        self.assertEqual(states, ["boot-up", "pre-operational", "operational"])
        self.assertEqual(set(commands), {"reset communication", "start"})
        self.assertEqual(len([wheel for wheel in enabled if enabled[wheel] > 1000]), 4)

    def test_sdo_transfers_are_told_apart(self):
        writes, answers = [], collections.Counter()
        for _, described, data in self.frames():
            values = described.decode(data)
            if described.name == "SDO_Request_FrontLeft" and values["Service"].named_value == "download":
                writes.append((values["DownloadIndex"].raw_value, values["Data"].raw_value))
            elif described.name == "SDO_Answer_FrontLeft":
                answers[values["Service"].named_value] += 1
        self.assertIn((0x60FF, 0), writes)
        self.assertEqual(answers["download"], len(writes))
        self.assertEqual(answers["abort"], 0)

    def test_the_shared_layout_is_described_as_well(self):
        robot = os.path.join(self.folder, "shared.toml")
        with open(ROBOT, encoding="utf-8") as file:
            text = file.read()
        changed = text.replace('pdo_layout = "own"', 'pdo_layout = "shared"').replace("cycle_ms = 2", "cycle_ms = 1")
        self.assertNotEqual(text, changed)
        with open(robot, "w", encoding="utf-8") as file:
            file.write(changed)
        done = ivo("dbc", robot)
        self.assertEqual(done.returncode, 0, done.stderr)
        path = os.path.join(self.folder, "shared.dbc")
        with open(path, "w", encoding="utf-8") as file:
            file.write(done.stdout)
        database, complaints = read_dbc(path)
        self.assertEqual(complaints, [])
        pair = database.frame_by_name("RPDO2_RearLeft_RearRight")
        self.assertEqual((pair.arbitration_id.id, pair.size, pair.cycle_time), (0x303, 8, 1))
        values = pair.decode((652).to_bytes(4, "little") + (-652).to_bytes(4, "little", signed=True))
        self.assertAlmostEqual(float(values["TargetWheelSpeed_RearLeft"].phys_value), 652 / 651.8986469044033)
        self.assertAlmostEqual(float(values["TargetWheelSpeed_RearRight"].phys_value), 652 / 651.8986469044033)
        self.assertEqual(database.frame_by_name("RPDO1_RearLeft").size, 2)

    def test_wrong_input_is_refused_in_one_line(self):
        for args in (("dbc",), ("dbc", os.path.join(self.folder, "none.toml")), ("dbc", ROBOT, "--out", self.folder)):
            done = ivo(*args)
            self.assertEqual(done.returncode, 2, args)
            self.assertRegex(done.stderr, r"^(ivo: )?.+\n$")
            self.assertEqual(done.stderr.count("\n"), 1)


class TheCheckItself(unittest.TestCase):
    def test_hears_a_complaint_about_a_line_that_is_wrong(self):
        with tempfile.NamedTemporaryFile("w", suffix=".dbc") as file:
            file.write('VERSION ""\n\nBU_: A\n\nBO_ 1 ONE: 1 A\n SG_ Broken : x|8@1+ (1,0) [0|0] "" A\n')
            file.flush()
            self.assertTrue(read_dbc(file.name)[1])


if __name__ == "__main__":
    unittest.main()
