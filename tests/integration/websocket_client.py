"""A WebSocket (RFC 6455) for tests: what a browser or a script would send, and whatever else, over a plain socket."""

import base64
import collections
import hashlib
import json
import os
import select
import socket
import struct
import time

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
Answer = collections.namedtuple("Answer", "status headers body")


def _read_head(connection):
    head = b""
    while b"\r\n\r\n" not in head:
        more = connection.recv(4096)
        if not more:
            raise ConnectionError(f"closed after {head!r}")
        head += more
    head, rest = head.split(b"\r\n\r\n", 1)
    lines = head.decode("latin-1").split("\r\n")
    headers = [(name.lower(), value.strip()) for name, value in (line.split(":", 1) for line in lines[1:])]
    return int(lines[0].split()[1]), headers, rest


class Refused(Exception):
    def __init__(self, status, body):
        super().__init__(f"{status} {body!r}")
        self.status = status
        self.body = body


class WebSocket:
    def __init__(self, port, path="/session", protocol="ivo-console", token=None, origin="", headers=(), patience_s=20, wrap=None, receive_buffer=None, host=None):
        """`origin` empty: this server's own; None: none is said. `token` goes as the cookie."""
        raw = socket.socket()
        if receive_buffer:
            raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        raw.settimeout(patience_s)
        raw.connect(("127.0.0.1", port))
        self.socket = wrap(raw) if wrap else raw
        key = base64.b64encode(os.urandom(16)).decode()
        lines = [f"GET {path} HTTP/1.1", f"Host: {host or f'localhost:{port}'}", "Upgrade: websocket", "Connection: Upgrade", f"Sec-WebSocket-Key: {key}",
                 "Sec-WebSocket-Version: 13"]
        if protocol:
            lines.append(f"Sec-WebSocket-Protocol: {protocol}")
        if origin is not None:
            lines.append(f"Origin: {origin or ('https' if wrap else 'http') + f'://localhost:{port}'}")
        if token:
            lines.append(f"Cookie: ivo={token}")
        lines.extend(headers)
        self.socket.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        status, answer, self.rest = _read_head(self.socket)
        if status != 101:
            self.socket.close()
            raise Refused(status, self.rest)
        accept = base64.b64encode(hashlib.sha1((key + GUID).encode()).digest()).decode()
        assert dict(answer)["sec-websocket-accept"] == accept, answer
        self.sequence = 0
        self.newest = None  # number of the newest status that was read
        self.ahead = collections.deque()  # read, and not heard yet
        self.answers_pings = True

    def close(self):
        self.socket.close()

    def send_frame(self, payload, opcode=TEXT, final=True):
        self.socket.sendall(frame(payload, opcode, final))

    def send(self, message):
        self.send_frame(message if isinstance(message, (bytes, str)) else json.dumps(message))

    def say(self, do, **keys):
        """The next message in order; its number."""
        if do in ("beat", "start"):
            keys.setdefault("seen", self.seen())
        self.sequence += 1
        self.send({"seq": self.sequence, "do": do, **keys})
        return self.sequence

    def _read(self, count):
        while len(self.rest) < count:
            more = self.socket.recv(65536)
            if not more:
                raise ConnectionError("the server has closed")
            self.rest += more
        part, self.rest = self.rest[:count], self.rest[count:]
        return part

    def frame(self):
        """(opcode, payload) of the next frame; pings are answered on the way."""
        while True:
            first, second = self._read(2)
            size = second & 127
            if size == 126:
                size, = struct.unpack(">H", self._read(2))
            elif size == 127:
                size, = struct.unpack(">Q", self._read(8))
            payload = self._read(size)
            while not first & 128:  # parts of one message
                more_first, more = self._read(2)
                size = more & 127
                if size == 126:
                    size, = struct.unpack(">H", self._read(2))
                elif size == 127:
                    size, = struct.unpack(">Q", self._read(8))
                payload += self._read(size)
                first |= more_first & 128
            opcode = first & 15
            if opcode == PING:
                if self.answers_pings:
                    self.send_frame(payload, PONG)
                continue
            if opcode == CLOSE:
                raise ConnectionError(f"the server says goodbye: {payload!r}")
            return opcode, payload

    def hear(self):
        return self.ahead.popleft() if self.ahead else self._read_message()

    def _read_message(self):
        message = json.loads(self.frame()[1])
        if isinstance(message, dict) and message.get("type") == "status":
            self.newest = message["n"]
        return message

    def _has_more(self):
        return bool(self.rest) or getattr(self.socket, "pending", lambda: 0)() > 0 or bool(select.select([self.socket], [], [], 0)[0])

    def seen(self):
        """The number of the newest status that has come. What is read meanwhile is heard later."""
        while self.newest is None or self._has_more():
            self.ahead.append(self._read_message())
        return self.newest

    def wait_for(self, wanted, patience_s=20):
        """The next message that is wanted: a type, or a condition."""
        is_wanted = wanted if callable(wanted) else lambda message: message["type"] == wanted
        until = time.monotonic() + patience_s
        heard = None
        while time.monotonic() < until:
            heard = self.hear()
            if is_wanted(heard):
                return heard
        raise AssertionError(f"it did not come; the last was {heard}")

    def status(self, wanted=lambda status: True):
        return self.wait_for(lambda message: message["type"] == "status" and wanted(message))

    def ask(self, do, **keys):
        """Its verdict."""
        number = self.say(do, **keys)
        return self.wait_for(lambda message: message["type"] == "answer" and message["seq"] == number)["verdict"]


def frame(payload, opcode=TEXT, final=True):
    payload = payload.encode() if isinstance(payload, str) else payload
    size = len(payload)
    head = bytes([(128 if final else 0) | opcode])
    if size < 126:
        head += bytes([128 | size])
    elif size < 65536:
        head += bytes([128 | 126]) + struct.pack(">H", size)
    else:
        head += bytes([128 | 127]) + struct.pack(">Q", size)
    mask = os.urandom(4)
    key = (mask * (size // 4 + 1))[:size]
    masked = (int.from_bytes(payload, "big") ^ int.from_bytes(key, "big")).to_bytes(size, "big")
    return head + mask + masked


def request(port, method, path, body=None, headers=(), origin="", host=None, patience_s=20, wrap=None):
    """One HTTP request on a connection of its own. `origin` empty: this server's own for all but GET; None: none is said."""
    raw = socket.create_connection(("127.0.0.1", port), timeout=patience_s)
    with (wrap(raw) if wrap else raw) as connection:
        lines = [f"{method} {path} HTTP/1.1", f"Host: {host or f'localhost:{port}'}", "Connection: close"]
        if origin or (origin == "" and method != "GET"):
            lines.append(f"Origin: {origin or ('https' if wrap else 'http') + f'://localhost:{port}'}")
        if body is not None:
            body = body if isinstance(body, bytes) else json.dumps(body).encode()
            lines.append(f"Content-Length: {len(body)}")
        lines.extend(headers)
        connection.sendall(("\r\n".join(lines) + "\r\n\r\n").encode() + (body or b""))
        status, answer, content = _read_head(connection)
        size = int(dict(answer).get("content-length", -1))
        while size < 0 or len(content) < size:
            more = connection.recv(65536)
            if not more:
                break
            content += more
        return Answer(status, dict(answer), content)
