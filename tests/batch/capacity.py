#!/usr/bin/python3
"""Measures seconds and memory of `relievo batch` by the size of scans: capacity.py PROGRAM [POINTS...]

It prints, for each number of points, the medians over three samples of processor seconds, seconds and memory, as the journal
has them, and the memory that the program expects.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile

program = os.path.abspath(sys.argv[1])
with tempfile.TemporaryDirectory(prefix="relievo-capacity-") as folder:
    for points in sys.argv[2:]:
        scans, out = f"{folder}/{points}", f"{folder}/{points}-out"
        os.makedirs(scans)
        for sample in ("shell", "green_man", "still_life"):
            subprocess.run([program, "sample", sample, "-o", f"{scans}/{sample}.ply", "--points", points], check=True)
        command = [program, "batch", scans, "-o", out, "--height", "3", "--width", "80", "--quiet", "--jobs", "1"]
        listed = subprocess.run([*command, "--list"], stdout=subprocess.PIPE, text=True, check=True).stdout
        need = max(json.loads(line)["need_mb"] for line in listed.splitlines())
        subprocess.run(command, check=True)
        with open(f"{out}/scans.jsonl", encoding="utf-8") as file:
            records = [json.loads(line) for line in file]
        print(points, *(f"{name} {statistics.median(r[name] for r in records):.2f}" for name in ("cpu_seconds", "seconds", "peak_mb")),
              f"expected {need:.0f}", flush=True)
