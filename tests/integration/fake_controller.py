"""A controller's side of the console's socket, by the layout that firmware/console/console_messages.hpp gives it: says what a test tells it
to, and remembers what it heard."""

import collections
import json
import os
import socket
import struct
import threading
import time

MAGIC, VERSION = 0x434F5649, 3
(PING, CONSENT, NO_CONSENT, STOP, CLEAR_FAULT, PAUSE, INIT, REPLAN, ENOUGH, ACCEPT, FOUND, BEAT, REMOVE_AREA, PUT_AREA, POSE) = range(1, 16)
ANSWER, STATUS, DOCUMENT_PART = 101, 102, 103
(ACCEPTED, WRONG_SIZE, WRONG_MAGIC, WRONG_VERSION, UNKNOWN_KIND, NOT_ZERO, REPLAYED, OUT_OF_ORDER, TOO_OFTEN, NOT_ASKED, OTHER_QUESTION,
 ANSWERED, TOO_MANY_CLIENTS, OUT_OF_RANGE, NOT_NOW, OUTDATED, NOT_AN_AREA) = range(17)
DOCUMENTS = ("mission", "map", "aerial", "probability", "searched", "plan", "previous_plan", "areas", "notice", "report")
NOBODY = EVERYBODY = 255

HEADER = struct.Struct("<IHHII")
COMMAND = struct.Struct("<IHHIIII")
AREA = struct.Struct("<IHHIIBBBBI128d")
POSE_COMMAND = struct.Struct("<IHHIIB7x6d")
REPLY = struct.Struct("<IHHIIIHH")
AGENT = struct.Struct("<ddddIId")
STATUS_HEAD = struct.Struct("<IHHIIqI16BIII7B5x4xdiidddqdd")
STATUS_TAIL = struct.Struct("<160s9Q17QQQII")
PART = struct.Struct("<IHHIIHHIIIII8192s")
AGENTS = 8
STATUS_SIZE = STATUS_HEAD.size + AGENTS * AGENT.size + STATUS_TAIL.size
assert (STATUS_SIZE, AREA.size, POSE_COMMAND.size, PART.size) == (912, 1048, 72, 8232)

MISSION = {
    "name": "yard", "map": {"width_m": 2, "height_m": 1, "width_px": 4, "height_px": 2, "resolution_m": 0.5, "aerial": False},
    "cells": {"columns": 2, "rows": 1, "cell_m": 1},
    "classes": [{"name": "pavement", "colour": "#808080", "obstacle": False}, {"name": "wall", "colour": "#202020", "obstacle": True}],
    "agents": [{"name": "IVO", "kind": "robot", "motion": "", "start_m": [0.2, 0.2], "heading_rad": 0.0, "speed_mps": 0.35, "sight_radius_m": 2.5},
               {"name": "Ana", "kind": "person", "motion": "reported", "start_m": [0.4, 0.2], "heading_rad": 0.0, "speed_mps": 1.0,
                "sight_radius_m": 2.5}]}

Message = collections.namedtuple("Message", "kind question argument packet at")


