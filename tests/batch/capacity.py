#!/usr/bin/python3
"""Measures what `relievo batch` needs: capacity.py PROGRAM [--points 2000 ...] [--workers] [--rounds 3]

It prints, for each number of points, the medians over three samples of processor seconds, seconds and memory, as the journal
has them, and the memory that the program expects. With --workers it does six scans of each number of points in turns on one
processor, one at a time, and on two, two at a time, and prints the processor seconds of a scan (median of the rounds), the
seconds of the clock (the best round, as other programs only make it longer), and the scans in an hour that follow from both.
"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time

SAMPLES = ("shell", "green_man", "still_life")


def write_scans(program, folder, points, copies=1):
    os.makedirs(folder)
    for i in range(copies):
        for sample in SAMPLES:
            subprocess.run([program, "sample", sample, "-o", f"{folder}/{sample}-{i}.ply", "--points", str(points)], check=True)


def records_of(out):
    with open(f"{out}/scans.jsonl", encoding="utf-8") as file:
        return [json.loads(line) for line in file]


def by_size(program, folder, points):
    scans, out = f"{folder}/scans-{points}", f"{folder}/out-{points}"
    write_scans(program, scans, points)
    command = [program, "batch", scans, "-o", out, "--height", "3", "--width", "80", "--quiet", "--jobs", "1"]
    listed = subprocess.run([*command, "--list"], stdout=subprocess.PIPE, text=True, check=True).stdout
    need = max(json.loads(line)["need_mb"] for line in listed.splitlines())
    subprocess.run(["taskset", "-c", "0", *command], check=True)
    records = records_of(out)
    print(points, *(f"{name} {statistics.median(r[name] for r in records):.2f}" for name in ("cpu_seconds", "seconds")),
          f"peak_mb {max(r['peak_mb'] for r in records):.0f}, expected {need:.0f}", flush=True)


def by_workers(program, folder, points, rounds):
    scans = f"{folder}/scans-of-workers-{points}"
    write_scans(program, scans, points, copies=2)
    count = 2 * len(SAMPLES)
    cpu, clock = {1: [], 2: []}, {1: [], 2: []}
    for i in range(rounds):
        for workers, processors in ((1, "0"), (2, "0,1")):
            out = f"{folder}/out-of-workers-{points}-{i}-{workers}"
            start = time.perf_counter()
            subprocess.run(["taskset", "-c", processors, program, "batch", scans, "-o", out, "--height", "3", "--width", "80",
                            "--quiet", "--jobs", str(workers)], check=True)
            clock[workers].append((time.perf_counter() - start) / count)
            cpu[workers].append(statistics.mean(record["cpu_seconds"] for record in records_of(out)))
    for workers in (1, 2):
        seconds, best = statistics.median(cpu[workers]), min(clock[workers])
        print(f"{points} points, {workers} at a time: {seconds:.2f} s of processor time a scan, {3600 * workers / seconds:.0f} "
              f"an hour; best by the clock {best:.2f} s, {3600 / best:.0f} an hour", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--points", type=int, nargs="+", default=[300_000])
    parser.add_argument("--workers", action="store_true")
    parser.add_argument("--rounds", type=int, default=3)
    given = parser.parse_args()
    program = os.path.abspath(given.program)
    with tempfile.TemporaryDirectory(prefix="relievo-capacity-") as folder:
        for points in given.points:
            if given.workers:
                by_workers(program, folder, points, given.rounds)
            else:
                by_size(program, folder, points)


if __name__ == "__main__":
    main()
