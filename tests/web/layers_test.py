#!/usr/bin/python3
"""What lies on the map: the ground as it is drawn or from the air, and what is shown or hidden over it."""

import os
import shutil
import unittest

from console_rig import ConsoleTest, courtyard
from mission_files import SOURCE_DIR, write_png

MAPS = os.path.join(SOURCE_DIR, "config", "maps")
GREEN, BROWN = (40, 120, 60), (120, 90, 60)
GROUND = """const canvas = document.querySelector("[data-grid=aerial]");
return canvas ? [...canvas.getContext("2d").getImageData(2, 2, 1, 1).data].slice(0, 3) : null"""
SEEN = "return [...document.querySelectorAll('[data-grid]')].map((node) => node.dataset.grid).sort()"


class Layers(ConsoleTest):
    def begin_with_a_picture_from_the_air(self):
        maps = os.path.join(self.folder, "maps")
        os.makedirs(maps)
        shutil.copy(os.path.join(MAPS, "courtyard.png"), maps)
        write_png(os.path.join(maps, "air.png"), [[GREEN] * 84] * 54 + [[BROWN] * 84] * 54)
        with open(os.path.join(MAPS, "courtyard.toml"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(maps, "courtyard.toml"), "w", encoding="utf-8") as file:
            file.write('aerial = "air.png"\n' + text)
        self.start_controller(courtyard("unknown").replace(f"{SOURCE_DIR}/config/maps/courtyard.toml", os.path.join(maps, "courtyard.toml")))
        self.start_server()

    def test_the_ground_from_the_air_and_as_it_is_drawn(self):
        self.begin_with_a_picture_from_the_air()
        screen = self.screen("Ana's tablet", "tablet")
        screen.press("layers-button")
        screen.wait("document.getElementById('layers').checkVisibility()")
        screen.judge("layers")
        self.until(lambda: "map" in screen.js(SEEN), "the map")
        screen.press("layer-aerial")
        self.until(lambda: screen.js(GROUND) == list(GREEN), "the picture, its upper edge above")
        self.until(lambda: "map" not in screen.js(SEEN), "no map beneath it")
        screen.browser.picture("aerial")
        for name in ("probability", "searched"):
            self.until(lambda: name in screen.js(SEEN), name)
            screen.press(f"layer-{name}")
            self.until(lambda: name not in screen.js(SEEN), f"no {name}")
        screen.press("layer-plan")
        screen.wait("document.querySelectorAll('.path-left').length === 0")
        screen.press("layer-map")
        self.until(lambda: screen.js(SEEN) == ["map"], "the map alone")

    def test_a_map_without_a_picture_offers_none(self):
        self.begin()
        screen = self.screen("Ana's tablet", "tablet")
        screen.press("layers-button")
        self.assertFalse(screen.js("return document.getElementById('layer-aerial').checkVisibility() && !document.getElementById('layer-aerial').disabled"))

    def test_before_there_is_a_controller(self):
        self.start_server()
        with open(os.path.join(self.folder, "controller.log"), "w", encoding="utf-8"):
            pass
        screen = self.screen("Ana's tablet", "tablet", paired=False)
        screen.wait("!document.getElementById('pairing').hidden")
        screen.type("pairing-code", self.new_code())
        screen.press("pairing-send")
        screen.wait("document.getElementById('pairing').hidden")
        screen.wait_state("none")
        screen.judge("no-controller")


if __name__ == "__main__":
    unittest.main()
