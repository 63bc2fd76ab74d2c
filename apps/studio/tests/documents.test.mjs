// Tests that the engine and the page keep a document for each scan, even after crashes, and that projects can contain
// scans.
import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import {closeSync, copyFileSync, existsSync, mkdirSync, openSync, readFileSync, readdirSync, rmSync, statSync,
  writeFileSync, writeSync} from "node:fs";
import http from "node:http";
import path from "node:path";
import {test} from "node:test";
import {engine, folder, scan, studioIn, withEngine} from "./engine_suite.mjs";
import {EngineProcess, PROGRAM, eventually, pageModule, run, sleep, temporaryFolder} from "./support.mjs";

const {Keeper} = await pageModule("keeper.js");

withEngine("shell", 5000, () => {});

const stateOf = (input, height, changed) => ({version: 1, changed, at: 0, steps: [{input, options: {height}}]});
const keep = (of, document, kept, tab = "a") => of.post("state", {document, state: kept, tab});
const filesIn = (place) => readdirSync(place, {recursive: true}).sort();
const dropped = async (of, name, bytes) => (await of.upload(name, bytes)).input;
const heightKept = async (of, input) => (await of.kept(input)).steps[0].options.height;

test("keeps a document for each scan, and the newer state of each", async () => {
  const inputs = [{sample: "shell"}, {sample: "green_man"}, {path: scan}], ids = [];
  for (const [i, input] of inputs.entries()) {
    const {document, kept, is_there: isThere} = await engine.json("document", {input});
    assert.equal(kept, null);
    assert.equal(isThere, true);
    assert.equal((await keep(engine, document, stateOf(input, i + 1, 100))).status, 200);
    ids.push(document);
  }
  assert.equal(new Set(ids).size, 3);
  for (const [i, input] of inputs.entries()) {
    assert.equal((await keep(engine, ids[i], stateOf(input, 50, 99), "b")).status, 409);
    const {document, kept} = await engine.json("document", {input});
    assert.equal(document, ids[i]);
    assert.equal(kept.steps[0].options.height, i + 1);
  }
  const thumbnail = "data:image/jpeg;base64,AAAA";
  assert.equal((await engine.post("thumbnail", {document: ids[0], thumbnail})).status, 200);
  assert.equal((await engine.post("thumbnail", {document: ids[0], thumbnail: "javascript:alert()"})).status, 400);
  const {recent} = await engine.json("recent");
  assert.deepEqual(recent.map((entry) => entry.document), [...ids].reverse());
  assert.equal(recent[2].thumbnail, thumbnail);
  for (let round = 0; round < 50; round++) {
    for (const i of [2, 0, 1]) await keep(engine, ids[i], stateOf(inputs[i], i + 1, 101 + round));
    const order = (await engine.json("recent")).recent.map((entry) => entry.document);
    assert.deepEqual(order, [ids[1], ids[0], ids[2]], "the newest come first, however fast they follow one another");
  }
  for (const document of ["../x", "", "0123", 3])
    assert.ok((await keep(engine, document, {changed: 1})).status >= 400, `${document}`);
});

test("neither replaces a document that it cannot read, nor removes a scan then", async () => {
  let other = await studioIn("unread");
  const input = await dropped(other, "b.xyz", "0 0 0\n"), {document} = await other.json("document", {input});
  // A folder takes the place of the document's file, so that the studio cannot read the document.
  mkdirSync(path.join(folder, "unread", "documents", `${document}.json`), {recursive: true});
  const told = await other.post("document", {input}), kept = await keep(other, document, stateOf(input, 1, 1));
  assert.match(String(told.body), /expected a folder of the studio that can be read: /);
  assert.deepEqual([told.status, kept.status], [500, 500]);
  await other.stop();
  other = await studioIn("unread"); // at its start a studio removes scans that no document needs
  await other.stop();
  assert.ok(existsSync(input.path));
});

