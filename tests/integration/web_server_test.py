#!/usr/bin/env python3
"""ivo-console from outside: who is let in, who may do what, and what no client can do to the others."""

import http.client
import json
import os
import random
import re
import socket
import stat
import struct
import subprocess
import time
import unittest

import fake_controller as fake
from web_server import PROGRAM, WebServerTest
from websocket_client import BINARY, PONG, Refused, WebSocket, frame, request


class Files(WebServerTest):
    def test_the_page_needs_no_pairing_and_runs_nothing_of_others(self):
        self.start()
        for path, kind in (("/", "text/html; charset=utf-8"), ("/main.js", "text/javascript; charset=utf-8"), ("/page.css", "text/css; charset=utf-8"),
                           ("/manifest.webmanifest", "application/manifest+json"), ("/icons/icon.svg", "image/svg+xml"),
                           ("/leaflet/leaflet.js", "text/javascript; charset=utf-8"), ("/leaflet/images/layers.png", "image/png")):
            answer = self.get(path)
            self.assertEqual((answer.status, answer.headers["content-type"]), (200, kind), path)
            policy = answer.headers["content-security-policy"]
            for part in ("default-src 'none'", "script-src 'self'", "frame-ancestors 'none'", "base-uri 'none'", "form-action 'none'"):
                self.assertIn(part, policy)
            self.assertNotIn("unsafe", policy)
            self.assertEqual(answer.headers["x-content-type-options"], "nosniff")
            self.assertEqual(answer.headers["referrer-policy"], "no-referrer")
            self.assertEqual(answer.headers["cross-origin-opener-policy"], "same-origin")
            self.assertIn("permissions-policy", answer.headers)

    def test_a_file_that_is_known_is_not_sent_again(self):
        self.start()
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        connection.request("GET", "/main.js")
        answer = connection.getresponse()
        self.assertEqual(answer.read(), b"'use strict';")
        for _ in range(3):  # on the same connection
            connection.request("GET", "/main.js", headers={"If-None-Match": answer.headers["etag"]})
            again = connection.getresponse()
            self.assertEqual((again.status, again.read()), (304, b""))
        connection.close()

    def test_nothing_else_can_be_asked_for(self):
        self.start()
        token = self.pair()
        for path in ("/notes.txt", "/../state/tokens", "/%2e%2e/state/tokens", "/icons/../../state/tokens", "/icons", "/web/", "//etc/passwd",
                     "/leaflet/../../../../etc/passwd", "/main.js%00"):
            for who in (None, token):
                try:
                    self.assertIn(self.get(path, who).status, (400, 403, 404), path)
                except ConnectionError:
                    pass  # hung up on
        for method in ("DELETE", "PATCH", "OPTIONS", "PUT"):
            self.assertIn(request(self.port, method, "/", headers=[f"Cookie: ivo={token}"]).status, (403, 404, 405), method)

    def test_what_the_controller_knows_needs_pairing(self):
        controller = self.controller()
        self.start()
        paths = ("/grid/map", "/grid/probability", "/grid/searched", "/areas.geojson", "/keepout.yaml", "/keepout.pgm", "/report.json", "/plan.json",
                 "/aerial.png")
        for path in paths:
            self.assertEqual(self.get(path).status, 403, path)
            self.assertEqual(self.get(path, "0" * 64).status, 403, path)
        token = self.pair()
        page = self.page(token)
        page.wait_for(lambda message: message.get("name") == "report")
        self.assertEqual(self.get("/grid/map", token).body, controller.documents["map"][1])
        self.assertEqual(struct.unpack("<2f", self.get("/grid/probability", token).body), (0.75, 0.25))
        self.assertEqual(self.get("/grid/searched", token).body, bytes([1]))
        self.assertEqual(json.loads(self.get("/areas.geojson", token).body)["features"], [])
        self.assertTrue(self.get("/keepout.pgm", token).body.startswith(b"P5"))
        for path in ("/report.json", "/plan.json", "/aerial.png"):
            self.assertEqual(self.get(path, token).status, 404, path)
        controller.publish("report", {"end": "found"})
        page.wait_for(lambda message: message.get("name") == "report")
        self.assertEqual(json.loads(self.get("/report.json", token).body), {"end": "found"})

    def test_a_large_document_comes_whole(self):
        controller = self.controller()
        self.start()
        page = self.page(self.pair())
        page.wait_for(lambda message: message.get("name") == "report")
        waypoints = [[i * 0.001, 1.5] for i in range(60_000)]
        controller.publish("plan", {"agents": [{"waypoints_m": waypoints}]})
        plan = page.wait_for(lambda message: message.get("name") == "plan")
        self.assertEqual(plan["value"]["agents"][0]["waypoints_m"], waypoints)


