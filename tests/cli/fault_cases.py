"""The cases of scripts/fault-campaign. They cause each fault in each command, and check the consequences."""

import shutil
import signal
import subprocess
import sys
import time

from fault_place import (SIGNALS, BROKEN, NO_ROOM, Faults, Place, Skip, batch_command, failing_allocations, files_in, finish,
                         make_command, require, temporaries)
from fault_studio import studio

OUTPUTS = ("a.stl", "a.png", "a.tif")


def run_with_fault(place, kind, chance, command, name):
    """Runs a program with a fault. Returns its exit code, its errors, and whether the fault came before it ended."""
    faults, most = place.faults, place.setup.most[name]
    if kind == "allocation":
        faults.arm(Faults.ALLOCATIONS, chance.randint(1, most[0]), chance.choice([1, 1, 3, 10**9]))
    elif kind == "write":
        faults.arm(Faults.WRITES, chance.randint(1, most[3]), chance.choice([1, 10**9]), chance.choice([NO_ROOM, BROKEN]))
    elif kind == "read":
        faults.arm(Faults.READS, chance.randint(1, most[6]), chance.choice([1, 10**9]))
    process = place.start(command, {})
    if kind == "kill" and chance.random() < 0.5:  # half of the signals come while the program writes outputs
        while process.poll() is None and not place.is_writing():
            time.sleep(0.003)
        time.sleep(chance.uniform(0, 0.02))
    elif kind in ("kill", "folder gone", "clock"):
        time.sleep(chance.uniform(0, most["seconds"]))
    was_running = process.poll() is None
    if kind == "kill":
        return end_by_signal(process, chance.choice(SIGNALS), was_running)
    if kind == "folder gone":
        shutil.rmtree(place.out, ignore_errors=True)
    elif kind == "clock":
        faults[Faults.CLOCK] = chance.choice([-1, 1]) * chance.randint(1, 10**9)
    code, _, errors = finish(process)
    return code, errors, faults.disarm() or (was_running and kind in ("folder gone", "clock")) or (kind == "full disk" and code != 0)


def end_by_signal(process, number, was_running):
    """Ends a program by a signal: it must end at once without a message. Returns the values of run_with_fault()."""
    process.send_signal(number)
    sent = time.monotonic()
    code, _, errors = finish(process)
    require(code in (0, -number) and not errors, "after signal", number, "exit code", code, errors[:2000])
    require(code == 0 or time.monotonic() - sent < 5, "signal", number, "ended it after", time.monotonic() - sent, "s")
    return code, errors, was_running


def check_end(kind, code, errors):
    """Requires that a program ended with an exit code and a message that are allowed for this fault."""
    require(code in (0, 1) or kind == "kill", "exit code", code, errors[:2000])
    lines = errors.splitlines()
    require(code != 1 or len(lines) >= 1, "no message")
    require(all(line.startswith("relievo: ") for line in lines), "other lines than messages:", errors[:2000])
    return lines


