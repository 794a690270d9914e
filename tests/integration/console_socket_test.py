#!/usr/bin/env python3
"""The console's socket of `ivo run`, from outside: consent and stop come through it, and nothing else does."""

import os
import random
import re
import socket
import stat
import subprocess
import tempfile
import time
import unittest

import console_client as console
from console_client import Client
from mission_files import BUILD_DIR, IVO, MISSION, events, ivo, read_json, write_mission


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

    def start(self, *more, out=None):
        """ivo run without a terminal, in the folder of this test."""
        mission = write_mission(self.folder, MISSION.replace('"drawn"', '"unknown"'))
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

    def flood(self, client):
        """As much of each kind as ten thousand of all are; all of it is refused, and by its own name."""
        rude = self.client()
        chance = random.Random(5)
        good = console.COMMAND.pack(console.MAGIC, console.VERSION, console.CONSENT, console.COMMAND.size, 1, 1, 0)

        def with_field(offset, form, value):
            return good[:offset] + value.to_bytes(form, "little") + good[offset + form:]

        kinds = {
            console.WRONG_SIZE: lambda: chance.randbytes(chance.choice([1, 15, 16, 23, 25, 100, 1024, 1500, 4000])),
            console.WRONG_MAGIC: lambda: with_field(0, 4, chance.randrange(1 << 20)),
            console.WRONG_VERSION: lambda: with_field(4, 2, chance.randrange(console.VERSION + 1, 1 << 16)),
            console.UNKNOWN_KIND: lambda: with_field(6, 2, chance.randrange(6, 1 << 16)),
            console.NOT_ZERO: lambda: with_field(20, 4, chance.randrange(1, 1 << 32)),
            console.REPLAYED: lambda: with_field(12, 4, 0),
            console.OUT_OF_ORDER: lambda: with_field(12, 4, chance.randrange(2, 1 << 32)),
        }
        before = client.status()
        each = 1500
        for _ in range(each):
            for make in kinds.values():
                rude.socket.send(make())
        # What it has sent is heard in order: when its last is refused, all are.
        while client.status().messages[console.OUT_OF_ORDER] < each:
            pass
        after = client.status()
        for verdict in kinds:
            self.assertEqual(after.messages[verdict] - before.messages[verdict], each, verdict)
        self.assertEqual(after.messages[console.ACCEPTED], before.messages[console.ACCEPTED])
        self.assertEqual((after.mode, after.question), (before.mode, before.question))
        self.assertGreater(after.answers_dropped, 0, "it never reads")

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
        sent, full = map(int, re.match(r"29 pings, (\d+) of garbage sent; (\d+) not taken; ", load.stdout).groups())
        self.assertEqual(sent + full, 1980)
        self.assertGreater(sent, 100, "a socket takes more before it is full")
        client.command(console.PING)
        after = client.status(lambda status: sum(status.messages) >= sent + 30)
        self.assertEqual((after.messages[console.ACCEPTED], sum(after.messages)), (30, sent + 30))
        client.command(console.NO_CONSENT, asked.question)
        self.end(process, 3)


if __name__ == "__main__":
    unittest.main()
