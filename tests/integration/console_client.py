"""A client of the console's socket, by the layout that firmware/console/console_messages.hpp gives it."""

import json
import socket
import struct
import time
from collections import namedtuple

MAGIC, VERSION = 0x434F5649, 3
(PING, CONSENT, NO_CONSENT, STOP, CLEAR_FAULT, PAUSE, INIT, REPLAN, ENOUGH, ACCEPT, FOUND, BEAT, REMOVE_AREA, PUT_AREA, POSE) = range(1, 16)
ANSWER, STATUS, DOCUMENT_PART = 101, 102, 103
(ACCEPTED, WRONG_SIZE, WRONG_MAGIC, WRONG_VERSION, UNKNOWN_KIND, NOT_ZERO, REPLAYED, OUT_OF_ORDER, TOO_OFTEN, NOT_ASKED, OTHER_QUESTION,
 ANSWERED, TOO_MANY_CLIENTS, OUT_OF_RANGE, NOT_NOW, OUTDATED, NOT_AN_AREA) = range(17)
NOTHING, FOR_CONSENT, FOR_CLEARING = range(3)
PLANNING, STARTING, AWAITING_CONSENT, SEARCHING, STOPPING, DONE, FAULT, PAUSING = range(8)
RUNNING, SEARCH_FOUND, PATHS_ENDED = range(3)
NO_PAUSE, PAUSE_ASKED, BEAT_LOST, PAUSE_TO_REPLAN, PAUSE_FOR_NO_GO = range(5)
NOBODY = 255
PREFERRED, NO_GO, EVERYBODY = 0, 1, 255
DOCUMENTS = ("mission", "map", "aerial", "probability", "searched", "plan", "previous_plan", "areas", "notice", "report")

HEADER = struct.Struct("<IHHII")
COMMAND = struct.Struct("<IHHIIII")
AREA = struct.Struct("<IHHIIBBBBI128d")
POSITION = struct.Struct("<IHHIIB7x6d")
REPLY = struct.Struct("<IHHIIIHH")
PART = struct.Struct("<IHHIIHHIIIII")
PART_BYTES = 8192
STATUS_SIZE = 912
MOST_MESSAGES = 24_000  # of ten minutes
Reply = namedtuple("Reply", "of_sequence verdict")
Agent = namedtuple("Agent", "x_m y_m moved_m left_m path_ended reported report_age_s")
Status = namedtuple("Status", """question asks mode search stop_cause plan_ready search_started finished finder plan_number areas_revision
    accepted preparing with_preferences pause_cause watched into_no_go beat_age_s generation expected_time_s searched_mass agents fault cycles messages
    answers_dropped statuses_dropped clients""")


def status_of(packet):
    question, asks, mode, search, _, stop_cause, ready, started, _, finished, finder, _, agents = struct.unpack_from("<I12B", packet, 24)
    plan, areas, accepted, preparing, preferences, pause, watched, into_no_go, beat = struct.unpack_from("<II5BxB9xd", packet, 48)
    generation, _, expected = struct.unpack_from("<iid", packet, 80)
    searched, = struct.unpack_from("<d", packet, 120)
    people = [Agent(*struct.unpack_from("<4dIId", packet, 136 + 48 * i)) for i in range(agents)]
    fault = packet[520:680].split(b"\0", 1)[0].decode()
    messages = struct.unpack_from("<17Q", packet, 752)
    return Status(question, asks, mode, search, stop_cause, ready, started, finished, finder, plan, areas, accepted, preparing, preferences, pause,
                  watched, into_no_go, beat, generation, expected, searched, people, fault, *struct.unpack_from("<Q", packet, 680), messages,
                  *struct.unpack_from("<QQI", packet, 888))


