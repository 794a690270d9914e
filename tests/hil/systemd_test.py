#!/usr/bin/env python3
"""The installed service under systemd as PID 1, in a guest with vcan0 and simulated drives: what starts it, what watches it, and
that nothing of that moves the robot.
"""

import collections
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
SOURCE_DIR = os.path.realpath(os.path.join(HERE, "..", ".."))
BUILD_DIR = os.environ.get("IVO_BUILD_DIR", os.path.join(SOURCE_DIR, "build", "release"))
CONFIG = os.path.join(SOURCE_DIR, "config")
GUEST = os.path.join(SOURCE_DIR, "toolchain", "vcan.d", "systemd-guest")
SCRATCH_ROOT = os.path.join(SOURCE_DIR, "toolchain", "packaging", "scratch_root")

# The guest has one processor, and time of a host that may be busy: no affinity, a longer timeout, and lock step with the drives.
DROP_IN = "[Service]\nCPUAffinity=\nWatchdogSec=20s\n"
OPTIONS = 'IVO_OPTIONS="--can vcan0 --clock sync"\n'


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
    assert done.returncode == 0, f"{' '.join(command)}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def configure(folder):
    """What a person adds to the packages' /etc, for the courtyard."""
    mission = read(f"{CONFIG}/missions/courtyard.toml")
    for there, here in (("../maps/courtyard.toml", "map.toml"), ("../robots/ivo.toml", "robot.toml"), ("generations = 40", "generations = 4")):
        assert there in mission
        mission = mission.replace(there, here)
    write(f"{folder}/ivo/mission.toml", mission)
    shutil.copy(f"{CONFIG}/maps/courtyard.toml", f"{folder}/ivo/map.toml")
    shutil.copy(f"{CONFIG}/maps/courtyard.png", f"{folder}/ivo/")
    write(f"{folder}/ivo/controller.env", OPTIONS)
    write(f"{folder}/systemd/system/ivo-controller.service.d/guest.conf", DROP_IN)


