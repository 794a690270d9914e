"""A bus as candump recorded it, and what controller and drives do in it. Times in microseconds, of the kernel that recorded."""

import re
import struct
from collections import namedtuple

Frame = namedtuple("Frame", "at_us id data")
Command = namedtuple("Command", "at_us controlword target")  # RPDO1
Status = namedtuple("Status", "at_us statusword position")  # TPDO1

SYNC = 0x080
MASTER = 127
HEARTBEAT_LOST = 0x8130
QUICK_STOP = 0x02
ENABLE_OPERATION = 0x0F
LINE = re.compile(r"\((\d+)\.(\d{6})\) \w+ ([0-9A-F]{3})#([0-9A-F]*)\n")


def read(path):
    frames = []
    with open(path, encoding="ascii") as file:
        for number, line in enumerate(file, 1):
            match = LINE.fullmatch(line)
            if not match:
                raise ValueError(f"{path}:{number}: {line!r} is no frame")
            seconds, micros, identifier, data = match.groups()
            frames.append(Frame(int(seconds) * 1_000_000 + int(micros), int(identifier, 16), bytes.fromhex(data)))
    return frames


def commands(frames, node):
    return [Command(f.at_us, *struct.unpack("<Hi", f.data)) for f in frames if f.id == 0x200 + node]


def statuses(frames, node):
    return [Status(f.at_us, *struct.unpack("<Hi", f.data)) for f in frames if f.id == 0x180 + node]


def emergencies(frames, node):
    return [(f.at_us, struct.unpack_from("<H", f.data)[0]) for f in frames if f.id == 0x080 + node and node]


def heartbeats(frames, node):
    return [f.at_us for f in frames if f.id == 0x700 + node]


def velocity(statuses_of_drive):
    """[(time, counts a second)] between one TPDO1 and the next."""
    return [
        (b.at_us, (b.position - a.position) / (b.at_us - a.at_us) * 1e6)
        for a, b in zip(statuses_of_drive, statuses_of_drive[1:])
        if b.at_us > a.at_us
    ]


def cycles(frames):
    """Frames of each cycle: from a SYNC to the one before the next."""
    parts = []
    for frame in frames:
        if frame.id == SYNC:
            parts.append([])
        if parts:
            parts[-1].append(frame)
    return parts


# Length of a standard data frame on the wire, with the three bits between frames (CiA 301's bus: ISO 11898-1, 10.4).
FIXED_BITS = 13  # CRC and ACK delimiters, ACK slot, end of frame, intermission
CRC_POLYNOMIAL = 0x4599


def to_bits(value, width):
    return [value >> i & 1 for i in range(width - 1, -1, -1)]


def crc15(bits):
    crc = 0
    for bit in bits:
        crc = (crc << 1 ^ (CRC_POLYNOMIAL if bit != crc >> 14 & 1 else 0)) & 0x7FFF
    return crc


def wire_bits(frame):
    """With the stuff bits that these very bits get."""
    bits = [0] + to_bits(frame.id, 11) + [0, 0, 0] + to_bits(len(frame.data), 4)
    for byte in frame.data:
        bits += to_bits(byte, 8)
    bits += to_bits(crc15(bits), 15)
    stuffed, run, last = 0, 0, None
    for bit in bits:
        run = run + 1 if bit == last else 1
        last = bit
        if run == 5:
            stuffed, run, last = stuffed + 1, 1, 1 - bit
    return len(bits) + stuffed + FIXED_BITS


def worst_bits(frame):
    """With as many stuff bits as any frame of its length can get."""
    return 34 + 8 * len(frame.data) + (34 + 8 * len(frame.data) - 1) // 4 + FIXED_BITS
