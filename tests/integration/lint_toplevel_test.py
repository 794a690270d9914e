#!/usr/bin/python3 -B
import unittest

import lint


class Toplevel(unittest.TestCase):
    def test_accepts_the_names_of_the_house_dotfiles_and_what_is_built(self):
        files = {name: "" for name in ("README.md", "LICENSE", "CMakeLists.txt", ".clang-tidy", "planner/a.cpp", "build/a", "out/a")}
        self.assertEqual(lint.run("toplevel", files), (0, ""))

    def test_refuses_any_other_name(self):
        for path in ("src/a.cpp", "notes.md", "setup.py"):
            status, said = lint.run("toplevel", {path: ""})
            self.assertEqual(status, 1, path)
            self.assertIn(f"{path.split('/')[0]}: not a name of the top folder", said)


unittest.main()
