#!/usr/bin/env python3
"""can_pipe.py INTERFACE CMD [ARG...]: runs CMD with a CAN interface for its standard input and output, a frame a line, ID#DATA in hexadecimal.
SIGTERM ends CMD's input; the exit status is CMD's."""

import os
import selectors
import signal
import socket
import struct
import subprocess
import sys

FRAME = struct.Struct("=IB3x8s")


def line_of(frame):
    identifier, size, data = FRAME.unpack(frame)
    return f"{identifier & socket.CAN_SFF_MASK:x}#{data[:size].hex()}\n".encode()


def frame_of(line):
    identifier, data = line.split(b"#")
    payload = bytes.fromhex(data.decode())
    return FRAME.pack(int(identifier, 16), len(payload), payload)


def main(interface, command):
    bus = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
    bus.bind((interface,))
    ended, end = os.pipe()
    signal.signal(signal.SIGTERM, lambda *_: os.write(end, b"."))
    child = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    selector = selectors.DefaultSelector()
    for source in (bus, child.stdout, ended):
        selector.register(source, selectors.EVENT_READ)
    rest = b""
    while True:
        ready = [key.fileobj for key, _ in selector.select()]
        if bus in ready:
            child.stdin.write(line_of(bus.recv(FRAME.size)))
            child.stdin.flush()
        if child.stdout in ready:
            block = os.read(child.stdout.fileno(), 65536)
            if not block:
                break
            *lines, rest = (rest + block).split(b"\n")
            for line in lines:
                bus.send(frame_of(line))
        if ended in ready:
            break
    child.stdin.close()
    return child.wait()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
