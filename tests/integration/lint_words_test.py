#!/usr/bin/python3 -B
import unittest

import lint


class Words(unittest.TestCase):
    def refuses(self, path, text, said):
        status, output = lint.run("words", {path: "\n" + text + "\n"})
        self.assertEqual(status, 1, f"{path} may not contain {text}")
        self.assertIn(f"{path}:2: {said}", output)

    def accepts(self, path, text):
        self.assertEqual(lint.run("words", {path: text + "\n"}), (0, ""))

    def test_refuses_the_heap_where_code_is_bounded(self):
        for path in ("planner/a.cpp", "drivers/a.hpp", "firmware/loop/a.cpp", "firmware/motion/a.cpp", "firmware/safety/a.cpp"):
            self.refuses(path, "int* p = new int;", "new: the heap")
        self.refuses("planner/a.cpp", "void* p = malloc(3);", "malloc(: the heap")
        self.refuses("planner/a.cpp", "std::vector<int> v;", "std::vector: the heap, through a container")
        self.refuses("planner/a.cpp", "std::string s;", "std::string: the heap, through a string")

    def test_refuses_text_streams_and_exceptions_where_code_is_bounded(self):
        self.refuses("drivers/a.cpp", "std::snprintf(b, 3, f);", "snprintf(: text formatting")
        self.refuses("drivers/a.cpp", "#include <iostream>", "#include <iostream>: a stream")
        self.refuses("firmware/safety/a.cpp", "throw 3;", "throw: an exception")

    def test_refuses_a_clock_that_was_not_handed_in(self):
        self.refuses("planner/a.cpp", "auto t = std::chrono::steady_clock::now();", "steady_clock::now(: a clock of its own")
        self.accepts("drivers/a.cpp", "auto t = clock.now();")

    def test_accepts_text_only_in_a_file_of_that_name_which_no_bounded_file_includes(self):
        self.accepts("drivers/fault_text.cpp", '#include "drivers/fault_text.hpp"\nstd::string s;')
        self.refuses("drivers/a.cpp", '#include "drivers/fault_text.hpp"', "drivers/fault_text.hpp: text formatting")

    def test_refuses_an_alias_that_nothing_uses(self):
        self.refuses("firmware/a.cpp", "namespace fs = std::filesystem;  // fs::path", "fs: an alias that is not used")
        self.accepts("firmware/a.cpp", "namespace fs = std::filesystem;\nfs::path p;")

    def test_accepts_them_elsewhere(self):
        self.accepts("firmware/files/a.cpp", "std::vector<std::string> v; throw 3;")

    def test_accepts_what_only_looks_alike(self):
        self.accepts("planner/a.cpp", "std::string_view s; StaticVector<int, 3> v; int newest = 1; // a new vector, no throw\n")
        self.accepts("planner/a.cpp", 'constexpr auto s = "throw a new one"; constexpr int n = 1\'000\'000;')

    def test_sees_code_behind_a_digit_separator(self):
        self.refuses("planner/a.cpp", "int n = 1'000; int* p = new int; int m = 2'000;", "new: the heap")

    def test_refuses_leftovers_everywhere(self):
        for word in ("TO" + "DO", "FIX" + "ME", "X" + "XX", "HA" + "CK"):
            self.refuses("firmware/files/a.cpp", f"// {word}: later", word)
            self.refuses("toolchain/README.md", f"{word} later", word)

    def test_accepts_a_template_for_a_file_name(self):
        self.accepts("toolchain/a", "mktemp /tmp/a." + "X" * 6)


unittest.main()
