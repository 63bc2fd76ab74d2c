"""Makes reliefs of a whole catalogue of scans on many machines, with Dask distributed.

    import relievo.batch
    run = relievo.batch.run("scans", "reliefs", scheduler="tcp://head:8786", height=4, width=80)

or, on a command line, `python3 -m relievo.batch scans -o reliefs --scheduler tcp://head:8786 --height 4`. Without a
scheduler, workers are started on this machine. All machines need the program `relievo` and the same file system. The
program lists the scans, makes each relief and writes the pages (`relievo batch --list`, `--job` and `--pages`). So the
results are those of `relievo batch`, and a run that one of them began can be continued by the other. Dask distributes
the scans, and shows the run in its dashboard. If a worker dies, another worker does its scans again.
"""

# Dask's functions have no type annotations, and the type check must also work without Dask.
# mypy: disable-error-code="no-untyped-call, import"

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import typing
import uuid
from contextlib import contextmanager
from dataclasses import dataclass

Record = dict[str, typing.Any]  # the record of one scan, as in scans.jsonl
Watch = typing.Callable[[Record, int, int], None]

# The largest number of attempts for a scan. A scan is tried again if the system killed its program or a disk was full.
TRIES = 3
# Dask gets up to this many scans in one task, because each task, and each start of the program, takes several
# milliseconds.
MOST_IN_TASK = 8
# The name of the Dask resource by which a worker states its memory in megabytes: dask worker --resources
# "relievo_mb=16000".
RESOURCE = "relievo_mb"
# By default Dask checks its workers 50 to 100 times per second, which takes several percent of the processor time.
QUIET = {"distributed.worker.profile.enabled": False, "distributed.admin.tick.interval": "500ms"}


@dataclass(frozen=True)
class Run:
    """The outcome of a run: a record for each scan, as in the file `scans.jsonl`, and the path of the page."""

    records: list[Record]
    index: str

    @property
    def made(self) -> list[Record]:
        return [record for record in self.records if record["status"] == "made"]

    @property
    def failed(self) -> list[Record]:
        return [record for record in self.records if record["status"] != "made"]


def run(
    source: str,
    output: str,
    *,
    scheduler: typing.Any = None,
    workers: int | None = None,
    program: str = "relievo",
    flags: typing.Sequence[str] = (),
    watch: Watch | None = None,
    **options: typing.Any,
) -> Run:
    """Makes reliefs of all scans of a folder or a table (CSV), and returns the outcome as a `Run`.

    `scheduler` is the address of a Dask scheduler, or a `distributed.Client`. Without it, `workers` processes are
    started on this machine, by default one per processor. The options are those of `relievo batch`, with underscores:
    `height=4`, `base_image="wave.png"`, `files="stl,report"`. `flags` are further flags, as typed on a command line.
    `watch(record, done, count)` is called after each scan. Reliefs that were made before from the same contents and
    options are kept. A scan that fails does not end the run. Raises ValueError with the program's message if options
    are wrong or there is no scan.
    """
    program = _path_of(program)
    output = os.path.abspath(output)
    flags = [*flags, *(f"--{name.replace('_', '-')}={value}" for name, value in options.items())]
    lines = _call([program, "batch", source, "-o", output, "--list", *flags]).splitlines()
    with _client(scheduler, workers) as client:
        records = list(_work(client, program, ["-o", output, *_output_flags(flags)], lines, watch))
    # Ignores the exit code, which is 1 if a scan failed, because the records contain the failures.
    subprocess.run([program, "batch", source, "-o", output, "--pages", "--quiet", *flags], stderr=subprocess.DEVNULL,
                   check=False)
    return Run(records, os.path.join(output, "index.html"))


def _path_of(program: str) -> str:
    found = shutil.which(program)
    if found is None:
        raise ValueError(f"{program}: expected the program relievo, which Python's package does not bring along; "
                         "its path is given as program= or --program")
    return found


def _call(command: list[str]) -> str:
    ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if ended.returncode:
        raise ValueError(ended.stderr.strip() or f"{command[0]} ended with {ended.returncode}")
    return ended.stdout


def _output_flags(flags: typing.Sequence[str]) -> list[str]:
    """Returns the flags that choose the kinds of output files. The line for each scan contains all other options."""
    kept = []
    for flag, value in zip(flags, [*flags[1:], ""]):
        if flag.startswith("--files="):
            kept.append(flag)
        elif flag == "--files":
            kept.append(f"--files={value}")
    return kept


@contextmanager
def _client(scheduler: typing.Any, workers: int | None) -> typing.Iterator[typing.Any]:
    """Yields a client of Dask. Closes it afterwards, unless the caller has provided it."""
    import cloudpickle
    import dask
    from distributed import Client, LocalCluster

    # Workers on other machines need only the program, not this module.
    cloudpickle.register_pickle_by_value(sys.modules[__name__])
    if isinstance(scheduler, Client):
        yield scheduler
    elif scheduler:
        with Client(scheduler) as client:
            yield client
    else:
        workers = workers or len(os.sched_getaffinity(0))
        memory_mb = 0.8 * _available_mb() / workers
        with dask.config.set(QUIET), LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            memory_limit=0,
            dashboard_address=":0",
            resources={RESOURCE: memory_mb},
        ) as cluster, Client(cluster) as client:
            yield client


