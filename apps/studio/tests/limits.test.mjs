// Sends the studio requests that are too many, too slow or too large, and starts other studios beside it.
import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import {readFileSync, readdirSync, writeFileSync} from "node:fs";
import path from "node:path";
import {test} from "node:test";
import {PICTURE, OPTIONS, connect, engine, folder, head, scan, state, stillWorks, studioIn,
  withEngine} from "./engine_suite.mjs";
import {EngineProcess, sleep} from "./support.mjs";

const MIB = 2 ** 20;

withEngine("shell", 20000);

function mostMemory() {
  const [, kib] = readFileSync(`/proc/${engine.child.pid}/status`, "utf8").match(/VmHWM:\s+(\d+)/);
  return kib / 1024;
}

// Sends up to `size` bytes, and stops when the server takes no more. Returns the server's answer.
function pour(head, size) {
  return new Promise((resolve) => {
    const socket = connect(), part = Buffer.alloc(MIB, "x");
    let answer = "", sent = 0;
    socket.on("data", (data) => (answer += data));
    socket.on("close", () => resolve(answer));
    const more = () => {
      while (sent < size && !socket.destroyed) {
        sent += part.length;
        if (!socket.write(part)) return socket.once("drain", more);
      }
    };
    socket.write(head);
    more();
  });
}

test("takes huge, tiny and negative numbers, or says what was expected", async () => {
  const values = [1e300, -1e300, 3.5e38, 1e-300, -1, 0, 1e9, -1e5];
  const parts = (v) => [{light: [v, v, v]}, {light: [0, 0, v]}, {light: [1, 1, v]}, {u: v}, {width: v},
    ...["yaw", "pitch", "zoom", "x", "y"].map((name) => ({camera: {[name]: v}})),
    ...["height", "width", "margin", "steps"].map((name) => ({options: {...OPTIONS, [name]: v}}))];
  const isFine = ({status}, what) => assert.ok([200, 400, 422].includes(status), `${status} ${JSON.stringify(what)}`);
  for (const v of values) {
    for (const part of parts(v)) isFine(await engine.post("picture", {...PICTURE, ...part}), part);
    isFine(await engine.post("scan", {...PICTURE, towards: [v, 0, v], up: [0, v, 0]}), `scan ${v}`);
    isFine(await engine.post("profile", {...PICTURE, from: [v, v], to: [0, 0]}), `profile ${v}`);
  }
  assert.equal((await engine.post("picture", {...PICTURE, light: [1e300, 1e300, 1e300]})).status, 200);
  for (const light of [[0, 0, 0], [1, 2], "left", [1, 2, null]])
    assert.match(String((await engine.post("picture", {...PICTURE, light})).body), /light: expected three numbers/);
  for (const pixels of [1e300, -5, "many"])
    assert.equal((await engine.post("export", {options: OPTIONS, format: "heightmap", pixels})).status, 400);
  await stillWorks();
});

test("opens files only, and none that does not fit into memory", async () => {
  const pipe = path.join(folder, "pipe.ply"), huge = path.join(folder, "huge.ply"), gone = path.join(folder, "gone.ply");
  assert.equal(spawnSync("mkfifo", [pipe]).status, 0);
  assert.equal(spawnSync("truncate", ["-s", "2T", huge]).status, 0);
  const wanted = [["/dev/zero", /found a device/], [pipe, /found a pipe/], [folder, /found a folder/],
    [huge, /at most \d+ MiB/], [gone, /gone\.ply/]];
  for (const [file, text] of wanted) {
    const {document} = await engine.json("open", {input: {path: file}});
    assert.match((await engine.until(undefined, document)).error?.text ?? "nothing", text);
  }
  assert.ok(mostMemory() < 1000, `${mostMemory()} MiB`);
  await stillWorks();
});

test("says what is there in place of a scan", async () => {
  const pipe = path.join(folder, "in_place.ply"), gone = path.join(folder, "gone.ply");
  assert.equal(spawnSync("mkfifo", [pipe]).status, 0);
  for (const [file, found] of [["/dev/zero", "a device"], [pipe, "a pipe"], [folder, "a folder"]]) {
    const text = `${file}: expected a file, found ${found}`, input = {path: file, name: "x"};
    assert.equal((await engine.json("document", {input})).error?.text, text);
    const project = JSON.stringify({relievo: 1, input, options: {}});
    assert.equal((await engine.upload("p.relievo", project, "project")).error?.text, text);
  }
  assert.equal((await engine.json("document", {input: {path: gone}})).is_there, false);
});

test("does not read what it refuses", async () => {
  const before = mostMemory(), {host} = engine.url, length = `Content-Length: ${600 * MIB}\r\n\r\n`;
  const heads = [[`POST /wrong/api/upload HTTP/1.1\r\nHost: ${host}\r\n${length}`, /403/],
    [`${head("api/picture")}${length}`, /413/], ["GET /", /431/],
    [`${head("api/gone")}Expect: 100-continue\r\n${length}`, /404/]];
  for (const [head, status] of heads) assert.match(await pour(head, 600 * MIB), status);
  assert.ok(mostMemory() - before < 50, `${mostMemory() - before} MiB for refused bodies`);
  await stillWorks();
});

