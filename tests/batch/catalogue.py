"""Generates a catalogue of small scans, some of them bad, for the tests of batch runs."""

import math
import os
import random

# Reliefs of these scans take little time with these options.
OPTIONS = ["--method", "linear", "--height", "2", "--width", "30", "--resolution", "1.5", "--denoise", "0"]


def write_scan(path, seed, points=1500):
    """Writes a cloud with normals: an ellipsoid with waves, both chosen by the seed."""
    draw = random.Random(seed)
    a, b, c = (draw.uniform(0.6, 1.4) for _ in range(3))
    waves, depth = draw.randint(2, 6), draw.uniform(0.02, 0.15)
    rows = []
    for i in range(points):
        z = 1 - (2 * i + 1) / points
        turn = i * math.pi * (3 - math.sqrt(5))
        r = math.sqrt(1 - z * z)
        n = (r * math.cos(turn), r * math.sin(turn), z)
        scale = 1 + depth * math.sin(waves * n[0]) * math.cos(waves * n[1])
        rows.append(f"{a * scale * n[0]:.6f} {b * scale * n[1]:.6f} {c * scale * n[2]:.6f} "
                    f"{n[0] / a:.6f} {n[1] / b:.6f} {n[2] / c:.6f}")
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join(rows) + "\n")


BAD = [("ply", b"ply\nformat ascii 1.0\nelement vertex 3\n"),
       ("xyz", b"1 2 3\n4 5 six\n"),
       ("stl", b""),
       ("obj", b"v 0 0 0\n"),
       ("pcd", b"\x00\x01\x02")]


def write_catalogue(folder, good, bad):
    """Writes `good` good and `bad` bad scans, mixed. Returns the names of the good ones and of the bad ones."""
    os.makedirs(folder)
    names = [f"scan-{i:04}" for i in range(good + bad)]
    is_bad = set(names[:: max(1, (good + bad) // max(1, bad))][:bad])
    for i, name in enumerate(names):
        if name in is_bad:
            ending, content = BAD[i % len(BAD)]
            with open(os.path.join(folder, f"{name}.{ending}"), "wb") as file:
                file.write(content)
        else:
            write_scan(os.path.join(folder, f"{name}.xyz"), i)
    return [name for name in names if name not in is_bad], sorted(is_bad)
