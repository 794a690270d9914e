#!/usr/bin/python3
"""Whatever others send to the server, by the hundred thousand: the page goes on showing the search, and the loop notices nothing."""

import json
import random
import socket
import threading
import unittest

from console_rig import ConsoleTest
from websocket_client import BINARY, Refused, WebSocket, frame, request

MESSAGES = 250_000  # over WebSockets, of all kinds
HTTP_REQUESTS = 500
SEED = 7
CYCLE_S = 0.002  # of config/robots/ivo.toml


def hostile_frames(random_):
    """One connection's: a few hundred messages that count for nothing, as bytes to be sent again and again."""
    texts = ['{"seq":1,"do":"beat"}', '{"seq":999999,"do":"start","question":1}', '{"do":"stop"', "[]", "null", '{"seq":2,"do":"area.put"}',
             '{"seq":3,"do":"init"}', '{"seq":-1,"do":"accept","plan":1}', '{"seq":1e99,"do":"replan","areas_revision":1}', "{" * 200, '"' + "a" * 300,
             '{"seq":4,"do":"position","agent":1,"x_m":1e308,"y_m":-1}', '{"seq":5,"do":"control.give"}', "\u0000\uffff\u202e"]
    parts = []
    for _ in range(400):
        kind = random_.randrange(10)
        if kind < 8:
            parts.append(frame(random_.choice(texts)))
        elif kind == 8:
            parts.append(frame(random_.randbytes(random_.randrange(120)), BINARY))
        else:
            parts.append(frame(random_.choice(texts)[: random_.randrange(40)]))
    return b"".join(parts), len(parts)


class Flood(threading.Thread):
    """Sends what counts for nothing, on one connection that stays open."""

    def __init__(self, port, token, seed):
        super().__init__(daemon=True)
        self.page = WebSocket(port, token=token, patience_s=None)
        self.data, self.count = hostile_frames(random.Random(seed))
        self.sent = 0
        threading.Thread(target=self.drain, daemon=True).start()

    def drain(self):
        try:
            while self.page.socket.recv(65536):
                pass
        except OSError:
            pass

    def run(self):
        while self.sent < MESSAGES // 2:
            self.page.socket.sendall(self.data)
            self.sent += self.count


class Hostile(ConsoleTest):
    def ask_wrongly(self, token):
        """HTTP that counts for nothing, and pages of others."""
        random_ = random.Random(SEED)
        for i in range(HTTP_REQUESTS):
            try:
                if i % 4 == 0:
                    with socket.create_connection(("127.0.0.1", self.port), timeout=20) as raw:
                        raw.sendall(random_.randbytes(200) + b"\r\n\r\n")
                elif i % 4 == 1:
                    request(self.port, "GET", "/" + "../" * random_.randrange(9) + "etc/passwd", headers=[f"Cookie: ivo={token}"])
                elif i % 4 == 2:
                    request(self.port, "PUT", "/areas.geojson", body=random_.randbytes(300), headers=[f"Cookie: ivo={token}"])
                else:
                    WebSocket(self.port, token=token, origin="http://elsewhere.example").close()
            except (OSError, Refused, ValueError):
                pass

    def test_a_search_goes_on(self):
        self.begin()
        ana = self.screen("Ana's tablet", "tablet")
        ana.take_controls()
        ana.start()
        ana.wait("Number(document.getElementById('agent-progress-0').value) > 0.02")
        floods = [Flood(self.port, self.token(role, f"hostile {role}"), SEED + i) for i, role in enumerate(("operator", "viewer"))]
        for flood in floods:
            self.addCleanup(flood.page.close)
        threads = [*floods, threading.Thread(target=self.ask_wrongly, args=(self.token("viewer"),), daemon=True)]
        for thread in threads:
            thread.start()
        shown = set()
        times_s = [ana.model("model.status.time_s")]
        beats = 0
        while any(thread.is_alive() for thread in threads):
            shown.add(ana.js("return Number(document.getElementById('agent-progress-0').value)"))
            time_s, mode, fresh = ana.model("[model.status.time_s, model.status.mode, model.status.start_fresh]")
            self.assertEqual(mode, "searching")
            times_s.append(time_s)
            beats += fresh
        self.assertGreater(len(shown), 3, "the robot's way did not grow")
        self.assertGreater(beats, 0, "no beat of hers came through")
        self.assertGreater(len(set(times_s)), 3, "the controller's clock did not go on")
        self.assertEqual(times_s, sorted(times_s))
        ana.wait_state("searching")
        ana.press("tab-screens")
        ana.press_details()
        # Each was judged and counted; a beat in order, at the beginning, is no offence.
        ana.wait("arguments[0].reduce((sum, id) => sum + parseInt(document.getElementById(id).textContent.replace(/\\D/g, '')), 0) >= arguments[1]",
                 ["refused-malformed", "refused-out_of_order", "refused-too_often", "refused-replayed", "refused-not_allowed"],
                 MESSAGES)
        for flood in floods:
            flood.page.close()
        for name in ("malformed", "out_of_order", "too_often", "foreign_origin"):
            ana.wait("parseInt(document.getElementById(arguments[0]).textContent.replace(/\\D/g, '')) > 0", f"refused-{name}")
        ana.judge("refused")
        ana.act("found", "!document.getElementById('found-choice').hidden")
        ana.press("found-1")
        ana.wait_text("now-title", "Ana found the object!")
        self.assertEqual(self.controller.wait(60), 0)
        with open(self.stats, encoding="utf-8") as file:
            stats = json.load(file)
        self.assertEqual([stats[key] for key in ("commands_refused", "frames_refused", "frames_lost", "frames_not_sent")], [0, 0, 0, 0])
        # How many periods have no cycle says how busy this machine is as well, and is only told. That cycles went on beside the flood is shown by the time that
        # each tells the page, and by the robot's way, which is gone cycle by cycle: every period has a cycle or is counted as one without.
        periods = stats["cycles"] + stats["periods_skipped"]
        self.assertGreater(stats["cycles"], 0)
        self.assertGreater(periods * CYCLE_S, times_s[-1] - times_s[0])
        print(f"{stats['periods_skipped']} of {periods} periods without a cycle, {MESSAGES} hostile messages beside them")
        modes = [each["mode"] for each in self.events() if each["event"] == "mode"]
        self.assertNotIn("fault", modes)
        # Nothing in between: consent, the search, and its end.
        self.assertEqual(modes[modes.index("searching"):].count("searching"), 1, modes)
        self.assertNotIn("pausing", modes)


if __name__ == "__main__":
    unittest.main()