test("writes a dropped scan to the disk as it arrives", async () => {
  const before = mostMemory(), size = 300 * MIB;
  const request = `${head("api/upload?name=x.ply")}Connection: close\r\nContent-Length: ${size}\r\n\r\n`;
  const answer = await pour(request, size);
  assert.match(answer, /^HTTP\/1.1 200/);
  assert.ok(mostMemory() - before < 50, `${mostMemory() - before} MiB for a dropped scan`);
  const cut = connect();
  cut.write(`${request}ply`);
  await sleep(200);
  cut.destroy();
  for (let i = 0; i < 50 && readdirSync(state).some((name) => name.startsWith("upload")); ++i) await sleep(50);
  assert.deepEqual(readdirSync(state).filter((name) => name.startsWith("upload")), []);
});

test("answers while hundreds of others send slowly", async () => {
  const starts = ["", "G", `${head("", "GET")}X: `, `${head("icon.svg", "GET")}\r\n`];
  const slow = Array.from({length: 600}, (_, i) => {
    const socket = connect();
    socket.write(starts[i % starts.length]);
    return socket;
  });
  const dripping = setInterval(() => slow.forEach((socket) => socket.write("x")), 300);
  await sleep(1000);
  for (let i = 0; i < 10; ++i) {
    const began = performance.now();
    await stillWorks();
    assert.ok(performance.now() - began < 2000, `${performance.now() - began} ms`);
  }
  clearInterval(dripping);
  slow.forEach((socket) => socket.destroy());
});

test("keeps work and draws while a hundred files arrive slowly", async () => {
  const document = "00000000000000ab";
  const slow = Array.from({length: 100}, (_, i) => {
    const socket = connect();
    socket.write(`${head(`api/upload?name=${i}.ply`)}Content-Length: ${MIB}\r\n\r\nply`);
    return socket;
  });
  await sleep(1000);
  for (let i = 0; i < 5; ++i) {
    const kept = {changed: 2 + i, at: 0, steps: [{input: {sample: "shell"}}]};
    const {status, body} = await engine.post("state", {document, state: kept});
    assert.equal(status, 200, String(body));
    await stillWorks();
  }
  slow.forEach((socket) => socket.destroy());
  const refused = await engine.post("thumbnail", {document, thumbnail: "data:image/jpeg;base64,AAAA"});
  assert.equal(refused.status, 200);
  await engine.post("remove", {document});
});

// A connection cannot buffer an answer of 7 MB. So the answering thread waits until the server closes the connection.
test("answers while more than a hundred others do not read their answers", {timeout: 120000}, async () => {
  const deaf = [], body = JSON.stringify({...PICTURE, document: engine.document, width: 1600, height: 1200});
  for (let group = 0; group < 12; ++group) {
    const first = Array.from({length: 10}, () => new Promise((resolve) => {
      const socket = connect();
      socket.once("readable", () => resolve(socket.read(1)?.toString())); // reads one byte and no more
      socket.write(`${head("api/picture")}Content-Length: ${body.length}\r\n\r\n${body}`);
      deaf.push(socket);
    }));
    assert.ok((await Promise.all(first)).every((byte) => byte === "H"));
    await stillWorks();
  }
  deaf.forEach((socket) => socket.destroy());
  await stillWorks();
});

test("keeps many requests on one connection, and two that are sent at once", async () => {
  const socket = connect(), get = `${head("icon.svg", "GET")}\r\n`;
  let text = "";
  socket.on("data", (data) => (text += data));
  socket.write(get + get);
  await sleep(500);
  socket.write(get);
  await sleep(500);
  assert.equal(text.match(/HTTP\/1\.1 200/g).length, 3);
  socket.destroy();
});

test("shares its port with nobody", async () => {
  const other = new EngineProcess(path.join(folder, "other"), "--port", engine.url.port);
  await assert.rejects(other.ready(), /expected a port that is free/);
});

test("keeps apart what two studios keep, and says so", async () => {
  const first = await studioIn("shared"), second = await studioIn("shared");
  assert.equal((await first.about()).notice, "");
  const {notice} = await second.about();
  assert.match(notice, /^Another studio uses the folder .* this one keeps its own work apart\.$/);
  assert.ok(second.errors.includes(`${notice} It does so in ${path.join(folder, "shared-2")}.`), second.errors);
  const kept = async (of) => (await of.kept({sample: "shell"})).from;
  const {document} = await first.json("document", {input: {sample: "shell"}});
  for (const [of, from] of [[first, "first"], [second, "second"]]) {
    await of.post("state", {document, state: {from, at: 0, steps: [{input: {sample: "shell"}}]}});
    assert.equal(await kept(of), from);
  }
  await first.stop();
  const third = await studioIn("shared");
  assert.equal(await kept(third), "first");
  await Promise.all([second.stop(), third.stop()]);
});

test("says when nothing can be kept, and works all the same", async () => {
  const file = path.join(folder, "file");
  writeFileSync(file, "");
  const other = await new EngineProcess(path.join(file, "state"), scan).ready();
  const {notice} = await other.about();
  assert.equal(notice, "Your work is not kept, as the studio's folder cannot be written to.");
  assert.ok(other.errors.includes(`${notice} ${path.join(file, "state")}: Not a directory`), other.errors);
  await other.open({path: scan});
  assert.equal((await other.post("picture", PICTURE)).status, 200);
  const {status, body} = await other.post("state", {state: {}});
  assert.equal(status, 500);
  assert.match(String(body), /expected a folder of the studio that can be written to: Not a directory/);
  await other.stop();
});
