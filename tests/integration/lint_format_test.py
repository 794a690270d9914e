#!/usr/bin/python3 -B
import unittest

import lint

STYLE = {".clang-format": "BasedOnStyle: Google\nColumnLimit: 120\n"}


class Format(unittest.TestCase):
    def test_accepts_what_clang_format_leaves(self):
        self.assertEqual(lint.run("format", STYLE | {"planner/a.cpp": "int a = 1;\n", "tests/a.hpp": "int b;\n"}), (0, ""))

    def test_names_each_file_that_it_would_change(self):
        status, said = lint.run("format", STYLE | {"planner/a.cpp": "int  a=1;\n", "tests/b.hpp": "int b ;\n", "hal/c.cpp": "int c;\n"})
        self.assertNotEqual(status, 0)
        self.assertIn("planner/a.cpp", said)
        self.assertIn("tests/b.hpp", said)
        self.assertNotIn("hal/c.cpp", said)


unittest.main()
