"""ivo-console as a test runs it: beside a controller of the test's own, with a page of two lines."""

import os
import re
import signal
import subprocess
import tempfile
import threading
import time
import unittest

from fake_controller import FakeController
from mission_files import BUILD_DIR
from websocket_client import WebSocket, request

PROGRAM = os.path.join(BUILD_DIR, "ivo-console")


class WebServerTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.socket = os.path.join(self.folder, "controller")
        self.state = os.path.join(self.folder, "state")
        self.web = os.path.join(self.folder, "web")
        self.wrap = None
        os.makedirs(os.path.join(self.web, "icons"))
        for name, content in (("index.html", "<!doctype html><title>page</title>"), ("main.js", "'use strict';"), ("page.css", "body{}"),
                              ("manifest.webmanifest", "{}"), ("icons/icon.svg", "<svg/>"), ("notes.txt", "not a part of the page")):
            with open(os.path.join(self.web, name), "w", encoding="utf-8") as file:
                file.write(content)

    def options(self, *more):
        return [PROGRAM, "--socket", self.socket, "--port", "0", "--web", self.web, "--state", self.state, *more]

    def controller(self, **keys):
        controller = FakeController(self.socket, **keys)
        self.addCleanup(controller.close)
        return controller

    def start(self, *more):
        self.process = subprocess.Popen(self.options(*more), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.said = []
        self.heard_all = threading.Thread(target=self._listen, args=(self.process, self.said), daemon=True)
        self.heard_all.start()
        self.addCleanup(self.process.stdout.close)
        self.addCleanup(self.heard_all.join)
        self.addCleanup(self.process.wait)
        self.addCleanup(self.process.kill)
        self.port = int(self.line(r"listening at https?://[^ ]*:(\d+)/")[1])
        self.line(r"the pairing code is \d{6}")

    def _listen(self, process, said):
        for line in process.stdout:
            said.append(line.rstrip("\n"))

    def line(self, pattern, patience_s=20):
        """The last line so far that fits."""
        until = time.monotonic() + patience_s
        while time.monotonic() < until:
            for line in reversed(list(self.said)):
                found = re.fullmatch(pattern, line)
                if found:
                    return found
            time.sleep(0.01)
        raise AssertionError(f"{pattern} was not said; said {self.said}")

    def end(self, how=signal.SIGTERM):
        self.process.send_signal(how)
        self.assertEqual(self.process.wait(20), 0)
        self.heard_all.join()

    def code(self):
        return self.line(r".*the (?:pairing code is|code is now) (\d{6})")[1]

    def shown_code(self):
        """As the robot's own screen shows it: what holds now, where a line may still be on its way."""
        return re.search(r"(?<!\d)\d{6}(?!\d)", self.get("/screen", host=f"localhost:{self.port}").body.decode())[0]

    def get(self, path, token=None, **keys):
        headers = [f"Cookie: ivo={token}"] if token else []
        return request(self.port, "GET", path, headers=headers, wrap=self.wrap, **keys)

    def post_code(self, code, name="Ana's tablet", **keys):
        return request(self.port, "POST", "/pair", {"code": code, "name": name}, wrap=self.wrap, **keys)

    def pair(self, name="Ana's tablet"):
        """Its token."""
        code = self.code()
        answer = self.post_code(code, name)
        self.assertEqual(answer.status, 204, answer)
        self.line(rf"paired: {re.escape(name)}; the code is now (?!{code})\d+")
        return re.match(r"ivo=([0-9a-f]{64});", answer.headers["set-cookie"])[1]

    def new_token(self, role, name="script"):
        done = subprocess.run([PROGRAM, "--state", self.state, "--new-token", name, "--role", role], capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def page(self, token, **keys):
        page = WebSocket(self.port, token=token, wrap=self.wrap, **keys)
        self.addCleanup(page.close)
        page.hello = page.hear()
        self.assertEqual(page.hello["type"], "hello")
        return page
