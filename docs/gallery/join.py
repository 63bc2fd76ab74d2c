"""Joins pictures into one grey one: the left halves (the fronts) of previews, or with --whole all of them. Pictures
that are grey are no previews and are taken whole.

Usage: join.py [--whole] OUT.png IN.png...
"""

import struct
import sys
import zlib

HEIGHT = 400


def read(path):
    """Bytes per pixel and rows of bytes of a PNG, grey or RGB."""
    data, at, packed = open(path, "rb").read(), 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            channels = {0: 1, 2: 3}[colour] * depth // 8
        packed += body if kind == b"IDAT" else b""
        at += 12 + size
    raw, step, rows, last = zlib.decompress(packed), channels * width, [], bytearray(channels * width)
    for y in range(height):
        method, row = raw[y * (step + 1)], bytearray(raw[y * (step + 1) + 1 : (y + 1) * (step + 1)])
        undo(method, row, last, channels)
        rows.append(row)
        last = row
    return channels, rows


def undo(method, row, above, step):
    for i in range(len(row)):
        a, b, c = (row[i - step] if i >= step else 0), above[i], (above[i - step] if i >= step else 0)
        if method == 1:
            row[i] = row[i] + a & 255
        elif method == 2:
            row[i] = row[i] + b & 255
        elif method == 3:
            row[i] = row[i] + (a + b) // 2 & 255
        elif method == 4:
            pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            row[i] = row[i] + (a if pa <= pb and pa <= pc else b if pb <= pc else c) & 255


def shrunk(path, parts):
    """Grey rows of the left half or of all, HEIGHT of them, averaged over boxes."""
    channels, rows = read(path)
    half, out = len(rows[0]) // channels // (parts if channels == 3 else 1), []
    columns = max(1, half * HEIGHT // len(rows))
    for y in range(HEIGHT):
        band = rows[y * len(rows) // HEIGHT : (y + 1) * len(rows) // HEIGHT]
        line = bytearray()
        for x in range(columns):
            first, last = x * half // columns, (x + 1) * half // columns
            values = [row[channels * i + channels // 2] for row in band for i in range(first, last)]
            line.append(sum(values) // len(values))
        out.append(line)
    return out


def write(path, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    # Each value as the difference from the one above: shaded surfaces pack better so.
    body = bytearray()
    last = bytearray(len(rows[0]))
    for row in rows:
        body += b"\2" + bytes((v - u) & 255 for v, u in zip(row, last))
        last = row
    png = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(body), 9)) + chunk(b"IEND", b"")
    open(path, "wb").write(b"\x89PNG\r\n\x1a\n" + png)


if __name__ == "__main__":
    is_whole = sys.argv[1] == "--whole"
    out, *previews = sys.argv[2 if is_whole else 1 :]
    parts = [shrunk(path, 1 if is_whole else 2) for path in previews]
    write(out, [bytearray().join(rows) for rows in zip(*parts)])
