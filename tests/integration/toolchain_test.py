#!/usr/bin/python3 -B
"""The entry points' own promises: how stages are summed up, and what is refused."""

import os
import subprocess
import tempfile
import unittest

import lint

TOOLCHAIN = os.path.join(lint.SOURCE_DIR, "toolchain")
REPORT = '<testsuite name="(empty)"\n\ttests="{}"\n\tfailures="{}"\n\tdisabled="0"\n\tskipped="{}"\n\ttime="5">\n</testsuite>\n'


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout, done.stderr


class Stages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.logs = folder.name

    def run_stages(self, body, *names):
        script = f"set -euo pipefail\nlogs={self.logs}\nroot=/\nrun_stage() {{ case $1 in {body} esac; }}\n"
        return run("bash", "-c", script + f". {TOOLCHAIN}/stages.sh\nrun_stages {' '.join(names)}")

    def report(self, total, wrong, skipped):
        with open(os.path.join(self.logs, "report"), "w", encoding="utf-8") as file:
            file.write(REPORT.format(total, wrong, skipped))
        return f"cp {self.logs}/report {self.logs}/$1.xml"

    def test_the_last_line_sums_the_tests_of_all_stages(self):
        status, said, _ = self.run_stages(f"a|b) {self.report(7, 0, 0)} ;; c) true ;;", "a", "b", "c")
        self.assertEqual(status, 0)
        self.assertEqual(said.splitlines()[-1], "14 passed, 0 failed, 0 skipped")

    def test_a_skipped_test_did_not_pass(self):
        self.assertIn("5 passed, 0 failed, 2 skipped", self.run_stages(f"a) {self.report(7, 0, 2)} ;;", "a")[1])

    def test_a_failed_test_stops_and_counts(self):
        status, said, _ = self.run_stages(f"a) {self.report(7, 2, 0)}; false ;; b) true ;;", "a", "b")
        self.assertEqual(status, 1)
        self.assertIn("stage a failed", said)
        self.assertNotIn("[2/2]", said)
        self.assertEqual(said.splitlines()[-1], "5 passed, 2 failed, 0 skipped")

    def test_a_stage_that_fails_without_tests_never_reads_as_success(self):
        status, said, _ = self.run_stages("a) echo the reason; false; echo never ;;", "a")
        self.assertEqual(status, 1)
        self.assertIn("the reason", said)
        self.assertNotIn("never", said)
        self.assertEqual(said.splitlines()[-1], "0 passed, 1 failed, 0 skipped")


class Refusals(unittest.TestCase):
    def test_install_names_an_unknown_section(self):
        status, _, said = run(os.path.join(TOOLCHAIN, "install"), "toys")
        self.assertEqual(status, 2)
        self.assertEqual(
            said, "toolchain/install: no packages in section 'toys'; expected one of build run test package rtsan fuzz rt picture peer web cross\n")

    def test_the_entry_points_say_how_they_are_called(self):
        for script, argument in (("test", "--fast"), ("fresh", "walk"), ("fuzz", "--week"), ("rt", "-x")):
            status, _, said = run(os.path.join(TOOLCHAIN, script), argument)
            self.assertEqual(status, 2, script)
            self.assertTrue(said.startswith(f"usage: toolchain/{script}"), said)
        self.assertEqual(run(os.path.join(TOOLCHAIN, "vcan"))[0], 2)

    def test_the_build_names_an_unknown_planner_profile(self):
        with tempfile.TemporaryDirectory() as folder:
            status, _, said = run("cmake", "-S", lint.SOURCE_DIR, "-B", folder, "-G", "Ninja", "-DIVO_PLANNER_PROFILE=huge")
        self.assertNotEqual(status, 0)
        self.assertIn('IVO_PLANNER_PROFILE is "huge"; expected micro, onboard or desktop', said)


unittest.main()
