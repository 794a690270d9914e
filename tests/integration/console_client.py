"""A client of the console's socket, by the layout that firmware/console/console_messages.hpp gives it."""

import socket
import struct
import time
from collections import namedtuple

MAGIC, VERSION = 0x434F5649, 2
PING, CONSENT, NO_CONSENT, STOP, CLEAR_FAULT, ANSWER, STATUS = 1, 2, 3, 4, 5, 101, 102
(ACCEPTED, WRONG_SIZE, WRONG_MAGIC, WRONG_VERSION, UNKNOWN_KIND, NOT_ZERO, REPLAYED, OUT_OF_ORDER, TOO_OFTEN, NOT_ASKED, OTHER_QUESTION,
 ANSWERED, TOO_MANY_CLIENTS) = range(13)
NOTHING, FOR_CONSENT, FOR_CLEARING = range(3)
PLANNING, STARTING, AWAITING_CONSENT, SEARCHING, STOPPING, DONE, FAULT = range(7)

HEADER = struct.Struct("<IHHII")
COMMAND = struct.Struct("<IHHIIII")
REPLY = struct.Struct("<IHHIIIHH")
STATUS_SIZE = 712
MOST_MESSAGES = 12_000  # of ten minutes
Reply = namedtuple("Reply", "of_sequence verdict")
Status = namedtuple("Status", "question asks mode finished fault cycles messages answers_dropped statuses_dropped clients")


def status_of(packet):
    question, asks, mode = struct.unpack_from("<IBB", packet, 24)
    fault = packet[352:512].split(b"\0", 1)[0].decode()
    messages = struct.unpack_from("<13Q", packet, 584)
    return Status(question, asks, mode, packet[36], fault, *struct.unpack_from("<Q", packet, 512), messages,
                  *struct.unpack_from("<QQI", packet, 688))


class Client:
    def __init__(self, path, patience_s=60):
        """Connects as soon as somebody listens."""
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        self.socket.settimeout(patience_s)
        self.sequence = 0
        self.heard = 0  # sequence numbers of the controller
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

    def send(self, kind, question=0):
        self.sequence += 1
        self.socket.send(COMMAND.pack(MAGIC, VERSION, kind, COMMAND.size, self.sequence, question, 0))

    def hear(self):
        """The next message: a Reply, a Status, or None when the controller has ended."""
        try:
            packet = self.socket.recv(4096)
        except ConnectionResetError:  # said once, before what was sent to us until then
            packet = self.socket.recv(4096)
        if not packet:
            return None
        magic, version, kind, size, sequence = HEADER.unpack_from(packet)
        self.heard += 1
        assert (magic, version, size, sequence) == (MAGIC, VERSION, len(packet), self.heard), packet
        if kind == ANSWER:
            assert size == REPLY.size, size
            return Reply(*REPLY.unpack(packet)[5:7])
        assert (kind, size) == (STATUS, STATUS_SIZE), (kind, size)
        return status_of(packet)

    def command(self, kind, question=0):
        """Its verdict."""
        self.send(kind, question)
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
