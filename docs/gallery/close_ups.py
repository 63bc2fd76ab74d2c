"""Makes close-ups.jpg: places on reliefs of scans, each by two programs, from height maps of 6,000 pixels.

Usage: close_ups.py FOLDER BEFORE AFTER, the folder of the scans and two relievo programs. Needs NumPy and Pillow.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy
from PIL import Image

SIDE = 400  # pixels of a close-up
MM = 110  # longer side of the plates
# Scan, options, and left, top and side of the place in shares of the plate's width.
PLACES = [
    ("dragon", [], 0.14, 0.20, 0.15),
    ("dragon", [], 0.70, 0.50, 0.12),
    ("armadillo", [], 0.10, 0.05, 0.20),
    ("armadillo", [], 0.40, 0.10, 0.20),
    ("falcon", [], 0.15, 0.60, 0.40),
    ("squirrel", [], 0.08, 0.38, 0.25),
    ("happy_buddha", [], 0.30, 0.10, 0.30),
    ("happy_buddha", [], 0.40, 0.50, 0.30),
    ("lion_takanawa", [], 0.30, 0.10, 0.25),
    ("nefertiti", [], 0.30, 0.30, 0.25),
    ("original/bun_zipper", [], 0.42, 0.04, 0.15),
    ("lion_takanawa_raw", ["--view", "0,-1,0", "--up", "0,0,1"], 0.30, 0.30, 0.30),
]


def heights(program, scan, options):
    """The height map in millimetres."""
    with tempfile.TemporaryDirectory() as work:
        solid, tiff = f"{work}/relief.stl", f"{work}/relief.tif"
        command = [program, "make", scan, "-o", solid, "--heightmap", tiff, "--heightmap-size", "6000"]
        subprocess.run([*command, "--height", "3", "--quiet", *options], check=True)
        return numpy.array(Image.open(tiff), dtype=float)


def shaded(z, mm_per_pixel):
    """A picture of polished plaster, lit from the upper left."""
    dy, dx = numpy.gradient(z, mm_per_pixel)
    normals = numpy.dstack([-dx, dy, numpy.ones_like(z)])
    normals /= numpy.linalg.norm(normals, axis=2)[..., None]
    light = numpy.array([-0.5, 0.5, 0.7]) / numpy.linalg.norm([-0.5, 0.5, 0.7])
    half = light + [0, 0, 1]
    half /= numpy.linalg.norm(half)
    grey = 0.15 + 0.6 * (normals @ light).clip(0, 1) + 0.35 * (normals @ half).clip(0, 1) ** 30
    return Image.fromarray((255 * grey.clip(0, 1)).astype(numpy.uint8))


def main(folder, *programs):
    Image.MAX_IMAGE_PIXELS = None
    rows = (len(PLACES) + 1) // 2
    sheet = Image.new("L", (4 * SIDE + 24, rows * (SIDE + 12) - 12), 255)
    for k, program in enumerate(programs):
        known = None
        for i, (scan, options, left, top, side) in enumerate(PLACES):
            if known != scan:
                known, z = scan, heights(program, str(pathlib.Path(folder, scan + ".ply")), options)
            width = z.shape[1]
            x, y, n = int(left * width), int(top * z.shape[0]), int(side * width)
            place = shaded(z[y : y + n, x : x + n], MM / max(z.shape)).resize((SIDE, SIDE), Image.LANCZOS)
            sheet.paste(place, (i % 2 * (2 * SIDE + 20) + k * (SIDE + 4), i // 2 * (SIDE + 12)))
    sheet.save(pathlib.Path(__file__).with_name("close-ups.jpg"), quality=80)


if __name__ == "__main__":
    main(*sys.argv[1:])