test("is found at the same address after it was killed", async () => {
  const place = path.join(folder, "again"), first = await studioIn("again");
  await first.stop("SIGKILL");
  const second = await studioIn("again");
  assert.equal(second.address, first.address);
  await second.stop();
  for (const name of ["", "address.json", "documents"].filter((each) => existsSync(path.join(place, each))))
    assert.equal(statSync(path.join(place, name)).mode & 0o077, 0, name); // other users must not read the token
  const other = await studioIn("elsewhere");
  assert.notEqual(other.url.pathname, first.url.pathname);
  await other.stop();
});

// Simulates a page that changes its document every few milliseconds.
class ScriptedPage {
  constructor(document, storage) {
    Object.assign(this, {document, changed: 0, confirmed: 0});
    this.keeper = new Keeper({
      send: (...args) => this.send(...args), prefix: "", storage, onOlder: () => (this.isOlder = true),
      onFailed: (error) => (this.failure = error), onKept: () => {},
    });
  }

  async send(document, kept, isMoving) {
    let answer;
    try {
      answer = await this.engine.post("state", {document, state: kept, tab: "page", is_moving: isMoving});
    } catch {
      throw Object.assign(new Error("lost"), {kind: "lost"});
    }
    if (answer.status === 200) this.confirmed = kept.changed;
    if (answer.status !== 200) throw Object.assign(new Error(String(answer.body)), {kind: "refused"});
  }

  change() {
    const steps = Array.from({length: 60}, () => ({input: {sample: "shell"}, options: {height: this.changed}}));
    this.keeper.keep(this.document, {version: 1, changed: ++this.changed, at: 59, steps}, true);
  }

  async drag(ms) {
    for (const end = performance.now() + ms; performance.now() < end;) {
      this.change();
      await sleep(8);
    }
  }
}

class MapStorage extends Map {
  getItem(key) {
    return this.get(key) ?? null;
  }
  setItem(key, text) {
    this.set(key, text);
  }
  removeItem(key) {
    this.delete(key);
  }
}

async function killAtRandom(place, times) {
  const document = "00000000000000aa", storage = new MapStorage(), page = new ScriptedPage(document, storage);
  const file = path.join(place, "documents", `${document}.json`);
  for (let i = 0; i < times; ++i) {
    page.engine = await new EngineProcess(place).ready();
    page.keeper.retry();
    const dragging = page.drag(150 + Math.random() * 150);
    await sleep(60 + Math.random() * 200);
    const {confirmed} = page;
    await page.engine.stop("SIGKILL");
    await dragging;
    const kept = JSON.parse(readFileSync(file, "utf8")); // the file is complete whenever the engine is killed
    assert.ok(kept.changed >= confirmed, `${kept.changed} of ${confirmed}`);
    while (page.keeper.isSending) await sleep(5); // after this, the engine or the browser has the newest change
    const copy = JSON.parse(storage.getItem(document) ?? "{}");
    assert.equal(Math.max(copy.changed ?? 0, kept.changed), page.changed); // engine and page together lose nothing
  }
  page.engine = await new EngineProcess(place).ready();
  page.keeper.retry();
  await eventually(() => assert.equal(storage.size, 0));
  assert.equal(JSON.parse(readFileSync(file, "utf8")).changed, page.changed);
  assert.deepEqual(readdirSync(path.join(place, "documents")), [`${document}.json`]);
  await page.engine.stop();
}

test("loses nothing that it has confirmed when it is killed, at 50 moments, and the page loses nothing", async () => {
  const places = Array.from({length: 5}, (_, i) => path.join(folder, `killed-${i}`));
  await Promise.all(places.map((place) => killAtRandom(place, 10)));
});

