"""Reads height maps and scans for scripts/build-jury."""
import array
import re
import struct
import zlib

NUMBERS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d",
           "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i", "uint32": "I", "float32": "f",
           "float64": "d"}


class Refused(Exception):
    """The reason why a scan is left out."""


def chunks(png):
    at = 8
    while at < len(png):
        size, kind = struct.unpack_from(">I4s", png, at)
        yield kind, png[at + 8:at + 8 + size]
        at += 12 + size


def paeth(left, above, corner):
    guess = left + above - corner
    return min((abs(guess - left), 0, left), (abs(guess - above), 1, above), (abs(guess - corner), 2, corner))[2]


def without_filter(kind, line, above):
    """Undoes the PNG filter of one line of an image with two bytes per pixel, in place."""
    for i, byte in enumerate(line):
        left, corner = (line[i - 2], above[i - 2]) if i >= 2 else (0, 0)
        predicted = (0, left, above[i], (left + above[i]) // 2)[kind] if kind < 4 else paeth(left, above[i], corner)
        line[i] = (byte + predicted) & 255
    return line


def read_png(png):
    """Returns the width, the height and the values of a PNG file with 16-bit greys, line by line from the top."""
    parts = list(chunks(png))
    width, height, bits, colour, _, _, interlaced = struct.unpack(">IIBBBBB", parts[0][1])
    if (bits, colour, interlaced) != (16, 0, 0):
        raise Refused("expected a height map of 16-bit greys without interlacing")
    raw = zlib.decompress(b"".join(data for kind, data in parts if kind == b"IDAT"))
    step, above, greys = 2 * width + 1, bytearray(2 * width), array.array("H")
    for at in range(0, step * height, step):
        above = without_filter(raw[at], bytearray(raw[at + 1:at + step]), above)
        greys.extend(struct.unpack(f">{width}H", above))
    return width, height, greys


def read_points(path):
    """Yields the points and normals, or None, of a binary PLY file whose first element is the vertices."""
    data = path.read_bytes()
    head, found, body = data.partition(b"end_header\n")
    lines = head.decode("ascii", "replace").split("element vertex ")
    if not found or "binary_little_endian" not in lines[0] or len(lines) != 2 or "element" in lines[0]:
        raise Refused("expected a binary PLY file, little endian, with vertices first")
    of_vertex = lines[1].split("element ")[0]
    kinds, names = zip(*re.findall(r"property (\S+) (\S+)", of_vertex))
    if not set(kinds) <= set(NUMBERS) or not {"x", "y", "z"} <= set(names):
        raise Refused("expected vertices with x, y and z and without lists")
    row = struct.Struct("<" + "".join(NUMBERS[kind] for kind in kinds))
    x, y, z = (names.index(axis) for axis in "xyz")
    normal = [names.index(f"n{axis}") for axis in "xyz"] if {"nx", "ny", "nz"} <= set(names) else None
    for values in row.iter_unpack(body[:int(of_vertex.split()[0]) * row.size]):
        yield (values[x], values[y], values[z]), normal and [values[axis] for axis in normal]
