#!/usr/bin/env python3
"""Searches in real time over vcan0 on a PREEMPT_RT kernel: 500 Hz is kept, and every stop is in time, by the kernel's own stamps.

Controller and drives are two processes in toolchain/rt, whose clock counts instructions: all figures are of a model of time, the same on
every machine, and say what software and kernel do, not what a computer's hardware adds.
"""

import os
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "rt"))

import recording  # noqa: E402
from mission_files import BUILD_DIR, MISSION, read_json, write_mission  # noqa: E402

RT = os.path.join(SOURCE_DIR, "toolchain", "rt")
FIGURES = os.path.join(SOURCE_DIR, "build", "log", "real_time.txt")
NODES = (1, 2, 3, 4)
SILENT = 4  # rear right

# config/rates.hpp
CYCLE_US = 2_000
HEARTBEAT_US = 50_000
HEARTBEAT_TIMEOUT_US = 150_000
FEEDBACK_TIMEOUT_US = 10_000
TICK_US = 1_000  # of the simulated drives
STEADY_US = 3_000_000
BIT_RATE = 1_000_000


def quick_stop_counts(robot):
    """Deceleration of a drive's quick stop, counts/s2 at the motor."""
    drive = robot["drive"]["front_left"]
    at_wheel = robot["limits"]["quick_stop_mps2"] / robot["base"]["wheel_radius_m"]
    return at_wheel * drive["gear_ratio"] * drive["velocity_per_radps"]


class Drive:
    """What the drives' own log says of one node."""

    LINE = re.compile(r"t_s=([\d.]+) node=(\d+) nmt=(\w+) power=(\w+) velocity=(-?\d+) wheel=(\w+)")

    def __init__(self, text, node):
        self.changes = [
            (round(float(at) * 1e6), nmt, power, int(velocity), wheel)
            for at, number, nmt, power, velocity, wheel in self.LINE.findall(text)
            if int(number) == node
        ]

    def quick_stop(self):
        """(time, velocity) at its last quick stop."""
        return next((at, velocity) for at, _, power, velocity, _ in reversed(self.changes) if power == "quick_stop_active")

    def at_rest(self):
        """Since when it rests, for good."""
        rests = self.changes[-1][4] == "rests"
        since = None
        for at, _, _, _, wheel in reversed(self.changes):
            if wheel != "rests":
                break
            since = at
        return since if rests else None


