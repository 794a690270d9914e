#!/usr/bin/env python3
"""`ivo wheels` from outside: at a terminal, with somebody who holds the key, and without one."""

import os
import re
import signal
import subprocess
import tempfile
import unittest

from mission_files import IVO, SOURCE_DIR, ivo
from technician import Technician

ROBOT = os.path.join(SOURCE_DIR, "config", "robots", "ivo.toml")


def robot_with(folder, name, changes):
    """A robot file like the shipped one, but with other values: {(wheel, key): value}."""
    with open(ROBOT, encoding="utf-8") as file:
        parts = re.split(r"(?=^\[drive\.)", file.read(), flags=re.MULTILINE)
    for (wheel, key), value in changes.items():
        place = next(i for i, part in enumerate(parts) if part.startswith(f"[drive.{wheel}]"))
        parts[place], changed = re.subn(rf"(?m)^{key} = \S+", f"{key} = {value}", parts[place])
        assert changed == 1, (wheel, key)
    path = os.path.join(folder, name)
    with open(path, "w", encoding="utf-8") as file:
        file.write("".join(parts))
    return path


class Wheels(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def test_list_says_which_eds_was_checked(self):
        path = robot_with(self.folder, "robot.toml", {})
        with open(path, encoding="utf-8") as file:
            text = file.read()
        eds = os.path.join(SOURCE_DIR, "config", "eds", "ivo_drive.eds")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace("[drive.rear_left]\n", f'[drive.rear_left]\neds = "{eds}"\n', 1))
        done = ivo("wheels", "list", "--sim", "--robot", path)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(re.findall(r"(?m)^checked +(.*)$", done.stdout),
                         [f"rear left: {eds} has all that the controller reads and writes"])

    def test_list_shows_every_drive_and_what_it_can(self):
        done = ivo("wheels", "list", "--sim")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for node, wheel in enumerate(("front left", "front right", "rear left", "rear right"), start=1):
            self.assertRegex(done.stdout, rf"(?m)^ +{node}  {wheel} .* 402 .*PV CSV\*  switch on disabled  IVO-class wheel drive$")

    def test_list_names_a_drive_that_is_missing_and_one_that_is_unknown(self):
        base = robot_with(self.folder, "base.toml", {("rear_left", "node_id"): "42"})
        done = ivo("wheels", "list", "--sim", "--sim-robot", base)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"(?m)^missing +node 3 \(rear left\): no answer")
        self.assertRegex(done.stdout, r"(?m)^unknown +node 42: ")

    def test_watch_says_what_it_hears_and_ends_when_it_is_told(self):
        done = ivo("wheels", "watch", "--sim", "--seconds", "0.2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"(?m)^0\.\d+ s +rear right: booted$")
        self.assertRegex(done.stdout, r"(?m)^heard +4 frames in ")

    def test_without_a_terminal_nothing_turns(self):
        for arguments in (("turn", "front_left"), ("check",)):
            done = ivo("wheels", *arguments, "--sim")
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, r"^ivo: wheels (turn|check) .*expected a terminal.*\n$")

    def test_what_makes_no_sense_is_refused_in_one_line(self):
        for arguments, words in (
            (("list",), "expected --can INTERFACE"),
            (("list", "--sim", "--can", "can0"), "expected one of them"),
            (("list", "--can", "no such interface"), "no such interface|no CAN sockets"),
            (("list", "--can", "can0", "--sim-robot", ROBOT), "together with --sim"),
            (("list", "--sim", "--robot", "/no/such/file.toml"), "/no/such/file.toml"),
            (("turn", "left", "--sim"), "expected front_left, front_right, rear_left or rear_right"),
            (("turn", "front_left", "--sim", "--radps", "3"), "expected a number, -2 to 2"),
            (("turn", "front_left", "--sim", "--radps", "nan"), "expected a number, -2 to 2"),
            (("turn", "front_left", "--sim", "--radps", "0"), "other than 0"),
            (("fly",), "expected list, watch, turn, check"),
            ((), "expected list, watch, turn, check"),
        ):
            done = ivo("wheels", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertRegex(done.stderr, rf"^ivo: .*({words}).*\n$", arguments)
            self.assertEqual(done.stdout, "")

    def test_a_wheel_turns_while_the_key_is_held_and_stops_when_it_is_let_go(self):
        with Technician("turn", "front_right", "--sim", "--radps", "1") as technician:
            before = technician.modes()
            technician.see("on blocks")
            technician.press("y")
            technician.see("power off; hold the space bar")
            technician.hold_until(r"told \+1\.00 rad/s, turns \+(0\.9|1\.0)")
            technician.see("power (on|off); hold the space bar")
            technician.see("power off; hold the space bar")
            technician.press("q")
            self.assertEqual(technician.end(), 0, technician.shown)
            self.assertRegex(technician.shown, r"power +off on all four drives\r\n")
            self.assertRegex(technician.shown, r"turned +0\.\d\d turns, -\d+ counts")
            self.assertEqual(technician.modes(), before)

    def test_a_tap_and_pasted_text_turn_nothing(self):
        with Technician("turn", "front_left", "--sim") as technician:
            technician.see("on blocks")
            technician.press("y")
            technician.see("power off; hold the space bar")
            technician.press(" " * 200)
            technician.see("keep holding")
            technician.see("power off; hold the space bar")
            technician.press("\x03")
            self.assertEqual(technician.end(), 0, technician.shown)
            self.assertNotIn("turns:", technician.shown)
            self.assertNotRegex(technician.shown, r"turned ")

    def test_nobody_who_says_no_has_anything_started(self):
        with Technician("turn", "front_left", "--sim") as technician:
            technician.see("on blocks")
            technician.press("n")
            self.assertEqual(technician.end(), 3, technician.shown)
            self.assertNotIn("start up", technician.shown)

    def test_signals_take_the_power_off_and_give_the_terminal_back(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGTSTP):
            with Technician("turn", "rear_left", "--sim") as technician:
                before = technician.modes()
                technician.see("on blocks")
                technician.press("y")
                technician.see("power off; hold the space bar")
                technician.hold_until("turns: told")
                technician.process.send_signal(number)
                self.assertEqual(technician.end(), 1, technician.shown)
                self.assertRegex(technician.shown, r"power +off on all four drives\r\n")
                self.assertEqual(technician.modes(), before)

    def test_a_program_that_fails_gives_the_terminal_back(self):
        with Technician("turn", "rear_left", "--sim") as technician:
            before = technician.modes()
            technician.see("on blocks")
            technician.press("y")
            technician.see("power off; hold the space bar")
            self.assertNotEqual(technician.modes(), before)
            technician.process.send_signal(signal.SIGABRT)
            self.assertEqual(technician.end(), -signal.SIGABRT)
            self.assertEqual(technician.modes(), before)

    def test_check_finds_what_is_wrong_and_how_the_file_should_be(self):
        base = robot_with(self.folder, "base.toml", {
            ("front_right", "sign"): "1",
            ("rear_left", "node_id"): "4", ("rear_left", "velocity_per_radps"): "684.0",
            ("rear_right", "node_id"): "3",
        })
        with Technician("check", "--sim", "--sim-robot", base, "--radps", "2", "--turns", "0.5") as technician:
            technician.see("on blocks")
            technician.press("y")
            for which, forward in (("1", "y"), ("2", "n"), ("4", "n"), ("3", "n")):
                technician.hold_until("Which wheel turned")
                technician.press(which)
                technician.see("as when the base drives ahead")
                technician.press(forward)
                technician.hold_until("How many turns")
                technician.press("\r")
            self.assertEqual(technician.end(), 1, technician.shown)
        shown = technician.shown.replace("\r\n", "\n")
        self.assertRegex(shown, r"front left \(node 1\): right; speed [+-]0\.\d %")
        toml = shown[shown.index("[drive.front_right]"):]
        self.assertRegex(
            toml,
            r"^\[drive\.front_right\]\nsign = 1  # was -1\n\n"
            r"\[drive\.rear_left\]\nnode_id = 4  # was 3\nvelocity_per_radps = 68[345]\S*  # was 651\S+\n\n"
            r"\[drive\.rear_right\]\nnode_id = 3  # was 4\n$",
        )

    def test_watch_ends_well_at_ctrl_c(self):
        watch = subprocess.Popen([IVO, "wheels", "watch", "--sim"], stdout=subprocess.PIPE, stdin=subprocess.DEVNULL)
        while b"booted" not in watch.stdout.readline():
            pass
        watch.send_signal(signal.SIGINT)
        self.assertEqual(watch.wait(), 0)
        watch.stdout.close()


if __name__ == "__main__":
    unittest.main()