class Pairing(WebServerTest):
    def test_a_code_counts_once(self):
        self.start()
        code = self.code()
        first = self.post_code(code)
        self.assertEqual(first.status, 204)
        cookie = first.headers["set-cookie"]
        for part in ("HttpOnly", "SameSite=Strict", "Path=/", "Max-Age=15552000"):
            self.assertIn(part, cookie)
        self.assertNotIn("Secure", cookie)
        again = self.post_code(code)
        self.assertEqual((again.status, json.loads(again.body)["error"]), (403, "wrong_code"))

    def test_five_wrong_codes_lock_who_guesses(self):
        self.start()
        code = self.code()
        wrong = "000000" if code != "000000" else "111111"
        left = [json.loads(self.post_code(wrong).body) for _ in range(5)]
        self.assertEqual([answer.get("left") for answer in left], [4, 3, 2, 1, None])
        self.assertEqual((left[4]["error"], left[4]["wait_s"]), ("locked", 30))
        answer = self.post_code(self.code())
        self.assertEqual((answer.status, json.loads(answer.body)["error"]), (403, "locked"), "the right one is not looked at either")
        self.assertEqual(len([line for line in self.said if "locked" in line]), 1)
        self.assertEqual(self.code(), code)

    def test_what_is_no_pairing_is_refused(self):
        self.start()
        for body in (b"", b"{}", b"[]", b"\xff\xfe", b'{"code":123456,"name":"x"}', b'{"code":"123456"}', b'{"code":"12345","name":"x"}',
                     b'{"code":"123456","name":"x","more":1}', b'{"code":"123456","code":"123456","name":"x"}'):
            self.assertEqual(request(self.port, "POST", "/pair", body).status, 400, body)
        self.assertEqual(request(self.port, "POST", "/pair", b" " * 2000).status, 413)
        self.assertEqual(request(self.port, "POST", "/pair", headers=["Transfer-Encoding: chunked"]).status, 413)

    def test_another_origin_cannot_pair(self):
        self.start()
        for origin in ("http://evil.example", f"http://localhost:{self.port + 1}", f"https://localhost:{self.port}", "null", None):
            self.assertEqual(self.post_code(self.code(), origin=origin).status, 403, origin)
        self.assertEqual(self.post_code(self.code()).status, 204)

    def test_the_robots_own_screen_shows_the_code(self):
        self.start()
        self.assertIn(self.code(), self.get("/screen", host=f"localhost:{self.port}").body.decode())
        self.assertEqual(self.get("/screen", host="evil.example").status, 403, "a name that was turned towards this machine")

    def test_who_is_paired_outlives_the_server_and_no_token_is_kept(self):
        self.start()
        token = self.pair()
        self.end()
        file = os.path.join(self.state, "tokens")
        with open(file, encoding="utf-8") as kept:
            text = kept.read()
        self.assertNotIn(token, text)
        self.assertIn("operator Ana's tablet", text)
        self.assertEqual(stat.S_IMODE(os.stat(file).st_mode), 0o600)
        self.start()
        self.assertEqual(self.page(token).hello["name"], "Ana's tablet")

    def test_a_damaged_list_of_tokens_is_refused_by_name(self):
        os.makedirs(self.state)
        with open(os.path.join(self.state, "tokens"), "w", encoding="utf-8") as file:
            file.write("ivo-console tokens 1\nnonsense\n")
        done = subprocess.run(self.options(), capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^ivo-console: .*/tokens:2: damaged; expected .*\n$")

    def test_a_token_of_the_command_line_counts_at_once(self):
        self.start()
        token = self.new_token("viewer")
        self.assertRegex(token, "^[0-9a-f]{64}$")
        self.assertEqual(self.page(token).hello["may_operate"], False)

    def paired(self):
        return subprocess.run(self.options("--paired"), capture_output=True, text=True, check=True).stdout

    def test_who_is_forgotten_is_hung_up_on_and_the_others_are_not(self):
        self.start()
        ana, luis = self.pair("Ana"), self.pair("Luis")
        gone, stays = self.page(ana), self.page(luis)
        self.assertRegex(self.paired(), r"^[0-9a-f]{8} operator Ana\n[0-9a-f]{8} operator Luis\n$")
        digits = self.paired().split()[0]
        done = subprocess.run(self.options("--forget", digits), capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout, f"forgotten: {digits} operator Ana\n")
        self.line(r"screen \d+, Ana: no longer paired")
        with self.assertRaises(ConnectionError):
            gone.wait_for(lambda message: False)
        self.assertEqual(self.get("/areas.geojson", ana).status, 403)
        stays.status(lambda status: [each["name"] for each in status["screens"]] == ["Luis"])
        done = subprocess.run(self.options("--forget", digits), capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr),
                         (2, f'ivo-console: --forget: "{digits}" is nobody\'s; expected the 8 digits that ivo-console --paired shows\n'))


