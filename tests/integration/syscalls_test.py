#!/usr/bin/python3 -B
"""toolchain/syscalls, on loops that do what they may and what they may not."""

import os
import subprocess
import tempfile
import unittest

import lint

LOOP = """
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>
#include <thread>

// It runs for 100 s unless toolchain/syscalls ends it. It sleeps until a time, as the loop does: a sleep that is interrupted goes on by itself.
void cycles() {
  prctl(PR_SET_NAME, "ivo-loop");
  constexpr long kCycles = 50'000;
  char* const pages = static_cast<char*>(mmap(nullptr, 4096 * kCycles, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  timespec wake{};
  clock_gettime(CLOCK_MONOTONIC, &wake);
  for (long cycle = 0; cycle < kCycles; ++cycle) {
    wake.tv_nsec += 2'000'000;
    if (wake.tv_nsec >= 1'000'000'000) wake.tv_nsec -= 1'000'000'000, ++wake.tv_sec;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, nullptr);
    (void)pages;
    EXTRA;
  }
}

int main() {
  signal(SIGINT, SIG_DFL);  // A shell's background program ignores it.
  std::thread(cycles).join();
}
"""


def syscalls(extra):
    with tempfile.TemporaryDirectory() as folder:
        build = ["c++", "-std=c++20", "-O1", "-w", "-x", "c++", "-", "-o", os.path.join(folder, "ivo"), f"-DEXTRA={extra}"]
        subprocess.run(build, input=LOOP, text=True, check=True)
        open(os.path.join(folder, "ivo-drives"), "w", encoding="utf-8").close()
        done = subprocess.run(
            [os.path.join(lint.SOURCE_DIR, "toolchain/syscalls"), "--seconds", "1", "--", "mission"],
            env=os.environ | {"IVO_BUILD_DIR": folder}, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
        )
        return done.returncode, done.stdout + done.stderr


class Syscalls(unittest.TestCase):
    def test_a_loop_that_sleeps_and_nothing_else_passes(self):
        status, said = syscalls("")
        self.assertEqual(status, 0, said)
        self.assertRegex(said, r"clock_nanosleep +\d+ +1\.000 +1\n")
        self.assertIn("0 minor, 0 major", said)

    def test_a_call_that_no_cycle_may_make_is_named(self):
        status, said = syscalls("if (cycle % 20 == 10) getppid()")
        self.assertEqual(status, 1, said)
        self.assertRegex(said, r"getppid +\d+ +0\.0[45]\d +1  not allowed\n")
        self.assertIn("a cycle calls getppid; expected nothing but clock_nanosleep, recvmmsg, sendmmsg", said)

    def test_a_page_that_was_not_there_is_seen(self):
        status, said = syscalls("pages[4096 * cycle] = 1")
        self.assertEqual(status, 1, said)
        self.assertIn("a cycle touched a page that was not there", said)


unittest.main()
