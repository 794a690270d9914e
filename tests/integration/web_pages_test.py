#!/usr/bin/env python3
"""What ivo-console gives to who asks: the page to everybody, all else to who is paired; with a controller, without one, and over TLS."""

import http.client
import json
import os
import re
import socket
import struct
import subprocess
import unittest

import fake_controller as fake
from web_server import PROGRAM, WebServerTest
from websocket_client import request


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
        for option in ("--socket", "--listen", "--port", "--certificate", "--key", "--origin", "--web", "--leaflet", "--state",
                       "--new-token", "--role", "--paired", "--forget"):
            self.assertIn(option, done.stdout)


if __name__ == "__main__":
    unittest.main()
