#!/usr/bin/env python3
"""Who is let in at ivo-console: pairing, and the doors that a stranger tries."""

import json
import os
import socket
import stat
import subprocess
import threading
import time
import unittest

from web_server import WebServerTest
from websocket_client import Refused, WebSocket, request


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

    def later_line(self):
        """Said after all that was asked until now."""
        self.page(self.new_token("viewer", "later"))
        self.line(r"screen \d+, later: .*")

    def test_five_wrong_codes_lock_who_guesses(self):
        self.start()
        code = self.code()
        wrong = "000000" if code != "000000" else "111111"
        left = [json.loads(self.post_code(wrong).body) for _ in range(5)]
        self.assertEqual([answer.get("left") for answer in left], [4, 3, 2, 1, None])
        self.assertEqual((left[4]["error"], left[4]["wait_s"]), ("locked", 30))
        answer = self.post_code(self.code())
        self.assertEqual((answer.status, json.loads(answer.body)["error"]), (403, "locked"), "the right one is not looked at either")
        self.line("pairing is locked for .* for 30 s")
        self.assertEqual(self.shown_code(), code, "nobody was paired")
        self.later_line()
        self.assertEqual(len([line for line in self.said if "locked" in line]), 1)

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
        self.assertEqual(self.shown_code(), self.code())
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

    def read_until_closed(self, page, closed):
        try:
            while True:
                page.hear()
        except ConnectionError:
            closed.set()

    def test_who_is_forgotten_is_hung_up_on_and_the_others_are_not(self):
        self.start()
        ana, luis = self.pair("Ana"), self.pair("Luis")
        self.assertRegex(self.paired(), r"^[0-9a-f]{8} operator Ana\n[0-9a-f]{8} operator Luis\n$")
        digits = self.paired().split()[0]
        gone, stays = self.page(ana), self.page(luis)
        # Both are read all the while, however long the disk takes: who does not answer is dropped for that.
        hung_up = threading.Event()
        reader = threading.Thread(target=self.read_until_closed, args=(gone, hung_up), daemon=True)
        reader.start()
        forget = subprocess.Popen(self.options("--forget", digits), stdout=subprocess.PIPE, text=True)
        stays.status(lambda status: [each["name"] for each in status["screens"]] == ["Luis"])
        said, _ = forget.communicate()
        self.assertEqual((forget.returncode, said), (0, f"forgotten: {digits} operator Ana\n"))
        self.line(r"screen \d+, Ana: no longer paired")
        self.assertTrue(hung_up.wait(20))
        reader.join()
        self.assertEqual(self.get("/areas.geojson", ana).status, 403)
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
        self.assertEqual(self.shown_code(), code, "nobody was paired")
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


if __name__ == "__main__":
    unittest.main()
