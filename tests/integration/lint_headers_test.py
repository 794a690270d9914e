#!/usr/bin/python3 -B
import unittest

import lint


class Headers(unittest.TestCase):
    def test_accepts_one_source_for_each_heavy_header(self):
        files = {
            "firmware/files/toml.cpp": "#include <toml++/toml.h>\n",
            "firmware/files/json.cpp": "#include <nlohmann/json.hpp>\n",
            "firmware/tools/line.cpp": "#include <CLI/CLI.hpp>\n",
            "firmware/files/picture.cpp": "#include <cairo.h>\n#include <cairo-svg.h>\n",
            "firmware/files/png.cpp": "#include <png.h>\n",
        }
        self.assertEqual(lint.run("headers", files), (0, ""))

    def test_refuses_a_second_source(self):
        for header in ("toml++/toml.hpp", "nlohmann/json.hpp", "CLI/CLI.hpp", "cairo/cairo.h", "png.h"):
            include = f"#include <{header}>\n"
            status, said = lint.run("headers", {"firmware/files/a.cpp": include, "firmware/tools/b.cpp": include})
            self.assertEqual(status, 1, header)
            self.assertIn("included by firmware/files/a.cpp, firmware/tools/b.cpp; expected one source", said)

    def test_refuses_a_header_that_would_hand_it_on(self):
        status, said = lint.run("headers", {"firmware/files/a.hpp": "#include <nlohmann/json.hpp>\n"})
        self.assertEqual(status, 1)
        self.assertIn("firmware/files/a.hpp:1: nlohmann-json: a header of ours includes it", said)

    def test_leaves_tests_alone(self):
        include = "#include <nlohmann/json.hpp>\n"
        self.assertEqual(lint.run("headers", {"tests/unit/a_test.cpp": include, "firmware/files/a.cpp": include}), (0, ""))


unittest.main()