// Simulates a drag with a simulated clock and an engine that takes `answerMs` to answer. Returns the longest time in ms
// during which a change was not sent, and the number of requests.
async function paceOfDrag(durationMs, answerMs) {
  const own = globalThis.setTimeout, storage = new MapStorage(), waiting = [];
  const due = () => waiting.filter(({at}) => at <= clock);
  const later = (act, ms) => waiting.push({act, at: clock + ms});
  let clock = 0, newest = 0, times = 0, longest = 0;
  const send = (document, {changed}) => new Promise((resolve) => {
    [newest, times] = [changed, times + 1];
    later(resolve, answerMs);
  });
  const keeper = new Keeper({send, storage, prefix: "", onOlder: () => {}, onFailed: assert.fail, onKept: () => {}});
  globalThis.setTimeout = later;
  Object.defineProperty(performance, "now", {value: () => clock, configurable: true});
  try {
    for (; clock < durationMs; ++clock) {
      keeper.keep("a", {changed: clock}, true);
      for (const one of due()) {
        waiting.splice(waiting.indexOf(one), 1);
        one.act();
        await new Promise(setImmediate);
      }
      longest = Math.max(longest, clock - newest);
    }
  } finally {
    globalThis.setTimeout = own;
    delete performance.now;
  }
  return {longest, times};
}

// An engine that is killed loses at most the changes of the last 100 ms or, if its last answer took longer, the changes
// since that answer.
test("sends what a drag changes every 60 ms, so that 100 ms are lost at most", async () => {
  for (const answerMs of [0, 10, 30]) {
    const {longest, times} = await paceOfDrag(3000, answerMs);
    assert.ok(longest + answerMs <= 100, `${longest} ms, with answers of ${answerMs}`);
    assert.ok(times <= 51, `${times} times`); // more requests would leave the engine no time for pictures
  }
});

test("reads the strokes of a project from a file beside it, as make does", async () => {
  const strokes = [{name: "brow", brush: "raise", amount: 0.2, radius: 0.2, points: [[0.14, -0.11, 0.02]]}];
  const [list, project] = ["strokes.json", "painted.relievo"].map((name) => path.join(folder, name));
  writeFileSync(list, JSON.stringify(strokes));
  const options = {width: 40, strokes: "strokes.json"};
  writeFileSync(project, JSON.stringify({relievo: 1, input: {path: scan}, options}));
  const make = (...args) => {
    const out = path.join(folder, "painted.stl");
    run("make", ...args, "-o", out, "--quiet");
    return readFileSync(out);
  };
  const made = make(project);
  assert.ok(made.equals(make(scan, "--width", 40, "--strokes", list)));
  assert.ok(!made.equals(make(scan, "--width", 40)));
  const other = await new EngineProcess(temporaryFolder(), project).ready(), {first} = await other.about();
  assert.deepEqual(JSON.parse(first.options.strokes), strokes);
  const {document} = await other.json("document", {input: first.input});
  await other.json("state", {document, state: {version: 1, changed: 1, at: 0, steps: [{input: first.input}]}});
  assert.equal((await other.about()).first.options, undefined, "the document has newer work now");
  await other.stop();
});

test("packs a scan into a project, from which make and another machine make the same", async () => {
  const options = {height: 2, width: 40}, make = (project, ...args) =>
    spawnSync(PROGRAM, ["make", project, "-o", path.join(folder, "out.stl"), "--quiet", ...args]);
  const input = {path: scan, name: "scan.ply"}, project = {relievo: 1, input, options, studio: {material: "silver"}};
  const linked = path.join(folder, "linked.relievo"), packed = path.join(folder, "packed.relievo");
  writeFileSync(linked, JSON.stringify(project));
  assert.equal(make(linked).status, 0);
  const wanted = readFileSync(path.join(folder, "out.stl"));
  const saved = await engine.post("save", {project});
  assert.equal(saved.status, 200, String(saved.body));
  writeFileSync(packed, saved.body);
  assert.ok(saved.body.length < statSync(scan).size, `${saved.body.length} bytes`);

  const bytes = readFileSync(scan), moved = path.join(folder, "moved.ply");
  copyFileSync(scan, moved);
  rmSync(scan);
  assert.equal(make(packed).status, 0);
  assert.ok(readFileSync(path.join(folder, "out.stl")).equals(wanted));
  const lost = make(linked);
  assert.notEqual(lost.status, 0);
  assert.match(String(lost.stderr), /scan\.ply.*name the place of scan\.ply with --scan/);
  assert.equal(make(linked, "--scan", moved).status, 0);
  assert.ok(readFileSync(path.join(folder, "out.stl")).equals(wanted));

  const unpacked = await engine.upload("packed.relievo", saved.body, "project");
  assert.equal(unpacked.is_there, true);
  assert.deepEqual(readFileSync(unpacked.input.path), bytes);
  assert.deepEqual(unpacked.studio, project.studio);
  const asked = await engine.upload("linked.relievo", JSON.stringify(project), "project");
  assert.equal(asked.is_there, false);
  project.input.hash = unpacked.input.hash; // the engine finds the unpacked scan by this hash
  const found = await engine.upload("linked.relievo", JSON.stringify(project), "project");
  assert.equal(found.input.path, unpacked.input.path);
  for (let cut = 0; cut < saved.body.length; cut += Math.ceil(saved.body.length / 40))
    assert.equal((await engine.upload("cut.relievo", saved.body.subarray(0, cut), "project")).status, 400, `${cut}`);
  writeFileSync(scan, bytes);
});

