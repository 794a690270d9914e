#!/usr/bin/env python3
"""A search that is cut off by SIGKILL, at any moment, is there again: plan, tracks and log; nothing moves before somebody agrees."""

import os
import random
import resource
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import unittest
import zlib

from mission_files import IVO, MISSION, events, ivo, plaza, read_json, write_mission
from terminals import open_terminal

SEED = 20
POSITION_EVERY_S = 0.202  # in the event log: 200 ms, in whole cycles
SPEED_MPS = 1.0
MISSION = MISSION.replace('object = "drawn"', 'object = "unknown"').replace("speed_mps = 0.5", "speed_mps = 1.0").replace("[10.5, 1.5]", "[6.5, 1.5]")
GO_ON = b"Go on with the search?"
START = b"Start the search?"


def contents(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


def whole_lines(text):
    return text[: text.rfind(b"\n") + 1]


class Resume(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.mission = write_mission(cls.scratch.name, MISSION, plaza(32))
        whole = os.path.join(cls.scratch.name, "whole")
        done = ivo("run", cls.mission, "--yes", "--speed", "max", "--out", whole)
        assert done.returncode == 0, done.stderr
        cls.whole_plan = contents(whole, "plan.json")
        cls.whole_report = read_json(whole, "report.json")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def setUp(self):
        self.out = tempfile.mkdtemp(dir=self.scratch.name)

    def log(self):
        return contents(self.out, "events.jsonl") if os.path.exists(os.path.join(self.out, "events.jsonl")) else b""

    def kill_when(self, process, there):
        """SIGKILL as soon as `there` holds of the log; false when the run was faster."""
        while process.poll() is None and not there(self.log()):
            time.sleep(0.003)
        process.kill()
        process.communicate()
        return process.returncode == -signal.SIGKILL and b'"paths ended"' not in self.log()

    def begin(self, *options, mission=None, speed="25"):
        return subprocess.Popen([IVO, "run", mission or self.mission, "--speed", speed, "--out", self.out, *options],
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def cut_off(self, positions, speed=25.0):
        """A search that is killed when the log has so many positions. Where a busy host sees that too late, a slower one."""
        while not self.kill_when(self.begin("--yes", speed=str(speed)), lambda log: log.count(b'"position"') >= positions):
            self.setUp()
            speed /= 4
            self.assertGreater(speed, 0.2)

    def on_terminal(self, question, answer, *options, mission=None, killed_at=None):
        """(exit status, output) of a run on a terminal; without an answer it is killed at the question, or when the log says so."""
        near_end, far_end = open_terminal()
        speed = "5" if killed_at else "max"
        process = subprocess.Popen([IVO, "run", mission or self.mission, "--speed", speed, "--out", self.out, *options],
                                   stdin=far_end, stdout=far_end, stderr=far_end, start_new_session=True)
        os.close(far_end)
        output, asked = b"", False
        while True:
            try:
                output += os.read(near_end, 4096)
            except OSError:  # the program has ended
                break
            if not asked and question in output:
                asked = True
                if answer is None:
                    process.kill()
                else:
                    os.write(near_end, answer)
            if killed_at and killed_at(self.log()):
                process.kill()
        os.close(near_end)
        self.assertTrue(asked, output.decode())
        return process.wait(), output.decode().replace("\r\n", "\n")

    def searched_s(self):
        """What the log says: from one position to the next of the same search."""
        total, last = 0.0, None
        for event in events(self.out):
            if event["event"] == "search started":
                last = event["t_s"]
            elif event["event"] == "position":
                total, last = total + event["t_s"] - last, event["t_s"]
        return total

    def places(self):
        """Of each agent, the last that the log knows."""
        return {e["agent"]: (e["x_m"], e["y_m"]) for e in events(self.out) if e["event"] == "position"}

    def trim_log(self):
        log = whole_lines(self.log())
        with open(os.path.join(self.out, "events.jsonl"), "wb") as file:
            file.write(log)
        return log

    def assert_between(self, kept_s, logged_s):
        """The state may be younger than the last position in the log, but by no more than there is from one to the next."""
        self.assertTrue(logged_s - 1e-6 <= kept_s < logged_s + POSITION_EVERY_S, (logged_s, kept_s))

    def assert_near(self, place, logged):
        self.assertLess(max(abs(a - b) for a, b in zip(place, logged)), POSITION_EVERY_S * SPEED_MPS + 0.01)

    def assert_stands(self, log, searched_s, places):
        """Without a terminal nobody consents, whatever --yes says: all is there, nothing moves, the search stays."""
        done = ivo("run", self.mission, "--speed", "max", "--out", self.out, "--resume", "--yes")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertEqual(done.stderr, "")
        self.assertTrue(self.log().startswith(log), "the log is gone on with")
        said = events(self.out)[log.count(b"\n") :]
        self.assertEqual(said[0]["event"], "resumed")
        kept_s = said[0]["search_time_s"]
        self.assert_between(kept_s, searched_s)
        self.assertFalse({"consent", "position", "search started"} & {event["event"] for event in said})
        report = read_json(self.out, "report.json")
        self.assertEqual(report["end"], "no_consent")
        self.assertEqual(report["real_search_time_s"], kept_s)
        for agent in report["agents"]:
            if agent["name"] in places:
                self.assert_near(agent["final_position_m"], places[agent["name"]])
        return done.stdout

    def assert_goes_on(self, log, question=GO_ON):
        status, said = self.on_terminal(question, b"y\n", "--resume")
        self.assertEqual(status, 0, said)
        self.assertTrue(self.log().startswith(log), "the log is gone on with")
        self.assertEqual(contents(self.out, "plan.json"), self.whole_plan)
        times = [event["t_s"] for event in events(self.out)]
        self.assertEqual(times, sorted(times))
        report = read_json(self.out, "report.json")
        self.assertEqual(report["end"], "paths_ended")
        # It goes on, from where it was left: as long a way as at one go, and one more start from rest for each kill.
        for agent, whole in zip(report["agents"], self.whole_report["agents"]):
            self.assertAlmostEqual(agent["distance_m"], whole["distance_m"], delta=0.3)
        kills = sum(event["event"] == "resumed" for event in events(self.out))
        longer = report["real_search_time_s"] - self.whole_report["real_search_time_s"]
        self.assertTrue(-1.0 < longer < 1.0 + 2.0 * kills, longer)
        return said

    def assert_nothing_is_lost(self):
        log = self.trim_log()
        searched_s, places = self.searched_s(), self.places()
        said = self.assert_stands(log, searched_s, places)
        self.assertRegex(said, r"resumed +a search that was last heard of .* ago, [0-9.]+ s under way")
        self.assertRegex(said, r"check +IVO is taken to stand at .* up to 1\.40 m")
        self.assert_goes_on(log)
        # Where it stood is where it sets off, agent by agent.
        after = events(self.out)[log.count(b"\n") :]
        self.assertEqual([e["event"] for e in after if e["event"] in ("consent", "position")][0], "consent")
        for name, (x_m, y_m) in places.items():
            first = next(e for e in after if e["event"] == "position" and e["agent"] == name)
            self.assert_near((first["x_m"], first["y_m"]), (x_m, y_m))

    def test_killed_at_any_moment_of_the_search_nothing_is_lost(self):
        chance = random.Random(SEED)
        total = int(2 * 5 * self.whole_report["real_search_time_s"])
        for part in range(5):
            positions = 1 + (part * total + chance.randrange(total)) // 5
            with self.subTest(seed=SEED, positions=positions):
                self.setUp()
                self.cut_off(min(positions, total - 20))
                self.assert_nothing_is_lost()

    def test_killed_while_states_are_written_one_after_the_other_nothing_is_lost(self):
        # At this pace each second is over before the disk has the one before.
        chance = random.Random(SEED + 1)
        total = int(2 * 5 * self.whole_report["real_search_time_s"])
        for _ in range(2):
            positions = chance.randrange(1, total // 2)
            with self.subTest(seed=SEED + 1, positions=positions):
                self.setUp()
                self.cut_off(positions, speed=50.0)
                self.assert_nothing_is_lost()

    def test_killed_again_and_again_it_comes_to_its_end(self):
        self.cut_off(10)
        for positions in (40, 80):
            status, _ = self.on_terminal(GO_ON, b"y\n", "--resume", killed_at=lambda log: log.count(b'"position"') >= positions)
            self.assertEqual(status, -signal.SIGKILL)
        self.assert_nothing_is_lost()

    def test_killed_while_planning_it_is_planned_anew_and_asks(self):
        slow = write_mission(tempfile.mkdtemp(dir=self.scratch.name), MISSION.replace("generations = 5", "generations = 20000"), plaza(32))
        self.assertTrue(self.kill_when(self.begin("--yes", mission=slow, speed="1"), lambda log: b"plan improved" in log))
        log = self.trim_log()
        done = ivo("run", slow, "--speed", "max", "--out", self.out, "--resume", "--yes")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("cut off while it was being planned", done.stdout)
        self.assertTrue(self.log().startswith(log))
        self.assertNotIn("consent", [event["event"] for event in events(self.out)])
        # By now it has a plan, which stays.
        plan = contents(self.out, "plan.json")
        done = ivo("run", slow, "--speed", "max", "--out", self.out, "--resume")
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn("cut off before anybody had set off", done.stdout)
        self.assertEqual(contents(self.out, "plan.json"), plan)
        self.assertEqual([e["event"] for e in events(self.out)].count("plan ready"), 1)

    def test_killed_at_the_question_the_plan_is_there_and_the_question_comes_again(self):
        self.on_terminal(START, None)
        self.assertEqual(contents(self.out, "plan.json"), self.whole_plan)
        log = self.trim_log()
        os.remove(os.path.join(self.out, "plan.json"))
        self.assert_stands(log, 0.0, {})
        self.assertEqual(contents(self.out, "plan.json"), self.whole_plan, "it is kept with the search")
        self.assert_goes_on(log, START)
        self.assertNotIn("plan improved", [e["event"] for e in events(self.out)[log.count(b"\n") :]])

    def test_a_no_leaves_the_search_to_be_taken_up_another_time(self):
        self.cut_off(30)
        status, _ = self.on_terminal(GO_ON, b"n\n", "--resume")
        self.assertEqual(status, 3)
        self.assert_nothing_is_lost()

    def test_a_state_that_is_torn_is_said_and_the_log_makes_up_for_it(self):
        self.cut_off(45)
        newest = max((os.path.join(self.out, f"search.state.{n}") for n in (0, 1)),
                     key=lambda path: struct.unpack_from("<Q", contents(path), 16))
        with open(newest, "r+b") as file:
            file.truncate(os.path.getsize(newest) - 1)
        log = self.trim_log()
        said = self.assert_stands(log, self.searched_s(), self.places())
        self.assertIn("note        the newest state was not whole", said)
        self.assert_goes_on(log)

    def test_what_was_found_before_the_kill_is_reported_without_a_move(self):
        self.cut_off(40)
        self.trim_log()
        last = events(self.out)[-1]["t_s"] + POSITION_EVERY_S  # the state may be that much younger than the last line
        with open(os.path.join(self.out, "events.jsonl"), "a", encoding="utf-8") as file:
            file.write(f'{{"t_s":{last},"event":"found","agent":"Ana","x_m":1.0,"y_m":2.0}}\n')
        log = self.log()
        done = ivo("run", self.mission, "--speed", "max", "--out", self.out, "--resume")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("Ana found the object", done.stdout)
        self.assertNotIn("searching", [e.get("mode") for e in events(self.out)[log.count(b"\n") :]])

    def stop_when(self, process, there):
        """SIGTERM as soon as `there` holds of the log; the exit status."""
        while process.poll() is None and not there(self.log()):
            time.sleep(0.003)
        process.terminate()
        process.communicate()
        return process.returncode

    def test_a_search_that_was_stopped_goes_on_from_where_the_robot_came_to_rest(self):
        status = self.stop_when(self.begin("--yes", speed="5"), lambda log: log.count(b'"position"') >= 30)
        self.assertEqual(status, 1)
        report = read_json(self.out, "report.json")
        self.assertEqual(report["end"], "stopped")
        log = self.log()
        # Whoever stops it again, or says no, loses nothing either.
        done = ivo("run", self.mission, "--speed", "max", "--out", self.out, "--resume", "--yes")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertTrue(self.log().startswith(log), "the log is gone on with")
        again = read_json(self.out, "report.json")
        self.assertEqual(again["real_search_time_s"], report["real_search_time_s"])
        self.assertEqual([agent["final_position_m"] for agent in again["agents"]], [agent["final_position_m"] for agent in report["agents"]])
        self.assertEqual([agent["distance_m"] for agent in again["agents"]], [agent["distance_m"] for agent in report["agents"]])
        self.assert_goes_on(log)

    def test_a_search_that_was_stopped_before_anybody_set_off_asks_again(self):
        slow = write_mission(tempfile.mkdtemp(dir=self.scratch.name), MISSION.replace("generations = 5", "generations = 2000"), plaza(32))
        self.assertEqual(self.stop_when(self.begin(mission=slow, speed="1"), lambda log: b"plan improved" in log), 1)
        done = ivo("run", slow, "--speed", "max", "--out", self.out, "--resume")
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("resumed", done.stdout)

    def test_a_search_that_had_ended_before_the_kill_is_left_behind_once_it_is_reported(self):
        self.cut_off(40)
        self.trim_log()
        last = events(self.out)[-1]["t_s"] + POSITION_EVERY_S
        with open(os.path.join(self.out, "events.jsonl"), "a", encoding="utf-8") as file:
            file.write(f'{{"t_s":{last},"event":"found","agent":"Ana","x_m":1.0,"y_m":2.0}}\n')
        first = ivo("run", self.mission, "--speed", "max", "--out", self.out, "--resume")
        self.assertEqual(first.returncode, 0, first.stdout + first.stderr)
        log, report = self.log(), contents(self.out, "report.json")
        second = ivo("run", self.mission, "--speed", "max", "--out", self.out, "--resume")
        self.assertEqual(second.returncode, 3, second.stdout + second.stderr)
        self.assertIn("no search was cut off in", second.stdout)
        # And what it told is still there.
        self.assertEqual(contents(self.out, "events.previous.jsonl"), log)
        self.assertEqual(contents(self.out, "report.previous.json"), report)
        self.assertNotIn("found", [event["event"] for event in events(self.out)])

    def test_a_search_that_could_not_be_reported_has_not_ended(self):
        self.cut_off(40)
        os.makedirs(os.path.join(self.out, "report.json", "in the way"))
        status, said = self.on_terminal(GO_ON, b"y\n", "--resume")
        self.assertEqual(status, 1, said)
        self.assertIn("report.json", said)
        shutil.rmtree(os.path.join(self.out, "report.json"))
        done = ivo("run", self.mission, "--speed", "max", "--out", self.out, "--resume")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(read_json(self.out, "report.json")["end"], "paths_ended")

    def assert_refused(self, pattern, *, keeps=True):
        before = {name: contents(self.out, name) for name in os.listdir(self.out)}
        done = ivo("run", self.mission, "--speed", "max", "--out", self.out, "--resume", "--yes")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stderr, pattern)
        self.assertEqual(done.stderr.count("\n"), 1)
        if keeps:
            self.assertEqual({name: contents(self.out, name) for name in os.listdir(self.out)}, before)

    def test_a_search_of_a_changed_mission_is_refused_by_name_and_not_lost(self):
        folder = tempfile.mkdtemp(dir=self.scratch.name)
        mission = write_mission(folder, MISSION, plaza(32))
        self.mission, before = mission, self.mission
        self.addCleanup(setattr, self, "mission", before)
        self.cut_off(10)
        for name in ("mission.toml", "map.toml", "map.png"):
            path = os.path.join(folder, name)
            original = contents(path)
            with open(path, "ab") as file:
                file.write(b"\n")
            self.assert_refused(rf"^ivo: .*/{name}: has changed since the search in .* began; expected it as it was, or a run without --resume")
            with open(path, "wb") as file:
                file.write(original)
        # From another folder it is the same mission.
        moved = shutil.copytree(folder, folder + "_moved")
        done = ivo("run", os.path.join(moved, "mission.toml"), "--speed", "max", "--out", self.out, "--resume")
        self.assertEqual(done.returncode, 3, done.stderr)

    def test_without_resume_a_search_that_was_cut_off_is_set_aside_and_that_is_said(self):
        self.cut_off(10)
        log = self.log()
        done = ivo("run", self.mission, "--speed", "max", "--yes", "--out", self.out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"(?m)^note +.*: a search was cut off here, and --resume would take it up; it is kept as "
                                      r"search\.previous\.state\.\* and events\.previous\.jsonl$")
        self.assertEqual(contents(self.out, "events.previous.jsonl"), log)
        self.assertEqual(read_json(self.out, "report.json"), self.whole_report)
        # Under its old name it can still be taken up.
        for name in os.listdir(self.out):
            if ".previous." in name:
                os.replace(os.path.join(self.out, name), os.path.join(self.out, name.replace(".previous", "")))
        self.assert_nothing_is_lost()

    def test_with_nothing_to_take_up_a_new_search_begins(self):
        for _ in range(2):  # none, and one that has ended
            done = ivo("run", self.mission, "--speed", "max", "--yes", "--out", self.out, "--resume")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("no search was cut off in", done.stdout)
            self.assertEqual(read_json(self.out, "report.json"), self.whole_report)

    def write_slots(self, bytes_of_slot):
        for n in (0, 1):
            with open(os.path.join(self.out, f"search.state.{n}"), "wb") as file:
                file.write(bytes_of_slot)

    def test_a_damaged_state_is_refused_and_set_aside_by_the_next_run(self):
        self.cut_off(10)
        self.write_slots(b"rubbish")
        self.assert_refused(r"^ivo: .*/search\.state: what was kept of a search is damaged, in both copies; expected a whole one, or a run without --resume")
        done = ivo("run", self.mission, "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("damaged, in both copies; expected a whole one; it is kept as", done.stdout)

    def test_a_state_of_another_version_is_refused(self):
        self.cut_off(10)
        body = struct.pack("<IQI", 99, 1, 3) + b"abc"
        self.write_slots(b"IVOstate" + struct.pack("<I", zlib.crc32(body)) + body)
        self.assert_refused(r"^ivo: .*/search\.state: kept by another version of ivo, in form 99; expected form 3")

    def test_a_search_of_simulated_drives_is_not_taken_up_by_a_robot_nor_the_other_way_round(self):
        self.cut_off(10)
        for n in (0, 1):  # as if can_on_a_robot0 had been the interface
            path = os.path.join(self.out, f"search.state.{n}")
            slot = contents(path)
            body = slot[12:28] + slot[28 : 28 + struct.unpack_from("<I", slot, 24)[0]].replace(b"the virtual bus", b"can_on_a_robot0")
            with open(path, "wb") as file:
                file.write(slot[:8] + struct.pack("<I", zlib.crc32(body)) + body)
        self.assert_refused(r"^ivo: .*: a search on can_on_a_robot0 was cut off here; expected it to be taken up there, not on the virtual bus, "
                            r"or a run without --resume")

    def test_without_room_for_the_state_nothing_begins(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))

        done = subprocess.run([IVO, "run", self.mission, "--yes", "--speed", "max", "--out", self.out], capture_output=True, text=True,
                              stdin=subprocess.DEVNULL, preexec_fn=limit, check=False)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stderr, r"^ivo: .*/search\.state\.new: cannot be written: File too large\n$")

    def test_a_state_that_cannot_be_made_is_refused(self):
        os.mkdir(os.path.join(self.out, "search.state.new"))
        done = ivo("run", self.mission, "--yes", "--speed", "max", "--out", self.out)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stderr, r"^ivo: .*/search\.state\.new: cannot be written: Is a directory\n$")

    def test_a_search_that_can_no_longer_be_kept_says_so_once_and_is_a_failure(self):
        process = self.begin("--yes", speed="1")
        while process.poll() is None and b'"position"' not in self.log():
            time.sleep(0.003)
        slot = os.path.join(self.out, "search.state.1")
        while True:  # it may be written just now
            try:
                os.remove(slot)
            except FileNotFoundError:
                pass
            try:
                os.mkdir(slot)
                break
            except FileExistsError:
                pass
        output, errors = process.communicate()
        self.assertEqual(process.returncode, 1, output)
        said = errors.decode()
        self.assertIn("search.state.1: cannot be written: Is a directory; a run that is cut off now loses", said)
        self.assertEqual(said.count("search.state.1"), 2, "when it began, and at the end")
        self.assertEqual(read_json(self.out, "report.json")["end"], "paths_ended")


if __name__ == "__main__":
    unittest.main()
