#!/usr/bin/python3
"""A whole search by people in front of screens: from drawing to the report, by mouse and by finger."""

import json
import os
import re
import time
import unittest

from console_rig import ENDLESS, ConsoleTest, courtyard

# What two screens must agree on.
SHOWN = """const text = (id) => document.getElementById(id).textContent;
return { state: text("state"), title: text("now-title"), facts: document.getElementById("facts-rows").innerText,
  areas: document.querySelectorAll(".area").length, paths: document.querySelectorAll(".path-left").length, list: document.getElementById("area-list").textContent }"""
NOTE_HELD = """const button = document.getElementById("hold-start");
window.was_held = false;
new MutationObserver(() => { window.was_held ||= button.classList.contains("held"); }).observe(button, { attributes: true, attributeFilter: ["class"] });"""


class WholeSearch(ConsoleTest):
    def assert_same(self, *screens):
        self.until(lambda: len({json.dumps(screen.js(SHOWN)) for screen in screens}) == 1, f"the same on all, {[screen.js(SHOWN) for screen in screens]}")

    def draw(self, screen):
        """A rectangle that Ana prefers, by a drag, and a polygon where nobody goes, by taps."""
        browser = screen.browser
        screen.press("tab-areas")
        screen.press("purpose-prefer-1")
        screen.press("draw-rectangle")
        screen.wait("document.body.dataset.tool === 'rectangle'")
        browser.drag(screen.place(4, 17), screen.place(20, 26.5), lambda: browser.picture("drawing"))
        screen.wait("document.querySelector('.area[data-slot=\"0\"]')")
        screen.press("purpose-no_go-")
        screen.press("draw-polygon")
        screen.wait("document.body.dataset.tool === 'polygon'")
        for place in ((13, 8), (17.5, 8), (17.5, 12), (15, 13)):
            browser.tap(screen.place(*place))
        screen.wait("!document.getElementById('draw-done').hidden")
        browser.picture("polygon")
        browser.tap(screen.place(13, 8))
        screen.wait("document.querySelector('.area[data-slot=\"1\"]')")

    def agree(self, screen):
        """Init, areas, Replan, the figures beside each other, Accept. Each plan is made until it is good enough."""
        screen.take_controls()
        screen.enough()
        number = screen.plan_number()
        screen.press("init")
        screen.wait_planning_after(number)
        screen.judge("planning")
        screen.enough()
        number = screen.plan_number()
        self.draw(screen)
        for area, words in (("area-0", r"Ana prefers.*16\.0.×.9\.\d.m · 15\d.m² · \d\d.%.of probability"), ("area-1", r"No-go for everybody.*m²")):
            self.until(lambda area=area, words=words: re.search(words, screen.text(area)), f"{words}, it is {screen.text(area)}")
        screen.judge("areas")
        screen.press("replan-areas")
        screen.wait_planning_after(number)
        screen.enough()
        screen.wait("!document.getElementById('facts-before').hidden && document.getElementById('fact-preferred-1')")
        screen.judge("agree")
        now, before = screen.js("return [...document.querySelectorAll('#fact-preferred-1 td')].map((cell) => parseInt(cell.textContent))")
        self.assertGreater(now, before)
        screen.act("accept", "document.body.dataset.act === 'hold-start'")
        screen.judge("accepted")

    def short_press(self, screen):
        """Its ring begins, and is not full when the button is let go. A page whose link is not steady at that moment begins none: then again."""
        screen.js(NOTE_HELD)
        while not screen.js("return window.was_held"):
            screen.wait_act("hold-start")
            place = screen.middle("hold-start")
            screen.browser.press(place)
            time.sleep(0.3)
            screen.browser.release(place)
        screen.wait("!document.getElementById('hold-start').classList.contains('held')")
        self.assertEqual(screen.js("return [document.body.dataset.act, document.body.dataset.started]"), ["hold-start", "no"])

    def test_two_screens_and_a_mouse(self):
        self.begin(generations=ENDLESS)
        ana, luis = self.screen("Ana's desk"), self.screen("Luis's tablet", "tablet")
        self.agree(ana)
        self.assert_same(ana, luis)
        luis.judge("watching")
        self.short_press(ana)
        ana.hold_start(lambda: ana.browser.picture("holding"))
        for screen in (ana, luis):
            screen.wait_state("searching")
        self.assert_same(ana, luis)
        ana.wait("Number(document.getElementById('agent-progress-0').value) > 0.05")
        ana.press("position-1")
        ana.wait("document.body.dataset.tool === 'position'")
        ana.browser.tap(ana.place(10.5, 8))
        for screen in (ana, luis):
            screen.wait_words("agent-words-1", "agent.seen")
        ana.judge("searching")
        luis.judge("searching")
        luis.act("found", "!document.getElementById('found-choice').hidden")  # who watches may say it too
        luis.judge("who")
        luis.press("found-1")
        for screen in (ana, luis):
            screen.wait_stage("end")
            screen.wait_text("now-title", "Ana found the object!")
            screen.wait("!document.getElementById('report-file').hidden")
        self.assert_same(ana, luis)
        ana.judge("found")
        self.assertEqual(self.controller.wait(60), 0)
        # That the controller has ended too is nothing to be alarmed about.
        for screen in (ana, luis):
            screen.wait_state("found_by_person")
        with open(os.path.join(self.out, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
        self.assertIn(f"{report['agents'][0]['distance_m']:.1f}", ana.text("report-rows"))

    def last_place(self, agent):
        """To 10 cm: a finger is no finer."""
        return [(round(each["x_m"], 1), round(each["y_m"], 1)) for each in self.events() if each["event"] == "position" and each["agent"] == agent][-1]

    def test_a_phone_and_fingers(self):
        self.begin(generations=ENDLESS)
        phone = self.screen("Ana's phone", "phone")
        phone.judge("paired")
        self.agree(phone)
        self.short_press(phone)
        phone.hold_start(lambda: phone.browser.picture("holding"))
        phone.wait_state("searching")
        phone.press("tab-search")
        phone.browser.drag(phone.middle("agent-1"), phone.place(13, 6))
        phone.wait_words("agent-words-1", "agent.seen")
        self.until(lambda: self.last_place("Ana") == (13.0, 6.0), "Ana's place")
        phone.judge("searching")
        phone.act("found", "!document.getElementById('found-choice').hidden")
        phone.press("found-1")
        phone.wait_text("now-title", "Ana found the object!")
        phone.judge("found")

    def test_the_robot_finds_it(self):
        self.begin([13.0, 12.3])
        screen = self.screen("Ana's tablet", "tablet")
        screen.take_controls()
        screen.start()
        screen.wait_stage("end", patience_s=120)
        screen.wait_text("now-title", "IVO found the object!")
        screen.wait_text("report-rows", "The object was at13.0")
        screen.judge("robot-found")

    def test_the_paths_end_without_it(self):
        # Little to search, and the object elsewhere.
        gaussians = "{ mean_m = [14.4, 14.7], sigma_m = 0.7, weight = 1.0 },\n]"
        mission = courtyard([4.0, 6.0])
        begin, end = mission.index("gaussians = [") + len("gaussians = ["), mission.index("\n]\n") + 2
        self.start_controller(mission[:begin] + gaussians + mission[end:])
        self.start_server()
        screen = self.screen("Ana's phone", "phone")
        screen.take_controls()
        screen.start()
        screen.wait_stage("end", patience_s=120)
        screen.wait_text("now-title", "Both paths are at their end")
        screen.judge("paths-ended")


if __name__ == "__main__":
    unittest.main()
