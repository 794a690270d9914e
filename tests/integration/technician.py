"""Somebody at a terminal with `ivo wheels`: reads what is shown, holds the space bar as a keyboard does, answers."""

import os
import re
import select
import subprocess
import time

from mission_files import IVO
from terminals import open_terminal

PATIENCE_S = 120  # a busy host is slow; nothing here is about how slow


class Technician:
    def __init__(self, *arguments, columns=160):
        self.near_end, far_end = open_terminal()
        subprocess.run(["stty", "cols", str(columns), "rows", "40"], stdin=far_end, check=False)
        self.process = subprocess.Popen(
            [IVO, "wheels", *arguments], stdin=far_end, stdout=far_end, stderr=far_end, start_new_session=True
        )
        self.far_end = far_end  # kept: what the terminal was before is looked at afterwards
        self.shown = ""
        self.read_to = 0

    def _take(self, wait_s):
        ready, _, _ = select.select([self.near_end], [], [], wait_s)
        if not ready:
            return False
        try:
            self.shown += os.read(self.near_end, 65536).decode(errors="replace")
        except OSError:
            return False
        return True

    def see(self, pattern):
        """The match of what is shown, after what was seen before."""
        end = time.monotonic() + PATIENCE_S
        while True:
            match = re.compile(pattern).search(self.shown, self.read_to)
            if match:
                self.read_to = match.end()
                return match
            ended = self.process.poll() is not None
            if not self._take(0.0 if ended else 0.1) and ended or time.monotonic() > end:
                raise AssertionError(f"never shown: {pattern}\n{self.shown}")

    def press(self, keys):
        os.write(self.near_end, keys.encode())

    def hold_until(self, pattern):
        """Holds the space bar until `pattern` is shown; a host that held up the keys has it let go and held again."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            self.press(" ")
            next_key = time.monotonic() + 0.5
            begin = self.read_to
            while True:
                match = re.compile(pattern).search(self.shown, begin)
                if match:
                    self.read_to = match.end()
                    return match
                self._take(max(0.0, min(0.03, next_key - time.monotonic())))
                if self.process.poll() is not None:
                    raise AssertionError(f"ended before: {pattern}\n{self.shown}")
                if time.monotonic() >= next_key:
                    if self.shown.rfind("let go of the space bar") > self.shown.rfind("keep holding"):
                        break
                    self.press(" ")
                    next_key = time.monotonic() + 0.03
            # let go
            quiet = time.monotonic() + 0.5
            while time.monotonic() < quiet:
                self._take(0.05)
                match = re.compile(pattern).search(self.shown, begin)
                if match:
                    self.read_to = match.end()
                    return match
        raise AssertionError(f"never shown: {pattern}\n{self.shown}")

    def end(self):
        """The exit status, when all was shown."""
        end = time.monotonic() + PATIENCE_S
        while self.process.poll() is None and time.monotonic() < end:
            self._take(0.1)
        while self._take(0.0):
            pass
        return self.process.poll()

    def modes(self):
        """The terminal's, as stty has them."""
        return subprocess.run(["stty", "-g"], stdin=self.far_end, capture_output=True, text=True, check=True).stdout

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.close(self.near_end)
        os.close(self.far_end)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