class Doors(WebServerTest):
    def test_a_name_that_was_turned_towards_this_machine_is_refused(self):
        self.start("--origin", "http://tablet:8000")
        token = self.pair()
        evil = f"evil.example:{self.port}"
        code = self.code()
        answer = request(self.port, "POST", "/pair", {"code": code, "name": "x"}, host=evil, origin=f"http://{evil}")
        self.assertEqual((answer.status, json.loads(answer.body)), (403, {"error": "foreign_host"}))
        self.assertEqual(self.code(), code, "nobody was paired")
        self.page(token).status(lambda status: status["refused"]["foreign_host"] == 1)
        answer = request(self.port, "PUT", "/areas.geojson", {}, headers=[f"Cookie: ivo={token}"], host=evil, origin=f"http://{evil}")
        self.assertEqual((answer.status, json.loads(answer.body)), (403, {"error": "foreign_host"}))
        with self.assertRaises(Refused) as refusal:
            WebSocket(self.port, token=token, host=evil, origin=f"http://{evil}")
        self.assertEqual((refusal.exception.status, refusal.exception.body), (403, b'{"error":"foreign_host"}'))
        for host in (f"127.0.0.1:{self.port}", f"{socket.gethostname()}:{self.port}", f"{socket.gethostname()}.local:{self.port}", "tablet:1"):
            self.page(token, host=host, origin=f"http://{host}")

    def test_a_body_is_taken_only_from_who_is_paired(self):
        self.start()
        with socket.create_connection(("127.0.0.1", self.port), timeout=20) as connection:
            connection.sendall(f"PUT /areas.geojson HTTP/1.1\r\nHost: localhost:{self.port}\r\nOrigin: http://localhost:{self.port}\r\n"
                               "Content-Length: 1000000\r\n\r\n".encode())
            self.assertTrue(connection.recv(4096).startswith(b"HTTP/1.1 403"), "not one byte of it was sent")

    def test_what_is_no_http_is_hung_up_on(self):
        self.start()
        for text in (b"CONNECT evil.example:443 HTTP/1.1\r\nHost: evil.example\r\n\r\n", b"CONNECT / HTTP/1.1\r\n\r\n"):
            with socket.create_connection(("127.0.0.1", self.port), timeout=5) as connection:
                connection.sendall(text)
                try:
                    self.assertIn(connection.recv(12)[:4], (b"", b"HTTP"))
                    while connection.recv(4096):
                        pass
                except ConnectionError:
                    pass

    def test_what_is_no_websocket_has_a_deadline(self):
        self.start()
        begin = time.monotonic()
        with socket.create_connection(("127.0.0.1", self.port), timeout=60) as connection:
            connection.sendall(f"POST /pair HTTP/1.1\r\nHost: localhost:{self.port}\r\nOrigin: http://localhost:{self.port}\r\n"
                               "Content-Length: 1000\r\n\r\n".encode())
            connection.settimeout(2)
            while time.monotonic() - begin < 50:  # a byte now and then
                try:
                    connection.sendall(b" ")
                    if connection.recv(100) == b"":
                        break
                except socket.timeout:
                    pass
                except ConnectionError:
                    break
        self.assertLess(time.monotonic() - begin, 40)

    def refused(self, **keys):
        with self.assertRaises(Refused) as refusal:
            WebSocket(self.port, **keys)
        self.assertEqual(refusal.exception.status, 403)

    def test_a_session_needs_cookie_and_origin(self):
        self.start()
        token = self.pair()
        self.refused()
        self.refused(token="0" * 64)
        for origin in ("http://evil.example", "null", None, f"http://localhost:{self.port + 1}"):
            self.refused(token=token, origin=origin)
        page = self.page(token)
        self.assertEqual(page.status(lambda status: status["refused"]["foreign_origin"] >= 4)["refused"]["foreign_origin"], 4)

    def test_an_origin_that_is_named_is_let_in(self):
        self.start("--origin", "http://tablet:8000")
        token = self.pair()
        self.page(token, origin="http://tablet:8000")
        self.refused(token=token, origin="http://tablet:8001")

    def test_a_script_says_its_token_and_no_origin(self):
        self.start()
        token = self.new_token("operator")
        for keys in ({"path": f"/session?token={token}"}, {"headers": [f"Authorization: Bearer {token}"]}):
            script = WebSocket(self.port, origin=None, **keys)
            self.assertEqual(script.hear()["name"], "script")
            script.close()
        self.refused(origin="http://evil.example", headers=[f"Authorization: Bearer {token}"])
        self.assertEqual(request(self.port, "GET", "/plan.json", headers=[f"Authorization: Bearer {token}"]).status, 404)

    def test_who_comes_without_the_pages_subprotocol_speaks_ros(self):
        self.start()
        page = self.page(self.pair())
        token = self.new_token("viewer", "rviz")
        ros = WebSocket(self.port, path=f"/?token={token}", protocol=None, origin=None)
        self.addCleanup(ros.close)
        status = page.status(lambda status: len(status["screens"]) == 2)
        self.assertEqual([(screen["name"], screen["kind"]) for screen in status["screens"]], [("Ana's tablet", "page"), ("rviz", "ros")])

    def test_one_address_opens_only_so_many(self):
        self.start()
        crowd = []
        for _ in range(40):
            crowd.append(socket.create_connection(("127.0.0.1", self.port)))
        time.sleep(0.3)
        crowd[-1].settimeout(5)
        try:
            self.assertEqual(crowd[-1].recv(1), b"")
        except ConnectionResetError:
            pass
        for one in crowd:
            one.close()
        until = time.monotonic() + 20
        while time.monotonic() < until:  # there is room again, once it has noticed
            try:
                self.assertEqual(self.get("/").status, 200)
                break
            except ConnectionError:
                time.sleep(0.05)
        self.pair()


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

    def test_starting_needs_a_fresh_link_and_beats_follow(self):
        page = self.operator()
        self.assertEqual(page.ask("start", question=1), "not_fresh", "no beat has come")
        self.assertEqual(page.ask("beat"), "accepted")
        self.assertTrue(page.status(lambda status: status["start_fresh"])["start_fresh"])
        self.assertEqual(page.ask("beat"), "accepted")
        self.assertEqual(page.ask("start", question=1), "accepted")
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
        self.assertEqual(page.ask("beat"), "accepted")
        self.fake.wait_for(fake.BEAT)
        self.assertEqual(page.ask("start", question=1, seen=old), "not_fresh", "beats come, but this one is old")
        self.assertEqual(page.ask("start", question=1), "accepted")

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


