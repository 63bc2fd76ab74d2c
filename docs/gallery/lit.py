"""Shades a height map of 16 bits, whose white is HEIGHT_MM above its black, as a matt surface in parallel light. The
grey of level ground is 128 in any light, so that the contrast of two lights can be compared.

Usage: lit.py AZIMUTH,ELEVATION HEIGHT_MM PIXEL_MM IN.png OUT.png
"""

import math
import sys

import join


def heights(path, height_mm):
    """Rows of heights in mm."""
    size, rows = join.read(path)
    assert size == 2, path
    level = height_mm / 65535
    return [[level * (256 * row[i] + row[i + 1]) for i in range(0, len(row), 2)] for row in rows]


def shaded(z, light, pixel_mm):
    """Rows of grey levels: the cosine of the angle between normal and light, divided by that of level ground."""
    rows = []
    for y in range(1, len(z) - 1):
        row = bytearray()
        for x in range(1, len(z[0]) - 1):
            right = (z[y][x + 1] - z[y][x - 1]) / (2 * pixel_mm)
            up = (z[y - 1][x] - z[y + 1][x]) / (2 * pixel_mm)
            cosine = (light[2] - light[0] * right - light[1] * up) / math.hypot(1, right, up)
            row.append(max(0, min(255, round(128 * cosine / light[2]))))
        rows.append(row)
    return rows


def main():
    direction, height_mm, pixel_mm, path, out = sys.argv[1:]
    azimuth, elevation = (math.radians(float(angle)) for angle in direction.split(","))
    light = [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
    join.write(out, shaded(heights(path, float(height_mm)), light, float(pixel_mm)))


if __name__ == "__main__":
    main()
