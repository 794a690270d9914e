#!/usr/bin/env python3
"""`ivo plan` from outside: what it writes, what it says, how it ends."""

import os
import resource
import signal
import subprocess
import tempfile
import time
import unittest

from json_schema import schema_faults
from mission_files import COURTYARD, IVO, MISSION, ivo, read_json, write_mission
from terminals import open_terminal

PREFERRED = MISSION + "preferred = [{ rectangle_m = [6.0, 6.0, 12.0, 12.0] }]\n"


def handles(process, number):
    with open(f"/proc/{process}/status", encoding="utf-8") as file:
        caught = next(line for line in file if line.startswith("SigCgt:"))
    return int(caught.split()[1], 16) >> (number - 1) & 1 == 1


class Plan(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.out = os.path.join(self.folder, "out")

    def plan(self, *args, mission=MISSION, out=None):
        done = ivo("plan", write_mission(self.folder, mission), "--out", out or self.out, *args)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def bytes_of(self, out):
        with open(os.path.join(out, "plan.json"), "rb") as file:
            return file.read()

    def test_the_courtyard_is_planned_and_nothing_moves(self):
        done = ivo("plan", COURTYARD, "--iterations", "20", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(os.listdir(self.out)), ["plan.json", "search.png"])
        with open(os.path.join(self.out, "search.png"), "rb") as file:
            self.assertTrue(file.read().startswith(b"\x89PNG"))
        plan = read_json(self.out, "plan.json")
        self.assertEqual(plan["generations_done"], 20)
        self.assertEqual([agent["name"] for agent in plan["agents"]], ["IVO", "Ana"])
        for words in ("ET ", "ET_c", "EST", "unseen", "bound", "strict", "unobservable", "IVO: ", "Ana: ", "graph and tables", "search "):
            self.assertIn(words, done.stdout)

    def test_a_plan_is_as_its_schema_says(self):
        for i, mission in enumerate((MISSION, PREFERRED)):
            out = os.path.join(self.folder, str(i))
            self.plan(mission=mission, out=out)
            self.assertEqual(schema_faults(os.path.join(out, "plan.json"), "plan"), [])
            self.assertEqual(read_json(out, "plan.json")["score"]["expected_sub_prior_time_s"] is None, mission is MISSION)

    def test_the_same_mission_and_seed_give_the_same_bytes_and_another_seed_others(self):
        outs = [os.path.join(self.folder, name) for name in ("first", "second", "other")]
        self.plan(out=outs[0])
        self.plan("--seed", "3", out=outs[1])  # the mission's own
        self.plan("--seed", "4", out=outs[2])
        self.assertEqual(self.bytes_of(outs[0]), self.bytes_of(outs[1]))
        self.assertNotEqual(read_json(outs[0], "plan.json")["agents"], read_json(outs[2], "plan.json")["agents"])
        self.assertEqual(read_json(outs[2], "plan.json")["seed"], 4)

    def test_threads_are_colonies_whose_plan_depends_on_their_number_and_the_seed_alone(self):
        outs = [os.path.join(self.folder, name) for name in ("one", "two", "again", "pinned")]
        self.plan("--iterations", "40", out=outs[0])
        self.plan("--iterations", "40", "--threads", "2", out=outs[1])
        self.plan("--iterations", "40", "--threads", "2", out=outs[2])
        core = min(os.sched_getaffinity(0))
        done = subprocess.run(
            [IVO, "plan", os.path.join(self.folder, "mission.toml"), "--iterations", "40", "--threads", "2", "--out", outs[3]],
            capture_output=True, check=False, stdin=subprocess.DEVNULL, preexec_fn=lambda: os.sched_setaffinity(0, {core}),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.bytes_of(outs[1]), self.bytes_of(outs[2]))
        self.assertEqual(self.bytes_of(outs[1]), self.bytes_of(outs[3]))
        one, two = (read_json(out, "plan.json") for out in outs[:2])
        self.assertEqual((one["threads"], two["threads"], two["generations_done"]), (1, 2, 40))
        self.assertLessEqual(two["score"]["expected_time_continuous_s"], one["score"]["expected_time_continuous_s"])
        self.assertEqual(schema_faults(os.path.join(outs[1], "plan.json"), "plan"), [])

    def test_threads_end_by_time_too(self):
        self.plan("--threads", "2", "--time-limit", "2")
        self.assertGreater(read_json(self.out, "plan.json")["generations_done"], 5)

    def test_colonies_that_find_no_memory_are_refused_by_what_they_need(self):
        def little_memory():
            resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))

        done = subprocess.run(
            [IVO, "plan", write_mission(self.folder), "--threads", "16", "--out", self.out],
            capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, preexec_fn=little_memory,
        )
        self.assertEqual(done.returncode, 2)
        self.assertRegex(
            done.stderr,
            r"^ivo: --threads: no memory for 16 colonies; expected [1-9][0-9]* MB for each after the first, or fewer of them\n$",
        )
        self.assertFalse(os.path.exists(self.out))

    def test_plan_and_run_make_the_same_plan(self):
        self.plan()
        run = os.path.join(self.folder, "run")
        self.assertEqual(ivo("run", os.path.join(self.folder, "mission.toml"), "--speed", "max", "--out", run).returncode, 3)
        self.assertEqual(self.bytes_of(self.out), self.bytes_of(run))

    def test_options_take_the_place_of_what_the_mission_says(self):
        self.plan("--profile", "paper", "--heuristic", "mts", "--iterations", "2")
        plan = read_json(self.out, "plan.json")
        self.assertEqual((plan["profile"], plan["heuristic"], plan["generations_done"]), ("paper", "mts", 2))
        self.plan(mission=MISSION.replace("[planner]", '[planner]\nprofile = "paper"\nheuristic = "mts"'))
        plan = read_json(self.out, "plan.json")
        self.assertEqual((plan["profile"], plan["heuristic"], plan["generations_done"]), ("paper", "mts", 5))

    def test_the_gap_is_of_the_continuous_time_above_the_larger_bound(self):
        self.plan()
        plan = read_json(self.out, "plan.json")
        bounds = plan["bounds"]
        bound = max(bounds["area_s"], bounds["reach_s"])
        self.assertGreater(bound, 0)
        self.assertAlmostEqual(plan["gap"], plan["score"]["expected_time_continuous_s"] / bound - 1)
        self.assertLessEqual(max(bounds["area_strict_s"], bounds["reach_strict_s"]), plan["score"]["expected_time_continuous_s"])

    def test_a_time_limit_ends_the_search_and_the_file_says_how_far_it_came(self):
        self.plan("--time-limit", "2")
        self.assertGreater(read_json(self.out, "plan.json")["generations_done"], 5)  # the mission's generations do not hold
        self.plan("--time-limit", "1000", "--iterations", "3")
        self.assertEqual(read_json(self.out, "plan.json")["generations_done"], 3)

    def test_however_short_the_time_there_is_a_plan(self):
        self.plan("--time-limit", "0.001")
        self.assertEqual(schema_faults(os.path.join(self.out, "plan.json"), "plan"), [])

    def test_ctrl_c_ends_the_search_with_the_best_plan_so_far(self):
        for threads in ("1", "3"):
            with self.subTest(threads):
                self.interrupt("--threads", threads)

    def interrupt(self, *args):
        process = subprocess.Popen(
            [IVO, "plan", write_mission(self.folder), "--iterations", "1000000000", "--out", self.out, *args],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )
        for line in process.stdout:
            if line.startswith("planning"):
                break
        process.send_signal(signal.SIGINT)
        said, complained = process.communicate()
        self.assertEqual(process.returncode, 1, complained)
        if complained:  # the signal came before the first plan
            self.assertEqual(complained, "ivo: stopped before there was a plan; nothing was written\n")
            self.assertEqual(os.listdir(self.out), [])
            return
        self.assertIn("stopped", said)
        self.assertEqual(schema_faults(os.path.join(self.out, "plan.json"), "plan"), [])
        self.assertTrue(os.path.exists(os.path.join(self.out, "search.png")))

    def test_without_a_terminal_progress_is_a_few_quiet_lines(self):
        lines = [line for line in self.plan("--iterations", "400").splitlines() if line.startswith("planning")]
        self.assertTrue(2 <= len(lines) <= 11, lines)
        self.assertIn("ET_c", lines[-1])

    def test_on_a_terminal_progress_is_drawn_over_itself(self):
        near_end, far_end = open_terminal()
        mission = write_mission(self.folder)
        process = subprocess.Popen([IVO, "plan", mission, "--time-limit", "3", "--out", self.out], stdin=far_end, stdout=far_end)
        os.close(far_end)
        seen = b""
        while True:
            try:
                part = os.read(near_end, 4096)
            except OSError:
                break
            if not part:
                break
            seen += part
        os.close(near_end)
        self.assertEqual(process.wait(), 0)
        self.assertGreater(seen.count(b"\r\x1b[Kplanning"), 2)
        self.assertNotIn(b"\nplanning", seen.split(b"\r\x1b[K", 1)[1])

    def test_options_out_of_range_are_refused_by_name(self):
        mission = write_mission(self.folder)
        for args, line in (
            (["--profile", "quick"], 'ivo: --profile: "quick"; expected paper or fast; ivo --help shows what there is\n'),
            (["--heuristic", "x"], 'ivo: --heuristic: "x"; expected tsp or mts; ivo --help shows what there is\n'),
            (["--time-limit", "0"], 'ivo: --time-limit: "0"; expected a number, 0.001 to 86400; ivo --help shows what there is\n'),
            (["--time-limit", "nan"], 'ivo: --time-limit: "nan"; expected a number, 0.001 to 86400; ivo --help shows what there is\n'),
            (["--iterations", "2.5"], 'ivo: --iterations: "2.5"; expected a whole number, 1 to 1000000000; ivo --help shows what there is\n'),
            (["--seed", "-1"], 'ivo: --seed: "-1"; expected a whole number, 0 to 9223372036854775807; ivo --help shows what there is\n'),
            (["--threads", "0"], 'ivo: --threads: "0"; expected a whole number, 1 to 16; ivo --help shows what there is\n'),
            (["--threads", "17"], 'ivo: --threads: "17"; expected a whole number, 1 to 16; ivo --help shows what there is\n'),
            (["--threads", "two"], 'ivo: --threads: "two"; expected a whole number, 1 to 16; ivo --help shows what there is\n'),
        ):
            done = ivo("plan", mission, "--out", self.out, *args)
            self.assertEqual((done.returncode, done.stderr), (2, line))
        self.assertFalse(os.path.exists(self.out))

    def test_a_wrong_mission_is_refused_before_anything_is_written(self):
        done = ivo("plan", write_mission(self.folder, MISSION.replace("[1.5, 1.5]", "[99.0, 1.5]")), "--out", self.out)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^ivo: .*mission.toml:15: agent\[0\].start_m: .*outside the map.*\n$")
        self.assertFalse(os.path.exists(self.out))

    def test_a_folder_that_cannot_hold_the_plan_is_refused_before_the_search(self):
        os.makedirs(os.path.join(self.out, "plan.json", "in the way"))
        done = ivo("plan", write_mission(self.folder), "--iterations", "1000000000", "--out", self.out)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr, f"ivo: {self.out}/plan.json: cannot be written: it is a folder; expected a file\n")
        self.assertEqual(os.listdir(self.out), ["plan.json"])
        file = os.path.join(self.folder, "file")
        with open(file, "wb"):
            pass
        for out in (file, os.path.join(file, "below"), "/proc/nobody"):
            done = ivo("plan", os.path.join(self.folder, "mission.toml"), "--out", out)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
            self.assertIn(f"ivo: {out}", done.stderr)

    def test_ctrl_c_while_graph_and_tables_are_built_ends_at_once_and_leaves_nothing(self):
        # 192 x 192 m in cells of 0.25 m: seconds of building.
        mission = write_mission(self.folder, MISSION.replace("spacing_m = 3.0", "spacing_m = 4.0"),
                                map_text='image = "map.png"\nresolution_m = 4.0\n')
        process = subprocess.Popen([IVO, "plan", mission, "--out", self.out], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while not handles(process.pid, signal.SIGINT):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(), ("", "ivo: stopped before there was a plan; nothing was written\n"))
        self.assertEqual(process.returncode, 1)
        self.assertFalse(os.path.exists(self.out))

    def test_one_of_a_thing_is_spoken_of_as_one(self):
        said = self.plan("--iterations", "1")
        self.assertIn("1 of 1 generation,", said)
        self.assertRegex(said, r"search \S+ s, 1 generation\n")

    def test_with_sub_priors_the_bound_says_what_was_minimised(self):
        words = "a search with sub-priors minimises EST, not ET_c"
        self.assertNotIn(words, self.plan())
        self.assertRegex(self.plan(mission=PREFERRED), rf"(?m)^bound .*{words}$")


if __name__ == "__main__":
    unittest.main()