class Hostile(WebServerTest):
    def setUp(self):
        super().setUp()
        self.fake = self.controller()
        self.start()
        self.token = self.pair()
        self.witness = self.page(self.token)
        self.witness.status(lambda status: status["controller"] == "connected")

    def test_order_and_repetition(self):
        page = self.page(self.token)
        for message, verdict in (('{"seq":2,"do":"beat","seen":SEEN}', "out_of_order"), ('{"seq":1,"do":"beat","seen":SEEN}', "accepted"), ('{"seq":1,"do":"beat","seen":SEEN}', "replayed"),
                                 ('{"seq":0,"do":"beat","seen":SEEN}', "malformed"), ('{"seq":2,"do":"bow"}', "malformed"), ('{"seq":3,"do":"beat","seen":SEEN}', "accepted"),
                                 ('{"seq":4,"do":"beat","seen":SEEN,"do":"end"}', "malformed"), ('{"seq":4,"do":"beat","seen":SEEN,"more":1}', "malformed"),
                                 ('{"seq":4,"do":"position","agent":1,"x_m":1e999,"y_m":0}', "malformed"), ('{"seq":4.0,"do":"beat","seen":SEEN}', "malformed"),
                                 ("[" * 5000, "malformed"), ("", "malformed"), ('{"seq":4,"do":"beat","seen":SEEN}' + " " * 9000, "too_large")):
            page.send(message.replace("SEEN", str(page.seen())))
            self.assertEqual(page.wait_for("answer")["verdict"], verdict, message[:60])
        page.send_frame('{"seq":4,"do":"beat","seen":1}', BINARY)
        self.assertEqual(page.wait_for("answer")["verdict"], "malformed")
        refused = page.status(lambda status: status["refused"]["malformed"] >= 9)["refused"]
        self.assertEqual((refused["replayed"], refused["out_of_order"], refused["too_large"]), (1, 1, 1))

    def test_a_message_in_parts_is_one(self):
        page = self.page(self.token)
        page.send_frame('{"seq":1,', final=False)
        page.send_frame('"do":"beat","seen":%d}' % page.seen(), opcode=0)
        self.assertEqual(page.wait_for("answer")["verdict"], "accepted")

    def test_a_stop_is_never_too_often(self):
        page = self.page(self.token)
        for _ in range(60):
            page.say("beat")
        page.wait_for(lambda message: message.get("verdict") == "too_often")
        self.assertEqual(page.ask("stop"), "accepted")
        self.fake.wait_for(fake.PAUSE)

    def test_garbage_by_the_hundred_thousand_while_statuses_go_on(self):
        rude = self.page(self.token)
        rude.socket.settimeout(60)
        chance = random.Random(7)
        each = 20_000
        makers = (lambda: bytes(chance.choices(range(32, 127), k=chance.randrange(60))),
                  lambda: b'{"seq":1,"do":"beat"', lambda: b'{"seq":99999999,"do":"init"}', lambda: b'{"seq":0,"do":"end"}',
                  lambda: b'{"do":"stop","seq":-1}')
        block = b"".join(frame(make()) for _ in range(200) for make in makers)
        self.witness.status()
        longest = 0.0
        last = time.monotonic()
        rude.socket.setblocking(False)
        sent = b""
        done = 0
        while done < each // 200:
            if not sent:
                sent = block
                done += 1
            try:
                sent = sent[rude.socket.send(sent):]
            except BlockingIOError:
                pass
            try:
                rude.socket.recv(1 << 20)
            except BlockingIOError:
                pass
            while self.readable(self.witness):
                if self.witness.hear()["type"] == "status":
                    longest = max(longest, time.monotonic() - last)
                    last = time.monotonic()
        refused = self.witness.status(lambda status: status["refused"]["malformed"] + status["refused"]["out_of_order"] >= 5 * each - 1000)["refused"]
        self.assertGreaterEqual(refused["out_of_order"], each - 200)
        self.assertEqual(self.fake.messages(), [], "nothing of it reached the controller")
        self.assertEqual(self.witness.ask("stop"), "accepted")
        self.assertLess(longest, 5.0)

    def readable(self, page):
        if page.rest:
            return True
        page.socket.settimeout(0.001)
        try:
            return bool(page.socket.recv(1, socket.MSG_PEEK))
        except (socket.timeout, BlockingIOError):
            return False
        finally:
            page.socket.settimeout(20)

    def test_who_does_not_read_is_dropped_and_nobody_waits_for_him(self):
        slow = self.page(self.token, receive_buffer=4096)
        number = slow.hello["screen"]
        slow_names = lambda status: [screen["screen"] for screen in status["screens"]]
        self.witness.status(lambda status: number in slow_names(status))
        begin = time.monotonic()
        self.witness.status(lambda status: number not in slow_names(status))
        self.assertLess(time.monotonic() - begin, 20)
        self.line(rf"screen {number}, .*: (silent for 5 s|does not read what it is sent)")

    def test_who_answers_no_ping_is_dropped(self):
        mute = self.page(self.token)
        mute.answers_pings = False
        with self.assertRaises(ConnectionError):
            while True:
                mute.hear()

    def test_garbage_instead_of_http_ends_one_connection(self):
        chance = random.Random(8)
        for _ in range(200):
            with socket.create_connection(("127.0.0.1", self.port)) as connection:
                try:
                    connection.sendall(chance.randbytes(chance.randrange(1, 3000)))
                except ConnectionError:
                    pass
        with socket.create_connection(("127.0.0.1", self.port), timeout=20) as connection:
            try:
                connection.sendall(b"GET / HTTP/1.1\r\n" + b"X: " + b"a" * 100_000)
                connection.recv(100)
            except ConnectionError:
                pass
        self.assertEqual(self.witness.ask("beat"), "accepted")