def make(setup, kind, chance, number):
    with Place(setup, number) as place:
        whole = setup.whole["make"]
        if kind == "full disk":
            place.make_disk(place.out, chance.randint(32, sum(map(len, whole.values())) // 900))
        place.add_foreign_files(place.out)
        for name in OUTPUTS:
            (place.out / name).write_bytes(b"old")
        code, errors, has_hit = run_with_fault(place, kind, chance, make_command(place, chance.choice([1, 2])), "make")
        lines = check_end(kind, code, errors)
        require(len(lines) <= 1, "more than one line:", errors[:2000])
        require(kind != "allocation" or code == 0 or "expected more free memory" in errors, "another message:", errors)
        if kind == "folder gone":
            return has_hit
        place.check_foreign_files()
        made = files_in(place.out)
        for name in OUTPUTS:
            require(made.get(name) in (b"old", whole[name]), name, "is neither old nor whole")
            require(code != 0 or made[name] == whole[name], name, "is not new, and the exit code 0")
        require(code == -signal.SIGKILL or not temporaries(place.out), "left", temporaries(place.out))
        if code == -signal.SIGKILL:
            code, _, errors = finish(place.start(make_command(place), {}))
            require(code == 0 and not temporaries(place.out), "the next run left", temporaries(place.out), code, errors)
        return has_hit


def batch(setup, kind, chance, number):
    with Place(setup, number) as place:
        whole = {name: content for name, content in setup.whole["batch"].items() if name.endswith((".stl", ".png"))}
        if kind == "full disk":
            place.make_disk(place.out, chance.randint(32, sum(map(len, whole.values())) // 900))
        place.mark_as_batch()
        place.add_foreign_files(place.out)
        code, errors, has_hit = run_with_fault(place, kind, chance, batch_command(place), "batch")
        # The mark of a batch's folder may be removed before the folder's other files. Then the program finds a folder
        # that is neither empty nor made by a batch, and refuses it.
        if kind == "folder gone" and code == 2 and "expected an empty folder, or one of relievo batch" in errors:
            return has_hit
        check_end(kind, code, errors)
        place.wait_for_processes()
        if kind == "full disk":
            subprocess.run(["mount", "-o", "remount,size=100m", place.out], check=True)
        if kind != "folder gone":
            place.check_foreign_files()
            for name, content in files_in(place.out).items():
                is_of_all = name == "contact-sheet.png"  # this picture shows all scans that were made, so it may differ
                require(is_of_all or name not in whole or content == whole[name], name, "is not whole")
        place.faults[Faults.CLOCK] = 0
        is_of_others = place.out.is_dir() and any(place.out.iterdir()) and not place.is_marked()
        code, _, errors = finish(place.start(batch_command(place), {}))
        # If files were written after the mark was removed, the folder no longer counts as a batch's.
        if kind == "folder gone" and is_of_others:
            require(code == 2, "a folder of others is taken", code, errors[:2000])
            return has_hit
        require(code == 0, "the next run ends with", code, errors[:2000])
        made = files_in(place.out)
        for name, content in whole.items():
            require(made.get(name) == content, name, "is not whole after the next run")
        require(not temporaries(place.out), "the next run left", temporaries(place.out))
        if kind != "folder gone":
            place.check_foreign_files()
        return has_hit


PYTHON = """
import os, signal, sys
import numpy as np
sys.path.insert(0, sys.argv[1])
from fault_place import Faults
from pathlib import Path
import relievo

faults = Faults.__new__(Faults)
faults.open(Path("faults"))

def work(session):
    frame = session.frame()
    picture = session.picture(frame, width=60, height=40)
    relief = session.make()
    relief.save("out/a.stl", preview="out/a.png", heightmap="out/a.tif")
    return frame.heights.tobytes(), picture.tobytes(), relief.to_bytes("stl")

kind, first, count, error, threads = map(int, sys.argv[2:7])
options = dict(method="paper", width_mm=30, resolution_mm=.5, denoise=0)
relievo.set_threads(threads)
session = relievo.Session("scan.ply", **options)
whole = work(session)
print("begun", flush=True)
for _ in range(3):
    if kind >= 0: faults.arm(kind, first, count, error)
    try:
        again = relievo.Session("scan.ply", **options)
        assert work(again) == whole, "other results"
        assert work(session) == whole, "other results"
    except (relievo.Error, MemoryError, OSError) as refusal:
        print(type(refusal).__name__)
    faults.disarm()
    if kind != Faults.CLOCK and kind != -2: assert work(session) == whole, "other results afterwards"
print("ended")
"""


def python(setup, kind, chance, number):
    if not setup.has_python():
        raise Skip("Python's package, which is not built")
    with Place(setup, number) as place:
        if kind == "full disk":
            place.make_disk(place.out, 8000)
        place.add_foreign_files(place.out)
        numbers = {"allocation": [Faults.ALLOCATIONS, *failing_allocations(place.faults, chance), 0],
                   "write": [Faults.WRITES, chance.randint(1, 6), chance.choice([1, 10**9]), chance.choice([NO_ROOM, BROKEN])],
                   "read": [Faults.READS, chance.randint(1, 3), chance.choice([1, 10**9]), BROKEN]}.get(kind, [-2, 0, 0, 0])
        (place.folder / "work.py").write_text(PYTHON)
        here = __file__.rpartition("/")[0]
        process = place.start([sys.executable, "work.py", here, *numbers, chance.choice([1, 2])],
                              {"PYTHONPATH": setup.python, "EXCEPT": "python3,numpy,ld-linux,libblas,liblapack", "AT_ONCE": "1"})
        begun = process.stdout.readline()
        require(begun == b"begun\n", "Python: does not begin:", begun or process.stderr.read())
        if kind in ("kill", "folder gone", "clock"):
            time.sleep(chance.uniform(0, 0.5))
        if kind == "kill":
            process.send_signal(chance.choice(SIGNALS))
        elif kind == "full disk":
            place.fill_disk(place.out, chance.randint(0, 300_000))
        elif kind == "folder gone":
            shutil.rmtree(place.out, ignore_errors=True)
        elif kind == "clock":
            place.faults[Faults.CLOCK] = chance.choice([-1, 1]) * chance.randint(1, 10**9)
        code, out, errors = finish(process)
        if kind == "kill":
            require(code in (0, 1, *(-each for each in SIGNALS)), "Python: exit code", code, errors[-2000:])
        else:
            require(code == 0 and out.rstrip().endswith("ended"), "Python: exit code", code, out[-500:], errors[-2000:])
        if kind != "folder gone":
            place.check_foreign_files()
            require(kind == "kill" or not temporaries(place.out), "Python: left", temporaries(place.out))
        return kind in ("kill", "folder gone", "clock") or len(out.splitlines()) > 1


CASES = {"make": make, "batch": batch, "studio": studio, "python": python}
KINDS = [(kind, command) for kind in ("allocation", "write", "read", "kill", "full disk", "folder gone", "clock") for command in CASES]
KINDS.append(("slow client", "studio"))
