#!/usr/bin/env python3
"""`ivo bench` from outside, shortened: names, tables, records. Figures are not judged here: a slow machine fails no test."""

import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from json_schema import schema_faults
from mission_files import IVO, ivo, read_json


def running(process):
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


class Bench(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.json = os.path.join(scratch.name, "records.json")

    def bench(self, name, *args):
        done = ivo("bench", name, "--quick", "--json", self.json, *args)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(schema_faults(self.json, "bench"), [])
        records = read_json(self.json)
        self.assertEqual({record["bench"] for record in records}, {name})
        for record in records:
            self.assertEqual(record["target"] is None, record["holds"] is None, record)
            self.assertEqual(record["value"] is None, record["figure"].startswith("skipped: "), record)
            self.assertIn(record["case"], done.stdout)
        return records, done.stdout

    def test_without_a_name_the_benches_are_listed(self):
        done = ivo("bench")
        self.assertEqual(done.returncode, 0)
        for name in ("table1", "speed", "quality", "scale", "can", "all"):
            self.assertRegex(done.stdout, rf"(?m)^{name} +\w")

    def test_an_unknown_name_is_refused(self):
        done = ivo("bench", "fastest")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r'^ivo: no bench is called "fastest"; expected table1, speed, quality, compare, scale, can, loop, all\n$')
        for path in ("/nowhere/records.json", os.path.dirname(self.json)):  # at once, not after the work
            done = ivo("bench", "all", "--json", path)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))
            self.assertIn(f"ivo: {path}: cannot be written: ", done.stderr)
        done = ivo("bench", "scale", "--data", "/nowhere")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1)

    def test_table1_has_every_row_with_both_heuristics_beside_the_papers_figures(self):
        records, table = self.bench("table1")
        times = {record["case"]: record["value"] for record in records if record["figure"] == "ET"}
        papers = {record["case"]: record["value"] for record in records if record["figure"] == "paper's"}
        self.assertEqual(len(papers), 16)
        self.assertEqual(len(times), 20)  # and G/S exchanged, twice a heuristic
        self.assertEqual(papers["M1/U TSP, 5.0 m, cells 0.50 m"], 80.98)
        self.assertEqual(papers["M2/G/S MTS (our reading), 5.0 m, cells 0.50 m"], 86.32)
        for words in ("ET, worst", "unseen", "CT", "PD", "exchanged"):
            self.assertIn(words, table)
        again = {record["case"]: record["value"] for record in self.bench("table1")[0] if record["figure"] == "ET"}
        self.assertEqual(times, again)

    def test_speed_takes_tables_apart(self):
        records, _ = self.bench("speed")
        figures = {(record["case"], record["figure"]) for record in records}
        for case in ("M1/U", "M2/U"):
            for figure in ("search", "search, worst", "graph and tables", "paper's"):
                self.assertIn((case, figure), figures)

    def test_speed_stands_beside_the_naive_planner(self):
        records, _ = self.bench("speed")
        for scene in ("M1/U", "M2/U"):
            case = {record["figure"]: record for record in records if record["case"] == f"{scene}, beside the naive planner"}
            self.assertGreater(case["times as fast as the naive planner"]["value"], 1)
            self.assertIn("naive planner, an ant", case)

    def test_speed_without_the_naive_planner_says_so(self):
        alone = os.path.join(os.path.dirname(self.json), "ivo")
        shutil.copy(IVO, alone)
        done = subprocess.run([alone, "bench", "speed", "--quick"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("M1/U, beside the naive planner: skipped: no ivo-naive beside this program\n", done.stdout)

    def test_an_interrupt_leaves_no_naive_planner_behind(self):
        folder = os.path.dirname(self.json)
        shutil.copy(IVO, folder)
        began = os.path.join(folder, "began")
        naive = os.path.join(folder, "ivo-naive")
        with open(naive, "w", encoding="utf-8") as file:
            file.write(f"#!/bin/sh\necho $$ >{began}.part\nmv {began}.part {began}\nexec sleep 600\n")
        os.chmod(naive, 0o755)
        process = subprocess.Popen([os.path.join(folder, "ivo"), "bench", "speed", "--quick"], stdout=subprocess.DEVNULL)
        self.wait_for(lambda: os.path.exists(began))
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), -signal.SIGINT)
        with open(began, encoding="utf-8") as file:
            child = int(file.read())
        self.wait_for(lambda: not running(child))

    def wait_for(self, condition):
        for _ in range(600):
            if condition():
                return
            time.sleep(0.1)
        self.fail("waited for a minute")

    def test_quality_says_how_many_plans_are_complete(self):
        records, _ = self.bench("quality")
        complete = [record for record in records if record["figure"] == "complete"]
        self.assertEqual(len(complete), 6)
        for record in records:
            if record["figure"] == "gap":
                values = {r["figure"]: r["value"] for r in records if r["case"] == record["case"]}
                self.assertGreater(values["bound"], 0)
                self.assertGreaterEqual(values["ET_c, worst"], values["ET_c"])

    def test_scale_without_data_says_what_it_left_out(self):
        records, _ = self.bench("scale")
        skipped = [record["case"] for record in records if record["figure"] == "skipped: no --data folder"]
        self.assertEqual(skipped, ["Dubai mask, 5 m", "Dubai mask, 3.5 m", "SAREnv prior, 3.5 m"])
        self.assertTrue([record for record in records if record["figure"] == "exponent"])


if __name__ == "__main__":
    unittest.main()