class Absence(WebServerTest):
    def test_a_controller_goes_and_comes_back(self):
        first = self.controller()
        first.set(question=4)
        first.publish("plan", {"number": 1})
        self.start()
        page = self.page(self.pair())
        self.assertEqual(page.status(lambda status: status["controller"] == "connected")["question"], 4)
        self.assertEqual(page.ask("control.request"), "accepted")
        first.close()
        gone = page.status(lambda status: status["controller"] == "absent")
        self.assertEqual(gone["question"], 4, "what was known last")
        self.assertEqual(page.ask("init"), "no_controller")
        self.assertEqual(page.ask("stop"), "no_controller")
        second = self.controller()
        second.set(question=1)
        back = forgotten = False
        while not (back and forgotten):  # in whatever order
            heard = page.hear()
            back = back or (heard.get("controller"), heard.get("question")) == ("connected", 1)
            forgotten = forgotten or (heard.get("name") == "plan" and heard["value"] is None)
        self.assertEqual(page.ask("init"), "accepted")
        self.assertEqual(len(second.wait_for(fake.INIT)), 1)

    def test_a_controller_that_is_silent_is_said_so(self):
        controller = self.controller()
        self.start()
        page = self.page(self.pair())
        page.status(lambda status: status["controller"] == "connected")
        controller.silent = True
        self.assertGreaterEqual(page.status(lambda status: status["controller"] == "silent")["controller_age_s"], 1.0)
        controller.silent = False
        page.status(lambda status: status["controller"] == "connected")

    def test_without_a_controller_there_is_a_page_all_the_same(self):
        self.start()
        page = self.page(self.pair())
        self.assertEqual(page.status()["controller"], "none")
        self.assertEqual(page.ask("stop"), "no_controller")

    def test_who_speaks_nonsense_is_no_controller(self):
        with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as stranger:
            stranger.bind(self.socket)
            stranger.listen()
            self.start()
            page = self.page(self.pair())
            for _ in range(3):
                other, _ = stranger.accept()
                with other:
                    other.send(b"hello")
            self.assertEqual(page.status()["controller"], "none")
        self.line(r"no controller: .* does not speak as this program does.*")

    def test_it_says_goodbye(self):
        self.start()
        page = self.page(self.pair())
        self.end()
        with self.assertRaisesRegex(ConnectionError, "goodbye"):
            while True:
                page.hear()
        self.assertEqual(self.said[-1], "ended")


