#!/usr/bin/env python3
"""`ivo run` from outside: what it writes, what it returns, what it never does."""

import os
import resource
import signal
import subprocess
import tempfile
import unittest

from mission_files import COURTYARD, IVO, MISSION, events, ivo, read_json, write_mission, write_png
from terminals import open_terminal


def contents(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


class Run(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.out = os.path.join(self.folder, "out")

    def modes(self):
        return [event["mode"] for event in events(self.out) if event["event"] == "mode"]

    def test_the_courtyard_search_is_the_same_every_time(self):
        outs = [os.path.join(self.folder, name) for name in ("first", "second")]
        for out in outs:
            done = ivo("run", COURTYARD, "--yes", "--speed", "max", "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("plan.json", "report.json", "events.jsonl"):
            self.assertEqual(contents(outs[0], name), contents(outs[1], name), name)
        self.assertTrue(contents(outs[0], "search.png").startswith(b"\x89PNG"))

        plan = read_json(outs[0], "plan.json")
        report = read_json(outs[0], "report.json")
        self.assertTrue(plan["score"]["complete"])
        self.assertLessEqual(plan["score"]["unseen_mass"], 0.014)
        self.assertEqual(report["plan_score"], plan["score"])
        self.assertEqual((report["plan_bounds"], report["plan_gap"]), (plan["bounds"], plan["gap"]))
        self.assertIn(report["end"], ("found", "paths_ended"))
        robot, person = report["agents"]
        self.assertGreater(robot["distance_m"], 1.0)
        self.assertLessEqual(robot["mean_speed_mps"], 0.35)
        self.assertAlmostEqual(person["mean_speed_mps"], 0.5, places=2)
        # No date, no machine, no duration of the host.
        for name in ("plan.json", "report.json"):
            text = contents(outs[0], name).decode()
            self.assertNotRegex(text, r"20[2-9]\d-\d\d|wall|host")

    def test_the_robot_drives_along_its_plan(self):
        done = ivo("run", COURTYARD, "--yes", "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        waypoints = read_json(self.out, "plan.json")["agents"][0]["waypoints_m"]
        track = [(e["x_m"], e["y_m"]) for e in events(self.out) if e["event"] == "position" and e["agent"] == "IVO"]
        self.assertGreater(len(track), 100)
        for at in track:
            self.assertLess(min(distance(at, a, b) for a, b in zip(waypoints, waypoints[1:])), 0.10, at)

    def test_without_anybody_to_ask_nothing_moves(self):
        done = ivo("run", write_mission(self.folder), "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("nobody consented", done.stdout)
        self.assertIn("expected time", done.stdout)
        self.assertTrue(read_json(self.out, "plan.json")["agents"])
        self.assertEqual(read_json(self.out, "report.json")["end"], "no_consent")
        self.assertNotIn("searching", self.modes())
        for agent in read_json(self.out, "report.json")["agents"]:
            self.assertEqual(agent["distance_m"], 0.0)

    def ask_at_a_terminal(self, answer, typed_before=b""):
        terminal, far_end = open_terminal()
        os.write(terminal, typed_before)
        process = subprocess.Popen(
            [IVO, "run", write_mission(self.folder), "--speed", "max", "--out", self.out],
            stdin=far_end, stdout=far_end, stderr=far_end, start_new_session=True,
        )
        os.close(far_end)
        output = b""
        while True:
            try:
                more = os.read(terminal, 4096)
            except OSError:  # the program has ended
                break
            if b"Start the search?" in output + more and b"Start the search?" not in output:
                os.write(terminal, answer)
            output += more
        os.close(terminal)
        self.assertIn(b"Start the search?", output)
        return process.wait()

    def converse(self, arguments, answers):
        """Runs ivo on a terminal; each question, in order, is answered when it is there. (exit status, output)"""
        terminal, far_end = open_terminal()
        process = subprocess.Popen([IVO, "run", *arguments, "--out", self.out],
                                   stdin=far_end, stdout=far_end, stderr=far_end, start_new_session=True)
        os.close(far_end)
        output, asked_from = b"", 0
        pending = list(answers)
        while True:
            try:
                output += os.read(terminal, 4096)
            except OSError:  # the program has ended
                break
            while pending and pending[0][0] in output[asked_from:]:
                question, answer = pending.pop(0)
                asked_from = output.index(question, asked_from) + len(question)
                os.write(terminal, answer)
        os.close(terminal)
        self.assertEqual(pending, [], output.decode())
        return process.wait(), output.decode()

    def script(self, text):
        path = os.path.join(self.folder, "script.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    REBOOT = '[[at]]\nt_s = 8.0\ndrive = "rear_left"\nfault = "reboot"\n'

    def test_a_fault_can_be_cleared_at_the_terminal_and_the_search_goes_on_after_consent(self):
        status, said = self.converse(
            [write_mission(self.folder), "--speed", "max", "--script", self.script(self.REBOOT)],
            [(b"Start the search?", b"y\n"), (b"Start the drives up again?", b"y\n"), (b"Go on with the search?", b"y\n")],
        )
        self.assertEqual(status, 0, said)
        self.assertIn("drive 3 (rear left): rebooted", said)
        modes = self.modes()
        self.assertEqual(modes.count("searching"), 2, modes)
        self.assertLess(modes.index("fault"), len(modes) - modes[::-1].index("searching"))
        self.assertIn("fault cleared", [event["event"] for event in events(self.out)])

    ENDLESS = "".join(f'[[at]]\nt_s = {t_s}\ndrive = "{drive}"\nfault = "{fault}"\n' for t_s, drive, fault in (
        (8.0, "rear_left", "endless_stop"), (8.0, "front_left", "fault")))

    def test_a_wheel_that_does_not_stop_is_told_of_as_soon_as_it_is_known(self):
        status, said = self.converse(
            [write_mission(self.folder), "--speed", "max", "--script", self.script(self.ENDLESS)],
            [(b"Start the search?", b"y\n"),
             (b"emergency 7300h; drive 3 (rear left) still turned when the quick stop had had its time", b""),
             (b"Start the drives up again?", b"n\n")],
        )
        self.assertEqual(status, 1, said)
        self.assertEqual(said.count("Start the drives up again?"), 2, "asked at once, and again with the news")
        self.assertEqual(read_json(self.out, "report.json")["reason"],
                         "drive 1 (front left): emergency 7300h; drive 3 (rear left) still turned when the quick stop had had its time")

    def test_a_fault_that_nobody_clears_ends_the_run(self):
        status, said = self.converse(
            [write_mission(self.folder), "--speed", "max", "--script", self.script(self.REBOOT)],
            [(b"Start the search?", b"y\n"), (b"Start the drives up again?", b"n\n")],
        )
        self.assertEqual(status, 1, said)
        self.assertEqual(read_json(self.out, "report.json")["reason"], "drive 3 (rear left): rebooted")

    def test_without_a_terminal_a_fault_ends_the_run(self):
        done = ivo("run", write_mission(self.folder), "--yes", "--speed", "max", "--out", self.out,
                   "--script", self.script(self.REBOOT))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("rebooted", done.stdout)

    def test_a_script_is_for_simulated_drives_of_this_process(self):
        done = ivo("run", write_mission(self.folder), "--can", "vcan7", "--out", self.out, "--script", self.script(""))
        self.assertEqual((done.returncode, done.stderr),
                         (2, "ivo: --script: the drives on vcan7 are not ours; expected it without --can, or of ivo-drives\n"))

    def test_yes_at_the_terminal_starts_the_search(self):
        self.assertEqual(self.ask_at_a_terminal(b"y\n"), 0)
        self.assertIn("searching", self.modes())

    def test_what_was_typed_before_the_plans_were_shown_is_no_consent(self):
        self.assertEqual(self.ask_at_a_terminal(b"n\n", typed_before=b"y\ny\n"), 3)
        self.assertNotIn("searching", self.modes())

    def test_without_a_screen_to_show_the_plans_on_nobody_is_asked(self):
        terminal, far_end = open_terminal()
        os.write(terminal, b"y\n")
        done = subprocess.run(
            [IVO, "run", write_mission(self.folder), "--speed", "max", "--out", self.out],
            stdin=far_end, capture_output=True, text=True, check=False,
        )
        os.close(far_end)
        os.close(terminal)
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertNotIn("searching", self.modes())

    def test_only_a_whole_yes_is_a_yes(self):
        self.assertEqual(self.ask_at_a_terminal(b"yonder\n"), 3)

    def test_anything_else_at_the_terminal_starts_nothing(self):
        self.assertEqual(self.ask_at_a_terminal(b"\n"), 3)
        self.assertNotIn("searching", self.modes())

    def test_a_stop_signal_ends_the_search_at_rest_and_is_reported(self):
        mission = MISSION.replace('object = "drawn"', 'object = "unknown"')
        process = subprocess.Popen(
            [IVO, "run", write_mission(self.folder, mission), "--yes", "--speed", "1", "--out", self.out],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )
        for line in process.stdout:
            if line.startswith("searching"):
                process.send_signal(signal.SIGTERM)
                break
        output, errors = process.communicate()
        self.assertEqual(process.returncode, 1, output + errors)
        self.assertEqual(read_json(self.out, "report.json")["end"], "stopped")
        self.assertEqual(self.modes()[-2:], ["stopping", "done"])

    def test_an_object_in_reach_is_found_by_the_robot(self):
        mission = MISSION.replace('object = "drawn"', "object = [2.0, 2.0]")
        done = ivo("run", write_mission(self.folder, mission), "--yes", "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = read_json(self.out, "report.json")
        self.assertEqual((report["end"], report["finder"]), ("found", "IVO"))

    def test_a_search_for_an_unknown_object_ends_with_the_paths(self):
        mission = MISSION.replace('object = "drawn"', 'object = "unknown"')
        done = ivo("run", write_mission(self.folder, mission), "--yes", "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = read_json(self.out, "report.json")
        self.assertEqual((report["end"], report["finder"], report["object_m"]), ("paths_ended", None, None))
        for agent in report["agents"]:
            self.assertAlmostEqual(agent["distance_m"], agent["planned_length_m"], delta=0.05 * agent["planned_length_m"] + 0.3)

    def test_two_runs_into_one_folder_are_refused(self):
        mission = MISSION.replace('object = "drawn"', 'object = "unknown"')
        first = subprocess.Popen(
            [IVO, "run", write_mission(self.folder, mission), "--yes", "--speed", "1", "--out", self.out],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
        )
        for line in first.stdout:
            if line.startswith("searching"):
                break
        second = ivo("run", os.path.join(self.folder, "mission.toml"), "--yes", "--speed", "max", "--out", self.out)
        first.send_signal(signal.SIGTERM)
        first.communicate()
        self.assertEqual(second.returncode, 2, second.stdout)
        self.assertRegex(second.stderr, r"^ivo: .*another run is writing here.*\n$")
        self.assertEqual(first.returncode, 1)
        self.assertTrue(events(self.out))

    def test_results_of_an_earlier_run_are_not_left_beside_new_ones(self):
        os.mkdir(self.out)
        for name in ("plan.json", "report.json", "search.png"):
            with open(os.path.join(self.out, name), "w", encoding="utf-8") as file:
                file.write("old")
        process = subprocess.Popen(
            [IVO, "run", write_mission(self.folder, MISSION.replace("generations = 5", "generations = 1000000")), "--yes", "--out", self.out],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True,
        )
        process.stdout.readline()
        process.kill()
        process.communicate()
        self.assertFalse(set(os.listdir(self.out)) & {"plan.json", "report.json", "search.png"})

    def test_the_plans_can_be_looked_at_before_anybody_consents(self):
        done = ivo("run", write_mission(self.folder), "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 3)
        self.assertLess(done.stdout.index("search.png"), done.stdout.index("nobody consented"))

    def test_a_run_has_the_same_result_at_every_speed(self):
        for out, speed in (("fast", "max"), ("slow", "200")):
            done = ivo("run", write_mission(self.folder), "--yes", "--speed", speed, "--out", os.path.join(self.folder, out))
            self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("plan.json", "report.json"):
            self.assertEqual(contents(os.path.join(self.folder, "fast"), name), contents(os.path.join(self.folder, "slow"), name), name)

    def run_with_room_for(self, size, *args):
        """Runs ivo on a disk on which no file grows beyond `size` bytes."""

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        return subprocess.run([IVO, "run", *args, "--yes", "--speed", "max", "--out", self.out], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, preexec_fn=limit, check=False)

    def test_events_that_cannot_be_written_are_a_failure(self):
        # So slow that there are more events than fit; the picture does.
        mission = MISSION.replace('object = "drawn"', 'object = "unknown"').replace("speed_mps = 0.5", "speed_mps = 0.1")
        done = self.run_with_room_for(150_000, write_mission(self.folder, mission))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"^ivo: .*events were lost.*\n$")

    def test_nobody_searches_by_a_plan_that_could_not_be_kept(self):
        os.makedirs(os.path.join(self.out, "plan.json", "in the way"))
        done = ivo("run", write_mission(self.folder), "--yes", "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("plan.json", done.stderr)
        self.assertEqual(read_json(self.out, "report.json")["reason"], "the plans could not be written")
        self.assertNotIn("searching", self.modes())

    def test_a_prior_may_be_an_image(self):
        rows = [[(0, 0, 0)] * 48 for _ in range(48)]
        for row in range(24):
            rows[row][:24] = [(200, 200, 200)] * 24  # the upper left quarter
        write_png(os.path.join(self.folder, "prior.png"), rows, grey=True)
        mission = MISSION.replace('"uniform"', '{ image = "prior.png", resolution_m = 0.25 }')
        done = ivo("run", write_mission(self.folder, mission), "--yes", "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        x, y = read_json(self.out, "report.json")["object_m"]
        self.assertTrue(x < 6 and y > 6, (x, y))

    def test_where_a_reported_person_was_is_not_invented(self):
        mission = MISSION.replace('kind = "person"', 'kind = "person"\nmotion = "reported"')
        done = ivo("run", write_mission(self.folder, mission), "--yes", "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIsNone(read_json(self.out, "report.json")["agents"][1]["distance_m"])

    def test_the_shipped_missions_run(self):
        folder = os.path.dirname(COURTYARD)
        for name in ("m1.toml", "m1_gaussians.toml", "m2.toml"):
            done = ivo("run", os.path.join(folder, name), "--speed", "max", "--out", os.path.join(self.folder, name))
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertLess(read_json(self.folder, name, "plan.json")["score"]["unseen_mass"], 0.05)

    def test_an_output_folder_that_cannot_be_is_refused_before_anything_starts(self):
        blocked = os.path.join(self.folder, "file")
        with open(blocked, "w", encoding="utf-8"):
            pass
        done = ivo("run", write_mission(self.folder), "--yes", "--speed", "max", "--out", blocked)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^ivo: .*file.*\n$")


def distance(p, a, b):
    """From point p to the segment a b."""
    ab = (b[0] - a[0], b[1] - a[1])
    length2 = ab[0] ** 2 + ab[1] ** 2
    t = 0.0 if length2 == 0 else max(0.0, min(1.0, ((p[0] - a[0]) * ab[0] + (p[1] - a[1]) * ab[1]) / length2))
    return ((p[0] - a[0] - t * ab[0]) ** 2 + (p[1] - a[1] - t * ab[1]) ** 2) ** 0.5


if __name__ == "__main__":
    unittest.main()
