"""Runs the cases of scripts/fault-campaign in the studio: a page sends its requests while faults last."""

import http.client
import json
import shutil
import signal
import socket
import threading
import time
from pathlib import Path

from fault_place import (PATIENCE, SIGNALS, BROKEN, NO_ROOM, Faults, Find, Place, failing_allocations, finish, require,
                         temporaries)


class Page:
    """A page of a studio. While a fault lasts, the studio may answer with errors."""

    ANSWERS = (200, 202, 400, 409, 422, 500, 503, 507)

    def __init__(self, place):
        self.place = place
        self.process = place.start([place.program, "studio", "--no-browser", "--state", "state"], {"AT_ONCE": "1"})
        line = self.process.stdout.readline().decode()
        require("http://" in line, "studio: no address:", line, self.process.poll())
        _, _, self.address, self.token, _ = line.split()[-1].split("/")
        self.kept = 0

    def ask(self, action, request):
        """Returns the status and the body of an answer; no status if the connection ended."""
        body = request if isinstance(request, bytes) else json.dumps(request)
        try:
            connection = http.client.HTTPConnection(self.address, timeout=PATIENCE)
            connection.request("POST", f"/{self.token}/api/{action}", body)
            answer = connection.getresponse()
            content = answer.read()
        except TimeoutError:
            raise Find(f"studio: no answer to {action}") from None
        except (OSError, http.client.HTTPException):
            return None, b""
        require(answer.status in self.ANSWERS, "studio:", action, "is answered by", answer.status, content[:500])
        return answer.status, content

    def must(self, action, request):
        status, content = self.ask(action, request)
        require(status == 200, "studio: without a fault", action, "is answered by", status, content[:500])
        return content

    def opening(self, sample):
        return {"input": {"path": str(self.place.folder / "scans" / f"{sample}.ply")}, "tab": "t", "view": "front"}

    def open(self, sample):
        status, content = self.ask("open", self.opening(sample))
        return json.loads(content)["document"] if status == 200 else None

    def wait(self, document):
        """Waits until nothing is being prepared. Returns the error of the last preparation."""
        for _ in range(PATIENCE * 50):
            status = json.loads(self.must("status", {"document": document}))
            if not status["busy"]:
                require(status["making"]["stage"] == "", "studio: still makes", status["making"])
                return status["error"]
            time.sleep(0.02)
        raise Find("studio: still prepares")

    def keep(self, document):
        status, content = self.ask("state", {"document": document, "state": {"changed": self.kept + 1, "text": "x" * (self.kept % 5 * 9000)}})
        if status == 200:
            self.kept += 1
        return status, content


    def keep_a_scan(self):
        """Uploads a scan as if it were dropped on the page, and keeps its document. Returns the scan's path."""
        content = self.must("upload?name=dropped.ply", (self.place.folder / "scan.ply").read_bytes() + b"dropped")
        dropped = json.loads(content)["input"]
        document = json.loads(self.must("open", {"input": dropped, "tab": "u", "view": "front"}))["document"]
        self.must("state", {"document": document, "state": {"changed": 1, "text": dropped["path"]}})
        return Path(dropped["path"])


def start_without_reading(place, chance):
    """Starts a studio that cannot read all of its files, and ends it."""
    place.faults.arm(Faults.READS, chance.randint(1, 12), chance.choice([1, 10**9]))
    process = place.start([place.program, "studio", "--no-browser", "--state", "state"], {})
    process.stdout.readline()
    process.terminate()
    finish(process)
    place.faults.disarm()


def picture_request(document):
    return {"document": document, "options": {"method": "paper", "resolution": 1}, "width": 60, "height": 40}


def work(page, document, chance):
    """Sends one of the requests that users cause."""
    request = picture_request(document)
    action = chance.choice(["open", "view", "picture", "turn", "piece", "export", "scan", "keep", "upload", "save", "recent", "remove"])
    if action == "open":
        page.open(chance.choice(["shell", "still_life", "green_man"]))
    elif action == "view":
        page.ask("view", {"document": document, "view": chance.choice(["front", "left", "top"])})
    elif action == "picture":
        page.ask("picture", {**request, "options": {"height": chance.uniform(1, 3), "outline": chance.choice(["rectangle", "ellipse"])}})
    elif action == "turn":
        page.ask("picture", {**request, "turned": {"towards": [chance.uniform(-1, 1), 0, 1], "up": [0, 1, 0]}})
    elif action in ("piece", "export"):
        page.ask(action, {"document": document, "options": {"resolution": 1, "rim": chance.uniform(1, 3)},
                          "format": chance.choice(["stl", "3mf", "heightmap", "preview"]), "pixels": 64})
    elif action == "scan":
        page.ask("scan", {**request, "towards": [0, 0, 1], "up": [0, 1, 0]})
    elif action == "keep":
        page.keep(document)
    elif action == "upload":
        page.ask(f"upload?name={chance.randint(1, 99)}.ply", (page.place.folder / "scan.ply").read_bytes() + bytes([chance.randint(0, 255)]))
    elif action == "save":
        page.ask("save", {"project": {"input": {"path": str(page.place.folder / "scan.ply")}, "options": {}}})
    elif action == "remove":
        other = page.open("still_life")
        page.ask("remove", {"document": other, "tab": "t"})
        page.open("shell")
    else:
        page.ask("recent", {})


