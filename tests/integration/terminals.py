"""Pseudo-terminals for tests."""

import fcntl
import os
import pty
import struct
import subprocess
import tempfile
import unittest


def open_terminal():
    """(near end, far end) of a pseudo-terminal; on a bare root that has no devpts, root mounts one for a moment."""
    try:
        return pty.openpty()
    except OSError:
        pass
    with tempfile.TemporaryDirectory() as folder:
        mount = ["mount", "-t", "devpts", "-o", "newinstance,ptmxmode=0666", "devpts", folder]
        if subprocess.run(mount, capture_output=True, check=False).returncode != 0:
            raise unittest.SkipTest("no pseudo-terminals here, and only root may mount some")
        try:
            near_end = os.open(os.path.join(folder, "ptmx"), os.O_RDWR | os.O_NOCTTY)
            fcntl.ioctl(near_end, 0x40045431, struct.pack("i", 0))  # TIOCSPTLCK: unlock
            number = struct.unpack("i", fcntl.ioctl(near_end, 0x80045430, bytes(4)))[0]  # TIOCGPTN
            return near_end, os.open(os.path.join(folder, str(number)), os.O_RDWR | os.O_NOCTTY)
        finally:
            subprocess.run(["umount", "--lazy", folder], check=True)