class FakeController:
    """Listens at `path` from its first line on; each client hears statuses and documents, and an answer to each message."""

    def __init__(self, path, answer=lambda message: ACCEPTED, statuses_per_second=20):
        self.path = path
        self.answer = answer
        self.silent = False  # says no statuses
        self.period_s = 1.0 / statuses_per_second
        self.status = {"question": 1, "asks": 1, "mode": 2, "search": 0, "stop_cause": 0, "plan_ready": 1, "search_started": 0, "finished": 0,
                       "finder": NOBODY, "stop_held": 0, "plan_number": 1, "areas_revision": 1, "accepted": 0, "preparing": 0,
                       "with_preferences": 0, "pause_cause": 0, "watched": 0, "into_no_go": 255, "beat_age_s": -1.0, "generation": 3, "generations": 40,
                       "expected_time_s": 10.0, "unseen_mass": 0.1, "horizon_s": 180.0, "search_time_s": 0.0, "searched_mass": 0.25,
                       "heading_rad": 0.5, "agents": [(0.2, 0.2, 0.0, 1.0, 0, 0, -1.0), (0.4, 0.2, 0.0, 1.0, 0, 1, 0.4)], "fault": "", "taken_up": 0}
        self.documents = {name: (1, b"") for name in DOCUMENTS}
        self.documents["mission"] = (1, json.dumps(MISSION).encode())
        self.documents["map"] = (1, bytes([0, 0, 0, 1, 0, 0, 1, 1]))
        self.documents["probability"] = (1, struct.pack("<2f", 0.75, 0.25))
        self.documents["searched"] = (1, bytes([1]))
        self.documents["areas"] = (1, b'{"areas":[]}')
        self.heard = []
        self.lock = threading.Lock()
        self.ended = threading.Event()
        self.listener = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        if os.path.exists(path):
            os.unlink(path)
        self.listener.bind(path)
        self.listener.listen()
        self.listener.settimeout(0.05)
        self.threads = [threading.Thread(target=self._accept, daemon=True)]
        self.threads[0].start()

    def close(self):
        self.ended.set()
        for thread in self.threads:
            thread.join()
        self.listener.close()
        if os.path.exists(self.path):
            os.unlink(self.path)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def set(self, **fields):
        with self.lock:
            self.status.update(fields)

    def publish(self, name, content):
        """A document anew; `content` is bytes, or what becomes JSON."""
        content = content if isinstance(content, bytes) else json.dumps(content).encode()
        with self.lock:
            self.documents[name] = (self.documents[name][0] + 1, content)

    def messages(self, kind=None):
        with self.lock:
            return [message for message in self.heard if kind in (None, message.kind)]

    def wait_for(self, kind, count=1, patience_s=20):
        until = time.monotonic() + patience_s
        while time.monotonic() < until:
            found = self.messages(kind)
            if len(found) >= count:
                return found
            time.sleep(0.01)
        raise AssertionError(f"{count} of kind {kind} were not heard; heard {[message.kind for message in self.messages()]}")

    def _accept(self):
        while not self.ended.is_set():
            try:
                client, _ = self.listener.accept()
            except socket.timeout:
                continue
            thread = threading.Thread(target=self._serve, args=(client,), daemon=True)
            self.threads.append(thread)
            thread.start()

    def _serve(self, client):
        sequence = 0
        sent = {}
        next_status = time.monotonic()
        client.settimeout(0.005)

        def say(packet_of):
            nonlocal sequence
            sequence += 1
            client.settimeout(1.0)
            client.send(packet_of(sequence))
            client.settimeout(0.005)

        with client:
            try:
                while not self.ended.is_set():
                    if time.monotonic() >= next_status and not self.silent:
                        next_status = time.monotonic() + self.period_s
                        say(self._status)
                        self._say_documents(sent, say)
                    try:
                        packet = client.recv(4096)
                    except socket.timeout:
                        continue
                    if not packet:
                        return
                    self._hear(packet, say)
            except OSError:
                return

    def _say_documents(self, sent, say):
        for number, name in enumerate(DOCUMENTS, start=1):
            with self.lock:
                revision, content = self.documents[name]
            if sent.get(name) == revision:
                continue
            sent[name] = revision
            for begin in range(0, max(len(content), 1), 8192):
                part = content[begin:begin + 8192]
                say(lambda sequence, number=number, revision=revision, content=content, begin=begin, part=part: PART.pack(
                    MAGIC, VERSION, DOCUMENT_PART, PART.size, sequence, number, 0, revision, len(content), begin, len(part), 0, part))

    def _hear(self, packet, say):
        _, _, kind, _, of_sequence = HEADER.unpack_from(packet)
        question, argument = struct.unpack_from("<II", packet, 16) if len(packet) == COMMAND.size else (0, 0)
        message = Message(kind, question, argument, packet, time.monotonic())
        with self.lock:
            self.heard.append(message)
        verdict = self.answer(message)
        if verdict is not None:
            say(lambda sequence: REPLY.pack(MAGIC, VERSION, ANSWER, REPLY.size, sequence, of_sequence, verdict, 0))

    def _status(self, sequence):
        with self.lock:
            now = dict(self.status)
        agents = now["agents"]
        packet = STATUS_HEAD.pack(
            MAGIC, VERSION, STATUS, STATUS_SIZE, sequence, time.monotonic_ns(), now["question"], now["asks"], now["mode"], now["search"], 0,
            now["stop_cause"], now["plan_ready"], now["search_started"], 0, now["finished"], now["finder"], 0, len(agents), 0, 0, 0,
            now["stop_held"], 0, now["plan_number"], now["areas_revision"], now["accepted"], now["preparing"], now["with_preferences"],
            now["pause_cause"], now["watched"], 0, now["into_no_go"], now["beat_age_s"], now["generation"], now["generations"], now["expected_time_s"],
            now["unseen_mass"], now["horizon_s"], int(now["search_time_s"] * 1e9), now["searched_mass"], now["heading_rad"])
        for i in range(AGENTS):
            packet += AGENT.pack(*(agents[i] if i < len(agents) else (0.0, 0.0, 0.0, 0.0, 0, 0, -1.0)))
        return packet + STATUS_TAIL.pack(now["fault"].encode(), *([0] * 9), *([0] * 17), 0, 0, 1, now["taken_up"])
