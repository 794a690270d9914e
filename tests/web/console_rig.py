"""A controller on the virtual bus, the console's server beside it, and browsers that show its page: what the tests of the page have in common."""

import json
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "integration"))

from selenium.common.exceptions import JavascriptException

from browser import Browser
from mission_files import BUILD_DIR, COURTYARD, IVO, SOURCE_DIR
from screen import Screen

CONSOLE = os.path.join(BUILD_DIR, "ivo-console")
PAGE = os.path.join(SOURCE_DIR, "firmware", "web", "page")
ROBOT = os.path.join(SOURCE_DIR, "config", "robots", "ivo.toml")
OWN_ROBOT = "own_robot.toml"  # beside a test's mission
SHIPPED_TIMEOUT_S = 2.0       # without a beat of the operator's page, of config/robots/ivo.toml
LONG_TIMEOUT_S = 30.0         # of a test that is not about beats: a page that is judged, or has a slow machine, sends none for a while
ENDLESS = 1_000_000           # generations, the most that a mission may have: planning lasts until somebody has enough
PATIENCE_S = 30


def replaced(path, *pairs):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


def courtyard(object_place, motion="reported", generations=6):
    """The courtyard's mission, soon planned: the object at `object_place`, or "unknown". The robot is the test's own."""
    return replaced(COURTYARD, ('object = "drawn"', f"object = {json.dumps(object_place)}"), ('motion = "simulated"', f'motion = "{motion}"'),
                    ("generations = 40", f"generations = {generations}"), ('"../robots/ivo.toml"', f'"{OWN_ROBOT}"'), ('"../', f'"{SOURCE_DIR}/config/'),
                    ("preferred = [{ rectangle_m = [4.0, 17.0, 20.0, 26.9] }]", "preferred = []"))


def robot(operator_timeout_s):
    """As it is shipped, but for how long it goes on without a beat."""
    return replaced(ROBOT, (f"\noperator_timeout_s = {SHIPPED_TIMEOUT_S} ", f"\noperator_timeout_s = {operator_timeout_s} "))


class ConsoleTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.socket = os.path.join(self.folder, "console")
        self.state = os.path.join(self.folder, "state")
        self.out = os.path.join(self.folder, "out")
        self.stats = os.path.join(self.folder, "stats.json")
        self.said = []
        self.port = 0
        self.controller = self.server = None

    def start(self, command, **options):
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, **options)
        self.addCleanup(self.end, process)
        return process

    def end(self, process):
        """At once; what it said is kept."""
        process.kill()
        process.wait()
        if process.stdout:
            process.listener.join()
            process.stdout.close()

    def start_controller(self, mission=None, *more, speed="1", operator_timeout_s=LONG_TIMEOUT_S):
        """`mission` None: the one that is there already, and its robot."""
        path = os.path.join(self.folder, "mission.toml")
        if mission is not None:
            for name, text in (("mission.toml", mission), (OWN_ROBOT, robot(operator_timeout_s))):
                with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
        with open(os.path.join(self.folder, "controller.log"), "a", encoding="utf-8") as log:
            self.controller = self.start([IVO, "run", path, "--console", self.socket, "--speed", speed, "--out", self.out, "--stats", self.stats, *more],
                                         stdout=log, stderr=log)

    def start_server(self):
        """On the port that it had before, if it had one."""
        self.server = self.start([CONSOLE, "--socket", self.socket, "--port", str(self.port), "--web", PAGE, "--state", self.state], stdout=subprocess.PIPE, text=True)
        self.said = []
        self.server.listener = threading.Thread(target=self.listen, args=(self.server, self.said), daemon=True)
        self.server.listener.start()
        self.port = int(self.line(r"listening at http://127\.0\.0\.1:(\d+)/")[1])

    def listen(self, process, said):
        for line in process.stdout:
            said.append(line.rstrip("\n"))

    def line(self, pattern):
        """The last line of the server so far that fits."""
        return self.until(lambda: next((found for found in (re.fullmatch(pattern, line) for line in reversed(self.said)) if found), None), pattern)

    def until(self, true, what="it"):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            try:
                found = true()
            except JavascriptException:
                found = None  # an element that is not there yet
            if found:
                return found
            time.sleep(0.02)
        raise AssertionError(f"{what} did not come; the server said {self.said}, the controller {self.controller_said()}")

    def controller_said(self):
        with open(os.path.join(self.folder, "controller.log"), encoding="utf-8") as file:
            return file.read()[-2000:]

    def begin(self, object_place="unknown", motion="reported", speed="1", generations=6, operator_timeout_s=LONG_TIMEOUT_S):
        self.start_controller(courtyard(object_place, motion, generations), speed=speed, operator_timeout_s=operator_timeout_s)
        self.start_server()

    def new_code(self):
        return self.line(r".*the (?:pairing code is|code is now) (\d{6})")[1]

    def screen(self, name="Ana's tablet", shape="desk", language="en", paired=True):
        browser = Browser(self, shape, language)
        screen = Screen(self, browser, name)
        screen.open()
        if paired:
            screen.pair(self.new_code())
        return screen

    def operator(self, name="Ana's tablet", shape="desk"):
        """A screen that holds the controls, over a plan that can be accepted."""
        screen = self.screen(name, shape)
        screen.take_controls()
        screen.wait_act("accept")
        return screen

    def token(self, role="operator", name="script"):
        done = subprocess.run([CONSOLE, "--state", self.state, "--new-token", name, "--role", role], capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def events(self):
        """So far; a line that is being written is none yet."""
        with open(os.path.join(self.out, "events.jsonl"), encoding="utf-8") as file:
            return [json.loads(line) for line in file.read().split("\n")[:-1]]