class Client:
    def __init__(self, path, patience_s=60):
        """Connects as soon as somebody listens."""
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.socket.settimeout(patience_s)
        self.sequence = 0
        self.heard = 0  # sequence numbers of the controller
        self.documents = {}  # by name, those that are whole
        self.parts = {}
        until = time.monotonic() + patience_s
        while True:
            try:
                self.socket.connect(path)
                return
            except (FileNotFoundError, ConnectionRefusedError):
                if time.monotonic() > until:
                    raise
                time.sleep(0.01)

    def close(self):
        self.socket.close()

    def send(self, kind, question=0, argument=0):
        self.sequence += 1
        self.socket.send(COMMAND.pack(MAGIC, VERSION, kind, COMMAND.size, self.sequence, question, argument))

    def put_area(self, slot, corners, purpose=PREFERRED, agent=1):
        """Its verdict."""
        self.sequence += 1
        numbers = [number for corner in corners for number in corner]
        numbers += [0.0] * (128 - len(numbers))
        self.socket.send(AREA.pack(MAGIC, VERSION, PUT_AREA, AREA.size, self.sequence, slot, purpose, agent, len(corners), 0, *numbers))
        return self.verdict()

    def report(self, agent, x_m, y_m):
        """Its verdict."""
        self.sequence += 1
        self.socket.send(POSITION.pack(MAGIC, VERSION, POSE, POSITION.size, self.sequence, agent, x_m, y_m, 0.0, 0.5, 0.0, 0.0))
        return self.verdict()

    def gather(self, packet):
        document, _, revision, whole, begin, count, _ = PART.unpack_from(packet)[5:]
        name = DOCUMENTS[document - 1]
        if begin == 0:
            self.parts[name] = (revision, b"")
        had = self.parts[name]
        assert had[0] == revision and len(had[1]) == begin, (name, had[0], revision, begin)
        self.parts[name] = (revision, had[1] + packet[PART.size:PART.size + count])
        if begin + count == whole:
            self.documents[name] = self.parts[name][1]

    def document(self, name, wanted=lambda value: True):
        """The text of the document as JSON, as soon as it is wanted."""
        for _ in range(MOST_MESSAGES):
            if self.documents.get(name) and wanted(json.loads(self.documents[name])):
                return json.loads(self.documents[name])
            if self.hear() is None:
                raise AssertionError("the controller ended before it was seen")
        raise AssertionError(f"{name} is {self.documents.get(name)}")

    def hear(self):
        """The next message: a Reply, a Status, the number of a document that came in part, or None when the controller has ended."""
        try:
            packet = self.socket.recv(16384)
        except ConnectionResetError:  # said once, before what was sent to us until then
            packet = self.socket.recv(16384)
        if not packet:
            return None
        magic, version, kind, size, sequence = HEADER.unpack_from(packet)
        self.heard += 1
        assert (magic, version, size, sequence) == (MAGIC, VERSION, len(packet), self.heard), packet
        if kind == ANSWER:
            assert size == REPLY.size, size
            return Reply(*REPLY.unpack(packet)[5:7])
        if kind == DOCUMENT_PART:
            self.gather(packet)
            return packet[16:18]
        assert (kind, size) == (STATUS, STATUS_SIZE), (kind, size)
        return status_of(packet)

    def command(self, kind, question=0, argument=0):
        """Its verdict."""
        self.send(kind, question, argument)
        return self.verdict()

    def verdict(self):
        """Of what was sent last."""
        while True:
            heard = self.hear()
            if heard is None:
                raise AssertionError("the controller ended before it answered")
            if isinstance(heard, Reply) and heard.of_sequence == self.sequence:
                return heard.verdict

    def status(self, wanted=lambda status: True):
        """The next status that is wanted."""
        heard = None
        for _ in range(MOST_MESSAGES):
            heard = self.hear()
            if heard is None:
                raise AssertionError("the controller ended before it was seen")
            if isinstance(heard, Status) and wanted(heard):
                return heard
        raise AssertionError(f"it was not among {MOST_MESSAGES} messages, the last of which is {heard}")
