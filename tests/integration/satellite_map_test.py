#!/usr/bin/env python3
"""A segmented satellite image with a palette of its own is a map like any other: through a class table, in the same mission form.

The images (Humans in the Loop with the Mohammed Bin Rashid Space Centre, CC0) are not part of the product; without them beside the
checkout the test says that it was skipped.
"""

import os
import tempfile
import unittest

from mission_files import SOURCE_DIR, ivo, read_json

IMAGES = os.path.join(SOURCE_DIR, "..", "shared", "data", "dubai")

CLASSES = """\
[[class]]
name = "building"
colour = [60, 16, 152]
[[class]]
name = "soil"
colour = [132, 41, 246]
[[class]]
name = "road"
colour = [110, 193, 228]
[[class]]
name = "grass"
colour = [254, 221, 58]
[[class]]
name = "water"
colour = [226, 169, 41]
[[class]]
name = "pavement"
colour = [155, 155, 155]
"""

MAP = 'image = "{image}"\nresolution_m = 0.4\nclasses = "classes.toml"\n'

MISSION = """\
format = 1
map = "map.toml"
seed = 5
object = "drawn"
prior = {{ gaussians = [{{ mean_m = [150.0, 120.0], sigma_m = 20.0 }}] }}

[planner]
cell_m = 1.0
spacing_m = 8.0
generations = 2
ants = 2

[[agent]]
name = "IVO"
kind = "robot"
robot = "{source}/config/robots/ivo.toml"
start_m = {robot}
speed_mps = 1.0
sight_radius_m = 6.0

[[agent]]
name = "Ana"
kind = "person"
start_m = {person}
speed_mps = 1.4
sight_radius_m = 6.0
"""


@unittest.skipUnless(os.path.isdir(IMAGES), "no satellite images in ../shared/data/dubai")
class SatelliteMap(unittest.TestCase):
    def test_a_search_is_planned_and_run_on_it(self):
        with tempfile.TemporaryDirectory() as folder:
            files = {
                "classes.toml": CLASSES,
                "map.toml": MAP.format(image=os.path.realpath(os.path.join(IMAGES, "tile1_1.png"))),
                "mission.toml": MISSION.format(source=SOURCE_DIR, robot="[148.0, 110.0]", person="[156.0, 130.0]"),
            }
            for name, text in files.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            out = os.path.join(folder, "out")
            done = ivo("run", os.path.join(folder, "mission.toml"), "--yes", "--speed", "max", "--out", out)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            plan = read_json(out, "plan.json")
            self.assertGreater(plan["nodes"], 800)
            self.assertLess(plan["score"]["unseen_mass"], 0.5)
            self.assertTrue(os.path.getsize(os.path.join(out, "search.png")) > 100_000)

    def test_a_colour_that_the_table_leaves_out_is_refused_with_its_place(self):
        with tempfile.TemporaryDirectory() as folder:
            files = {
                "classes.toml": CLASSES.replace("[226, 169, 41]", "[1, 1, 1]").replace("[60, 16, 152]", "[2, 2, 2]"),
                "map.toml": MAP.format(image=os.path.realpath(os.path.join(IMAGES, "tile1_1.png"))),
                "mission.toml": MISSION.format(source=SOURCE_DIR, robot="[148.0, 110.0]", person="[156.0, 130.0]"),
            }
            for name, text in files.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            done = ivo("run", os.path.join(folder, "mission.toml"), "--yes", "--speed", "max", "--out", os.path.join(folder, "out"))
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, r"tile1_1\.png.*(column|row).*\n$")


if __name__ == "__main__":
    unittest.main()