test("packs the height map of a base, and keeps it with the document", async () => {
  const map = path.join(folder, "map.png"), out = path.join(folder, "out.stl");
  const make = (input, ...args) => {
    const {status, stderr} = spawnSync(PROGRAM, ["make", input, "-o", out, "--quiet", ...args]);
    return status === 0 ? readFileSync(out) : String(stderr);
  };
  make(scan, "--height", "3", "--heightmap", map, "--heightmap-size", "64");
  const wanted = make(scan, "--height", "2", "--width", "40", "--base", "image:height=3", "--base-image", map);
  const {path: kept} = await dropped(engine, "map.png", readFileSync(map));
  const options = {height: 2, width: 40, base: "image:height=3", "base-image": kept};
  const project = {relievo: 1, input: {path: scan, name: "scan.ply"}, options};
  const linked = path.join(folder, "based.relievo"), packed = path.join(folder, "based_packed.relievo");
  writeFileSync(linked, JSON.stringify(project));
  assert.ok(wanted.equals(make(linked)));
  const plane = make(linked, "--base", "plane");
  writeFileSync(packed, (await engine.post("save", {project})).body);
  rmSync(kept);
  assert.match(make(linked), /map\.png: expected a file that can be read/);
  assert.ok(plane.equals(make(linked, "--base", "plane")), "an image that is not used is missed");
  assert.ok(wanted.equals(make(packed)));
  assert.ok(wanted.equals(make(linked, "--base-image", map)));

  const other = await studioIn("based");
  const {input, options: {"base-image": unpacked}} = await other.upload("p.relievo", readFileSync(packed), "project");
  assert.ok(readFileSync(unpacked).equals(readFileSync(map)));
  const {document} = await other.json("document", {input});
  const steps = [{input, options: {"base-image": unpacked}}, {input, options: {}}]; // undo restores the image
  await keep(other, document, {version: 1, changed: 5, at: 1, steps});
  await other.stop();
  const next = await studioIn("based");
  assert.ok(existsSync(unpacked));
  await next.stop();
});

