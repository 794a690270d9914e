#!/usr/bin/env python3
"""Every wrong input is refused before anything moves or is written: one clear line, exit status 2."""

import os
import tempfile
import unittest

from mission_files import BUILDING, MISSION, PAVEMENT, ivo, plaza, write_mission

WALLED_IN = plaza()
for column in range(48):
    for row in range(48):
        if max(abs(column - 5.5), abs(row - 41.5)) in (6.5, 7.5):  # a ring of building around (1.5, 1.5)
            WALLED_IN[row][column] = BUILDING
BLOCKED = plaza()
for column in range(8):
    for row in range(40, 48):
        BLOCKED[row][column] = BUILDING
STRANGE = plaza()
STRANGE[10][20] = (1, 2, 3)

LAST_SPEED = MISSION[: -len("0.5\n")]
AREA = 'preferred = [{ rectangle_m = [8.0, 8.0, 9.0, 9.0] }]\n'
NORTH_WALL = plaza()
for column in range(48):
    for row in range(24):
        NORTH_WALL[row][column] = BUILDING

# name: (mission, rows of the map, what the line must say)
CASES = {
    "a missing key": (MISSION.replace('map = "map.toml"\n', ""), None, ["mission.toml:", "map"]),
    "an unknown key": (MISSION.replace("seed = 3", "sead = 3"), None, ["mission.toml:3:", "sead", "seed"]),
    "a wrong type": (MISSION.replace("seed = 3", 'seed = "three"'), None, ["mission.toml:3:", "seed"]),
    "a wrong unit": (MISSION + "speed_kmh = 2.0\n", None, ["mission.toml:25:", "speed_kmh", "speed_mps", "metres a second"]),
    "out of range": (LAST_SPEED + "50.0\n", None, ["mission.toml:24:", "speed_mps", "50", "expected"]),
    "a robot faster than it can": (MISSION.replace("speed_mps = 0.5", "speed_mps = 2.5", 1), None,
                                   ["mission.toml:17: agent[0].speed_mps", "at most 1"]),
    "no number": (LAST_SPEED + "nan\n", None, ["mission.toml:24:", "speed_mps"]),
    "no TOML": (MISSION.replace("seed = 3", "seed = = 3"), None, ["mission.toml:3:"]),
    "a map that is not there": (MISSION.replace("map.toml", "other.toml"), None, ["mission.toml:2: map:", "other.toml"]),
    "a colour that is no class": (MISSION, STRANGE, ["map.png", "20", "10", "#010203"]),
    "a start in an obstacle": (MISSION, BLOCKED, ["mission.toml:15: agent[0].start_m", "inside an obstacle"]),
    "a start at the border": (MISSION.replace("[1.5, 1.5]", "[0.1, 1.5]"), None, ["mission.toml:15: agent[0].start_m", "0.1 m", "0.3 m"]),
    "a start outside": (MISSION.replace("[1.5, 1.5]", "[99.0, 1.5]"), None, ["mission.toml:15: agent[0].start_m", "outside the map"]),
    "a start where one may not be": (MISSION + "restricted = [{ rectangle_m = [9.0, 1.0, 11.5, 3.0] }]\n", None,
                                     ["mission.toml:22: agent[1].start_m", "Ana may not be"]),
    "a prior without mass": (MISSION.replace('"uniform"', "{ gaussians = [{ mean_m = [3.0, 9.0], sigma_m = 0.02 }] }"), NORTH_WALL,
                             ["mission.toml:5: prior", "no mass"]),
    "an agent that reaches no mass": (MISSION.replace('"uniform"', "{ gaussians = [{ mean_m = [10.0, 10.0], sigma_m = 0.1 }] }"),
                                      WALLED_IN, ["mission.toml:15: agent[0].start_m", "IVO"]),
    "an area without mass": (MISSION + AREA, NORTH_WALL, ["mission.toml:25: agent[1].preferred[0]", "Ana"]),
    "a Gaussian off the map": (MISSION.replace('"uniform"', "{ gaussians = [{ mean_m = [220.0, 5.0], sigma_m = 1.0 }] }"), None,
                               ["mission.toml:5: prior.gaussians[0].mean_m", "(220, 5)", "outside the map"]),
    "a Gaussian dealt to nobody": (MISSION.replace('"uniform"', '{ gaussians = [{ mean_m = [3.0, 5.0], sigma_m = 1.0, agent = "Bob" }] }'),
                                   None, ["mission.toml:5: prior.gaussians[0].agent", "Bob"]),
    "sub-priors beside areas": (MISSION.replace('"uniform"', '{ uniform = true, sub_priors = "alike" }') + AREA, None,
                                ["mission.toml:25: agent[1].preferred", "expected one of the two"]),
    "an area off the map": (MISSION + "restricted = [{ rectangle_m = [20.0, 1.0, 30.0, 3.0] }]\n", None,
                            ["mission.toml:25: agent[1].restricted[0]", "outside the map"]),
    "an object in a wall": (MISSION.replace('"drawn"', "[5.0, 9.0]"), NORTH_WALL, ["mission.toml:4: object", "building"]),
    "an object outside": (MISSION.replace('"drawn"', "[50.0, 1.0]"), None, ["mission.toml:4: object", "outside the map"]),
    "too many cells": (MISSION.replace("[planner]", "[planner]\ncell_m = 0.01"), None, ["planner.cell_m: the map has too many cells: 1440000, more than this build's 1048576; expected a larger cell_m; the planner profile that fits is desktop"]),
    "a narrow map that is too long": (MISSION.replace("[1.5, 1.5]", "[0.5, 1.5]").replace("[10.5, 1.5]", "[0.5, 5.0]"),
                                      [[PAVEMENT] * 4] * 40_000,  # a row of 4 takes the room of 32
                                      ["planner.cell_m: the map has too many cells: 1280000, more than this build's 1048576"]),
    "two robots": (MISSION.replace('kind = "person"', 'kind = "robot"\nrobot = "x.toml"'), None, ["mission.toml:", "robot"]),
    "a robot file that is not there": (MISSION.replace("ivo.toml", "nobody.toml"), None, ["mission.toml:14: agent[0].robot:", "nobody.toml"]),
}


