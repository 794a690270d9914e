#!/usr/bin/python3
"""Areas: moved, resized, removed, undone, by finger and by keyboard; who watches sees them and changes nothing."""

import json
import os
import unittest

from selenium.webdriver.common.keys import Keys

from console_rig import ConsoleTest

RECTANGLE = {"x": 5, "y": 18, "width": 6, "height": 4}


class Areas(ConsoleTest):
    def setUp(self):
        super().setUp()
        self.begin()

    def operator(self, *args):
        screen = super().operator(*args)
        screen.press("tab-areas")
        return screen

    def box(self, screen):
        """Of the area that is selected, as its form has it."""
        return screen.js("return ['x', 'y', 'width', 'height'].map((name) => document.getElementById(`form-${name}`).valueAsNumber)")

    def wait_box(self, screen, *box, within_m=0.15):
        self.until(lambda: all(abs(a - b) <= within_m for a, b in zip(self.box(screen), box)), f"{box}, it is {self.box(screen)}")

    def corner(self, screen, number):
        return screen.js("""const box = document.querySelector(`.handle[data-corner="${arguments[0]}"]`).getBoundingClientRect();
            return [box.left + box.width / 2, box.top + box.height / 2]""", number)

    def moves(self, screen):
        screen.put_area(**RECTANGLE)
        screen.wait("document.querySelector('.area[data-slot=\"0\"]') && document.querySelectorAll('.handle').length === 4")
        self.wait_box(screen, 5, 18, 6, 4)
        screen.browser.drag(screen.place(8, 20), screen.place(10, 21))
        self.wait_box(screen, 7, 19, 6, 4)
        screen.browser.drag(self.corner(screen, 2), screen.place(15, 25))
        self.wait_box(screen, 7, 19, 8, 6)
        screen.browser.drag(screen.place(10, 22), screen.place(25, 22))  # over the edge: it stays on the map
        self.wait_box(screen, 13, 19, 8, 6)
        screen.judge("edited")
        screen.press("undo")
        self.wait_box(screen, 7, 19, 8, 6)
        screen.press("undo")
        self.wait_box(screen, 7, 19, 6, 4)
        screen.press("area-remove-0")
        screen.wait("!document.querySelector('.area') && !document.getElementById('areas-none').hidden")
        screen.press("undo")
        screen.wait("document.querySelector('.area[data-slot=\"0\"]')")

    def test_by_finger(self):
        self.moves(self.operator("Ana's tablet", "tablet"))

    def test_by_mouse(self):
        self.moves(self.operator("Ana's desk", "desk"))

    def test_a_file_that_was_loaded_is_undone_in_one_step(self):
        screen = self.operator("Ana's desk", "desk")
        screen.put_area(**RECTANGLE)
        screen.wait("document.querySelector('.area[data-slot=\"0\"]')")
        box = [[2, 2], [6, 2], [6, 5], [2, 5], [2, 2]]
        path = os.path.join(self.folder, "areas.geojson")
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"type": "FeatureCollection", "features": [
                {"type": "Feature", "properties": {"purpose": "no_go", "agent": None}, "geometry": {"type": "Polygon", "coordinates": [[[x + shift, y] for x, y in box]]}}
                for shift in (0, 6)]}, file)
        screen.browser.driver.find_element("id", "areas-load-file").send_keys(path)
        screen.wait_text("area-0", "No-go")
        screen.wait_text("area-1", "No-go")
        screen.press("undo")
        screen.wait_text("area-0", "Ana prefers")
        screen.wait("document.querySelectorAll('.area').length === 1")

    def test_by_keyboard_alone(self):
        screen = self.operator("Ana's desk", "desk")
        screen.keys("area-numbers", Keys.ENTER)
        screen.wait("document.activeElement.id === 'form-x'")
        for name, value in {**RECTANGLE, "width": 40}.items():
            screen.type(f"form-{name}", str(value))
        screen.keys("form-height", Keys.ENTER)
        screen.wait_text("toast", "That is off the map")
        screen.type("form-width", "6")
        screen.keys("form-height", Keys.ENTER)
        screen.wait("document.querySelector('.area[data-slot=\"0\"]')")
        screen.type("form-width", "9")
        screen.keys("form-height", Keys.ENTER)
        screen.wait_text("area-0", "9.0")
        screen.keys("tab-areas", Keys.CONTROL, "z")
        screen.wait_text("area-0", "6.0")
        screen.keys("area-remove-0", Keys.SPACE)
        screen.wait("!document.querySelector('.area')")
        # A person's place, by the arrows.
        before = screen.js("return document.getElementById('agent-1').getBoundingClientRect().top")
        screen.keys("agent-1", Keys.ARROW_UP)
        screen.wait("document.getElementById('agent-1').getBoundingClientRect().top < arguments[0] - 5", before)

    def test_a_border_that_crosses_itself_is_no_area(self):
        screen = self.operator("Ana's desk", "desk")
        screen.press("draw-polygon")
        screen.wait("document.body.dataset.tool === 'polygon'")
        for place in ((5, 18), (11, 22), (11, 18), (5, 22)):
            screen.browser.tap(screen.place(*place))
        screen.press("draw-done")
        screen.wait_text("toast", "crosses itself")
        self.assertEqual(screen.js("return document.querySelectorAll('.area').length"), 0)
        screen.keys("draw-cancel", Keys.ESCAPE)
        screen.wait("document.body.dataset.tool === ''")

    def test_who_watches_sees_them_at_once_and_changes_nothing(self):
        ana = self.operator("Ana's desk", "desk")
        luis = self.screen("Luis's phone", "phone")
        ana.put_area(**RECTANGLE)
        ana.put_area("no_go-", x=1, y=1, width=2, height=3)
        luis.wait("document.querySelectorAll('.area').length === 2")
        luis.press("tab-areas")
        luis.wait("!document.getElementById('areas-locked').hidden")
        for name in ("draw-rectangle", "draw-polygon", "area-numbers", "undo", "area-remove-0", "replan-areas"):
            self.assertEqual(luis.js("return document.getElementById(arguments[0]).ariaDisabled", name), "true", name)
        luis.judge("watching-areas")
        luis.browser.driver.refresh()
        luis.wait("document.querySelectorAll('.area').length === 2")


if __name__ == "__main__":
    unittest.main()