def _available_mb() -> float:
    with open("/proc/meminfo", encoding="ascii") as file:
        for line in file:
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) / 1024
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") / 2**20


def _work(
    client: typing.Any, program: str, flags: list[str], lines: list[str], watch: Watch | None
) -> typing.Iterator[Record]:
    """Runs the jobs of all lines, and yields their records as they arrive."""
    from distributed import as_completed

    # If all workers state their memory, Dask gives each worker only as many jobs at a time as its memory allows. A scan
    # that is too large for every worker runs alone.
    workers = client.scheduler_info()["workers"].values()
    stated = [worker.get("resources", {}).get(RESOURCE) for worker in workers]
    most_mb = min(stated) if stated and all(stated) else None

    def submit(task: list[str]) -> typing.Any:
        jobs = [json.loads(line) for line in task]
        need = {RESOURCE: min(max(job["need_mb"] for job in jobs), most_mb)} if most_mb else None
        key = ("reliefs", f"{jobs[0]['name']} {uuid.uuid4().hex}")
        return client.submit(_do, program, flags, task, key=key, resources=need, pure=False)

    tasks = {submit(task): task for task in _tasks(lines, sum(worker["nthreads"] for worker in workers))}
    tries = dict.fromkeys(lines, 0)
    completed = as_completed(tasks)
    done = 0
    for future in completed:
        records, error = _outcome(future)
        for line in tasks.pop(future):
            job = json.loads(line)
            record = records.get(job["name"])
            tries[line] += 1
            # A scan is tried again in its own task, so that it affects no other scan if it kills its worker.
            if tries[line] < TRIES and (record is None or (record.get("may_succeed") and record["hash"])):
                again = submit([line])
                tasks[again] = [line]
                completed.add(again)
                continue
            record = record or {"name": job["name"], "file": job["file"], "status": "failed", "error": error}
            done += 1
            if watch:
                watch(record, done, len(lines))
            yield record
        future.release()


def _tasks(lines: list[str], threads: int) -> typing.Iterator[list[str]]:
    """Divides lines into tasks that become smaller, so that all workers end at about the same time."""
    start = 0
    while start < len(lines):
        size = max(1, min(MOST_IN_TASK, (len(lines) - start) // (4 * max(1, threads))))
        yield lines[start : start + size]
        start += size


def _do(program: str, flags: list[str], lines: list[str]) -> list[Record]:
    """Runs on a worker: does the jobs of the lines one after another. Returns the records of the jobs that ended."""
    jobs = [word for line in lines for word in ("--job", line)]
    ended = subprocess.run([program, "batch", *flags, *jobs], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                           check=False)
    if not ended.stdout:
        raise RuntimeError(ended.stderr.strip() or f"{program} ended with {ended.returncode}")
    return [json.loads(record) for record in ended.stdout.splitlines()]


def _outcome(future: typing.Any) -> tuple[dict[str, Record], str]:
    """Returns the records of a task by the names of the scans, and the reason why its other scans have no record."""
    error = future.exception()
    if error is not None:
        return {}, f"{type(error).__name__}: {error}"
    return {record["name"]: record for record in future.result()}, "expected a record, found none"


def _main() -> None:
    parser = argparse.ArgumentParser(prog="python3 -m relievo.batch", description=(__doc__ or "").split("\n")[0],
                                     epilog="All other flags are those of relievo batch.", allow_abbrev=False)
    parser.add_argument("source", help="a folder of scans, or a table (CSV)")
    parser.add_argument("-o", "--output", required=True, help="folder of the reliefs and the pages about them")
    parser.add_argument("--scheduler", help="address of a Dask scheduler; without it, workers on this machine")
    parser.add_argument("--workers", type=int, help="number of them; default: one per processor")
    parser.add_argument("--program", default="relievo", help="path of relievo, on all machines")
    given, flags = parser.parse_known_args()

    def watch(record: Record, done: int, count: int) -> None:
        if record["status"] != "made" and not record.get("is_kept"):
            print(f"failed: {record['name']}: {record['error']}", file=sys.stderr)
        if done % max(1, count // 20) == 0 or done == count:
            print(f"{done} of {count}", file=sys.stderr, flush=True)

    try:
        ended = run(given.source, given.output, scheduler=given.scheduler, workers=given.workers,
                    program=given.program, flags=flags, watch=watch)
    except ValueError as error:
        sys.exit(str(error))
    print(f"{given.output}: {len(ended.made)} reliefs, {len(ended.failed)} failed; see {ended.index}", file=sys.stderr)
    sys.exit(1 if ended.failed else 0)


if __name__ == "__main__":
    _main()