class WrongInput(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def refused(self, args, says):
        out = os.path.join(self.folder, "out")
        done = ivo(*args, "--out", out)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for words in says:
            self.assertIn(words, done.stderr)
        self.assertFalse(os.path.exists(out), "something was written")

    def test_each_case_is_refused_by_name(self):
        for name, (mission, rows, says) in CASES.items():
            with self.subTest(name):
                self.refused(["run", write_mission(self.folder, mission, rows), "--yes", "--speed", "max"], says)

    def test_a_can_interface_that_cannot_be_used_is_refused(self):
        # Without CAN in the kernel the line says that; with it, that there is no such interface. Both on vcan: tests/hil.
        self.refused(["run", write_mission(self.folder), "--yes", "--can", "can77"], ["CAN"])

    def test_a_watchdog_that_cannot_be_fed_is_refused(self):
        mission = write_mission(self.folder)
        self.refused(["run", mission, "--yes", "--watchdog", "/dev/nope"], ["/dev/nope", "expected a device"])
        self.refused(["run", mission, "--yes", "--watchdog", "/dev/null"], ["/dev/null", "expected a device as /dev/watchdog"])

    def test_options_that_do_not_fit_together_are_refused(self):
        mission = write_mission(self.folder)
        self.refused(["run", mission, "--clock", "sync"], ["--clock sync", "--can"])
        self.refused(["run", mission, "--can", "can77", "--speed", "max"], ["--speed", "--can"])
        self.refused(["run", mission, "--can", ""], ["--can", "empty"])
        self.refused(["run", mission, "--speed", "fast"], ["--speed", "fast", "max"])

    def test_an_unknown_command_is_refused_with_those_that_there_are(self):
        done = ivo("bogus")
        self.assertEqual((done.returncode, done.stderr),
                         (2, 'ivo: no command is called "bogus"; expected run, plan, score, bench, wheels, load, profile, dbc, doctor, console\n'))

    def test_a_command_line_that_makes_no_sense_is_refused(self):
        for args, says in (
            ([], "no command; expected run, plan, score, bench, wheels, load, profile, dbc, doctor, console"),
            (["--version"], 'no command is called "--version"; expected run, plan, score, bench, wheels, load, profile, dbc, doctor, console'),
            (["run"], "MISSION is required"),
            (["run", ""], "MISSION: is empty; expected a name"),
            (["score", "x.toml", ""], "PLAN: is empty; expected a name"),
            (["run", "x.toml", "--bogus"], "not expected: --bogus"),
            (["plan", "x.toml", "--seed"], "--seed: has no value; expected one"),
            (["bench", "speed", "--json"], "--json: has no value; expected one"),
            (["plan", "x.toml", "--seed", "1", "--seed", "2"], "--seed: is given twice; expected once"),
        ):
            done = ivo(*args)
            self.assertEqual(done.returncode, 2, args)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertTrue(done.stderr.startswith("ivo: "), done.stderr)
            self.assertIn(says, done.stderr)


if __name__ == "__main__":
    unittest.main()