test("keeps every document with its scan until it is removed, and says how much that is", async () => {
  const place = path.join(folder, "many"), count = 30, inputs = [], ids = [];
  let other = await studioIn("many");
  for (let i = 0; i < count; ++i) {
    inputs.push(await dropped(other, `${i}.xyz`, `${i} 0 0\n`));
    ids.push((await other.json("document", {input: inputs[i]})).document);
    await keep(other, ids[i], stateOf(inputs[i], 3, 5));
  }
  const models = [{file: inputs[0].path}, {file: inputs[1].path}];
  const lost = await dropped(other, "lost.xyz", "0 0 1\n"); // a scan without a stored document
  const scene = await dropped(other, "scene.json", JSON.stringify({models}));
  const ofScene = (await other.json("document", {input: scene})).document;
  await keep(other, ofScene, stateOf(scene, 3, 5));
  await other.stop();
  assert.ok(existsSync(lost.path));
  other = await studioIn("many");
  assert.ok(inputs.every((input) => existsSync(input.path)) && !existsSync(lost.path));
  const sizes = filesIn(place).filter((name) => /^(documents|scans).*\./.test(name));
  const bytes = sizes.reduce((sum, name) => sum + statSync(path.join(place, name)).size, 0);
  assert.deepEqual(await other.json("kept"), {documents: count + 1, bytes});
  const remove = async (document) => (await other.post("remove", {document, tab: "a"})).status;
  assert.equal(await remove(ids[0]), 200);
  assert.ok(existsSync(inputs[0].path), "the scene needs it");
  assert.equal(await remove(ids[2]), 200);
  assert.equal(await remove(ofScene), 200);
  const isGone = (input, i) => i === 0 || i === 2;
  assert.deepEqual(inputs.map((input) => !existsSync(input.path)), inputs.map(isGone));
  assert.equal((await other.json("kept")).documents, count - 2);
  await other.post("open", {input: inputs[3], tab: "b"});
  const shown = await other.post("remove", {document: ids[3], tab: "a"});
  assert.equal(shown.status, 409);
  assert.match(String(shown.body), /expected a document that no other tab shows/);
  await other.post("leave", {tab: "b"});
  assert.equal(await remove(ids[3]), 200);
  await other.post("open", {input: inputs[4], tab: "crashed"});
  assert.equal(await remove(ids[4]), 409);
  // The engine knows only the newest 64 tabs, so it forgets the tab that crashed.
  for (let i = 0; i < 64; ++i) await other.post("open", {input: inputs[5], tab: `${i}`});
  assert.equal(await remove(ids[4]), 200);
  assert.equal((await other.json("recent")).recent.some(({document}) => document === ids[3]), false);
  for (const id of ["../address", "", "0123"]) assert.equal(await remove(id), 400);
  rmSync(inputs.at(-1).path);
  assert.equal((await other.json("recent")).recent.find(({document}) => document === ids.at(-1)).is_there, false);
  assert.equal(await heightKept(other, inputs.at(-1)), 3);
  await other.stop();
});

test("keeps nothing of a document that has no scan and was not opened", async () => {
  const other = await studioIn("unknown"), document = "0123456789abcdef", thumbnail = "data:image/jpeg;base64,AAAA";
  const before = filesIn(path.join(folder, "unknown"));
  const isRefused = ({status, body}, why) => {
    assert.equal(status, 400);
    assert.ok(String(body).includes(why), String(body));
  };
  for (const state of [{changed: 5}, {changed: 5, at: 1, steps: [{input: {sample: "shell"}}]}])
    isRefused(await keep(other, document, state), "expected the state of a document with a scan");
  isRefused(await other.post("thumbnail", {document, thumbnail}), "expected the thumbnail of a kept document");
  assert.deepEqual(filesIn(path.join(folder, "unknown")), before);
  assert.deepEqual(await other.json("kept"), {documents: 0, bytes: 0});
  await keep(other, document, stateOf({sample: "shell"}, 3, 5));
  assert.equal((await other.post("thumbnail", {document, thumbnail})).status, 200);
  assert.equal((await other.json("kept")).documents, (await other.json("recent")).recent.length);
  await other.stop();
});

test("lists a document while its scan is being opened, before anything of it is kept", async () => {
  const other = await studioIn("opening"), input = {path: scan};
  const {document} = await other.json("open", {input, tab: "a"});
  const {recent} = await other.json("recent");
  assert.deepEqual(recent.map((entry) => [entry.document, entry.input.path, entry.is_there]), [[document, scan, true]]);
  other.document = document;
  await other.untilIdle();
  await keep(other, document, stateOf(input, 2, 1));
  assert.equal((await other.json("recent")).recent.length, 1);
  await other.stop();
});

