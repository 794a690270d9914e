#!/usr/bin/python3 -B
import json
import os
import shutil
import subprocess
import tempfile
import unittest

import lint


class Tidy(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.tree = self.folder.name
        shutil.copytree(os.path.join(lint.SOURCE_DIR, "toolchain/lint"), os.path.join(self.tree, "toolchain/lint"))
        shutil.copy(os.path.join(lint.SOURCE_DIR, ".clang-tidy"), self.tree)
        self.write("planner/one.hpp", "#pragma once\n\ninline int one() { return 1; }\n")
        self.write("planner/one.cpp", '#include "planner/one.hpp"\n\nint two() { return one() + one(); }\n')
        self.compiles("planner/one.cpp")

    def compiles(self, *paths):
        entries = []
        for path in paths:
            source = os.path.join(self.tree, path)
            command = f"c++ -I{self.tree} -std=c++20 -o {path}.o -c {source}"
            entries.append({"directory": self.tree, "file": source, "command": command, "output": path + ".o"})
        self.write("build/release/compile_commands.json", json.dumps(entries))

    def write(self, path, text):
        os.makedirs(os.path.join(self.tree, os.path.dirname(path)), exist_ok=True)
        with open(os.path.join(self.tree, path), "w", encoding="utf-8") as file:
            file.write(text)

    def tidy(self):
        done = subprocess.run([os.path.join(self.tree, "toolchain/lint/tidy")], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        return done.returncode, done.stdout + done.stderr

    def test_refuses_a_variable_without_a_value_and_goes_on_refusing(self):
        self.write("planner/one.cpp", "int two(int a) {\n  int b;\n  if (a > 0) {\n    b = 1;\n  }\n  return b;\n}\n")
        for _ in range(2):
            status, said = self.tidy()
            self.assertEqual(status, 1)
            self.assertIn("planner/one.cpp:2:7: error: variable 'b' is not initialized", said)
            self.assertIn("1 checked", said)

    def test_leaves_out_what_passed_until_a_header_changes(self):
        status, said = self.tidy()
        self.assertEqual(status, 0, said)
        self.assertIn("1 checked", said)
        self.assertIn("0 checked", self.tidy()[1])
        self.write("planner/one.hpp", "#pragma once\n\ninline int one() {\n  int a;\n  a = 1;\n  return a;\n}\n")
        status, said = self.tidy()
        self.assertEqual(status, 1, said)
        self.assertIn("planner/one.hpp:4:7: error: variable 'a' is not initialized", said)

    def test_finds_what_is_wrong_in_any_source_of_a_folder(self):
        self.write("planner/two.cpp", "int three() {\n  int c;\n  c = 3;\n  return c;\n}\n")
        self.write("planner/a_main.cpp", "int main() {}\n")
        self.write("planner/b_main.cpp", "int main() {}\n")
        self.compiles("planner/a_main.cpp", "planner/b_main.cpp", "planner/one.cpp", "planner/two.cpp")
        status, said = self.tidy()
        self.assertEqual(status, 1, said)
        self.assertIn("planner/two.cpp:2:7: error: variable 'c' is not initialized", said)
        self.assertIn("3 checked", said)
        self.assertIn("1 refused", said)

    def test_refuses_a_build_whose_commands_name_no_source(self):
        self.write("planner/a_main.cpp", "int main() {}\n")
        self.compiles("planner/a_main.cpp", "build/asan/unity_0.cpp")
        status, said = self.tidy()
        self.assertNotEqual(status, 0)
        self.assertIn("expected a build that compiles them one by one", said)

    def test_checks_anew_when_the_list_of_checks_changes(self):
        self.tidy()
        self.write(".clang-tidy", "Checks: '-*,misc-unused-parameters'\n")
        self.assertIn("1 checked", self.tidy()[1])


unittest.main()
