#!/usr/bin/python3 -B
import os
import subprocess
import tempfile
import unittest

import lint


def symbols(source, name="part", *options):
    """(exit status, output) of the lint over a library of one source."""
    with tempfile.TemporaryDirectory() as folder:
        part, archive = os.path.join(folder, name + ".o"), os.path.join(folder, "libpart.a")
        subprocess.run(["c++", "-std=c++20", "-O2", "-x", "c++", "-", "-c", "-o", part], input=source, text=True, check=True)
        subprocess.run(["ar", "rcs", archive, part], check=True)
        done = subprocess.run([os.path.join(lint.SOURCE_DIR, "toolchain/lint/symbols"), *options, archive], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr


class Symbols(unittest.TestCase):
    def refuses(self, source, symbol, what):
        status, said = symbols(source)
        self.assertEqual(status, 1, source)
        self.assertIn(f"symbols: part.o: {symbol}", said)
        self.assertIn(what, said)

    def test_refuses_the_heap(self):
        self.refuses("int* f() { return new int; }", "_Znwm", "the heap")
        self.refuses("#include <cstdlib>\nvoid* f(int n) { return std::malloc(n); }", "malloc", "the heap")
        self.refuses("#include <string>\nvoid f(std::string& s, int n) { s.append(n, 'a'); }", "_Znwm", "the heap")

    def test_refuses_exceptions(self):
        self.refuses("void f() { throw 3; }", "__cxa_throw", "an exception")
        self.refuses("#include <array>\nint f(std::array<int, 3>& a, int i) { return a.at(i); }", "_ZSt24__throw_out_of_range_fmt", "an exception")

    def test_refuses_clocks(self):
        self.refuses("#include <ctime>\nlong f() { timespec t; clock_gettime(0, &t); return t.tv_sec; }", "clock_gettime", "a clock")
        self.refuses("#include <chrono>\nauto f() { return std::chrono::steady_clock::now(); }", "_ZNSt6chrono3_V212steady_clock3nowEv", "a clock")

    def test_refuses_text_and_files(self):
        self.refuses('#include <cstdio>\nvoid f(int n) { std::printf("%d", n); }', "printf", "text formatting")
        self.refuses('#include <cstdio>\nauto f() { return std::fopen("a", "r"); }', "fopen", "a file")

    def test_refuses_locks(self):
        self.refuses("#include <mutex>\nstd::mutex m;\nvoid f() { m.lock(); }", "pthread_mutex_lock", "a lock")
        self.refuses("int g();\nint f() { static const int once = g(); return once; }", "__cxa_guard_acquire", "a lock")
        self.refuses("#include <atomic>\nvoid f(std::atomic<int>& a) { a.wait(3); }", "syscall", "a lock")

    def test_leaves_out_sentences_and_what_runs_before_the_loop(self):
        source = "int* f() { return new int; }"
        self.assertEqual(symbols(source, "fault_text"), (0, ""))
        self.assertEqual(symbols(source, "reader", "--before-the-loop=write*,read*")[0], 1, "write* is not there")
        self.assertEqual(symbols(source, "reader", "--before-the-loop=read*"), (0, ""))
        self.assertEqual(symbols(source, "reader", "--before-the-loop=read")[0], 1)

    def test_accepts_sums_traps_and_a_virtual_destructor(self):
        source = "#include <cmath>\nstruct A { virtual ~A(); virtual double f(double x); };\nA::~A() = default;\n"
        source += "double A::f(double x) { if (x < 0) __builtin_trap(); return std::sqrt(x) + std::atan2(x, 2); }\n"
        self.assertEqual(symbols(source), (0, ""))

    def test_accepts_a_function_of_the_library_that_shares_a_name(self):
        self.assertEqual(symbols('extern "C" int open(int);\nint f() { return open(1); }\nextern "C" int open(int a) { return a; }'), (0, ""))

    def test_refuses_what_is_no_library(self):
        done = subprocess.run([os.path.join(lint.SOURCE_DIR, "toolchain/lint/symbols"), __file__], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("not a library that nm can read", done.stderr)


unittest.main()
