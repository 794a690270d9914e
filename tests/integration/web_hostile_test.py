#!/usr/bin/env python3
"""What no client of ivo-console can do to the others, whatever it sends."""

import random
import socket
import time
import unittest

import fake_controller as fake
from web_server import WebServerTest
from websocket_client import BINARY, frame


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
        for message, verdict in (('{"seq":2,"do":"beat","seen":SEEN}', "out_of_order"), ('{"seq":1,"do":"beat","seen":SEEN}', "accepted"),
                                 ('{"seq":1,"do":"beat","seen":SEEN}', "replayed"), ('{"seq":0,"do":"beat","seen":SEEN}', "malformed"),
                                 ('{"seq":2,"do":"bow"}', "malformed"), ('{"seq":3,"do":"beat","seen":SEEN}', "accepted"),
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
        verdicts = set()
        until = time.monotonic() + 20
        while "too_often" not in verdicts:  # on a busy host a burst may take longer than its rate allows
            self.assertLess(time.monotonic(), until, verdicts)
            for _ in range(100):
                page.say("beat")
            while page.ahead:  # what has come until now
                verdicts.add(page.hear().get("verdict"))
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


if __name__ == "__main__":
    unittest.main()
