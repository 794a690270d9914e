"""PNG images of one palette index a pixel."""

import struct
import zlib

_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def _chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _header(width_px, rows, palette):
    size = struct.pack(">IIBBBBB", width_px, len(rows), 8, 3, 0, 0, 0)
    return _SIGNATURE + _chunk(b"IHDR", size) + _chunk(b"PLTE", b"".join(palette))


def _filtered(rows):
    return b"".join(b"\0" + row for row in rows)


def encode(width_px, rows, palette):
    """rows: bytes of palette indices, the top row first."""
    pixels = zlib.compress(_filtered(rows), 9)
    return _header(width_px, rows, palette) + _chunk(b"IDAT", pixels) + _chunk(b"IEND", b"")


def same(contents, width_px, rows, palette):
    """Whether contents is an image that encode made from these pixels, however well compressed."""
    header = _header(width_px, rows, palette)
    if not contents.startswith(header):
        return False
    rest = contents[len(header):]
    length = struct.unpack(">I", rest[:4])[0]
    try:
        return rest[4:8] == b"IDAT" and zlib.decompress(rest[8:8 + length]) == _filtered(rows)
    except zlib.error:
        return False
