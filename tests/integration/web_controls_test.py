#!/usr/bin/env python3
"""Who holds the controls at ivo-console, and what the controller is told then."""

import time
import unittest

import fake_controller as fake
from web_server import WebServerTest
from websocket_client import PONG, WebSocket, request


class Controls(WebServerTest):
    def setUp(self):
        super().setUp()
        self.fake = self.controller()
        self.start()
        self.token = self.pair()

    def operator(self):
        page = self.page(self.token)
        page.status(lambda status: status["controller"] == "connected")
        self.assertEqual(page.ask("control.request"), "accepted")
        return page

    def test_who_holds_the_controls_tells_the_controller(self):
        page = self.operator()
        self.fake.set(plan_number=2)
        for do, keys, kind, argument in (("init", {}, fake.INIT, 0), ("replan", {"areas_revision": 7}, fake.REPLAN, 7), ("enough", {"plan": 2}, fake.ENOUGH, 2),
                                         ("accept", {"plan": 2}, fake.ACCEPT, 2), ("found", {"agent": 1}, fake.FOUND, 1),
                                         ("area.remove", {"slot": 31}, fake.REMOVE_AREA, 31), ("end", {}, fake.STOP, 0), ("stop", {}, fake.PAUSE, 0)):
            self.assertEqual(page.ask(do, **keys), "accepted", do)
            heard = self.fake.wait_for(kind)[-1]
            self.assertEqual((heard.question, heard.argument), (0, argument), do)
        self.assertEqual(page.ask("clear_fault", question=3), "accepted")
        self.assertEqual(self.fake.wait_for(fake.CLEAR_FAULT)[0].question, 3)
        self.assertEqual(page.ask("position", agent=1, x_m=1.25, y_m=0.5), "accepted")
        self.assertEqual(fake.POSE_COMMAND.unpack(self.fake.wait_for(fake.POSE)[0].packet)[5:], (1, 1.25, 0.5, 0.0, 0.0, 0.0, 0.0))
        self.assertEqual(page.ask("area.put", slot=2, purpose="no_go", agent=None, polygon_m=[[0, 0], [1, 0], [1, 1]]), "accepted")
        area = fake.AREA.unpack(self.fake.wait_for(fake.PUT_AREA)[0].packet)
        self.assertEqual(area[5:15], (2, 1, fake.EVERYBODY, 3, 0, 0.0, 0.0, 1.0, 0.0, 1.0))

    def test_who_does_not_may_look_and_stop_and_say_what_he_sees(self):
        self.operator()
        other = self.page(self.pair("Ben's phone"))
        for do, keys in (("end", {}), ("init", {}), ("replan", {"areas_revision": 1}), ("enough", {"plan": 1}), ("accept", {"plan": 1}),
                         ("start", {"question": 1}), ("clear_fault", {"question": 1}), ("area.remove", {"slot": 0}), ("control.give", {}),
                         ("control.keep", {}), ("control.release", {}),
                         ("area.put", {"slot": 0, "purpose": "preferred", "agent": 1, "polygon_m": [[0, 0], [1, 0], [1, 1]]})):
            self.assertEqual(other.ask(do, **keys), "not_allowed", do)
        self.assertEqual(self.fake.messages(), [])
        for do, keys in (("stop", {}), ("found", {"agent": 1}), ("position", {"agent": 1, "x_m": 0.5, "y_m": 0.5}), ("beat", {})):
            self.assertEqual(other.ask(do, **keys), "accepted", do)
        self.assertEqual([message.kind for message in self.fake.messages()], [fake.PAUSE, fake.FOUND, fake.POSE], "only an operator's beats are passed on")

    def test_a_viewer_gets_no_controls(self):
        viewer = self.page(self.new_token("viewer"))
        self.assertEqual(viewer.ask("control.request"), "not_allowed")
        self.assertEqual(viewer.ask("stop"), "accepted")

    def test_the_controls_are_asked_for_and_given(self):
        first = self.operator()
        second = self.page(self.pair("Ben's phone"))
        self.assertEqual(second.ask("control.request"), "accepted")
        status = first.status(lambda status: status["request"])
        self.assertEqual((status["operator"]["name"], status["request"]["name"]), ("Ana's tablet", "Ben's phone"))
        self.assertEqual(first.ask("control.keep"), "accepted")
        first.status(lambda status: not status["request"])
        self.assertEqual(second.ask("init"), "not_allowed")
        self.assertEqual(second.ask("control.request"), "accepted")
        self.assertEqual(first.ask("control.give"), "accepted")
        self.assertEqual(second.ask("init"), "accepted")
        self.assertEqual(first.ask("init"), "not_allowed")
        self.assertEqual(second.ask("control.release"), "accepted")
        self.assertIsNone(second.status(lambda status: not status["operator"])["operator"])

    def test_a_holder_who_is_gone_holds_them_no_more(self):
        page = self.operator()
        page.status(lambda status: status["operator"])
        page.close()
        other = self.page(self.pair("Ben's phone"))
        other.status(lambda status: status["operator"] is None)
        self.assertEqual(other.ask("control.request"), "accepted")
        self.assertEqual(other.ask("init"), "accepted")

    def test_a_reload_keeps_the_controls(self):
        self.operator().close()
        page = self.page(self.token)
        self.assertEqual(page.ask("init"), "accepted")

    def until_fresh(self, ask):
        """What a busy host holds up for a second counts for nothing: it is asked anew until it is accepted, and nothing else is said to it."""
        until = time.monotonic() + 20
        while (verdict := ask()) != "accepted":
            self.assertEqual(verdict, "not_fresh")
            self.assertLess(time.monotonic(), until, "it never counted")

    def beat_until_told_fresh(self, page):
        until = time.monotonic() + 20
        fresh = False
        while not fresh:
            self.assertLess(time.monotonic(), until, "it was never told so")
            self.until_fresh(lambda: page.ask("beat"))
            fresh = page.status()["start_fresh"]

    def start_search(self, page, between=lambda: None):
        """Within a second of a beat, and of the status that both name."""

        def beat_and_start():
            self.until_fresh(lambda: page.ask("beat"))
            between()
            return page.ask("start", question=1)

        self.until_fresh(beat_and_start)

    def test_starting_needs_a_fresh_link_and_beats_follow(self):
        page = self.operator()
        self.assertEqual(page.ask("start", question=1), "not_fresh", "no beat has come")
        self.beat_until_told_fresh(page)
        self.start_search(page)
        consent = self.fake.wait_for(fake.CONSENT)[0]
        self.assertEqual((consent.question, consent.argument), (1, 1))
        self.fake.wait_for(fake.BEAT)
        page.status(lambda status: not status["start_fresh"])
        self.assertEqual(page.ask("start", question=1), "not_fresh", "the last beat is old")

    def test_what_was_held_up_on_its_way_is_not_fresh(self):
        page = self.operator()
        old = page.status()["n"]
        time.sleep(1.1)
        self.assertEqual(page.ask("beat", seen=old), "not_fresh", "it arrives now, and set out a second ago")
        self.assertEqual(page.ask("start", question=1, seen=old), "not_fresh")
        self.assertEqual(page.ask("beat", seen=1 << 31), "not_fresh", "no such status")
        self.assertEqual(self.fake.messages(fake.BEAT) + self.fake.messages(fake.CONSENT), [])
        # When the start behind it is accepted, the beat was fresh enough for this one too.
        self.start_search(page, lambda: self.assertEqual(page.ask("start", question=1, seen=old), "not_fresh", "beats come, but this one is old"))
        self.fake.wait_for(fake.BEAT)

    def test_a_ros_clients_beats_are_answers_to_the_newest_ping(self):
        token = self.new_token("operator", "rviz")
        ros = WebSocket(self.port, path=f"/?token={token}", protocol=None, origin=None)
        self.addCleanup(ros.close)
        ros.answers_pings = False
        ros.send({"op": "subscribe", "topic": "/ivo/state"})
        ros.send({"op": "subscribe", "topic": "/tf"})
        ros.wait_for(lambda message: message["op"] == "publish")
        ros.send({"op": "call_service", "service": "/ivo/take_control"})
        self.assertTrue(ros.wait_for(lambda message: message["op"] == "service_response")["values"]["success"])
        until = time.monotonic() + 1.5
        while time.monotonic() < until:
            for payload in (b"", b"\0", b"0", b"99999"):
                ros.send_frame(payload, PONG)
            time.sleep(0.1)
        self.assertEqual(self.fake.messages(fake.BEAT), [])
        ros.answers_pings = True
        until = time.monotonic() + 10
        while not self.fake.messages(fake.BEAT) and time.monotonic() < until:
            ros.hear()
        self.assertTrue(self.fake.messages(fake.BEAT))

    def test_what_the_controller_says_no_to_is_said_so(self):
        page = self.operator()
        for verdict, name in ((fake.NOT_ASKED, "not_asked"), (fake.OTHER_QUESTION, "other_question"), (fake.ANSWERED, "answered"),
                              (fake.OUT_OF_RANGE, "out_of_range"), (fake.NOT_NOW, "not_now"), (fake.OUTDATED, "outdated"), (fake.NOT_AN_AREA, "not_an_area")):
            self.fake.answer = lambda message, verdict=verdict: verdict
            self.assertEqual(page.ask("init"), name)
        self.assertEqual(page.status(lambda status: status["refused"]["by_controller"] >= 7)["refused"]["by_controller"], 7)
        self.fake.answer = lambda message: None
        self.assertEqual(page.ask("init"), "no_controller", "it never answers")

    def test_areas_are_put_from_a_file(self):
        text = {"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"purpose": "no_go", "agent": None},
             "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}},
            {"type": "Feature", "properties": {"purpose": "preferred", "agent": "Ana", "slot": 0},
             "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}}]}
        page = self.page(self.token)
        page.wait_for(lambda message: message.get("name") == "report")
        self.fake.publish("areas", {"areas": [{"slot": 5, "purpose": "no_go", "agent": None, "polygon_m": [[0, 0], [1, 0], [1, 1]], "area_m2": 0.5}]})
        page.wait_for(lambda message: message.get("name") == "areas")
        cookie = [f"Cookie: ivo={self.token}"]
        self.assertEqual(request(self.port, "PUT", "/areas.geojson", text, headers=cookie).status, 403, "it does not hold the controls")
        self.assertEqual(page.ask("control.request"), "accepted")
        self.assertEqual(request(self.port, "PUT", "/areas.geojson", text, headers=cookie, origin="http://evil.example").status, 403)
        self.assertEqual(request(self.port, "PUT", "/areas.geojson", {"type": "none"}, headers=cookie).status, 400)
        self.assertEqual(request(self.port, "PUT", "/areas.geojson", text, headers=cookie).status, 202)
        self.assertEqual(self.fake.wait_for(fake.REMOVE_AREA)[0].argument, 5)
        slots = [fake.AREA.unpack(message.packet)[5:8] for message in self.fake.wait_for(fake.PUT_AREA, 2)]
        self.assertEqual(slots, [(1, 1, fake.EVERYBODY), (0, 0, 1)])


if __name__ == "__main__":
    unittest.main()
