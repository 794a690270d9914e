#!/usr/bin/env python3
"""The packaged files of udev and systemd-networkd bring a CAN controller up, on emulated hardware: a virtual interface has no bit rate."""

import os
import subprocess
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
RT = os.path.join(SOURCE_DIR, "toolchain", "rt")
FILES = os.path.join(SOURCE_DIR, "toolchain", "packaging", "controller")


class NetworkInGuest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        brought = ["/lib/systemd/systemd-networkd", "/etc/passwd", "/etc/group", "/etc/nsswitch.conf", os.path.join(HERE, "network_in_guest") + ":/start"]
        udev = subprocess.run([RT + ".d/udev"], capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
        assert udev.returncode == 0, udev.stderr
        folder = udev.stdout.strip()
        brought += [f"{folder}/udevadm:/bin/udevadm", f"{folder}/99-default.link:/lib/systemd/network/99-default.link"]
        brought += [f"{FILES}/{name}:/packaged/{name}" for name in ("60-ivo-can0.network", "60-ivo-can0.link")]
        done = subprocess.run(
            [RT, "-d", "kvaser", *(word for file in brought for word in ("-f", file)), "sh", "/start"],
            capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        cls.can0, _, cls.rest = done.stdout.partition("\n3: can1:")

    def test_the_wheels_bus_is_up_at_the_robots_bit_rate(self):
        self.assertIn("state UP", self.can0)
        with open(os.path.join(SOURCE_DIR, "config", "robots", "ivo.toml"), encoding="utf-8") as file:
            self.assertIn("bit_rate_bps = 1000000 ", file.read())
        self.assertIn("bitrate 1000000 sample-point 0.875", self.can0)

    def test_its_queue_holds_a_cycle_and_no_old_command(self):
        self.assertIn("qlen 32", self.can0)
        self.assertIn("qlen 10", self.rest)
        self.assertIn("ID_NET_LINK_FILE=/etc/systemd/network/60-ivo-can0.link", self.rest)

    def test_it_joins_in_again_after_bus_off(self):
        self.assertIn("restart-ms 100", self.can0)

    def test_no_other_interface_is_touched_and_no_key_is_unknown(self):
        self.assertIn("state DOWN", self.rest.splitlines()[0])
        for complaint in ("Unknown", "Failed to parse", "Invalid"):
            self.assertNotIn(complaint, self.rest)


if __name__ == "__main__":
    unittest.main()
