#!/usr/bin/env python3
"""The drive contract over a real vcan0, against simulated drives in a process of their own: as it would run against a real one."""

import os
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))

from mission_files import BUILD_DIR  # noqa: E402

VCAN = os.path.join(SOURCE_DIR, "toolchain", "vcan")


def contract(eds):
    """(exit status, lines of the contract, lines of the drives' log)"""
    with tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp") as out:
        done = subprocess.run(
            [VCAN, os.path.join(HERE, "drive_contract_on_vcan"), BUILD_DIR, out, os.path.join(SOURCE_DIR, "config", "eds", eds)],
            capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
        )
        lines = []
        for name in ("contract.txt", "drives.log"):
            with open(os.path.join(out, name), encoding="utf-8") as file:
                lines.append(file.read().splitlines())
        return done.returncode, done.stdout + done.stderr, *lines


class DriveContractOnVcan(unittest.TestCase):
    def test_an_ivo_drive_keeps_all_of_it(self):
        status, said, checks, log = contract("ivo_drive.eds")
        self.assertEqual([line for line in checks if not line.startswith("kept ")], [], said)
        self.assertGreater(len(checks), 40)
        self.assertEqual(status, 0, said)
        third = [line for line in log if " node=3 " in line]
        self.assertTrue(any("power=operation_enabled" in line and "wheel=turns" in line for line in third))
        self.assertIn("wheel=rests", third[-1])

    def test_a_drive_with_a_fixed_mapping_keeps_what_it_has(self):
        status, said, checks, _ = contract("fixed_mapping_drive.eds")
        self.assertEqual([line for line in checks if line.startswith("BROKEN")], [], said)
        self.assertTrue(any(line.startswith("not there ") and "PDO mappings" in line for line in checks))
        self.assertEqual(status, 0, said)


if __name__ == "__main__":
    unittest.main()