// Tests with a slow disk: LD_PRELOAD replaces fsync() by a function that waits until the file GO exists.
test("follows the engine while the disk takes its time", async (t) => {
  const source = path.join(folder, "fsync.c"), library = path.join(folder, "fsync.so"), go = path.join(folder, "go");
  writeFileSync(source, `#include <stdlib.h>\n#include <unistd.h>\n#include <sys/syscall.h>
int fsync(int file) { while (access(getenv("GO"), F_OK)) usleep(5000); return syscall(SYS_fsync, file); }`);
  if (spawnSync("cc", ["-shared", "-fPIC", "-o", library, source]).status !== 0) return t.skip("needs a C compiler");
  writeFileSync(go, "");
  Object.assign(process.env, {LD_PRELOAD: library, GO: go});
  const other = new EngineProcess(path.join(folder, "slow"), scan);
  delete process.env.LD_PRELOAD;
  await other.ready();
  const {document} = await other.json("document", {input: {path: scan}});
  rmSync(go);
  const answers = [], kept = keep(other, document, stateOf({path: scan}, 1, 1)).then(() => answers.push("kept"));
  await sleep(200); // by then the engine waits for the disk
  const events = http.get(`${other.address}api/events`), heard = new Promise((resolve) =>
    events.on("response", (stream) => stream.on("data", (data) => String(data).includes(document) && resolve())));
  const late = sleep(30000).then(() => answers.push("late"));
  await Promise.race([heard.then(() => answers.push("heard")), late]);
  writeFileSync(go, "");
  await kept;
  assert.deepEqual(answers, ["heard", "kept"]);
  events.destroy();
  await other.stop();
});

test("shows several documents at once, each with its own scan, settings and files", async () => {
  const options = {width: 60, height: 2, view: "front"}, picture = (document) =>
    engine.post("picture", {document, options, width: 60, height: 40});
  const inputs = [{path: scan}, {sample: "shell"}], ids = [];
  for (const [i, input] of inputs.entries()) {
    ids.push((await engine.json("open", {input, tab: `tab${i}`})).document);
    engine.document = ids[i];
    await engine.untilIdle();
  }
  const [points, others] = await Promise.all(ids.map(async (document) =>
    (await engine.json("facts", {document})).input_points));
  assert.equal(points, 5000);
  assert.notEqual(others, points);
  for (const document of ids) assert.equal((await picture(document)).status, 200);
  await engine.post("leave", {tab: "tab0"});
  for (const sample of ["still_life"]) await engine.post("open", {input: {sample}, tab: "tab1"});
  assert.equal((await picture(ids[1])).status, 200); // the newest document without a tab stays open
  const closed = await picture(ids[0]);
  assert.equal(closed.status, 409);
  assert.equal(JSON.parse(closed.body).error.kind, "closed");
});

// Fills a disk with one file in it, and returns the file's path.
function fill(disk) {
  const file = path.join(disk, "full"), to = openSync(file, "w");
  assert.throws(() => {
    for (;;) writeSync(to, Buffer.alloc(1024));
  }, {code: "ENOSPC"});
  closeSync(to);
  return file;
}

test("keeps what it has while the disk is full, and says so", async (t) => {
  const disk = path.join(folder, "disk"), states = path.join(disk, "state"), input = {path: scan};
  mkdirSync(disk);
  if (spawnSync("mount", ["-t", "tmpfs", "-o", "size=512k", "none", disk]).status !== 0)
    return t.skip("a disk that can be filled needs root and tmpfs");
  let other = await studioIn("disk/state");
  try {
    await other.open(input);
    const {document} = other;
    assert.equal((await keep(other, document, stateOf(input, 1, 1))).status, 200);
    const files = filesIn(states), filler = fill(disk), noRoom = /expected room to write the file, but the disk is full/;
    const large = stateOf(input, 2, 2);
    large.steps[0].note = "x".repeat(100000);
    const kept = await keep(other, document, large), refused = [{status: kept.status, ...JSON.parse(kept.body)},
      await other.upload("a.ply", readFileSync(scan))];
    for (const {status, error: {text}} of refused) {
      assert.equal(status, 500);
      assert.match(text, noRoom);
      assert.ok(!text.includes(disk), text);
    }
    assert.deepEqual(filesIn(states), files, "nothing is left of what was refused");
    assert.equal(await heightKept(other, input), 1);
    await other.stop("SIGKILL");
    other = await studioIn("disk/state");
    assert.equal(await heightKept(other, input), 1);
    rmSync(filler);
    assert.equal((await keep(other, document, large)).status, 200);
    assert.equal(await heightKept(other, input), 2);
  } finally {
    await other.stop();
    spawnSync("umount", [disk]);
  }
});
