"""Helps scripts/fault-campaign: sets the numbers that make calls fail, makes folders, and runs programs in them."""

import mmap
import os
import shutil
import signal
import struct
import subprocess
import time
from pathlib import Path

SIZE = ["--method", "linear", "--denoise", "0", "--width", "30", "--height", "1", "--resolution", "0.5"]
SIGNALS = (signal.SIGKILL, signal.SIGINT, signal.SIGTERM)
NO_ROOM, BROKEN = 28, 5  # the error numbers ENOSPC and EIO
PATIENCE = 300  # seconds after which a program counts as stuck


class Find(Exception):
    """A requirement that is not met."""


class Skip(Exception):
    """A fault that cannot be made here."""


def require(condition, *complaint):
    if not condition:
        raise Find(" ".join(map(str, complaint)))


class Faults:
    """The numbers that tests/cli/faults.c reads; its enumeration says what they mean."""

    ALLOCATIONS, WRITES, READS, WRITE_ERROR, CLOCK, LEAST_BYTES = 0, 3, 6, 9, 10, 11

    def __init__(self, path):
        path.write_bytes(bytes(16 * 8))
        self.open(path)

    def open(self, path):
        with open(path, "r+b") as file:
            self.map = mmap.mmap(file.fileno(), 0)
        self.path = path

    def __getitem__(self, place):
        return struct.unpack_from("q", self.map, 8 * place)[0]

    def __setitem__(self, place, number):
        struct.pack_into("q", self.map, 8 * place, number)

    def arm(self, kind, first, count=1, error=BROKEN):
        """Lets `count` calls fail; the first of them is call number `first` from now on."""
        self[self.WRITE_ERROR] = error
        self[kind], self[kind + 2], self[kind + 1] = 0, count, first

    def disarm(self):
        """Ends all faults. Returns whether a call has failed, or the clock jumped."""
        kinds = (self.ALLOCATIONS, self.WRITES, self.READS)
        has_hit = any(0 < self[kind + 1] <= self[kind] for kind in kinds) or self[self.CLOCK] != 0
        for kind in kinds:
            self[kind + 1] = 0
        return has_hit


def failing_allocations(faults, chance):
    """Chooses which allocations fail: a single one, or all large ones after a number. Returns (first, count)."""
    count, faults[Faults.LEAST_BYTES], most = chance.choice([(1, 0, 4.7), (1, 4096, 3), (10**9, 4096, 3)])
    return int(10 ** chance.uniform(0, most)), count


class Setup:
    """The program, its inputs, and the outputs that it writes without faults."""

    def __init__(self, program, source, folder, python):
        self.program, self.folder, self.python = program, folder, python
        self.preload = folder / "faults.so"
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", self.preload, source / "tests/cli/faults.c"], check=True)
        for sample in ("shell", "still_life", "green_man"):
            subprocess.run([program, "sample", sample, "-o", folder / f"{sample}.ply", "--points", "2000"], check=True, capture_output=True)
        self.whole, self.most = {}, {}
        for command, run in (("make", make_command), ("batch", batch_command)):
            with Place(self, f"whole-{command}") as place:
                started = time.monotonic()
                ended = place.start(run(place), {}).wait()
                require(ended == 0, command, "ends with", ended, "without a fault")
                self.most[command] = {kind: max(1, place.faults[kind]) for kind in (0, 3, 6)}
                self.most[command]["seconds"] = time.monotonic() - started
                self.whole[command] = files_in(place.out)

    def has_python(self):
        return any(Path(self.python).glob("relievo/_native*.so"))


