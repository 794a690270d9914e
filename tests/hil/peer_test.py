#!/usr/bin/env python3
"""Our drivers as master of a CANopen node that somebody else wrote: npm's `canopen`, made from the EDS of our own drive.

Our SDO client reads it, our start-up configures it as a wheel drive, our heartbeats, SYNC and commands reach it, and what it sends reaches
us; both sides say what they saw, and tshark reads the recording as a third.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

from mission_test import BUILD_DIR, HERE, SOURCE_DIR, SIZES, VCAN, faults

sys.path.insert(0, os.path.join(SOURCE_DIR, "tests", "integration"))
import npm_packages

PEER = os.path.join(HERE, "peer")
EDS = os.path.join(SOURCE_DIR, "config", "eds", "ivo_drive.eds")
NODE_ID = 5
MASTER_NODE_ID = 127
OPERATIONAL = 5


def build_crc(packages):
    # Its only native part is one C file; npm's way to build it needs more, and asks, from version to version, for other permissions.
    crc = os.path.join(packages, "node_modules", "node-crc")
    os.makedirs(os.path.join(crc, "build", "Release"))
    npm_packages.run("gcc", "-O2", "-shared", "-fPIC", "-I/usr/include/node", "-DNODE_GYP_MODULE_NAME=crc",
                     "-DBUILDING_NODE_EXTENSION", os.path.join(crc, "c", "crc.c"), "-o", os.path.join(crc, "build", "Release", "crc.node"))


class ForeignNode(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        packages = npm_packages.install(PEER, build_crc)
        scratch = tempfile.TemporaryDirectory(prefix="ivo-hil.", dir="/var/tmp")
        cls.addClassCleanup(scratch.cleanup)
        cls.log = os.path.join(scratch.name, "bus.log")
        done = subprocess.run(
            [VCAN, os.path.join(HERE, "peer_on_vcan"), BUILD_DIR, packages, scratch.name, EDS, str(NODE_ID)],
            capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
        )

        def text(name):
            with open(os.path.join(scratch.name, name), encoding="utf-8", errors="replace") as file:
                return file.read()

        if done.returncode != 0:
            raise RuntimeError(f"status {done.returncode}: {done.stderr}{text('master.err')}{text('node.txt')}")
        cls.master = text("master.txt").splitlines()
        cls.node = json.loads(text("node.txt").splitlines()[-1])
        cls.sent = [tuple(map(int, re.findall(r"-?\d+", line))) for line in cls.master if line.startswith("sent ")]

    def test_sdo_reads_numbers_and_names_and_hears_refusals(self):
        self.assertEqual(
            [line for line in self.master if "object" in line],
            [
                "object 1000:0 20192", "object 1001:0 0", "object 1018:0 4", "object 1018:1 0", "object 1018:2 0", "object 1018:3 10000",
                "object 1018:4 0", "object 1008:0 IVO-class wheel drive", "object 2fff:0 aborted 6020000", "object 1018:9 aborted 6090011",
                "write object 1008:0 aborted 6010002", "write object 1017:0 0", "object 1017:0 3e8",
            ],
        )

    def test_start_up_configures_it_as_a_wheel_drive(self):
        self.assertIn("configured and operational", self.master)
        self.assertIn(f"channels {0x200 + NODE_ID:x} {0x180 + NODE_ID:x}", self.master)

    def test_commands_arrive_as_they_were_sent_with_a_sync_each(self):
        self.assertEqual(len(self.sent), 100)
        self.assertEqual(self.node["commands"], [[0x200 + NODE_ID, word, target] for word, target, _, _ in self.sent])
        self.assertEqual(self.node["syncs"], len(self.sent))

    def test_feedback_arrives_as_it_was_mapped(self):
        self.assertEqual([(word, target, 0x0231, target) for word, target, _, _ in self.sent], self.sent)

    def test_both_know_the_others_state(self):
        self.assertIn([MASTER_NODE_ID, OPERATIONAL], self.node["master"])
        heard = [line for line in self.master if line.startswith("heard ")]
        self.assertEqual(heard, ["heard boot-up message", "heard heartbeat Stopped", "heard heartbeat Pre-operational", "heard boot-up message"])
        self.assertEqual(self.master[-1], "end")

    def test_tshark_reads_every_frame(self):
        count, wrong, kinds = faults(self.log)
        self.assertGreater(count, 2 * len(self.sent))
        self.assertEqual(wrong[:5], [])
        self.assertEqual(kinds, set(SIZES), "NMT, SYNC, TPDO1, RPDO1, SDO both ways and heartbeats all occur")


if __name__ == "__main__":
    unittest.main()