@unittest.skipUnless(os.getuid() == 0, "not root; expected root, for the owners of files in a scratch root")
class ServiceInGuest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="ivo-systemd.", dir="/var/tmp")
        cls.addClassCleanup(scratch.cleanup)
        packages = os.path.join(scratch.name, "packages")
        run("cpack", "--config", os.path.join(BUILD_DIR, "CPackConfig.cmake"), "-B", packages)
        debs = sorted(os.path.join(packages, name) for name in os.listdir(packages) if name.endswith(".deb"))
        cls.root = os.path.join(scratch.name, "root")
        run(SCRATCH_ROOT, cls.root, "systemd", "kmod", "iproute2", "can-utils", *("@" + deb for deb in debs))
        for path in debs + [os.path.join(HERE, "service_in_guest")]:
            shutil.copy(path, f"{cls.root}/root")
        run("chroot", cls.root, "sh", "-c", "dpkg -i /root/*.deb")
        configure(f"{cls.root}/root/etc")
        said = run(GUEST, cls.root, "/root/service_in_guest", "/root/etc")
        cls.facts = collections.defaultdict(dict)
        for step, name, value in re.findall(r"^(\w+) ([^=]+)=(.*)$", said, re.M):
            cls.facts[step][name] = value

    def frames(self, first, last):
        """Data of the frames with COB-IDs of this range."""
        pattern = re.compile(r" vcan0 ([0-9A-F]{3})#([0-9A-F]*)$", re.M)
        return [bytes.fromhex(data) for cob, data in pattern.findall(read(f"{self.root}/guest/bus.log")) if first <= int(cob, 16) <= last]

    def assert_facts(self, step, **expected):
        self.assertEqual({name: self.facts[step].get(name) for name in expected}, expected)

    def test_without_a_mission_a_start_is_skipped_and_no_failure(self):
        self.assert_facts("unconfigured", ActiveState="inactive", ConditionResult="no", Result="success", MainPID="0")

    def test_configured_it_says_that_it_is_ready(self):
        self.assert_facts("ready", ActiveState="active", SubState="running", NRestarts="0")
        self.assert_facts("stands", ActiveState="active", SubState="running", NRestarts="0", StatusText="awaiting consent")

    def test_it_runs_without_privileges_but_with_its_limits(self):
        uids = self.facts["process"]["Uid"].split()
        self.assertEqual(len(set(uids)), 1)
        self.assertNotEqual(uids[0], "0")
        self.assert_facts("process", CapEff="0" * 16, CapBnd="0" * 16, NoNewPrivs="1", Seccomp="2", rtprio="90", memlock="unlimited")
        self.assertEqual(self.facts["folder"], {"/run/ivo": "ivo:ivo:750", "/var/lib/ivo": "ivo:ivo:750"})

    def test_within_its_walls_real_time_is_granted_and_the_internet_is_not(self):
        self.assert_facts("walls", fifo="yes", internet="no", shadow="no", etc="no")

    def test_a_process_that_hangs_is_killed_by_the_watchdog_and_restarted(self):
        self.assert_facts("hung", ActiveState="active", SubState="running", NRestarts="1", StatusText="awaiting consent")
        self.assertRegex(self.facts["hung"]["journal"], "Watchdog timeout")
        self.assertNotEqual(self.facts["hung"]["MainPID"], self.facts["ready"]["MainPID"])

    def test_a_process_that_is_killed_is_restarted(self):
        self.assert_facts("killed", ActiveState="active", SubState="running", NRestarts="2", StatusText="awaiting consent")

    def test_restarted_it_takes_up_its_plan_and_asks_again(self):
        self.assert_facts("killed", resumed="2")

    def test_a_stop_at_the_console_is_no_failure_and_not_undone(self):
        self.assert_facts("stopped", ActiveState="inactive", SubState="dead", Result="success", MainPID="0")

    def test_after_a_stop_it_is_started_by_hand_and_asks(self):
        self.assert_facts("again", ActiveState="active", SubState="running", StatusText="awaiting consent")

    def test_the_console_waits_for_a_person_to_switch_it_on_and_serves_its_page_then(self):
        self.assert_facts("console", enabled="disabled", ActiveState="active", SubState="running", CapBnd="0" * 16, page="HTTP/1.1 200 OK")
        uids = self.facts["console"]["Uid"].split()
        self.assertEqual(len(set(uids)), 1)
        self.assertNotEqual(uids[0], "0")

    def test_a_console_that_hangs_is_killed_by_the_watchdog_and_restarted(self):
        self.assert_facts("console_hung", ActiveState="active", SubState="running", NRestarts="1")
        self.assertRegex(self.facts["console_hung"]["journal"], "Watchdog timeout")
        self.assert_facts("console_stopped", ActiveState="inactive", Result="success")

    def test_whatever_becomes_of_the_console_the_controller_does_not_notice(self):
        self.assert_facts("beside_console", ActiveState="active", SubState="running", MainPID=self.facts["again"]["MainPID"])

    def test_a_package_installed_again_leaves_it_and_its_configuration_alone(self):
        self.assert_facts("reinstalled", ActiveState="active", SubState="running", MainPID=self.facts["again"]["MainPID"], configuration="kept")

    def test_removing_the_package_stops_it(self):
        self.assert_facts("removed", ActiveState="inactive", Result="success", MainPID="0")
        self.assertFalse(os.path.exists(f"{self.root}/usr/bin/ivo"))

    def test_nothing_moved(self):
        for what, first in (("told", 0x201), ("real", 0x181)):
            speeds = [int.from_bytes(data[2:6], "little", signed=True) for data in self.frames(first, first + 3)]
            self.assertGreater(len(speeds), 1000, what)
            self.assertEqual(set(speeds), {0}, what)


if __name__ == "__main__":
    unittest.main()