def send_slowly(page, chance, is_over):
    """Keeps connections open on which requests come slowly or not at all."""
    host, port = page.address.split(":")
    held = []
    for _ in range(chance.randint(1, 60)):
        action = chance.choice(["upload?name=a.ply", "state", "project?name=a.relievo", "picture"])
        head = f"POST /{page.token}/api/{action} HTTP/1.1\r\nHost: {page.address}\r\nContent-Length: 100000\r\n\r\n".encode()
        text = head + b"x" * chance.randint(0, 500)
        connection = socket.create_connection((host, int(port)), timeout=PATIENCE)
        connection.sendall(text[:chance.choice([len(text), chance.randint(1, len(head))])])
        held.append(connection)
    while not is_over.wait(0.05):
        try:
            chance.choice(held).sendall(b"y")
        except OSError:
            pass  # the studio has closed this connection
    for connection in held:
        connection.close()


def fault_in_studio(page, kind, chance, document):
    """Sends requests to the studio while a fault lasts. Returns whether the fault came."""
    faults, is_over, others = page.place.faults, threading.Event(), []
    if kind == "allocation":
        faults.arm(Faults.ALLOCATIONS, *failing_allocations(faults, chance))
    elif kind == "write":
        faults.arm(Faults.WRITES, chance.randint(1, 12), chance.choice([1, 10**9]), chance.choice([NO_ROOM, BROKEN]))
    elif kind == "read":
        faults.arm(Faults.READS, chance.randint(1, 12), chance.choice([1, 10**9]))
    elif kind == "clock":
        faults[Faults.CLOCK] = chance.choice([-1, 1]) * chance.randint(1, 10**9)
    elif kind == "folder gone":
        shutil.rmtree(page.place.state, ignore_errors=True)
    elif kind == "slow client":
        others.append(threading.Thread(target=send_slowly, args=(page, chance, is_over)))
    elif kind == "kill":
        others.append(threading.Timer(chance.uniform(0, 1), page.process.send_signal, [chance.choice(SIGNALS)]))
    for other in others:
        other.start()
    try:
        for _ in range(chance.randint(3, 8)):
            if kind == "slow client":
                status, content = page.keep(document)
                require(status == 200, "studio: beside slow clients, state is answered by", status, content[:500])
            else:
                page.keep(document)
            work(page, document, chance)
    finally:
        is_over.set()
        for other in others:
            other.join()
    return faults.disarm() or kind not in ("allocation", "write", "read")


def check_studio(page, kind, document, picture):
    """Requires that a studio goes on after a fault as if nothing had happened."""
    if page.process.poll() is not None:
        raise Find(f"studio: ended with {page.process.poll()} {page.process.stderr.read()[:2000]}")
    page.place.faults[Faults.CLOCK] = 0
    page.must("open", page.opening("shell"))
    error = page.wait(document)
    if error:  # an error belongs to work that was done during the fault
        page.must("view", {"document": document, "view": "front"})
        error = page.wait(document)
    require(not error, "studio: cannot prepare the scan again:", error)
    require(page.must("picture", picture_request(document)) == picture, "studio: another picture than before")
    if kind not in ("folder gone", "full disk"):
        status, content = page.keep(document)
        require(status == 200, "studio: cannot keep work:", status, content[:500])


def studio(setup, kind, chance, number):
    with Place(setup, number) as place:
        if kind == "full disk":
            place.make_disk(place.state, chance.randint(100, 400))
        place.add_foreign_files(place.out)
        page = Page(place)
        document = page.open("shell")
        page.wait(document)
        picture = page.must("picture", picture_request(document))
        dropped = page.keep_a_scan() if kind != "full disk" else None
        has_hit = fault_in_studio(page, kind, chance, document)
        if kind != "kill":
            check_studio(page, kind, document, picture)
        kept = page.kept
        page.process.send_signal(signal.SIGKILL if kind == "kill" else signal.SIGTERM)
        code, _, errors = finish(page.process)
        require(code in (0, *(-each for each in SIGNALS)), "studio: ended with", code, errors[:2000])
        place.check_foreign_files()
        if kind == "folder gone":
            return has_hit
        place.faults[Faults.CLOCK] = 0
        if kind == "read":
            start_without_reading(place, chance)
        page = Page(place)
        require(not dropped or dropped.exists(), "studio: the scan of a document is gone")
        path = str(place.folder / "scans" / "shell.ply")
        state = json.loads(page.must("document", {"input": {"path": path}}))["kept"] or {"changed": 0, "text": ""}
        require(state["changed"] in (kept, kept + 1), "studio: kept", state["changed"], "after", kept)
        require(state["changed"] == 0 or state["text"] == "x" * ((state["changed"] - 1) % 5 * 9000), "studio: what it kept is not whole")
        require(not temporaries(place.state), "studio: left", temporaries(place.state))
        page.process.terminate()
        finish(page.process)
        return has_hit
