#!/usr/bin/env python3
"""`ivo score` from outside: plans of ours and of other tools, and what it refuses."""

import json
import os
import tempfile
import unittest

from json_schema import schema_faults
from mission_files import BUILDING, MISSION, ivo, plaza, read_json, write_mission

ROWS = plaza()
for row in range(20, 28):  # a building in the middle, 5 to 7 m
    for column in range(20, 28):
        ROWS[row][column] = BUILDING

HERE = {"name": "IVO", "waypoints_m": [[1.5, 1.5], [1.5, 9.0]]}
THERE = {"name": "Ana", "waypoints_m": [[10.5, 1.5], [10.5, 9.0], [4.0, 9.0]]}


class Score(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.json = os.path.join(self.folder, "score.json")
        self.mission = write_mission(self.folder, rows=ROWS)

    def put(self, agents):
        path = os.path.join(self.folder, "foreign.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"agents": agents}, file) if isinstance(agents, list) else file.write(agents)
        return path

    def score(self, agents, *args, mission=None):
        done = ivo("score", mission or self.mission, self.put(agents), "--json", self.json, *args)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(schema_faults(self.json, "score"), [])
        return read_json(self.json)

    def refused(self, agents):
        done = ivo("score", self.mission, self.put(agents), "--json", self.json)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertFalse(os.path.exists(self.json))
        self.assertEqual(done.stdout, "")
        return done.stderr.replace(self.folder + "/", "")

    def test_a_plan_of_ours_gets_the_score_it_came_with(self):
        for i, mission in enumerate((MISSION, MISSION + "preferred = [{ rectangle_m = [6.0, 7.5, 12.0, 12.0] }]\n")):
            path = write_mission(self.folder, mission, ROWS)
            out = os.path.join(self.folder, str(i))
            self.assertEqual(ivo("plan", path, "--out", out).returncode, 0)
            done = ivo("score", path, os.path.join(out, "plan.json"), "--json", self.json)
            self.assertEqual(done.returncode, 0, done.stderr)
            plan, score = read_json(out, "plan.json"), read_json(self.json)
            for name, value in plan["score"].items():
                if isinstance(value, float):
                    self.assertAlmostEqual(score["score"][name], value, delta=1e-9, msg=name)
                else:
                    self.assertEqual(score["score"][name], value, name)
            for ours, theirs in zip(plan["agents"], score["agents"]):
                self.assertAlmostEqual(ours["length_m"], theirs["length_m"], delta=1e-6)
            self.assertEqual(score["agents"][0]["preferred_share"], None)
            self.assertEqual(score["agents"][1]["preferred_share"] is None, i == 0)

    def test_a_folder_gets_the_score_and_a_picture(self):
        out = os.path.join(self.folder, "out")
        score = self.score([HERE, THERE], "--out", out)
        self.assertEqual(sorted(os.listdir(out)), ["score.json", "search.png"])
        self.assertEqual(read_json(out, "score.json"), score)
        with open(os.path.join(out, "search.png"), "rb") as file:
            self.assertTrue(file.read().startswith(b"\x89PNG"))

    def test_what_cannot_be_written_is_refused(self):
        plan = self.put([HERE, THERE])
        for option, path in (("--json", "/nowhere/score.json"), ("--json", self.folder), ("--json", self.pipe()), ("--out", plan), ("--out", "/proc/nobody")):
            done = ivo("score", self.mission, plan, option, path)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assertIn(f"ivo: {path}: cannot be ", done.stderr)

    def pipe(self):
        path = os.path.join(self.folder, "pipe")
        os.mkfifo(path)
        return path

    def test_names_and_waypoints_are_enough_and_nothing_else_is_trusted(self):
        bare = self.score([HERE, THERE])
        lying = self.score([dict(HERE, speed_mps=1e9, length_m=-1, kind="dog"), dict(THERE, sight_radius_m="x")])
        self.assertEqual(bare, lying)
        self.assertFalse(bare["score"]["complete"])
        self.assertAlmostEqual(bare["agents"][0]["given_length_m"], 7.5)

    def test_agents_may_come_in_any_order_by_name_and_in_the_missions_order_without(self):
        named = self.score([THERE, HERE])
        nameless = self.score([{"waypoints_m": agent["waypoints_m"]} for agent in (HERE, THERE)])
        self.assertEqual(named, nameless)

    def test_what_a_path_does_after_it_last_saw_something_new_costs_nothing(self):
        once = self.score([HERE, THERE])
        back = self.score([dict(HERE, waypoints_m=HERE["waypoints_m"] + [[1.5, 1.5]]), THERE])
        self.assertEqual(once["score"], back["score"])
        self.assertAlmostEqual(back["agents"][0]["given_length_m"], 15.0)

    def test_the_share_of_the_path_in_preferred_areas_is_by_length(self):
        path = write_mission(self.folder, MISSION + "preferred = [{ rectangle_m = [9.0, 0.5, 12.0, 4.5] }]\n", ROWS)
        agent = self.score([HERE, dict(THERE, waypoints_m=[[10.5, 1.5], [10.5, 9.0]])], mission=path)["agents"][1]
        self.assertAlmostEqual(agent["length_m"], 7.5)
        self.assertAlmostEqual(agent["preferred_share"], 3.0 / 7.5)

    def test_agents_that_are_not_the_missions_are_refused(self):
        self.assertEqual(self.refused([HERE, dict(THERE, name="Bob")]),
                         'ivo: foreign.json: agents[1].name: "Bob" is no agent of the mission; expected IVO, Ana\n')
        self.assertEqual(self.refused([HERE]), "ivo: foreign.json: agents: Ana is missing; expected a path for each of IVO, Ana\n")
        self.assertEqual(self.refused([HERE, HERE]),
                         "ivo: foreign.json: agents[1].name: IVO is there a second time; expected one path an agent\n")
        self.assertEqual(self.refused([HERE, THERE, {"waypoints_m": [[1, 1]]}]),
                         "ivo: foreign.json: agents[2].name: one more than the mission has agents; expected IVO, Ana\n")

    def test_ways_that_cannot_be_gone_are_refused_by_agent_and_waypoint(self):
        def way(*points):
            return [dict(HERE, waypoints_m=[[1.5, 1.5], *points]), THERE]

        self.assertEqual(
            self.refused(way([1.5, 6.0], [10.5, 6.0])),
            "ivo: foreign.json: agents[0].waypoints_m[2]: the way of IVO from (1.5, 6) to (10.5, 6) meets an obstacle or the map's"
            " border; expected free ground for its footprint of 0.3 m\n")
        self.assertEqual(
            self.refused(way([1.5, 40.0])),
            "ivo: foreign.json: agents[0].waypoints_m[1]: the way of IVO from (1.5, 1.5) to (1.5, 40) leaves the map; expected free"
            " ground for its footprint of 0.3 m\n")
        self.assertIn("meets an obstacle or the map's border", self.refused(way([0.2, 1.5])))
        self.mission = write_mission(self.folder, MISSION + "restricted = [{ rectangle_m = [9.0, 4.0, 12.0, 5.0] }]\n", ROWS)
        self.assertEqual(
            self.refused([HERE, THERE]),
            "ivo: foreign.json: agents[1].waypoints_m[1]: the way of Ana from (10.5, 1.5) to (10.5, 9) enters a restricted area;"
            " expected free ground for its footprint of 0.3 m\n")

    def test_classes_of_ground_that_only_robots_may_not_enter_stop_only_robots(self):
        rows = [list(row) for row in ROWS]
        for row in range(16, 20):
            rows[row] = [(150, 104, 52)] * 48
        classes = '[[class]]\nname = "stairs"\ncolour = [150, 104, 52]\n[[class]]\nname = "pavement"\n[[class]]\nname = "building"\n'
        with open(os.path.join(self.folder, "classes.toml"), "w", encoding="utf-8") as file:
            file.write(classes.replace('"pavement"\n', '"pavement"\ncolour = [214, 210, 202]\n').replace(
                '"building"\n', '"building"\ncolour = [104, 84, 92]\n'))
        self.mission = write_mission(self.folder, MISSION, rows,
                                     'image = "map.png"\nresolution_m = 0.25\nclasses = "classes.toml"\n')
        self.assertIn("IVO from (1.5, 1.5) to (1.5, 9) enters a class of ground that it may not enter", self.refused([HERE, THERE]))
        self.score([dict(HERE, waypoints_m=[[1.5, 1.5]]), THERE])

    def test_a_first_waypoint_that_is_not_the_start_is_refused(self):
        self.assertEqual(self.refused([dict(HERE, waypoints_m=[[1.5, 1.52], [1.5, 9.0]]), THERE]),
                         "ivo: foreign.json: agents[0].waypoints_m[0]: (1.5, 1.52) is not where IVO starts; expected (1.5, 1.5)\n")
        self.score([dict(HERE, waypoints_m=[[1.5, 1.505], [1.5, 9.0]]), THERE])

    def test_what_is_no_plan_is_refused(self):
        self.assertEqual(self.refused("nothing"), "ivo: foreign.json:1: not JSON: \"nothing\" cannot stand here; expected a plan\n")
        self.assertEqual(self.refused('{"agents": [\n{"waypoints_m": [[1.5, NaN]]}]}'),
                         "ivo: foreign.json:2: not JSON: \"NaN]]}]}\" cannot stand here; expected a plan\n")
        self.assertEqual(self.refused('{"agents": [\n{"waypoints_m": [[1.5'), "ivo: foreign.json:2: not JSON: ends too early; expected a plan\n")
        self.assertEqual(self.refused(""), "ivo: foreign.json:1: not JSON: ends too early; expected a plan\n")
        self.assertEqual(self.refused('{"agents": [{"waypoints_m": [[1.5, 1e999]]}]}'),
                         "ivo: foreign.json: holds a number beyond all bounds; expected finite numbers\n")
        self.assertEqual(self.refused([dict(HERE, waypoints_m=[])]),
                         "ivo: foreign.json: agents[0].waypoints_m: is empty; expected a list of at least one\n")
        done = ivo("score", self.mission, os.path.join(self.folder, "nowhere.json"))
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.replace(self.folder + "/", ""),
                         "ivo: nowhere.json: cannot be read: No such file or directory; expected a plan\n")

    def test_a_plan_of_another_mission_is_refused(self):
        other = write_mission(self.folder, MISSION.replace("[1.5, 1.5]", "[2.5, 1.5]"), ROWS)
        done = ivo("score", other, self.put([HERE, THERE]), "--json", self.json)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("agents[0].waypoints_m[0]: (1.5, 1.5) is not where IVO starts; expected (2.5, 1.5)", done.stderr)

    def test_more_waypoints_than_fit_are_refused(self):
        many = [[1.5, 1.5 + (i % 2)] for i in range(100_000)]
        self.assertRegex(self.refused([dict(HERE, waypoints_m=many), THERE]),
                         r"^ivo: foreign.json: agents\[0\].waypoints_m: 100000 waypoints, more than this build's \d+; expected fewer\n$")


if __name__ == "__main__":
    unittest.main()
