#!/usr/bin/env python3
"""Areas that are closed after a plan was made: no consent counts for a way into one, whoever gives it and however."""

import os
import select
import subprocess
import tempfile
import unittest

import console_client as console
from console_client import Client
from mission_files import IVO, MISSION, events, write_mission
from terminals import open_terminal

# Of the plaza of 12 x 12 m where everybody starts at its lower edge: all that lies above.
ABOVE = [(0.2, 4), (11.8, 4), (11.8, 11.8), (0.2, 11.8)]


class NoGo(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.out = os.path.join(self.folder, "out")
        self.mission = write_mission(self.folder, MISSION.replace('"drawn"', '"unknown"').replace("generations = 5", "generations = 1000000"))
        self.terminal = None
        self.said = b""  # on the terminal, and not read yet

    def start(self, *more, terminal=False):
        path = os.path.join(self.folder, "console")
        command = [IVO, "run", self.mission, "--console", path, "--out", self.out, *more]
        if terminal:
            self.terminal, theirs = open_terminal()
            self.addCleanup(os.close, self.terminal)
            process = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs)
            os.close(theirs)
        else:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        client = Client(path)
        self.addCleanup(client.close)
        client.status(lambda status: status.mode == console.PLANNING and status.expected_time_s > 0)
        return client

    def close_and_plan_to_the_end(self, client):
        """An area is closed while the plan is made, that does not know of it."""
        self.assertEqual(client.put_area(9, ABOVE, console.NO_GO, console.EVERYBODY), console.ACCEPTED)
        self.assertEqual(client.command(console.ENOUGH, 0, 1), console.ACCEPTED)
        asked = client.status(lambda status: status.asks == console.FOR_CONSENT)
        self.assertEqual(asked.into_no_go, 0)
        return asked

    def modes(self):
        return [event["mode"] for event in events(self.out) if event["event"] == "mode"]

    def read_until(self, words):
        while words not in self.said:
            self.assertTrue(select.select([self.terminal], [], [], 60)[0], f"{words} did not come, but {self.said[-500:]}")
            self.said += os.read(self.terminal, 4096)
        self.said = self.said.split(words, 1)[1]

    def test_consent_beforehand_is_none_to_that(self):
        client = self.start("--yes")
        asked = self.close_and_plan_to_the_end(client)
        self.assertEqual(client.command(console.CONSENT, asked.question), console.OUTDATED)
        self.assertEqual(client.command(console.ACCEPT, 0, 1), console.OUTDATED)
        self.assertEqual(self.modes()[-1], "awaiting consent")
        self.assertEqual(client.command(console.REMOVE_AREA, 0, 9), console.ACCEPTED)
        client.status(lambda status: status.mode == console.SEARCHING)

    def test_consent_at_the_terminal_is_asked_for_again(self):
        client = self.start(terminal=True)
        self.close_and_plan_to_the_end(client)
        self.read_until(b"Start the search?")
        os.write(self.terminal, b"y\n")
        self.read_until(b"expected another plan first")
        self.read_until(b"Start the search?")
        self.assertEqual(self.modes()[-1], "awaiting consent")
        self.assertEqual(client.command(console.REMOVE_AREA, 0, 9), console.ACCEPTED)
        client.status(lambda status: status.into_no_go == console.NOBODY)
        os.write(self.terminal, b"y\n")
        client.status(lambda status: status.mode == console.SEARCHING)

    def test_a_robot_under_way_stands_before_it(self):
        client = self.start("--yes")
        self.assertEqual(client.command(console.ENOUGH, 0, 1), console.ACCEPTED)
        client.status(lambda status: status.mode == console.SEARCHING)
        self.assertEqual(client.put_area(9, ABOVE, console.NO_GO, 0), console.ACCEPTED)
        stands = client.status(lambda status: status.asks == console.FOR_CONSENT)
        self.assertEqual((stands.pause_cause, stands.into_no_go), (console.PAUSE_FOR_NO_GO, 0))
        self.assertIn("a no-go area lies ahead", [event.get("cause") for event in events(self.out) if event["event"] == "paused"])


if __name__ == "__main__":
    unittest.main()