class Place:
    """A folder for one fault, with inputs, older outputs, and foreign files."""

    def __init__(self, setup, number):
        self.setup, self.folder = setup, setup.folder / str(number)
        self.out, self.state = self.folder / "out", self.folder / "state"
        self.mounted = []
        # Some file systems support files without names, others do not. Places with odd and with even numbers test one
        # case each.
        self.environment = {"NO_TMPFILE": "1"} if str(number)[-1] in "13579" else {}

    def __enter__(self):
        self.out.mkdir(parents=True)
        (self.folder / "scans").mkdir()
        for sample in ("shell", "still_life", "green_man"):
            shutil.copy(self.setup.folder / f"{sample}.ply", self.folder / "scans")
        shutil.copy(self.setup.folder / "shell.ply", self.folder / "scan.ply")
        self.program, self.groups = self.setup.program, []
        self.faults = Faults(self.folder / "faults")
        return self

    def __exit__(self, *_):
        for group in self.groups:
            for process in processes_of(group):
                os.kill(process, signal.SIGKILL)
        for path in self.mounted:
            subprocess.run(["umount", "-l", path], check=False)
        shutil.rmtree(self.folder, ignore_errors=True)

    def mark_as_batch(self):
        """Marks the folder of outputs as one that a batch has made."""
        self.out.mkdir(exist_ok=True)
        (self.out / ".relievo_folder").write_text(
            "relievo batch made this folder or found it empty, and may remove what it has put here.\n")

    def is_marked(self):
        return (self.out / ".relievo_folder").exists()

    def add_foreign_files(self, folder):
        """Writes files that no program may touch, and keeps their state for check_foreign_files()."""
        folder.mkdir(exist_ok=True)
        for name in ("notes.txt", "a.stl.bak", "a.stl.relievo-", "größe\n.ply", "-o", "a.stl~"):
            (folder / name).write_text(name)
        (folder / "read-only").mkdir(exist_ok=True)
        (folder / "read-only" / "letter").write_text("x")
        (folder / "read-only").chmod(0o555)
        (folder / "link").symlink_to("/etc/hostname")
        self.foreign = {path: state_of(path) for path in [*folder.rglob("*"), *(self.folder / "scans").rglob("*")]}

    def check_foreign_files(self):
        for path, before in self.foreign.items():
            require(os.path.lexists(path), path.name, "is gone, a foreign file")
            require(state_of(path) == before, path.name, "has changed, a foreign file")

    def start(self, command, environment):
        known = {"LD_PRELOAD": str(self.setup.preload), "FAULTS": str(self.faults.path)}
        process = subprocess.Popen(list(map(str, command)), cwd=self.folder, env={**os.environ, **known, **self.environment, **environment},
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
        self.groups.append(process.pid)
        return process

    def is_writing(self):
        """Returns whether a process has an open temporary file of the outputs."""
        for process in (process for group in self.groups for process in processes_of(group)):
            try:
                files = [os.readlink(file) for file in Path(f"/proc/{process}/fd").iterdir()]
            except OSError:
                continue  # the process has ended
            if any(file.startswith((f"{self.out}/#", f"{self.out}/a.")) for file in files):
                return True
        return False

    def make_disk(self, path, kilobytes):
        path.mkdir(exist_ok=True)
        made = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "none", path], capture_output=True, check=False)
        if made.returncode != 0:
            raise Skip("full disks, which need root and tmpfs")
        self.mounted.append(path)

    def fill_disk(self, path, free):
        """Fills the disk until only the given number of bytes is free."""
        room = os.statvfs(path)
        with open(path / "filling", "wb") as file:
            file.write(bytes(max(0, room.f_bavail * room.f_frsize - free)))

    def wait_for_processes(self):
        for _ in range(PATIENCE * 20):
            if not any(map(processes_of, self.groups)):
                return
            time.sleep(0.05)
        raise Find("processes are left")


def processes_of(group):
    """Returns the processes of a group that have not ended."""
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if fields[0] not in "ZX" and int(fields[2]) == group:
            found.append(int(path.parent.name))
    return found


def state_of(path):
    about = path.lstat()
    content = os.readlink(path) if path.is_symlink() else path.read_bytes() if path.is_file() else sorted(os.listdir(path))
    return about.st_mode, about.st_mtime_ns, content


def files_in(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()} if folder.is_dir() else {}


def temporaries(folder):
    """Returns the names of the temporary files that are not empty. Such names end with two numbers. An empty file does not
    count: a program that is killed just after it made the file has not marked it as its own, so nobody may remove it."""
    return [path.name for path in folder.rglob("*.relievo-[0-9]*-[0-9]*") if size_of(path)] if folder.is_dir() else []


def size_of(path):
    try:
        return path.stat().st_size
    except OSError:
        return 0


def make_command(place, threads=2):
    return [place.program, "make", "scan.ply", *SIZE, "-o", "out/a.stl", "--preview", "out/a.png", "--heightmap", "out/a.tif",
            "--threads", threads, "--quiet"]


def batch_command(place):
    return [place.program, "batch", "scans", *SIZE, "-o", "out", "--jobs", "2", "--quiet", "--retry"]


def finish(process):
    """Waits for the end of a program; returns its exit code, output and errors."""
    try:
        out, errors = process.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        raise Find(f"stuck: {process.args[1]}") from None
    return process.returncode, out.decode(errors="replace"), errors.decode(errors="replace")
