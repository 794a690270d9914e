#!/usr/bin/env python3
"""The console's socket of `ivo run`, from outside: consent and stop come through it, and nothing else does."""

import json
import os
import random
import re
import socket
import stat
import struct
import subprocess
import tempfile
import threading
import time
import unittest

import console_client as console
from console_client import Client
from mission_files import BUILD_DIR, IVO, MISSION, events, ivo, plaza, read_json, write_mission


def contents(folder, name):
    with open(os.path.join(folder, name), "rb") as file:
        return file.read()


class ConsoleSocket(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.path = os.path.join(self.folder, "console")
        self.out = os.path.join(self.folder, "out")

    def start(self, *more, out=None, mission=MISSION.replace('"drawn"', '"unknown"'), rows=None):
        """ivo run without a terminal, in the folder of this test."""
        mission = write_mission(self.folder, mission, rows)
        process = subprocess.Popen([IVO, "run", mission, "--console", self.path, "--out", out or self.out, *(more or ("--speed", "max"))],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def client(self):
        client = Client(self.path)
        self.addCleanup(client.close)
        return client

    def asked(self, client, asks=console.FOR_CONSENT):
        return client.status(lambda status: status.asks == asks)

    def end(self, process, status):
        said, _ = process.communicate()
        self.assertEqual(process.returncode, status, said)
        return said

    def modes(self):
        return [event["mode"] for event in events(self.out) if event["event"] == "mode"]

    def script(self, text):
        path = os.path.join(self.folder, "script.toml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_consent_through_the_socket_starts_the_search(self):
        process = self.start()
        client = self.client()
        self.assertEqual(stat.S_IMODE(os.stat(self.path).st_mode), 0o660)
        asked = self.asked(client)
        self.assertEqual(asked.mode, console.AWAITING_CONSENT)
        self.assertEqual(client.command(console.CONSENT, asked.question), console.ACCEPTED)
        self.assertIn("the console says yes", self.end(process, 0))
        self.assertEqual(read_json(self.out, "report.json")["end"], "paths_ended")
        self.assertIn("searching", self.modes())
        self.assertFalse(os.path.exists(self.path))

    def test_nothing_moves_while_nobody_answers_and_no_ends_it(self):
        process = self.start()
        client = self.client()
        asked = self.asked(client)
        for _ in range(5):
            self.assertEqual(client.command(console.PING), console.ACCEPTED)
            self.assertEqual(client.status().mode, console.AWAITING_CONSENT)
        self.assertEqual(client.command(console.NO_CONSENT, asked.question), console.ACCEPTED)
        self.end(process, 3)
        self.assertNotIn("searching", self.modes())

    def test_stop_stops_a_search(self):
        process = self.start("--yes", "--speed", "5")
        client = self.client()
        client.status(lambda status: status.mode == console.SEARCHING)
        self.assertEqual(client.command(console.STOP), console.ACCEPTED)
        self.end(process, 1)
        self.assertEqual(read_json(self.out, "report.json")["end"], "stopped")
        self.assertEqual(self.modes()[-2:], ["stopping", "done"])

    def test_consent_to_what_is_not_asked_moves_nothing(self):
        process = self.start()
        client = self.client()
        asked = self.asked(client)
        self.assertEqual(client.command(console.CONSENT, asked.question + 1), console.OTHER_QUESTION)
        self.assertEqual(client.command(console.CONSENT, 0), console.OTHER_QUESTION)
        self.assertEqual(client.command(console.CLEAR_FAULT, asked.question), console.NOT_ASKED)
        self.assertEqual(client.status().mode, console.AWAITING_CONSENT)
        self.assertEqual(client.command(console.NO_CONSENT, asked.question), console.ACCEPTED)
        try:
            late = client.command(console.CONSENT, asked.question)
        except (AssertionError, BrokenPipeError):  # the run has ended by then
            late = console.ANSWERED
        self.assertIn(late, (console.ANSWERED, console.NOT_ASKED))
        self.end(process, 3)
        self.assertNotIn("searching", self.modes())

    def test_a_fault_is_cleared_through_the_socket_and_needs_consent_anew(self):
        reboot = self.script('[[at]]\nt_s = 8.0\ndrive = "rear_left"\nfault = "reboot"\n')
        process = self.start("--speed", "max", "--yes", "--script", reboot)
        client = self.client()
        asked = self.asked(client, console.FOR_CLEARING)
        self.assertEqual((asked.mode, asked.fault), (console.FAULT, "drive 3 (rear left): rebooted"))
        self.assertEqual(client.command(console.CONSENT, asked.question), console.NOT_ASKED)
        self.assertEqual(client.command(console.CLEAR_FAULT, asked.question), console.ACCEPTED)
        again = self.asked(client)
        self.assertEqual(again.question, asked.question + 1)
        self.assertEqual(client.command(console.CONSENT, again.question), console.ACCEPTED)
        self.end(process, 0)
        self.assertEqual(self.modes().count("searching"), 2)

    def test_garbage_by_the_ten_thousand_is_refused_and_counted_and_changes_nothing(self):
        calm, flooded = (os.path.join(self.folder, name) for name in ("calm", "flooded"))
        for out in (calm, flooded):
            process = self.start(out=out)
            client = self.client()
            asked = self.asked(client)
            if out == flooded:
                self.flood(client)
            self.assertEqual(client.command(console.CONSENT, asked.question), console.ACCEPTED)
            self.end(process, 0)
        for name in ("plan.json", "report.json"):
            self.assertEqual(contents(calm, name), contents(flooded, name), name)

    def flood(self, client, each=1500):
        """So many of each form and fault; all of it is refused, and by its own name."""
        rude = self.client()
        chance = random.Random(5)
        consent = console.COMMAND.pack(console.MAGIC, console.VERSION, console.CONSENT, console.COMMAND.size, 1, 1, 0)
        ping = console.COMMAND.pack(console.MAGIC, console.VERSION, console.PING, console.COMMAND.size, 1, 0, 0)
        corners = [3.0, 3.0, 9.0, 3.0, 9.0, 9.0] + [0.0] * 122
        area = console.AREA.pack(console.MAGIC, console.VERSION, console.PUT_AREA, console.AREA.size, 1, 31, console.PREFERRED, 1, 3, 0, *corners)
        pose = console.POSITION.pack(console.MAGIC, console.VERSION, console.POSE, console.POSITION.size, 1, 1, 3.0, 3.0, 0.0, 0.5, 0.0, 0.0)

        def with_field(offset, form, value, good=None):
            good = good or chance.choice((consent, area, pose))
            return good[:offset] + value.to_bytes(form, "little") + good[offset + form:]

        def with_number(offset, value, good):
            return good[:offset] + struct.pack("<d", value) + good[offset + 8:]

        nan, infinite = float("nan"), float("inf")
        kinds = [
            (console.WRONG_SIZE, lambda: chance.randbytes(chance.choice([1, 15, 2500, 4000]))),
            (console.WRONG_SIZE, lambda: chance.choice((consent, area, pose))[:-1]),
            (console.WRONG_SIZE, lambda: with_field(6, 2, console.PUT_AREA, pose)),
            (console.WRONG_MAGIC, lambda: with_field(0, 4, chance.randrange(1 << 20))),
            (console.WRONG_VERSION, lambda: with_field(4, 2, chance.randrange(console.VERSION + 1, 1 << 16))),
            (console.UNKNOWN_KIND, lambda: with_field(6, 2, chance.randrange(console.POSE + 1, 1 << 16))),
            (console.NOT_ZERO, lambda: with_field(20, 4, chance.randrange(1, 1 << 32), ping)),
            (console.NOT_ZERO, lambda: with_field(20, 4, chance.randrange(1, 1 << 32), area)),
            (console.NOT_ZERO, lambda: with_number(24 + 8 * chance.randrange(6, 128), 1.0, area)),
            (console.NOT_ZERO, lambda: with_field(chance.randrange(17, 24), 1, 1, pose)),
            (console.OUT_OF_RANGE, lambda: with_field(20, 4, chance.randrange(2, 1 << 32), consent)),
            (console.OUT_OF_RANGE, lambda: with_field(16, 1, chance.randrange(32, 256), area)),
            (console.OUT_OF_RANGE, lambda: with_field(19, 1, chance.randrange(65, 256), area)),
            (console.OUT_OF_RANGE, lambda: with_number(24 + 8 * chance.randrange(6), chance.choice((nan, infinite, -infinite, 1e300)), area)),
            (console.OUT_OF_RANGE, lambda: with_number(24 + 8 * chance.randrange(6), chance.choice((nan, infinite, -infinite)), pose)),
            (console.OUT_OF_RANGE, lambda: with_number(64, chance.choice((-1.0, 11.0)), pose)),
            (console.NOT_AN_AREA, lambda: with_field(19, 1, chance.randrange(3), area)),
            (console.REPLAYED, lambda: with_field(12, 4, 0)),
            (console.OUT_OF_ORDER, lambda: with_field(12, 4, chance.randrange(2, 1 << 32))),
        ]
        before = client.status()
        for _ in range(each):
            for _, make in kinds:
                rude.socket.send(make())
        # What it has sent is heard in order: when its last is refused, all are.
        after = client.status(lambda status: status.messages[console.OUT_OF_ORDER] >= before.messages[console.OUT_OF_ORDER] + each)
        for refused in {verdict for verdict, _ in kinds}:
            count = each * sum(verdict == refused for verdict, _ in kinds)
            self.assertEqual(after.messages[refused] - before.messages[refused], count, refused)
        self.assertEqual(after.messages[console.ACCEPTED], before.messages[console.ACCEPTED])
        self.assertEqual((after.mode, after.question, after.areas_revision), (before.mode, before.question, before.areas_revision))
        self.assertGreater(after.answers_dropped, 0, "it never reads")
        rude.close()
        return each * len(kinds)

    def test_a_hundred_thousand_hostile_messages_do_not_disturb_a_search(self):
        process = self.start("--yes", "--speed", "1", rows=plaza(160))  # minutes of search
        client = self.client()
        client.status(lambda status: status.mode == console.SEARCHING and status.search_started)
        sent = 0
        while sent < 100_000:
            sent += self.flood(client, 1000)
        self.assertEqual(client.command(console.FOUND, 0, 1), console.ACCEPTED)
        self.end(process, 0)
        report = read_json(self.out, "report.json")
        self.assertEqual(report["end"], "found")
        self.assertNotIn("pausing", self.modes())

    def test_more_than_the_rate_is_refused_but_a_stop(self):
        process = self.start()
        client = self.client()
        self.asked(client)
        verdicts = [client.command(console.PING) for _ in range(30)]
        self.assertEqual(set(verdicts), {console.ACCEPTED})
        hasty = self.client()
        verdict = console.ACCEPTED
        while verdict != console.TOO_OFTEN:  # on a busy host a burst may take longer than its rate allows
            for _ in range(100):
                hasty.send(console.PING)
            verdict = hasty.command(console.PING)
        client.status(lambda status: status.messages[console.TOO_OFTEN] > 0)
        self.assertEqual(hasty.command(console.STOP), console.ACCEPTED)
        self.end(process, 1)

    def test_whoever_dies_hangs_or_comes_too_late_is_not_noticed(self):
        process = self.start()
        client = self.client()
        hung = [self.client() for _ in range(2)]
        dead = self.client()
        dead.send(console.PING)
        dead.close()
        asked = self.asked(client)
        for _ in range(3):  # somebody always comes and goes
            self.client().close()
        client.status(lambda status: status.clients == 3)
        hung.append(self.client())
        hung[-1].status()
        late = self.client()
        self.assertEqual(late.hear().verdict, console.TOO_MANY_CLIENTS)
        self.assertIsNone(late.hear())
        self.assertEqual(client.command(console.CONSENT, asked.question), console.ACCEPTED)
        self.end(process, 0)

    def test_a_second_controller_is_refused_and_writes_nothing(self):
        process = self.start()
        client = self.client()
        asked = self.asked(client)
        other = os.path.join(self.folder, "other")
        done = ivo("run", write_mission(self.folder), "--console", self.path, "--out", other)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"ivo: --console: {self.path}: another process listens there; expected one controller at a time\n")
        self.assertFalse(os.path.exists(other))
        client.command(console.NO_CONSENT, asked.question)
        self.end(process, 3)

    def test_the_socket_of_a_controller_that_was_killed_is_replaced(self):
        process = self.start()
        self.asked(self.client())
        process.kill()
        process.wait()
        self.assertTrue(os.path.exists(self.path))
        self.test_consent_through_the_socket_starts_the_search()

    # The dialogue

    def all_of(self, kind):
        return [event for event in events(self.out) if event["event"] == kind]

    def start_reported(self, *more, generations=5):
        """A mission with a person whose place is reported and who would rather search in the north-east."""
        mission = MISSION.replace('"drawn"', '"unknown"').replace('kind = "person"', 'kind = "person"\nmotion = "reported"')
        mission = mission.replace("generations = 5", f"generations = {generations}") + "preferred = [{ polygon_m = [[6, 6], [11, 6], [11, 11], [6, 11]] }]\n"
        return self.start(*more, mission=mission)

    def keep_beating(self):
        """As a page does, from a place of its own. What ends it."""
        client = self.client()
        ended = threading.Event()

        def beat():
            while not ended.wait(0.1):
                client.command(console.BEAT)

        thread = threading.Thread(target=beat, daemon=True)
        thread.start()

        def end():
            ended.set()
            thread.join()

        self.addCleanup(end)
        return end

    def asked_about(self, client, plan):
        return client.status(lambda status: status.asks == console.FOR_CONSENT and status.plan_number == plan)

    def test_people_and_robot_talk_about_where_to_look(self):
        process = self.start_reported("--speed", "1")
        client = self.client()
        first = self.asked_about(client, 1)
        self.assertEqual(first.with_preferences, 1)
        mission = client.document("mission")
        self.assertEqual([agent["name"] for agent in mission["agents"]], ["IVO", "Ana"])
        self.assertEqual(len(client.document("areas")["areas"]), 1)
        for name in ("map", "probability", "searched", "plan"):
            self.assertGreater(len(client.documents[name]), 0, name)

        # Without preferences, then with others.
        self.assertEqual(client.command(console.INIT), console.ACCEPTED)
        self.assertEqual(self.asked_about(client, 2).with_preferences, 0)
        self.assertEqual(client.put_area(5, [(1, 7), (5, 7), (5, 11), (1, 11)]), console.ACCEPTED)
        self.assertEqual(client.put_area(6, [(1, 1), (5, 5), (5, 1), (1, 5)]), console.NOT_AN_AREA)
        self.assertEqual(client.command(console.REMOVE_AREA, 0, 0), console.ACCEPTED)
        seen = client.status(lambda status: status.areas_revision == first.areas_revision + 2)
        self.assertEqual(client.command(console.REPLAN, 0, first.areas_revision), console.OUTDATED)
        self.assertEqual(client.command(console.REPLAN, 0, seen.areas_revision), console.ACCEPTED)
        third = self.asked_about(client, 3)
        self.assertEqual(third.with_preferences, 1)
        self.assertIsNotNone(client.document("plan", lambda plan: plan["number"] == 3)["agents"][1]["preferred_share"])
        self.assertEqual(client.document("previous_plan", lambda plan: plan["number"] == 2)["with_preferences"], False)

        # What cannot be planned is refused by name, and the plan before stays.
        self.assertEqual(client.put_area(7, [(1, 1), (3, 1), (3, 3), (1, 3)], console.NO_GO, 0), console.ACCEPTED)
        seen = client.status(lambda status: status.areas_revision > seen.areas_revision)
        self.assertEqual(client.command(console.REPLAN, 0, seen.areas_revision), console.ACCEPTED)
        self.assertEqual(client.document("notice")["code"], "start_restricted")
        again = self.asked_about(client, 3)
        self.assertGreater(again.question, third.question)
        self.assertEqual(client.command(console.REMOVE_AREA, 0, 7), console.ACCEPTED)

        # Agreed, and somebody is there.
        self.assertEqual(client.command(console.ACCEPT, 0, 2), console.OUTDATED)
        verdict = console.OUTDATED
        while verdict == console.OUTDATED:  # until it has looked whether the way leads into a closed area, now that there is none
            time.sleep(0.05)
            verdict = client.command(console.ACCEPT, 0, 3)
        self.assertEqual(verdict, console.ACCEPTED)
        self.assertEqual(client.status(lambda status: status.accepted == 1).mode, console.AWAITING_CONSENT)
        self.assertEqual(client.command(console.CONSENT, third.question, 1), console.OTHER_QUESTION)
        end_beats = self.keep_beating()
        self.assertEqual(client.command(console.CONSENT, again.question, 1), console.ACCEPTED)
        client.status(lambda status: status.mode == console.SEARCHING)
        self.assertEqual(client.report(1, 10.5, 3.0), console.ACCEPTED)
        self.assertEqual(client.report(0, 10.5, 3.0), console.NOT_NOW)
        self.assertEqual(client.command(console.BEAT), console.ACCEPTED)
        there = client.status(lambda status: status.agents[1].reported and status.searched_mass > 0.05)
        self.assertEqual((there.mode, there.watched, there.agents[1].reported), (console.SEARCHING, 1, 1))
        self.assertEqual((there.agents[1].x_m, there.agents[1].y_m), (10.5, 3.0))
        self.assertGreater(there.searched_mass, 0.05)

        # Nobody is there any more.
        end_beats()
        lost = self.asked(client)
        self.assertEqual((lost.pause_cause, lost.search_started), (console.BEAT_LOST, 1))
        self.assertEqual(client.command(console.BEAT), console.ACCEPTED)
        self.assertEqual(client.status().mode, console.AWAITING_CONSENT, "a beat is no consent")

        # On from where everybody is; paused; found.
        seen = client.status()
        self.assertEqual(client.command(console.REPLAN, 0, seen.areas_revision), console.ACCEPTED)
        fourth = self.asked_about(client, 4)
        robot = client.document("plan", lambda plan: plan["number"] == 4)["agents"][0]["waypoints_m"][0]
        self.assertAlmostEqual(robot[0], fourth.agents[0].x_m, delta=0.02)
        self.assertAlmostEqual(robot[1], fourth.agents[0].y_m, delta=0.02)
        self.assertEqual(client.command(console.CONSENT, fourth.question, 0), console.ACCEPTED)
        client.status(lambda status: status.mode == console.SEARCHING)
        time.sleep(0.5)
        self.assertEqual(client.command(console.PAUSE), console.ACCEPTED)
        paused = self.asked(client)
        self.assertEqual(paused.pause_cause, console.PAUSE_ASKED)
        self.assertEqual(client.command(console.FOUND, 0, 7), console.OUT_OF_RANGE)
        self.assertEqual(client.command(console.FOUND, 0, 1), console.ACCEPTED)
        while client.hear() is not None:
            pass
        self.end(process, 0)
        self.assertEqual(json.loads(client.documents["report"]), read_json(self.out, "report.json"))
        self.assertEqual(read_json(self.out, "report.json")["end"], "found")
        self.assertEqual([event["cause"] for event in self.all_of("paused")], ["the operator's page is not heard", "operator"])
        self.assertEqual([event["plan"] for event in self.all_of("plan taken")], [4])

    def test_a_plan_may_be_asked_for_while_one_is_made(self):
        process = self.start_reported("--speed", "max", generations=1_000_000)
        client = self.client()
        client.status(lambda status: status.mode == console.PLANNING and status.expected_time_s > 0)
        self.assertFalse(client.document("plan")["done"])
        self.assertEqual(client.command(console.INIT), console.ACCEPTED)
        self.assertIn(client.command(console.INIT), (console.NOT_NOW, console.ACCEPTED))  # it may have begun by then
        second = client.status(lambda status: status.plan_number > 1 and status.preparing == 0 and status.expected_time_s > 0)
        self.assertEqual(second.mode, console.PLANNING)
        self.assertEqual(client.command(console.ENOUGH, 0, 1), console.OUTDATED)
        verdict = console.OUTDATED
        while verdict != console.ACCEPTED:  # the second wish may have made another since
            plan = client.status(lambda status: status.preparing == 0 and status.expected_time_s > 0).plan_number
            verdict = client.command(console.ENOUGH, 0, plan)
        asked = self.asked_about(client, plan)
        self.assertTrue(client.document("plan", lambda document: document["number"] == plan and document["done"]))
        self.assertEqual(client.command(console.NO_CONSENT, asked.question), console.ACCEPTED)
        self.end(process, 3)

    def test_a_search_that_is_killed_after_a_replan_is_taken_up_with_that_plan(self):
        process = self.start_reported("--speed", "5")
        client = self.client()
        self.assertEqual(client.command(console.CONSENT, self.asked_about(client, 1).question), console.ACCEPTED)
        client.status(lambda status: status.mode == console.SEARCHING and status.agents[0].moved_m > 1.0)
        self.assertEqual(client.report(1, 9.0, 4.0), console.ACCEPTED)
        self.assertEqual(client.command(console.INIT), console.ACCEPTED)
        second = self.asked_about(client, 2)
        planned = client.document("plan", lambda plan: plan["number"] == 2)
        self.assertEqual(client.command(console.CONSENT, second.question), console.ACCEPTED)
        client.status(lambda status: status.mode == console.SEARCHING and status.agents[0].moved_m > second.agents[0].moved_m + 1.0)
        time.sleep(1.5)  # it is kept once a second
        before = client.status()
        process.kill()
        process.communicate()
        client.close()

        process = self.start_reported("--speed", "max", "--resume")
        client = self.client()
        asked = self.asked(client)
        self.assertEqual(asked.search_started, 1)
        # As it was kept, a second ago at most: five metres of a search at five times real time, at half a metre a second.
        self.assertAlmostEqual(asked.agents[0].moved_m, before.agents[0].moved_m, delta=5.0)
        self.assertGreater(asked.agents[0].moved_m, second.agents[0].moved_m)
        self.assertEqual([agent["waypoints_m"] for agent in client.document("plan")["agents"]],
                         [agent["waypoints_m"] for agent in planned["agents"]])
        self.assertEqual(client.command(console.CONSENT, asked.question), console.ACCEPTED)
        while client.hear() is not None:
            pass
        self.end(process, 0)
        report = read_json(self.out, "report.json")
        self.assertEqual(report["end"], "paths_ended")
        end = planned["agents"][0]["waypoints_m"][-1]
        last = [event for event in events(self.out) if event["event"] == "position" and event["agent"] == "IVO"][-1]
        self.assertAlmostEqual(last["x_m"], end[0], delta=0.2)
        self.assertAlmostEqual(last["y_m"], end[1], delta=0.2)

    # The command line

    def tell(self, verb):
        return ivo("console", verb, "--socket", self.path)

    def test_the_command_line_asks_and_tells(self):
        process = self.start()
        self.asked(self.client())
        shown = self.tell("status")
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertIn("awaiting consent; asks for consent: the robot will move", shown.stdout)
        cleared = self.tell("clear")
        self.assertEqual((cleared.returncode, cleared.stderr),
                         (1, "ivo: the controller refuses: not asked for now; it is awaiting consent; asks for consent: the robot will move\n"))
        told = self.tell("consent")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.end(process, 0)

    def test_who_agrees_to_go_on_is_told_where_the_robot_is_taken_to_stand(self):
        process = self.start("--speed", "10")
        client = self.client()
        self.assertEqual(client.command(console.CONSENT, self.asked(client).question), console.ACCEPTED)
        while process.poll() is None and "position" not in [event["event"] for event in events(self.out)]:
            time.sleep(0.01)
        process.kill()
        process.communicate()
        process = self.start("--speed", "max", "--resume")
        self.asked(self.client())
        warning = r"(?m)^taken up +the robot is taken to stand at \([0-9.]+, [0-9.]+\); see to it before you agree$"
        self.assertRegex(self.tell("status").stdout, warning)
        self.assertRegex(self.tell("consent").stdout, warning)
        self.end(process, 0)

    def test_nobody_is_told_of_a_pose_where_nothing_is_taken_up(self):
        process = self.start()
        self.asked(self.client())
        self.assertNotIn("taken up", self.tell("status").stdout + self.tell("consent").stdout)
        self.end(process, 0)

    def test_the_command_line_refuses_and_stops(self):
        for verb, status in (("refuse", 3), ("stop", 1)):
            process = self.start()
            self.asked(self.client())
            self.assertEqual(self.tell(verb).returncode, 0)
            self.end(process, status)

    def test_the_command_line_says_who_is_not_there(self):
        done = self.tell("status")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"ivo: {self.path}: nobody listens there; expected a controller that runs, as ivo run --console {self.path}\n")
        with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as stranger:
            stranger.bind(self.path)
            stranger.listen()
            asking = subprocess.Popen([IVO, "console", "status", "--socket", self.path], stderr=subprocess.PIPE, text=True)
            other, _ = stranger.accept()
            with other:
                other.send(b"hello")
                _, said = asking.communicate()
        self.assertEqual(asking.returncode, 2)
        self.assertIn("does not speak as this program does", said)

    def test_the_load_generator_sends_what_it_says(self):
        process = self.start()
        client = self.client()
        asked = self.asked(client)
        load = subprocess.run([os.path.join(BUILD_DIR, "console_load"), self.path, "30", "2000", "1"], capture_output=True, text=True, check=True)
        # A socket that nobody gets to read for a tenth of a second is full.
        sent, full = map(int, re.match(r"29 messages, (\d+) of garbage sent; (\d+) not taken; ", load.stdout).groups())
        self.assertEqual(sent + full, 1980)
        self.assertGreater(sent, 100, "a socket takes more before it is full")
        client.command(console.PING)
        after = client.status(lambda status: sum(status.messages) >= sent + 30)
        self.assertEqual(sum(after.messages), sent + 30)
        # Of each three one is of a person who is not reported.
        self.assertEqual((after.messages[console.ACCEPTED], after.messages[console.NOT_NOW]), (21, 9))
        self.assertGreater(after.areas_revision, asked.areas_revision)
        client.command(console.NO_CONSENT, asked.question)
        self.end(process, 3)


if __name__ == "__main__":
    unittest.main()
