#!/usr/bin/python3
"""Measures what a run costs beside the reliefs: `relievo batch` and Dask against a loop of the shell.

    PYTHONPATH=PACKAGE overhead.py PROGRAM [--scans 40] [--rounds 5] [--points 1500] [--options "..."]
                                   [--at-once 1|2]

Each round does the same scans in turns by a loop of `relievo make` with the same options, by `relievo batch --jobs 1`,
and, with two at a time, by `xargs -P 2` and by Dask with two workers. It prints the medians of wall-clock and processor
seconds per scan. The pages at the end of a run are part of it. With two at a time it also prints the seconds of a Dask run
that finds all scans done: it starts its workers, looks at each scan and writes the pages.
"""

import argparse
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(__file__))
import catalogue

DASK = "Dask, 2 workers"


def measured(action):
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    action()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (time.perf_counter() - start, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--scans", type=int, default=40)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--points", type=int, default=1500)
    parser.add_argument("--options", default=" ".join(catalogue.OPTIONS))
    parser.add_argument("--at-once", type=int, choices=(1, 2), help="only the ways that do so many scans at a time")
    given = parser.parse_args()
    program, options = os.path.abspath(given.program), given.options
    with tempfile.TemporaryDirectory(prefix="relievo-overhead-") as folder:
        os.makedirs(f"{folder}/scans")
        for i in range(given.scans):
            catalogue.write_scan(f"{folder}/scans/{i}.xyz", i, given.points)
        make = (f"{program} make scans/$1.xyz -o out/$1.stl --preview out/$1.png --preview-size 400 --threads 1 --quiet "
                f"{options}")
        one_at_once = {
            "loop": f"for i in $(seq 0 {given.scans - 1}); do set -- $i; {make}; done",
            "batch --jobs 1": f"{program} batch scans -o out --jobs 1 --quiet {options}",
        }
        two_at_once = {
            "xargs -P 2": f"seq 0 {given.scans - 1} | xargs -P 2 -I @ sh -c 'set -- @; {make}'",
            "batch --jobs 2": f"{program} batch scans -o out --jobs 2 --quiet {options}",
            DASK: f"{sys.executable} -m relievo.batch scans -o out --workers 2 --program {program} {options}",
        }
        ways = {**(one_at_once if given.at_once != 2 else {}), **(two_at_once if given.at_once != 1 else {})}
        found = {way: [] for way in ways}
        for _ in range(given.rounds):
            for way, command in ways.items():
                shutil.rmtree(f"{folder}/out", ignore_errors=True)
                os.makedirs(f"{folder}/out")
                found[way].append(measured(lambda: subprocess.run(
                    ["sh", "-c", command], cwd=folder, stderr=subprocess.DEVNULL, check=True)))
        if given.at_once != 1:
            wall, busy = measured(lambda: subprocess.run(
                ["sh", "-c", two_at_once[DASK]], cwd=folder, stderr=subprocess.DEVNULL, check=True))
            print(f"Dask with nothing to do: {wall:.2f} s in all, {busy:.2f} s of processor time")
        for way, times in found.items():
            wall, busy = (statistics.median(column) / given.scans * 1000 for column in zip(*times))
            print(f"{way:18} {wall:8.1f} ms per scan, {busy:8.1f} ms of processor time")


if __name__ == "__main__":
    main()
