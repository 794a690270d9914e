#!/usr/bin/python3 -B
"""The .deb packages: what is in them, and what they do to a root that they are installed in, upgraded in and removed from."""

import glob
import hashlib
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from mission_files import BUILD_DIR, SOURCE_DIR

PACKAGING = os.path.join(SOURCE_DIR, "toolchain", "packaging")
UNIT = "/usr/lib/systemd/system/ivo-controller.service"
CONSOLE_UNIT = "/usr/lib/systemd/system/ivo-console.service"
CONFFILES = {
    "/etc/ivo/classes.toml", "/etc/ivo/controller.env", "/etc/ivo/robot.toml",
    "/etc/systemd/network/60-ivo-can0.link", "/etc/systemd/network/60-ivo-can0.network",
}
EXPOSURE_LIMIT = 2.5
LEFT_OUT = ("/packages", "/run", "/var/lib/dpkg", "/var/log")
CPU = "flags : avx2 bmi1 bmi2 f16c fma movbe\n"


def run(*command, env=None):
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False, env=env)
    return done.returncode, done.stdout, done.stderr


def said_by(*command, **kwargs):
    status, out, err = run(*command, **kwargs)
    assert status == 0, f"{' '.join(command)}: {status}\n{out}{err}"
    return out


def make_packages(folder, epoch=None):
    """Both packages by CPack alone, of the build under test."""
    env = {**os.environ, "SOURCE_DATE_EPOCH": epoch} if epoch else None
    said_by("cpack", "--config", os.path.join(BUILD_DIR, "CPackConfig.cmake"), "-B", folder, env=env)
    return sorted(glob.glob(os.path.join(folder, "*.deb")))


