#!/usr/bin/python3
"""Runs a catalogue on a local Dask cluster of two workers, and kills workers and the run.

    PYTHONPATH=PACKAGE dask_run.py PROGRAM [--good 980] [--bad 20]

PACKAGE is the folder that has the package relievo with its built module, for example build/release/python.
A worker is killed in the middle (kill -9), then the whole run. Then the run is started again. In the end there must be
a relief of each good scan, complete and with the bytes that `relievo make` writes, and one error of each bad scan.
"""

import argparse
import glob
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(__file__))
import catalogue

# A preview of the default size takes twice as long as one of these reliefs.
SMALL_PICTURES = ["--preview-size", "64"]


def journal(output):
    """Returns the journal's records, in the order of their lines."""
    lines = []
    for path in glob.glob(f"{output}/.journal/*.jsonl"):
        with open(path, encoding="utf-8") as file:
            for line in file:
                try:
                    lines.append(json.loads(line))
                except ValueError:
                    pass  # a killed program has not finished this line
    return lines


def wait_for(count, output, process, log):
    """Waits until the journal has `count` records."""
    while len(journal(output)) < count:
        if process.poll() is not None:
            sys.exit(f"the run ended before it could be killed, with {process.returncode}: {content(log).decode()}")
        time.sleep(0.02)


def processes():
    """Returns the number of each process, its parent's number, and its command line."""
    found = []
    for path in glob.glob("/proc/[0-9]*/cmdline"):
        try:
            with open(path, "rb") as file:
                command = file.read()
            with open(path.replace("cmdline", "stat"), encoding="utf-8") as file:
                state, parent = file.read().rsplit(")", 1)[1].split()[:2]
        except OSError:
            continue
        if state != "Z":
            found.append((int(path.split("/")[2]), int(parent), command))
    return found


def worker_processes(parent):
    """Returns the processes of Dask's workers whose parent has the number `parent`."""
    return [number for number, above, command in processes() if above == parent and b"spawn_main" in command]


def wait_for_the_end_of(workers, output):
    """Waits until these workers and their programs have ended, which can be shortly after the run."""
    deadline = time.time() + 120
    while True:
        left = [number for number, _, command in processes() if number in workers or output.encode() in command]
        if not left:
            return
        if time.time() > deadline:
            sys.exit(f"of the run that was killed, these processes are left: {left}")
        time.sleep(0.05)


def content(path):
    with open(path, "rb") as file:
        return file.read()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--good", type=int, default=980)
    parser.add_argument("--bad", type=int, default=20)
    given = parser.parse_args()
    program = os.path.abspath(given.program)
    with tempfile.TemporaryDirectory(prefix="relievo-dask-") as folder:
        scans, output = f"{folder}/scans", f"{folder}/out"
        good, bad = catalogue.write_catalogue(scans, given.good, given.bad)
        command = [sys.executable, "-m", "relievo.batch", scans, "-o", output, "--workers", "2", "--program", program,
                   *catalogue.OPTIONS, *SMALL_PICTURES]
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        count = len(good) + len(bad)

        log = f"{folder}/log"
        with open(log, "wb") as file:
            first = subprocess.Popen(command, env=environment, stderr=file, start_new_session=True)
        try:
            wait_for(count // 4, output, first, log)
            workers = worker_processes(first.pid)
            assert len(workers) == 2, f"expected two workers, found {workers}"
            os.kill(workers[0], signal.SIGKILL)
            wait_for(count // 2, output, first, log)
            workers = worker_processes(first.pid)
        finally:
            first.kill()  # kill -9: no program can clean up
            first.wait()
        wait_for_the_end_of(workers, output)
        before = len(journal(output))
        assert before < count, "the run was killed too late"

        second = subprocess.run(command, env=environment, stderr=subprocess.PIPE, text=True, check=False)
        assert second.returncode == 1, second.stderr
        check(output, scans, program, good, bad, first=before)
        print(f"{len(good)} reliefs and {len(bad)} errors; a worker was killed, and the run after {before} of {count}")


def check(output, scans, program, good, bad, first):
    with open(f"{output}/scans.jsonl", encoding="utf-8") as file:
        records = {record["name"]: record for record in map(json.loads, file)}
    assert sorted(records) == sorted(good + bad), "each scan has one record"
    assert [name for name in sorted(records) if records[name]["status"] == "made"] == good
    for name in bad:
        assert records[name]["error"].count("\n") == 0 and "expected" in records[name]["error"], records[name]
    # No scan may be finished twice. A scan may be started twice only if a worker or the run was killed while the scan
    # was being made.
    lines = journal(output)
    made = [record["name"] for record in lines if record["status"] == "made"]
    assert len(made) == len(set(made)) == len(good), f"{len(made)} made, {len(set(made))} different"
    assert len(lines) - first <= len(good) + len(bad) - first + 2, "what was done is not done again"
    files = sorted(os.path.basename(path) for path in glob.glob(f"{output}/*"))
    expected = [f"{name}.{ending}" for name in good for ending in ("stl", "png")]
    assert files == sorted([*expected, "contact-sheet.png", "index.html", "scans.jsonl"] +
                           [f"contact-sheet-{i + 1}.png" for i in range(1, (len(good) + len(bad) + 143) // 144)]), files
    for name in good:
        subprocess.run([program, "make", f"{scans}/{name}.xyz", "-o", f"{output}/../one.stl", "--quiet",
                        *catalogue.OPTIONS], check=True)
        assert content(f"{output}/../one.stl") == content(f"{output}/{name}.stl"), name


if __name__ == "__main__":
    main()
