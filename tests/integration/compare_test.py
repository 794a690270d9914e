#!/usr/bin/env python3
"""What the planner is compared with, from outside, shortened: `ivo bench compare` and ivo-naive. Figures are not judged here."""

import json
import os
import subprocess
import tempfile
import unittest

from json_schema import schema_faults
from mission_files import BUILD_DIR, ivo, read_json

RIVALS = ("greedy one step", "receding horizon", "lawnmower", "rollout tree search")


class Compare(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.json = os.path.join(scratch.name, "records.json")

    def naive(self, *args):
        return subprocess.run([os.path.join(BUILD_DIR, "ivo-naive"), *args], capture_output=True, text=True, check=False)

    def test_every_rival_has_a_complete_plan_of_every_scene(self):
        done = ivo("bench", "compare", "--quick", "--json", self.json)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(schema_faults(self.json, "bench"), [])
        records = read_json(self.json)
        figures = {(record["case"], record["figure"]): record["value"] for record in records}
        for scene in ("M1/U, 5.0 m", "courtyard, 2.5 m"):
            for time in ("0.02 s", "0.05 s"):
                for rival in RIVALS:
                    self.assertGreater(figures[f"{scene}, {time}", rival], 10.0)
                ours = [record for record in records if record["case"] == f"{scene}, {time}" and record["target"] is not None]
                self.assertEqual(len(ours), 1)
                self.assertRegex(ours[0]["figure"], "^ours")
        skipped = [record["figure"] for record in records if record["value"] is None]
        self.assertEqual(skipped, ["skipped: no --data folder"])

    def test_the_naive_planner_makes_the_same_plan_in_much_more_time(self):
        done = self.naive("--generations", "2", "--ants", "1", "--json", self.json)
        self.assertEqual(done.returncode, 0, done.stderr)  # 1 when the plans differ
        self.assertEqual(schema_faults(self.json, "bench"), [])
        figures = {record["figure"]: record for record in read_json(self.json)}
        self.assertEqual(figures["times as fast"]["target"], 100)
        self.assertIn("times as fast", done.stdout)

    def test_the_naive_planner_makes_the_same_plan_among_walls_and_can_say_so_to_programs_alone(self):
        done = self.naive("--map", "m2", "--generations", "1", "--ants", "2", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({record["case"] for record in json.loads(done.stdout)}, {"M2/U, 3.5 m, 1 generation of 2 ants"})

    def test_the_naive_planners_program_refuses_what_is_no_number_in_range(self):
        for args in (("--ants",), ("--ants", "0"), ("--ants", "2x"), ("--bees", "2"), ("--map", "m3"), ("--generations", "100000")):
            done = self.naive(*args)
            self.assertEqual(done.returncode, 2, args)
            self.assertEqual(done.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()