def digest(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def field(package, name):
    return said_by("dpkg-deb", "-f", package, name).strip()


def next_version(package, folder):
    """Makes folder.deb: the same package as a later version whose conffiles come changed."""
    said_by("dpkg-deb", "-R", package, folder)
    control = os.path.join(folder, "DEBIAN", "control")
    with open(control, encoding="utf-8") as file:
        text = re.sub(r"^Version: .*$", "Version: 99", file.read(), flags=re.M)
    with open(control, "w", encoding="utf-8") as file:
        file.write(text)
    for path in CONFFILES:
        with open(folder + path, "a", encoding="utf-8") as file:
            file.write("# of the later version\n")
    said_by("dpkg-deb", "--root-owner-group", "-Z", "gzip", "-b", folder, folder + ".deb")


def everything(root):
    """Each path of a root with what it is, so that two states can be compared; without logs and dpkg's own knowledge."""
    found = {}
    for place, folders, names in os.walk(root):
        folders[:] = [name for name in folders if os.path.join(place, name)[len(root):] not in LEFT_OUT]
        for name in folders + names:
            path = os.path.join(place, name)
            if os.path.islink(path):
                found[path[len(root):]] = os.readlink(path)
            elif os.path.isfile(path):
                found[path[len(root):]] = digest(path)
            else:
                found[path[len(root):]] = "folder"
    return found


@unittest.skipUnless(os.getuid() == 0, "not root; expected root, for chroot and the owners of files")
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="ivo-package.", dir="/var/tmp")
        cls.addClassCleanup(scratch.cleanup)
        cls.scratch = scratch.name
        cls.console, cls.controller, cls.tools = cls.packages = make_packages(os.path.join(cls.scratch, "first"), "1700000000")
        cls.bare = os.path.join(cls.scratch, "bare")
        said_by(os.path.join(PACKAGING, "scratch_root"), cls.bare, "systemd", *("@" + package for package in cls.packages))
        with open(os.path.join(cls.bare, "proc", "cpuinfo"), "w", encoding="utf-8") as file:
            file.write(CPU)

    def root(self):
        """A root of the test's own without our packages, which lie in /packages."""
        root = tempfile.mkdtemp(dir=self.scratch)
        self.addCleanup(shutil.rmtree, root)
        said_by("cp", "-a", self.bare + "/.", root)
        os.mkdir(root + "/packages")
        for package in self.packages:
            shutil.copy(package, root + "/packages")
        return root

    def inside(self, root, *command):
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LC_ALL": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive"}
        return run("chroot", root, *command, env=environment)

    def did(self, root, *command):
        status, out, err = self.inside(root, *command)
        self.assertEqual(status, 0, f"{' '.join(command)}\n{out}{err}")
        return out + err

    def installed(self):
        root = self.root()
        self.did(root, "dpkg", "-i", *("/packages/" + os.path.basename(package) for package in self.packages))
        return root

    def test_say_what_they_are_and_need(self):
        self.assertEqual([field(package, "Package") for package in self.packages], ["ivo-console", "ivo-controller", "ivo-tools"])
        with open(os.path.join(PACKAGING, "changelog"), encoding="utf-8") as file:
            version = re.match(r"ivo \((.*?)\)", file.readline()).group(1)
        for package in self.packages:
            self.assertEqual(field(package, "Version"), version)
            self.assertEqual(os.path.basename(package).split("_")[1], version)
            self.assertRegex(field(package, "Maintainer"), r"<.+@.+>")
            self.assertIn("libc6 (>=", field(package, "Depends"))
        for library in ("libcairo2", "libccd2", "libgpiod2", "libpng16-16", "adduser"):
            self.assertIn(library, field(self.controller, "Depends"))
        self.assertNotIn("libcairo2", field(self.tools, "Depends"))
        for name in ("ivo-controller", "libjs-leaflet", "libwebsockets17"):
            self.assertIn(name, field(self.console, "Depends"))
        self.assertNotIn("libcairo2", field(self.console, "Depends"), "the page's server draws nothing")

    def test_hold_what_a_robot_needs_and_no_mission(self):
        listed = said_by("dpkg-deb", "-c", self.controller)
        for path in CONFFILES | {UNIT, "/usr/bin/ivo", "/usr/share/ivo/eds/ivo_drive.eds", "/usr/lib/udev/rules.d/60-ivo-gpio.rules"}:
            self.assertRegex(listed, rf"\.{re.escape(path)}\n")
        for package in self.packages:
            for line in said_by("dpkg-deb", "-c", package).splitlines():
                mode, owner, path = line.split()[0], line.split()[1], line.split()[-1]
                self.assertEqual(owner, "root/root", line)
                self.assertIn(mode, ("drwxr-xr-x", "-rwxr-xr-x" if "/bin/" in path else "-rw-r--r--"), line)
                self.assertFalse(path.endswith("/etc/ivo/mission.toml"), "a mission of the package's own would let the robot move")
            self.assertRegex(said_by("dpkg-deb", "-c", package), r"/usr/share/doc/ivo-\w+/copyright\n")
        self.assertEqual(set(said_by("dpkg-deb", "-I", self.controller, "conffiles").split()), CONFFILES)
        self.assertEqual(said_by("dpkg-deb", "-I", self.console, "conffiles").split(), ["/etc/ivo/console.env"])

    def test_the_console_holds_its_page(self):
        root = self.installed()
        page = os.path.join(SOURCE_DIR, "firmware", "web", "page")
        shipped = root + "/usr/share/ivo-console/web"
        self.assertEqual(set(os.listdir(shipped)) | {"README.md"}, set(os.listdir(page)))
        self.assertTrue(os.path.exists(root + "/usr/share/javascript/leaflet/leaflet.js"))
        self.assertIn("--new-token", self.did(root, "ivo-console", "--help"))
        # It finds both where they are installed, and a token is all that it leaves behind.
        said = self.did(root, "ivo-console", "--state", "/tmp/state", "--new-token", "foxglove", "--role", "viewer")
        self.assertRegex(said, r"[0-9a-zA-Z_-]{32}")
        self.assertEqual(set(os.listdir(root + "/tmp/state")), {"tokens", "tokens.lock"})
        self.assertEqual(os.stat(root + "/tmp/state/tokens").st_mode & 0o777, 0o600)

    def test_the_same_build_makes_the_same_bytes(self):
        again = make_packages(os.path.join(self.scratch, "again"), "1700000000")
        self.assertEqual([digest(package) for package in again], [digest(package) for package in self.packages])

    def test_their_programs_start_and_their_examples_plan(self):
        root = self.installed()
        self.assertIn("Usage", self.did(root, "ivo", "--help"))
        self.assertIn("--can", self.did(root, "ivo-drives", "--help"))
        self.assertEqual(self.inside(root, "ivo-drive-contract")[0], 2)
        for mission in sorted(os.listdir(root + "/usr/share/ivo/missions")):
            self.did(root, "ivo", "plan", f"/usr/share/ivo/missions/{mission}", "--iterations", "1", "--out", "/tmp/plan")
            self.assertTrue(os.path.getsize(root + "/tmp/plan/search.png") > 0)

    def test_a_mission_in_etc_finds_robot_map_and_classes_beside_it(self):
        root = self.installed()
        share = root + "/usr/share/ivo"
        with open(share + "/missions/courtyard.toml", encoding="utf-8") as file:
            mission = file.read().replace("../maps/courtyard.toml", "map.toml").replace("../robots/ivo.toml", "robot.toml")
        with open(root + "/etc/ivo/mission.toml", "w", encoding="utf-8") as file:
            file.write(mission)
        with open(share + "/maps/courtyard.toml", encoding="utf-8") as file:
            text = file.read().replace("# classes = \"my_classes.toml\"", "classes = \"classes.toml\"")
        self.assertIn("\nclasses", text)
        with open(root + "/etc/ivo/map.toml", "w", encoding="utf-8") as file:
            file.write(text)
        shutil.copy(share + "/maps/courtyard.png", root + "/etc/ivo/courtyard.png")
        self.did(root, "ivo", "plan", "/etc/ivo/mission.toml", "--iterations", "1", "--out", "/tmp/plan")

    def test_what_a_robot_file_names_is_installed(self):
        root = self.installed()
        for path in ["/etc/ivo/robot.toml", *glob.glob("/usr/share/ivo/robots/*.toml", root_dir=root)]:
            with open(root + path, encoding="utf-8") as file:
                for eds in re.findall(r'^\s*eds\s*=\s*"(.*?)"', file.read(), re.M):
                    self.assertTrue(os.path.exists(os.path.join(root + os.path.dirname(path), eds)), f"{path}: {eds}")
        # And one that names a shipped EDS is taken.
        with open(root + "/etc/ivo/robot.toml", "r+", encoding="utf-8") as file:
            text = file.read().replace("node_id = 1\n", 'node_id = 1\neds = "../../usr/share/ivo/eds/ivo_drive.eds"\n')
            file.seek(0)
            file.write(text)
        self.did(root, "ivo", "load", "/etc/ivo/robot.toml")

    def test_install_makes_the_user_and_enables_and_starts_nothing(self):
        root = self.installed()
        self.assertRegex(self.did(root, "getent", "passwd", "ivo"), r"^ivo:x:\d+:\d+:[^:]*:/var/lib/ivo:/usr/sbin/nologin\n$")
        self.assertEqual(self.inside(root, "systemctl", "is-enabled", "ivo-controller")[1], "disabled\n")
        self.did(root, "systemctl", "preset", "ivo-controller", "ivo-console")
        for service in ("ivo-controller", "ivo-console"):
            self.assertEqual(self.inside(root, "systemctl", "is-enabled", service)[1], "disabled\n")
        self.assertFalse(os.path.exists(root + "/etc/ivo/mission.toml"))
        self.assertFalse(os.path.exists(root + "/var/lib/ivo"))
        self.assertEqual(self.did(root, "dpkg", "--audit"), "")

    def test_a_person_called_ivo_is_not_made_the_robots_user(self):
        root = self.root()
        self.did(root, "useradd", "--no-create-home", "ivo")
        person = self.did(root, "getent", "passwd", "ivo")
        status, _, said = self.inside(root, "dpkg", "-i", "/packages/" + os.path.basename(self.controller))
        self.assertNotEqual(status, 0)
        self.assertIn("The user `ivo' already exists, but is not a system user.", said)
        self.assertEqual(self.did(root, "getent", "passwd", "ivo"), person)

    def test_a_processor_without_the_instructions_is_refused_before_anything_is_unpacked(self):
        root = self.root()
        for flag in ("fma", "bmi1"):
            with open(root + "/proc/cpuinfo", "w", encoding="utf-8") as file:
                file.write(CPU.replace(f" {flag}", ""))
            status, _, said = self.inside(root, "dpkg", "-i", "/packages/" + os.path.basename(self.controller))
            self.assertNotEqual(status, 0)
            self.assertIn(f"ivo-controller: this processor has no {flag}; expected one that x86-64-v3 names", said)
            self.assertFalse(os.path.exists(root + "/usr/bin/ivo"))

    def test_an_upgrade_keeps_what_was_configured(self):
        root = self.installed()
        changed = ("/etc/ivo/robot.toml", "/etc/ivo/controller.env", "/etc/ivo/classes.toml")
        for path in changed:
            with open(root + path, "a", encoding="utf-8") as file:
                file.write("# measured\n")
        open(root + "/etc/ivo/mission.toml", "w", encoding="utf-8").close()
        self.did(root, "systemctl", "enable", "ivo-controller")
        os.makedirs(root + "/var/lib/ivo/search")
        next_version(self.controller, root + "/packages/next")
        self.did(root, "dpkg", "--force-confold", "-i", "/packages/next.deb")
        self.assertEqual(self.did(root, "dpkg-query", "-W", "-f", "${Version}", "ivo-controller"), "99")
        for path in CONFFILES:
            with open(root + path, encoding="utf-8") as file:
                last = file.read().splitlines()[-1]
            self.assertEqual(last, "# measured" if path in changed else "# of the later version", path)
        self.assertEqual(self.inside(root, "systemctl", "is-enabled", "ivo-controller")[1], "enabled\n")
        for path in ("/etc/ivo/mission.toml", "/var/lib/ivo/search"):
            self.assertTrue(os.path.exists(root + path), path)

    def test_removal_leaves_the_configuration_and_purge_nothing_but_the_user(self):
        root = self.root()
        before = everything(root)
        self.did(root, "dpkg", "-i", *("/packages/" + os.path.basename(package) for package in self.packages))
        self.did(root, "systemctl", "enable", "ivo-controller", "ivo-console")
        os.makedirs(root + "/var/lib/ivo/search")
        os.makedirs(root + "/var/lib/private/ivo-console")
        self.did(root, "dpkg", "-r", "ivo-tools", "ivo-console", "ivo-controller")
        left = set(everything(root)) - set(before)
        self.assertEqual({path for path in left if not path.startswith("/etc/")}, {"/var/lib/ivo", "/var/lib/ivo/search", "/var/lib/private", "/var/lib/private/ivo-console"})
        self.assertTrue(CONFFILES | {"/etc/ivo/console.env"} <= left)
        self.assertFalse([path for path in left if path.endswith(".service")], "a removed service stays enabled")
        self.did(root, "dpkg", "-P", "ivo-tools", "ivo-console", "ivo-controller")
        os.rmdir(root + "/var/lib/private")
        after = everything(root)
        of_users = {"/etc/passwd", "/etc/passwd-", "/etc/group", "/etc/group-", "/etc/shadow", "/etc/shadow-", "/etc/gshadow", "/etc/gshadow-",
                    "/etc/.pwd.lock", "/etc/subuid", "/etc/subgid", "/etc/subuid-", "/etc/subgid-"}
        self.assertEqual({path: what for path, what in after.items() if before.get(path) != what and path not in of_users}, {})
        self.assertEqual(set(before) - set(after), set())
        # Again from there: the user that stayed is taken as it is.
        self.did(root, "dpkg", "-i", "/packages/" + os.path.basename(self.controller))

    def test_the_units_are_such_as_systemd_accepts(self):
        root = self.installed()
        for unit in (UNIT, CONSOLE_UNIT):
            self.assertEqual(self.did(root, "systemd-analyze", "verify", unit), "")
        with open(root + UNIT, "a", encoding="utf-8") as file:
            file.write("[Service]\nNoSuchSetting=yes\n")
        self.assertIn("NoSuchSetting", "".join(self.inside(root, "systemd-analyze", "verify", UNIT)[1:]), "the check itself")

    def test_the_units_are_shut_in(self):
        root = self.installed()
        for unit in (UNIT, CONSOLE_UNIT):
            said = self.did(root, "systemd-analyze", "--no-pager", "security", "--offline=true", unit)
            exposure = float(re.search(r"Overall exposure level for \S+: (\d+\.\d+)", said).group(1))
            self.assertLess(exposure, EXPOSURE_LIMIT, said)
            print(f"exposure of {os.path.basename(unit)}: {exposure}")

    def test_the_unit_says_what_it_promises(self):
        with open(os.path.join(PACKAGING, "controller", "ivo-controller.service"), encoding="utf-8") as file:
            unit = file.read()
        for line in ("Type=notify", "NotifyAccess=main", "WatchdogSec=1s", "Restart=on-failure", "LimitRTPRIO=90", "LimitMEMLOCK=infinity",
                     "ConditionPathExists=/etc/ivo/mission.toml", "CapabilityBoundingSet=", "User=ivo", "StateDirectory=ivo", "RuntimeDirectory=ivo", "SuccessExitStatus=1", "RestartPreventExitStatus=3"):
            self.assertIn(f"\n{line}\n", unit)
        self.assertNotIn("RestartForceExitStatus", unit, "an ordered stop is not undone")

    def test_the_options_that_the_unit_gives_are_options_of_the_program(self):
        with open(os.path.join(PACKAGING, "controller", "ivo-controller.service"), encoding="utf-8") as file:
            command = re.search(r"^ExecStart=/usr/bin/ivo run (.*)$", file.read(), re.M).group(1)
        known = said_by(os.path.join(BUILD_DIR, "ivo"), "run", "--help")
        with open(os.path.join(PACKAGING, "controller", "controller.env"), encoding="utf-8") as file:
            command += " " + re.search(r'^IVO_OPTIONS="(.*)"$', file.read(), re.M).group(1)
        for option in re.findall(r"--[a-z-]+", command):
            self.assertIn(option, known)
        self.assertNotIn("--yes", command)

    def test_the_console_is_started_again_however_often_it_dies(self):
        with open(os.path.join(PACKAGING, "console", "ivo-console.service"), encoding="utf-8") as file:
            unit = file.read()
        self.assertRegex(unit, r"(?s)\[Unit\][^\[]*\nStartLimitIntervalSec=0\n")
        self.assertIn("\nRestart=always\n", unit)

    def test_the_options_that_the_consoles_unit_gives_are_options_of_its_program(self):
        known = said_by(os.path.join(BUILD_DIR, "ivo-console"), "--help")
        text = ""
        for name in ("ivo-console.service", "console.env"):
            with open(os.path.join(PACKAGING, "console", name), encoding="utf-8") as file:
                text += file.read()
        given = set(re.findall(r"(?<![\w-])--(?!help)[a-z-]+", text))
        self.assertTrue({"--socket", "--state", "--listen"} <= given)
        for option in given:
            self.assertIn(f"  {option} ", known)


if __name__ == "__main__":
    unittest.main()
