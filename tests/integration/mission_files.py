"""Missions for tests: a small free map and a mission on it, written into a scratch folder, to be changed by the test."""

import json
import os
import struct
import subprocess
import zlib

SOURCE_DIR = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
BUILD_DIR = os.environ.get("IVO_BUILD_DIR", os.path.join(SOURCE_DIR, "build", "release"))
IVO = os.path.join(BUILD_DIR, "ivo")
COURTYARD = os.path.join(SOURCE_DIR, "config", "missions", "courtyard.toml")

PAVEMENT = (214, 210, 202)
BUILDING = (104, 84, 92)


def write_png(path, rows, grey=False):
    """`rows`: colours from the top row down; of grey ones the first value counts."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = b"".join(b"\0" + b"".join(bytes(pixel[:1] if grey else pixel) for pixel in row) for row in rows)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0 if grey else 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def plaza(size_px=48):
    """A free square, 12 x 12 m at 0.25 m a pixel, as rows of colours that a test may paint on."""
    return [[PAVEMENT] * size_px for _ in range(size_px)]


MISSION = """\
format = 1
map = "map.toml"
seed = 3
object = "drawn"
prior = "uniform"

[planner]
spacing_m = 3.0
generations = 5

[[agent]]
name = "IVO"
kind = "robot"
robot = "{source}/config/robots/ivo.toml"
start_m = [1.5, 1.5]
sight_radius_m = 2.5
speed_mps = 0.5

[[agent]]
name = "Ana"
kind = "person"
start_m = [10.5, 1.5]
sight_radius_m = 2.5
speed_mps = 0.5
""".format(source=SOURCE_DIR)


def write_mission(folder, mission=MISSION, rows=None, map_text='image = "map.png"\nresolution_m = 0.25\n'):
    """Writes mission.toml, map.toml and map.png into `folder`; returns the mission's path."""
    write_png(os.path.join(folder, "map.png"), rows or plaza())
    for name, text in (("map.toml", map_text), ("mission.toml", mission)):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    return os.path.join(folder, "mission.toml")


def ivo(*args):
    """Runs ivo without standard input; returns the finished process."""
    return subprocess.run([IVO, *args], capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)


def read_json(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return json.load(file)


def events(folder):
    with open(os.path.join(folder, "events.jsonl"), encoding="utf-8") as file:
        return [json.loads(line) for line in file]