class Encrypted(WebServerTest):
    def test_with_a_certificate_all_goes_over_tls(self):
        import ssl  # pylint: disable=import-outside-toplevel
        certificate, key = (os.path.join(self.folder, name) for name in ("certificate", "key"))
        subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-keyout", key, "-out", certificate,
                        "-subj", "/CN=localhost", "-addext", "subjectAltName=DNS:localhost", "-days", "2"], check=True, capture_output=True)
        context = ssl.create_default_context(cafile=certificate)
        self.wrap = lambda raw: context.wrap_socket(raw, server_hostname="localhost")
        self.start("--certificate", certificate, "--key", key)
        self.assertEqual(self.get("/").status, 200)
        answer = self.post_code(self.code())
        self.assertIn("; Secure", answer.headers["set-cookie"])
        token = re.match(r"ivo=([0-9a-f]{64});", answer.headers["set-cookie"])[1]
        self.assertEqual(self.page(token).ask("beat"), "accepted")


class CommandLine(WebServerTest):
    def test_what_is_wrong_is_refused_by_name(self):
        for arguments, complaint in ((["--port", "70000"], '--port: "70000" will not do; expected a port, 0 to 65535'),
                                     (["--bogus"], '"--bogus" is no option; expected one that ivo-console --help shows'),
                                     (["--key", "k"], "--certificate and --key: one is given without the other; expected both or none"),
                                     (["--web", self.folder], f"{self.folder}: holds no index.html; expected the page's files"),
                                     (["--port"], "--port: has no value; expected one behind it")):
            done = subprocess.run(self.options(*arguments), capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (2, f"ivo-console: {complaint}\n"))

    def test_a_port_that_is_taken_is_refused(self):
        with socket.create_server(("127.0.0.1", 0)) as other:
            done = subprocess.run(self.options("--port", str(other.getsockname()[1])), capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("cannot be listened at", done.stderr)

    def test_help_names_every_option(self):
        done = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True)
        for option in ("--socket", "--listen", "--port", "--certificate", "--key", "--origin", "--web", "--leaflet", "--state", "--new-token", "--role", "--paired", "--forget"):
            self.assertIn(option, done.stdout)


if __name__ == "__main__":
    unittest.main()