class Scenario:
    def __init__(self, folder):
        self.folder = folder
        self.frames = recording.read(os.path.join(folder, "bus.log"))
        log = self.text("drives.log")
        self.drives = {node: Drive(log, node) for node in NODES}
        self.status = int(self.text("status"))

    def text(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def from_master(self):
        return [f for f in self.frames if 0x200 < f.id <= 0x204 or f.id == 0x700 + recording.MASTER]

    def speed_before(self, node, at_us):
        """Counts a second, over the 20 ms before."""
        last = [s for s in recording.statuses(self.frames, node) if at_us - 21_000 <= s.at_us <= at_us]
        return (last[-1].position - last[0].position) / (last[-1].at_us - last[0].at_us) * 1e6

    def positions(self, node, begin_us, end_us=None):
        """[(time, counts)] by whatever tells them: TPDO1, or an answer to whoever read 6064h."""
        return [
            (f.at_us, int.from_bytes(f.data[-4:], "little", signed=True))
            for f in self.frames
            if (f.id == 0x180 + node or (f.id == 0x580 + node and f.data[:4] == b"\x43\x64\x60\x00"))
            and begin_us <= f.at_us and (end_us is None or f.at_us < end_us)
        ]


class RealTime(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp")
        cls.addClassCleanup(scratch.cleanup)
        mission = os.path.join(scratch.name, "mission")
        os.mkdir(mission)
        # Nobody finds the object: the wheels turn until something happens. At this heading all four do.
        write_mission(mission, MISSION.replace(f"{SOURCE_DIR}/config/robots/", "").replace('"drawn"', '"unknown"')
                      .replace("generations = 5", "generations = 1").replace("start_m = [1.5, 1.5]", "start_m = [1.5, 1.5]\nheading_deg = 20.0"))
        with open(os.path.join(SOURCE_DIR, "config", "robots", "ivo.toml"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(mission, "ivo.toml"), "w", encoding="utf-8") as file:
            file.write(text)
        cls.ramp = quick_stop_counts(tomllib.loads(text))
        results = os.path.join(scratch.name, "results")
        brought = [("ivo", os.path.join(BUILD_DIR, "ivo")), ("ivo-drives", os.path.join(BUILD_DIR, "ivo-drives")), ("mission", mission),
                   ("faults", os.path.join(SOURCE_DIR, "tests", "rt", "faults_in_guest"))]
        done = subprocess.run(
            [RT, "-t", "2400", "-o", results, *sum((["-f", f"{path}:/given/{name}"] for name, path in brought), []), "sh", "/given/faults"],
            capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
        )
        if done.returncode != 0:
            raise RuntimeError(f"status {done.returncode}: {done.stdout}{done.stderr}")
        cls.scenarios = {name: Scenario(os.path.join(results, name)) for name in ("crash", "suspended", "heartbeat", "silence")}
        cls.figures = []

    @classmethod
    def tearDownClass(cls):
        os.makedirs(os.path.dirname(FIGURES), exist_ok=True)
        with open(FIGURES, "w", encoding="utf-8") as file:
            file.write("A model of time (instruction-counting clock, PREEMPT_RT kernel): no computer's hardware is in it.\n")
            file.writelines(line + "\n" for line in cls.figures)
        print(*cls.figures, sep="\n", file=sys.stderr)

    def say(self, text):
        self.figures.append(text)

    # 500 Hz

    def steady(self):
        """The frames of the last seconds before the controller is killed, by cycles."""
        scenario = self.scenarios["crash"]
        end = scenario.from_master()[-1].at_us
        parts = recording.cycles([f for f in scenario.frames if end - STEADY_US <= f.at_us <= end])[1:-1]
        self.assertGreater(len(parts), 0.99 * STEADY_US / CYCLE_US)
        return parts

    def test_the_period_is_kept(self):
        syncs = [part[0].at_us for part in self.steady()]
        periods = [b - a for a, b in zip(syncs, syncs[1:])]
        self.say(f"SYNC period over {len(periods)} cycles: {min(periods)} to {max(periods)} us")
        self.assertGreater(min(periods), CYCLE_US - CYCLE_US / 8)
        self.assertLess(max(periods), CYCLE_US + CYCLE_US / 8)
        # Each on its own multiple of the period: no drift, none skipped.
        phases = [at - syncs[0] - i * CYCLE_US for i, at in enumerate(syncs)]
        self.assertLess(max(map(abs, phases)), CYCLE_US / 8)

    def test_no_period_is_skipped_from_power_to_the_fault(self):
        for name, scenario in self.scenarios.items():
            enabled = [c.at_us for c in recording.commands(scenario.frames, 1) if c.controlword == recording.ENABLE_OPERATION]
            syncs = [f.at_us for f in scenario.frames if f.id == recording.SYNC and enabled[0] <= f.at_us <= enabled[-1]]
            longest = max(b - a for a, b in zip(syncs, syncs[1:]))
            self.assertLess(longest, 1.5 * CYCLE_US, name)

    def test_no_frame_is_lost_and_all_come_within_their_cycle(self):
        latest = 0
        for part in self.steady():
            ids = sorted(f.id for f in part if f.id < 0x700)
            self.assertEqual(ids, [0x080, 0x181, 0x182, 0x183, 0x184, 0x201, 0x202, 0x203, 0x204], part[0].at_us)
            latest = max(latest, max(f.at_us for f in part if 0x180 < f.id < 0x190) - part[0].at_us)
        self.say(f"last TPDO1 after its SYNC: at most {latest} us, on a bus without wire time")
        self.assertLess(latest, CYCLE_US / 2)
        for name, scenario in self.scenarios.items():
            self.assertIn(" 0 lost in receiving, 0 in sending", scenario.text("drives.txt"), name)

    def test_the_load_leaves_half_of_the_bus(self):
        frames = [f for part in self.steady() for f in part if f.id < 0x580 or f.id > 0x67F]
        seconds = (frames[-1].at_us - frames[0].at_us) / 1e6
        measured = sum(map(recording.wire_bits, frames)) / seconds / BIT_RATE
        worst = sum(map(recording.worst_bits, frames)) / seconds / BIT_RATE
        self.say(f"load at 1 Mbit/s, frames as recorded: {100 * measured:.1f} %; were each stuffed as badly as its length allows: {100 * worst:.1f} %")
        self.assertLess(worst, 0.5)
        self.assertLess(measured, worst)
        self.assertEqual([f for part in self.steady() for f in part if 0x580 <= f.id <= 0x67F], [], "SDO while moving")

    # The controller is gone: killed, or stopped and continued

    def check_stop_without_master(self, name):
        scenario = self.scenarios[name]
        sent = scenario.from_master()
        gone = next((a.at_us for a, b in zip(sent, sent[1:]) if b.at_us - a.at_us > HEARTBEAT_TIMEOUT_US), sent[-1].at_us)
        heartbeat = max(at for at in recording.heartbeats(scenario.frames, recording.MASTER) if at <= gone)
        for node in NODES:
            speed = scenario.speed_before(node, gone)
            self.assertGreater(abs(speed), 500, f"{name}: wheel {node} was to be turning")
            begin = next(at for at, code in recording.emergencies(scenario.frames, node) if code == recording.HEARTBEAT_LOST and at > gone)
            self.assertGreater(begin - heartbeat, HEARTBEAT_TIMEOUT_US - TICK_US)
            self.assertLessEqual(begin - gone, HEARTBEAT_TIMEOUT_US + CYCLE_US)

            # By its positions: the ramp begins then and not later, and ends in standstill.
            after = scenario.positions(node, begin)
            rest = next(at for at, counts in after if counts == after[-1][1])
            before = max(scenario.positions(node, 0, begin))
            ramp_us = abs(speed) / self.ramp * 1e6
            self.assertLessEqual(rest - begin, ramp_us + 2 * CYCLE_US + TICK_US)
            self.assertGreater(after[-1][0] - rest, 200_000, "watched at standstill")
            travelled = abs(after[-1][1] - before[1]) - abs(speed) * (begin - before[0]) / 1e6
            self.assertLessEqual(travelled, speed**2 / (2 * self.ramp) + abs(speed) * 2 * CYCLE_US / 1e6 + 2)
            # And by its own log.
            stop_at, stop_speed = scenario.drives[node].quick_stop()
            self.assertLessEqual(scenario.drives[node].at_rest() - stop_at, abs(stop_speed) / self.ramp * 1e6 + 2 * TICK_US + CYCLE_US)
            self.say(f"{name}, wheel {node}: {abs(speed):.0f} counts/s; last frame to ramp {(begin - gone) / 1e3:.1f} ms, to standstill "
                     f"{(rest - gone) / 1e3:.1f} ms")
        return scenario, gone

    def test_a_controller_that_is_killed_stops_all_wheels(self):
        scenario, gone = self.check_stop_without_master("crash")
        self.assertEqual(scenario.status, 137)
        self.assertEqual([f for f in scenario.from_master() if f.at_us > gone], [])

    def test_a_controller_that_is_suspended_stops_all_wheels_and_moves_none_when_it_goes_on(self):
        scenario, gone = self.check_stop_without_master("suspended")
        again = next(f.at_us for f in scenario.from_master() if f.at_us > gone)
        for node in NODES:
            for command in recording.commands(scenario.frames, node):
                if command.at_us >= again:
                    self.assertEqual(command.target, 0)
                    self.assertNotEqual(command.controlword & recording.ENABLE_OPERATION, recording.ENABLE_OPERATION)
            positions = {counts for _, counts in scenario.positions(node, again)}
            self.assertEqual(len(positions), 1, f"wheel {node} moved again")
        self.assertEqual(scenario.status, 1)
        self.assertEqual(read_json(scenario.folder, "out", "report.json")["end"], "fault")

    # A drive is gone

    def check_group_stop(self, name, last, limit_us):
        """`last`: the drive's last sign of life. All four are told to stop in one cycle, within `limit_us`, and stand within their ramp."""
        scenario = self.scenarios[name]
        driving = {node: [c for c in recording.commands(scenario.frames, node) if c.at_us <= last][-1] for node in NODES}
        for node, command in driving.items():
            self.assertEqual(command.controlword, recording.ENABLE_OPERATION, node)
        stop = next(part for part in recording.cycles(scenario.frames) if part[0].at_us > last and
                    any(f.id == 0x201 and f.data[0] != recording.ENABLE_OPERATION for f in part))
        for node in NODES:
            (command,) = recording.commands(stop, node)
            self.assertEqual((command.controlword, command.target), (recording.QUICK_STOP, 0), f"{name}, drive {node}")
            self.assertLessEqual(command.at_us - last, limit_us)
        told = stop[0].at_us
        self.say(f"{name}: last sign of drive {SILENT} to quick stop of all four {(told - last) / 1e3:.1f} ms")
        for node in NODES:
            stop_at, speed = scenario.drives[node].quick_stop()
            self.assertLessEqual(scenario.drives[node].at_rest() - stop_at, abs(speed) / self.ramp * 1e6 + 2 * TICK_US + CYCLE_US, node)
            if name == "heartbeat" or node != SILENT:
                begin = told + CYCLE_US  # a command acts with the SYNC after it
                speed = scenario.speed_before(node, told)
                self.assertGreater(abs(speed), 500, f"{name}: wheel {node} was to be turning")
                after = scenario.positions(node, begin)
                rest = next(at for at, counts in after if counts == after[-1][1])
                self.assertLessEqual(rest - begin, abs(speed) / self.ramp * 1e6 + 2 * CYCLE_US + TICK_US, node)
                self.say(f"{name}, wheel {node}: {abs(speed):.0f} counts/s; quick stop to standstill {(rest - told) / 1e3:.1f} ms")
        # By the drives' own log; to the one that is gone NMT says so too, which acts before the next SYNC does.
        began = [scenario.drives[node].quick_stop()[0] for node in NODES]
        self.assertLessEqual(max(began) - min(began), CYCLE_US + TICK_US)
        self.assertEqual(scenario.status, 1)
        report = read_json(scenario.folder, "out", "report.json")
        self.assertEqual(report["end"], "fault")
        self.assertIn(f"drive {SILENT}", report["reason"])

    def test_a_drive_without_heartbeat_stops_all_four(self):
        last = recording.heartbeats(self.scenarios["heartbeat"].frames, SILENT)
        gap = next((a for a, b in zip(last, last[1:]) if b - a > 2 * HEARTBEAT_US), last[-1])
        # Heard a cycle after it came, missed a cycle after it was due, both by the loop's clock.
        self.check_group_stop("heartbeat", gap, HEARTBEAT_TIMEOUT_US + 2 * CYCLE_US + CYCLE_US / 8)

    def test_a_drive_that_falls_silent_stops_all_four(self):
        frames = self.scenarios["silence"].frames
        last = recording.statuses(frames, SILENT)[-1].at_us
        self.check_group_stop("silence", last, CYCLE_US + FEEDBACK_TIMEOUT_US + 2 * CYCLE_US)


class Recordings(unittest.TestCase):
    def test_bits_are_counted_as_they_are_on_the_wire(self):
        text = [bit for byte in b"123456789" for bit in recording.to_bits(byte, 8)]
        self.assertEqual(recording.crc15(text), 0x059E, "the check value of CRC-15/CAN")
        # 34 zeros get a stuff bit after each five.
        self.assertEqual(recording.wire_bits(recording.Frame(0, 0, b"")), 47 + 6)
        for size, least, most in ((0, 47, 55), (1, 55, 65), (2, 63, 75), (6, 95, 115), (8, 111, 135)):
            frames = [recording.Frame(0, i * 37 % 0x7FF, bytes((i * (k + 3) * 91) % 256 for k in range(size))) for i in range(500)]
            bits = [recording.wire_bits(frame) for frame in frames]
            self.assertGreaterEqual(min(bits), least)
            self.assertLessEqual(max(bits), most)
            self.assertEqual(recording.worst_bits(frames[0]), most)

    def test_a_line_that_is_no_frame_is_refused(self):
        with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
            log.write("(1.000000) vcan0 080#\n(1.000001) vcan0 181#11\n")
            log.flush()
            self.assertEqual([f.id for f in recording.read(log.name)], [0x080, 0x181])
            log.write("DROPCOUNT: dropped 3 CAN frames on 'vcan0' socket (total drops 3)\n")
            log.flush()
            with self.assertRaisesRegex(ValueError, ":3: "):
                recording.read(log.name)


if __name__ == "__main__":
    unittest.main()
