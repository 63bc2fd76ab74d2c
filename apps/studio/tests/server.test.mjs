// Sends requests to the server: those of its page, those of other sites, broken ones, and too many.
import assert from "node:assert/strict";
import {spawn} from "node:child_process";
import {existsSync, readFileSync, readdirSync, writeFileSync} from "node:fs";
import net from "node:net";
import path from "node:path";
import {test} from "node:test";
import {fileURLToPath} from "node:url";
import {PICTURE, OPTIONS, connect, engine, folder, head, scan, stillWorks, studioIn,
  withEngine} from "./engine_suite.mjs";
import {PROGRAM, readStl, run, sleep, temporaryFolder, writeSample} from "./support.mjs";

withEngine("shell", 20000);

const status = async (answer) => (await answer).status;
const facts = () => engine.json("facts");

// Returns the facts that come with a picture. `part` replaces parts of the usual request.
async function picture(part = {}) {
  const answer = await engine.post("picture", {...PICTURE, ...part});
  assert.equal(answer.status, 200, String(answer.body));
  return JSON.parse(answer.headers["x-relievo"]);
}
// Returns the shorter side of the relief's box divided by the longer side.
async function shape() {
  const {size} = await facts();
  return size[1] / size[0];
}

test("serves the page and nothing else", async () => {
  const page = await engine.get("");
  assert.equal(page.status, 200);
  const wanted = {"content-security-policy": /^default-src 'none'; .*frame-ancestors 'none'$/,
    "x-frame-options": /^DENY$/, "x-content-type-options": /^nosniff$/, "referrer-policy": /^no-referrer$/,
    "permissions-policy": /camera=\(\)/,
    "cross-origin-opener-policy": /^same-origin$/, "cross-origin-embedder-policy": /^require-corp$/,
    "cross-origin-resource-policy": /^same-origin$/, "cache-control": /^no-store$/};
  for (const answer of [page, await engine.get("gone.js"), await engine.request("/")])
    for (const [name, value] of Object.entries(wanted)) assert.match(answer.headers[name] ?? "", value, name);
  assert.equal(await status(engine.get("main.js")), 200);
  const wrong = ["gone.js", "../main.js", "../../etc/passwd", "%2e%2e/%2e%2e/etc/passwd", "..%2f..%2fetc%2fpasswd",
    "/etc/passwd", "main.js%00.css", "api/", "api/gone"];
  for (const name of wrong)
    assert.notEqual(await status(engine.get(name)), 200, name);
});

test("wants its token", async () => {
  const token = engine.url.pathname.slice(1, -1), wrong = token.replace(/.$/, (c) => (c === "0" ? "1" : "0"));
  const targets = ["/", "/main.js", `/${wrong}/`, `/${token.slice(0, -1)}/`, `/${token}x/`, "/api/about",
    `/x/${token}/`, "//", "*"];
  for (const target of targets)
    assert.ok([400, 403].includes(await status(engine.request(target))), target);
  assert.equal(await status(engine.request(`/${wrong}/api/picture`, {method: "POST", body: "{}"})), 403);
  assert.equal(await status(engine.request(`/${token}`)), 308);
});

test("refuses other hosts and origins", async () => {
  const {pathname, port} = engine.url;
  const hosts = ["evil.example", `evil.example:${port}`, "127.0.0.1", `127.0.0.1.evil.example:${port}`,
    "127.0.0.1:", "localhost:80x"];
  for (const Host of hosts)
    assert.ok([400, 403].includes(await status(engine.request(pathname, {headers: {Host}}))), Host);
  const origins = ["http://evil.example", "null", `https://127.0.0.1:${port}`, `http://127.0.0.1:${+port + 1}`,
    `http://127.0.0.1:${port}.evil.example`];
  for (const Origin of origins)
    assert.equal(await status(engine.post("picture", PICTURE, {headers: {Origin}})), 403, Origin);
  assert.equal(await status(engine.post("picture", PICTURE, {headers: {Origin: `http://127.0.0.1:${port}`}})), 200);
  assert.equal(await status(engine.request(pathname, {headers: {Host: `localhost:${port}`}})), 200);
  const tunnel = {Host: "localhost:9000", Origin: "http://localhost:9000"}; // a tunnel has another port
  assert.equal(await status(engine.post("picture", PICTURE, {headers: tunnel})), 200);
  assert.equal(await status(engine.post("picture", PICTURE, {headers: {...tunnel, Origin: "http://localhost:9001"}})), 403);
  const foreign = await engine.request(pathname, {headers: {Host: "evil.example"}});
  assert.ok(!foreign.body.toString().includes(pathname), "the token must not leak");
});

test("says how to reach it through ssh", async () => {
  const place = temporaryFolder(), args = ["studio", "--no-browser", "--state", place];
  const env = {...process.env, SSH_CONNECTION: "10.0.0.7 50000 10.0.0.9 2222", USER: "ada"};
  const child = spawn(PROGRAM, args, {env}), out = await new Promise((resolve) => {
    let text = "";
    child.stdout.on("data", (data) => (text += data).includes("ssh -N") && resolve(text));
  });
  const [, port] = out.match(/127\.0\.0\.1:(\d+)/);
  assert.ok(out.includes(`\n  ssh -N -L ${port}:127.0.0.1:${port} -p 2222 ada@10.0.0.9\n`), out);
  child.kill("SIGINT");
  await new Promise((resolve) => child.on("exit", resolve));
});

test("is not reached from other machines", async () => {
  const addresses = readFileSync("/proc/net/tcp", "utf8").split("\n").map((line) => line.trim().split(/\s+/)[1]);
  const port = Number(engine.url.port).toString(16).toUpperCase().padStart(4, "0");
  assert.ok(addresses.includes(`0100007F:${port}`));
  assert.ok(!addresses.includes(`00000000:${port}`));
});

test("refuses what is too large", async () => {
  const huge = {method: "POST", headers: {"Content-Length": String(5 * 2 ** 30)}};
  for (const action of ["picture", "upload"]) assert.equal(await rawStatus(action, huge.headers, ""), 413, action);
  assert.equal(await rawStatus("picture", {"Content-Length": String(5 * 2 ** 20)}, ""), 413);
  assert.ok([400, 413].includes(await rawStatus("picture", {"Transfer-Encoding": "chunked"}, chunks(5 * 2 ** 20))));
  assert.equal(await status(engine.request(engine.url.pathname + "x".repeat(600))), 414);
  assert.ok((await status(engine.request(engine.url.pathname + "x".repeat(20000)))) >= 400);
  assert.equal(await status(engine.post("picture", {...PICTURE, width: 8192, height: 8192})), 400);
  await stillWorks();
});

test("refuses malformed requests and says what was expected", async () => {
  const bodies = ["", "{", "[]", "null", "\"x\"", "{\"options\":", "\xff\xfe", "[".repeat(100000), "{\"options\": 3}"];
  for (const body of bodies)
    for (const action of ["picture", "export", "open", "document", "state", "project", "save", "profile", "scan"]) {
      const answer = await engine.post(action, Buffer.from(body, "latin1"));
      const isRefused = answer.status >= 400 && answer.status < 500;
      assert.ok(isRefused, `${action} ${body.slice(0, 20)} ${answer.status}`);
      assert.ok(JSON.parse(answer.body).error.text.length > 5);
    }
  const wrong = [{width: "wide"}, {width: -1}, {width: 1e9}, {material: "cheese"}, {material: 3}, {camera: []},
    {camera: {zoom: 0}}, {options: {heigth: 2}}, {options: {height: "2"}}, {options: {height: -1}},
    {options: {tone: "x"}}, {options: {view: 3}}, {u: -1}];
  for (const part of wrong) {
    const answer = await status(engine.post("picture", {...PICTURE, ...part}));
    assert.ok([400, 422].includes(answer), `${JSON.stringify(part)} ${answer}`);
  }
  assert.equal(await status(engine.post("export", {options: OPTIONS, format: "exe"})), 422);
  assert.equal(await status(engine.post("export", {options: {...OPTIONS, view: "left"}, format: "stl"})), 422);
  assert.equal(await status(engine.post("view", {view: "sideways"})), 422);
  assert.equal(await status(engine.request(engine.url.pathname, {method: "DELETE"})), 405);
  await stillWorks();
});

test("says what it expected in each field", async () => {
  const camera = {zoom: 0}, far = [1e9, 0], wrong = [
    ["picture", {camera}, "zoom: expected 0.05 to 100"], ["picture", {camera: {x: "far"}}, "x: expected a number"],
    ["picture", {camera: {y: 1e7}}, "x: expected x and y within a million mm"],
    ["picture", {width: 8192, height: 8192}, "width: expected a picture of at most eight million pixels"],
    ["picture", {light: [0, 0, 0]}, "light: expected three numbers, not all of them 0"],
    ["picture", {material: "cheese"}, "material: expected one of plaster, silver, bronze, walnut or porcelain, found"],
    ["picture", {u: -1}, "u: expected a number that is not negative"],
    ["profile", {from: 3}, "from: expected two numbers"],
    ["profile", {from: far, to: far}, "from: expected a place on the plate"],
    ["points", {places: 3}, "places: expected at most 1000 places"],
    ["points", {places: [[0, "x"]]}, "places: expected two numbers for each place"],
    ["scan", {towards: 3}, "towards: expected directions as three numbers"],
    ["export", {format: "heightmap", pixels: 3}, "pixels: expected a number from 16 to 16384"],
    ["export", {format: "heightmap", pixel: "3 parsecs"}, "pixel: expected a length from 0.001 to 100 mm"],
    ["export", {format: "heightmap", pixel: 3}, "pixel: expected a text"],
    ["export", {format: "heightmap", "heightmap-bits": "32"}, "heightmap-bits: expected 8 or 16 for a .png, found 32"],
    ["state", {state: 3}, "expected a state"],
    ["state", {document: "x", state: {}}, "document: expected the name of a document"],
    ["thumbnail", {thumbnail: "x"}, "expected a thumbnail"], ["picture", "[]", "body: expected an object in JSON"],
    ...["", "0".repeat(16), "../../etc/passwd"].map((document) => ["picture", {document}, "expected a document that is open"]),
    ["picture", {document: 3}, "expected fields of their types"],
    ["open", {input: {path: scan}, tab: 3}, "expected fields of their types"],
    ["save", {project: {input: {sample: "shell"}, options: {}}}, "expected a scan of one file"]];
  for (const [action, part, text] of wrong) {
    const answer = await engine.post(action, typeof part === "string" ? part : {...PICTURE, ...part});
    assert.ok(JSON.parse(answer.body).error.text.includes(text), `${action}: ${text}, not ${answer.body}`);
  }
  const multipart = {"Content-Type": "multipart/form-data; boundary=x"};
  const refused = await engine.post("upload", "--x--", {headers: multipart});
  assert.match(String(refused.body), /expected plain bytes or JSON/);
  const deleted = await engine.request(engine.url.pathname, {method: "DELETE"});
  assert.match(String(deleted.body), /expected GET or POST/);
});

// Returns all names of stages that the sources use in begin_stage(progress, "..."), progress.stage("...") and
// each("...").
function stagesInSources() {
  const root = fileURLToPath(new URL("../../..", import.meta.url)), stages = new Set(["waiting"]);
  for (const folder of ["src", "apps"])
    for (const name of readdirSync(path.join(root, folder), {recursive: true})) {
      if (!name.endsWith(".cpp")) continue;
      const text = readFileSync(path.join(root, folder, name), "utf8");
      for (const [, stage] of text.matchAll(/(?:begin_stage\(\s*&?\w+,|[.>]stage\(|[.]each\()\s*"([^"]+)"/g))
        stages.add(stage);
    }
  return [...stages];
}

test("names every stage for people", async () => {
  const {stages} = await engine.about(), found = stagesInSources();
  assert.ok(found.length >= 25, `${found}`);
  for (const stage of found) assert.match(stages[stage] ?? "", /^[A-Z].{5,}/, stage);
});

test("takes everything that the page offers to choose", async () => {
  const page = (await engine.get("index.html")).body.toString(), {options, materials} = await engine.about();
  const [, methods] = page.match(/<select id="method"[^>]*>(.*?)<\/select>/s);
  const offered = {method: [...methods.matchAll(/value="([^"]+)"/g)].map(([, value]) => value)};
  for (const {name, choices} of options) if (["outline", "form"].includes(name)) offered[name] = choices;
  for (const [name, values] of Object.entries(offered)) {
    assert.ok(values.length >= 2, name);
    for (const value of values) await picture({options: {...OPTIONS, [name]: value}});
  }
  for (const {id} of materials) await picture({material: id});
});

test("sends the views as it turns the model", async () => {
  for (const {name, towards, up} of (await engine.about()).views) {
    await engine.prepare({view: name});
    const {rotation} = await facts();
    const rows = [...rotation.slice(6), ...rotation.slice(3, 6)];
    assert.ok([...towards, ...up].every((x, i) => x === rows[i]), `${name}: ${towards} ${up} ${rows}`);
  }
  await engine.prepare({view: "front"});
});

test("finds the points of the model under places of its picture, in the coordinates of the scan", async () => {
  const file = path.join(folder, "bowl.xyz"), bowl = (x, y) => 300 + ((x - 100) ** 2 + (y - 200) ** 2) / 8, lines = [], {document} = engine;
  for (let i = 0; i <= 80; ++i)
    for (let j = 0; j <= 60; ++j) lines.push([100 + (i - 40) / 40, 200 + (j - 30) / 40]);
  writeFileSync(file, lines.map(([x, y]) => `${x} ${y} ${bowl(x, y)}`).join("\n"));
  await engine.open({path: file, name: "bowl.xyz"});
  for (const [up, place] of [["", (u, v) => [99 + 2 * u, 199.25 + 1.5 * v]], ["1,0,0", (u, v) => [99 + 2 * v, 200.75 - 1.5 * u]]]) {
    await engine.prepare({view: "front", up});
    const places = [[0.5, 0.5], [0.1, 0.8], [0.93, 0.22], [1.2, 0.5], [0.5, -3]];
    const {points} = await engine.json("points", {places});
    assert.deepEqual(points.slice(3), [null, null], "beside the model");
    for (const [i, [x, y, z]] of points.slice(0, 3).entries()) {
      const [wantedX, wantedY] = place(...places[i]);
      assert.ok(Math.hypot(x - wantedX, y - wantedY) < 1e-9, `${x} ${y} at ${places[i]}`);
      // The tolerance is the slope of the bowl times half a step of the grid.
      assert.ok(Math.abs(z - bowl(x, y)) < 0.006, `${z} is not ${bowl(x, y)}`);
    }
  }
  engine.document = document;
});

test("samples the tone curve and the paper's formula", async () => {
  const {delta} = await facts(), last = 80;
  const near = (found, wanted) => assert.ok(Math.abs(found - wanted) < 6e-4, `${found} is not ${wanted}`);
  const paper = await picture({options: {...OPTIONS, method: "paper", saturation: 0.5}});
  const even = await picture({options: {...OPTIONS, saturation: 0}});
  const drawn = await picture({options: {...OPTIONS, tone: "0,0.2;0.5,0.4;1,0.9"}});
  for (let i = 0; i <= last; ++i) {
    const power = Math.sqrt((i / last) ** 2 / delta);
    near(paper.curve.share[i], 1 - Math.exp(-power));
    near(paper.curve.kept[i], 1 - Math.exp(-paper.u * power));
    near(even.curve.share[i], 1);
    assert.ok(i === 0 || drawn.curve.share[i] >= drawn.curve.share[i - 1]);
  }
  for (const [i, share] of [[0, 0.2], [40, 0.4], [80, 0.9]]) near(drawn.curve.share[i], share);
  assert.deepEqual(drawn.curve.kept, drawn.curve.share);
});

test("meets the height at rest in pictures of any size", async () => {
  const wanted = {options: {...OPTIONS, height: 3.3}, fine: true}, exact = await picture(wanted);
  await picture({options: {...OPTIONS, height: 1}}); // the next search begins far from its result
  const large = await picture({...wanted, width: 2000, height: 1500});
  assert.ok(Math.abs(large.u / exact.u - 1) < 3e-3, `${large.u} is not ${exact.u}`);
});

test("tells the size of the piece, and cuts the piece that the file will be", async () => {
  const plain = await picture();
  assert.deepEqual(plain.size_mm.map((mm) => mm.toFixed(1)), ["70.0", (60 * (await shape()) + 10).toFixed(1), "5.0"]);
  assert.equal(plain.most_width_mm, null);
  const coin = {height: 2, view: "front", outline: "circle", diameter: 80, rim: 3, "rim-height": 1.5};
  const {size_mm: size, width_mm: width, most_width_mm: most, relief_mm: relief} =
    await picture({options: coin, fine: true});
  assert.deepEqual(size.slice(0, 2).map((mm) => mm.toFixed(6)), ["80.000000", "80.000000"]);
  assert.equal(width, most);
  for (const [x, y] of [relief[0], relief[1]]) assert.ok(Math.hypot(x, y) < 40 * Math.SQRT2, `${x} ${y}`);
  assert.ok(Math.abs(Math.max(relief[1][0] - relief[0][0], relief[1][1] - relief[0][1]) - width) < 0.01);
  const line = {from: [-40.5, 0], to: [40.5, 0]};
  const {heights_mm: heights} = await engine.json("profile", {...PICTURE, options: coin, ...line});
  assert.equal(heights.length, 400);
  const at = (mm) => heights[Math.round((mm + 40.5) / 81 * 399)];
  for (const mm of [-39, 39]) assert.ok(Math.abs(at(mm) - 1.5) < 1e-3, `rim ${at(mm)}`);
  for (const mm of [-36, 36]) assert.ok(Math.abs(at(mm)) < 1e-3, `ground ${at(mm)}`);
  for (const mm of [-40.5, 40.5]) assert.ok(at(mm) <= -3 + 1e-3, `beside the coin ${at(mm)}`);
  assert.ok(Math.max(...heights) <= 2.01 && Math.max(...heights) > 1.6, `${Math.max(...heights)}`);
  const wide = await engine.post("picture", {...PICTURE, options: {...coin, width: most + 1}});
  assert.equal(wide.status, 422);
  assert.match(String(wide.body), /width: expected at most [\d.]+ mm, which the plate leaves/);
});

test("makes a picture once", async () => {
  const options = {...OPTIONS, saturation: 0.7};
  assert.ok((await picture({options, fine: true})).solves >= 1);
  assert.equal((await picture({options, fine: true})).solves, 0);
  assert.equal((await picture({options, light: [1, 0, 1]})).solves, 0);
  assert.equal((await picture({options: {...options, height: 2.1}})).solves, 1);
});

test("gives up a fine picture when another is asked for", async () => {
  const large = {...PICTURE, width: 1600, height: 1500, fine: true};
  assert.equal((await engine.post("picture", large)).status, 200);
  const fine = engine.post("picture", {...large, light: [1, 0, 1]});
  await sleep(50); // drawing the fine picture takes several times longer than this
  assert.equal((await engine.post("picture", PICTURE)).status, 200);
  const {status, body} = await fine; // not the status of an error, since browsers log errors in their console
  assert.deepEqual([status, JSON.parse(body).error.kind], [202, "cancelled"]);
  assert.equal((await engine.post("picture", large)).status, 200);
});

test("takes a view that is chosen while the scan is read", async () => {
  const input = {sample: "still_life", name: "still_life"}, {document} = await engine.json("open", {input});
  await engine.post("view", {document, view: "left"});
  engine.document = document;
  const status = await engine.untilIdle();
  assert.equal(status.input.sample, "still_life");
  assert.equal(status.requested.view, "left");
  assert.equal((await facts()).rotation[6], -1);
  await engine.open({path: scan});
});

test("crops a scan as seen", async () => {
  const crop = "0,0,0.5,1", before = await facts();
  const {requested} = await engine.prepare({view: "front", crop}), {size} = await facts();
  assert.equal(requested.crop, crop);
  assert.ok(Math.abs(size[0] / before.size[0] - 0.5) < 0.1, `${size} of ${before.size}`);
  const wrong = await engine.post("view", {view: "front", crop: "0,0,1"});
  assert.equal(wrong.status, 422);
  await engine.prepare({view: "front"});
});

test("shows the pixels of a depth image, and no other scan", async () => {
  const none = await engine.post("pixels");
  assert.equal(none.status, 409);
  assert.match(String(none.body), /expected a depth image to be open/);
  assert.equal((await facts()).depth_image, null);
  assert.equal((await engine.post("view", {view: "front", "depth-values": "deep"})).status, 422);
});

test("removes as much noise as is measured or asked for", async () => {
  const measured = (await facts()).noise;
  assert.equal((await engine.prepare({view: "front", denoise: "0.6"})).requested.denoise, "0.6");
  assert.equal((await facts()).noise, 0.6);
  assert.equal((await engine.post("view", {view: "front", denoise: "much"})).status, 422);
  await engine.prepare({view: "front"});
  assert.equal((await facts()).noise, measured);
});

test("keeps a document as it is while the opening of another is cancelled", async () => {
  const before = await engine.json("status");
  const {document} = await engine.json("open", {input: {sample: "green_man", name: "green_man"}});
  await engine.post("cancel", {document});
  const now = await engine.until(undefined, document);
  assert.equal(now.error.kind, "cancelled");
  assert.equal(now.model, 0);
  assert.deepEqual(await engine.json("status"), before);
  await stillWorks();
  await engine.prepare({view: "left"});
  assert.equal((await facts()).input_points, 20000);
  await engine.prepare({view: "front"});
});

// Copies a generated scan with all vectors rotated about x, so that z points up instead of y, as in the files of many
// scanners.
function writeUpright(scan, file) {
  const bytes = readFileSync(scan);
  const start = bytes.indexOf("end_header\n") + "end_header\n".length;
  for (let at = start; at < bytes.length; at += 12) { // each position and each normal has three floats
    const [y, z] = [bytes.readFloatLE(at + 4), bytes.readFloatLE(at + 8)];
    bytes.writeFloatLE(-z, at + 4);
    bytes.writeFloatLE(y, at + 8);
  }
  writeFileSync(file, bytes);
}

test("finds the face of a scan, and sets it upright, whichever way the scanner held it", async () => {
  const face = path.join(folder, "face.ply"), turned = path.join(folder, "turned_face.ply"), found = [];
  writeSample("green_man", 20000, face);
  writeUpright(face, turned);
  for (const scan of [face, turned]) {
    const {document} = await engine.json("open", {input: {path: scan}, view: "auto"});
    engine.document = document;
    found.push({view: (await engine.untilIdle()).requested.view, ...await facts()});
  }
  assert.equal(found[0].view, "front");
  assert.equal(found[1].view, "bottom");
  assert.deepEqual(found[1].rotation.map(Math.abs), [1, 0, 0, 0, 0, 1, 0, 1, 0]);
  assert.equal(found[1].rotation[5], 1); // the scan's upward axis also points up on the relief
  for (const i of [0, 1]) assert.ok(Math.abs(found[1].size[i] / found[0].size[i] - 1) < 0.01, `${found[1].size}`);
  await engine.open({path: scan});
});

test("stops at the stage at which it is cancelled", async () => {
  const large = path.join(folder, "large.ply");
  writeSample("shell", 300000, large);
  const stages = ["waiting", "read", "view", "spacing", "normals", "visible points", "curvature", "triangulation"];
  for (const stage of ["spacing", "normals", "curvature"]) {
    const {document} = await engine.json("open", {input: {path: large}, view: "left"}), at = stages.indexOf(stage);
    await engine.until(({busy, stage}) => !busy || stages.indexOf(stage) >= at, document, 0);
    await engine.post("cancel", {document});
    const now = await engine.until(undefined, document);
    assert.deepEqual([now.error?.kind, now.model], ["cancelled", 0]);
    assert.ok([stage, stages[at + 1]].includes(now.stage), `${now.stage} after ${stage}`);
  }
  await stillWorks();
});

test("opens scenes, and exports what make makes of them", async () => {
  const scene = path.join(folder, "scene.json"), out = path.join(folder, "scene.stl");
  writeFileSync(scene, JSON.stringify({models: [
    {file: "scan.ply", translate: [0, 0, 0]}, {file: "scan.ply", rotate: [0, 60, 0], translate: [0.5, 0, -1]}]}));
  await engine.open({path: scene});
  await stillWorks();
  const exported = await engine.post("export", {options: OPTIONS, format: "stl"});
  assert.equal(exported.status, 200, String(exported.body));
  run("make", scene, "-o", out, "--width", 60, "--height", 2, "--quiet");
  assert.ok(readFileSync(out).equals(exported.body));
  await engine.open({path: scan});
});

test("keeps dropped files inside its folder", async () => {
  const bytes = readFileSync(scan);
  for (const name of ["../../../escape.ply", "/tmp/escape.ply", "..", "a\\..\\b.ply", "x\u0000y.ply", ""]) {
    const {status, input} = await engine.upload(name, bytes);
    assert.equal(status, 200, name);
    assert.ok(input.path.startsWith(path.join(folder, "state", "scans")), name);
  }
  assert.ok(!existsSync(path.join(folder, "escape.ply")) && !existsSync("/tmp/escape.ply"));
});

test("answers a thousand requests at once", async () => {
  const ask = (_, i) => status(i % 2 ? engine.post("picture", PICTURE) : engine.get("api/about"));
  const answers = await Promise.all(Array.from({length: 1000}, ask));
  assert.ok(answers.every((answer) => answer === 200 || answer === 503), [...new Set(answers)].join());
  assert.ok(answers.filter((answer) => answer === 200).length >= 500);
  await stillWorks();
});

test("survives a page that closes during an export, and half a request", async () => {
  for (let i = 0; i < 20; ++i) await cut("export", JSON.stringify({options: OPTIONS, format: "stl"}), i * 15);
  await cut("upload?name=x.ply", "", 10, 1000);
  await stillWorks();
});

test("exports the very bytes that make writes", async () => {
  const options = {
    ...OPTIONS, saturation: 0.3, detail: 0.05, tone: "0,0.2;0.6,0.5;1,0.9", steepest: 60, boundary: 4, margin: 2,
    thickness: 1.5, form: "mirror", resolution: 0.2, tolerance: 0.02, triangles: 900000, draft: 40,
  };
  const project = path.join(folder, "p.relievo");
  writeFileSync(project, JSON.stringify({relievo: 1, input: {path: "scan.ply"}, options}));
  for (const format of ["stl", "3mf", "ply", "obj"]) {
    const file = path.join(folder, `out.${format}`);
    run("make", project, "-o", file);
    const exported = (await engine.post("export", {options, format})).body;
    assert.ok(exported.equals(readFileSync(file)), format);
    if (format === "stl") assert.ok(readStl(exported).isClosed);
  }
});

test("exports a picture in the material that is shown", async () => {
  const export_ = (part) => engine.post("export", {options: OPTIONS, format: "preview", ...part});
  const made = path.join(folder, "made.png"), {width, height} = OPTIONS;
  run("make", scan, "-o", path.join(folder, "made.stl"), "--preview", made, "--width", width, "--height", height,
    "--view", "front");
  const plaster = (await export_({})).body, bronze = (await export_({material: "bronze"})).body;
  assert.ok(plaster.equals(readFileSync(made)));
  assert.ok(!bronze.equals(plaster));
  const wrong = await export_({material: "lead"});
  assert.equal(wrong.status, 422);
  assert.match(String(wrong.body), /expected one of plaster, silver, bronze, walnut or porcelain, found 'lead'/);
});

test("opens a mesh and looks at it from where the view is", async () => {
  const [mesh, project, out] = ["mesh.stl", "mesh.relievo", "again.stl"].map((name) => path.join(folder, name));
  run("make", scan, "-o", mesh, "--height", 6);
  const other = await studioIn("mesh");
  await other.open({path: mesh});
  const texts = (await other.json("facts")).remarks.map(({text}) => text);
  assert.match(texts.join("\n"), /^The points are taken from a mesh of \d+ triangles: with fewer points from meshes, below,/m);
  const options = {...OPTIONS, view: "1,0.5,2", height: 1, width: 20, mode: "auto"};
  await other.prepare({view: options.view});
  writeFileSync(project, JSON.stringify({relievo: 1, input: {path: "mesh.stl"}, options}));
  run("make", project, "-o", out);
  const exported = await other.post("export", {options, format: "stl"});
  assert.equal(exported.status, 200, String(exported.body));
  assert.ok(exported.body.equals(readFileSync(out)));
  await other.stop();
});

test("shows a mesh of few corners without holes while a view is chosen", async () => {
  const cube = path.join(folder, "cube.obj");
  const faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"];
  const corners = Array.from({length: 8}, (_, i) => `v ${i & 1} ${i >> 1 & 1} ${i >> 2}`);
  writeFileSync(cube, [...corners, ...faces.map((face) => `f ${face}`)].join("\n"));
  const other = await studioIn("cube");
  await other.open({path: cube});
  const size = 120, {status, body} = await other.post("scan",
    {width: size, height: size, towards: [1, 1, 1], up: [0, 1, 0], options: OPTIONS});
  assert.equal(status, 200, String(body).slice(0, 200));
  const opaque = (x, y) => body[4 * (y * size + x) + 3] > 0;
  for (let i = -20; i <= 20; ++i)
    assert.ok(opaque(size / 2 + i, size / 2) && opaque(size / 2, size / 2 + i), `at ${i}`);
  await other.stop();
});

test("ends when the last page has gone, and not before", async () => {
  const short = await studioIn("short", "--linger", "1");
  const page = net.connect(short.url.port, "127.0.0.1");
  page.write(`${head("api/events", "GET", short.url)}\r\n`);
  await new Promise((resolve) => page.once("data", resolve));
  await sleep(1500);
  assert.equal(short.child.exitCode, null);
  page.destroy();
  assert.deepEqual(await short.ended, {code: 0, signal: null});
});

test("ends with Ctrl-C", async () => {
  const other = await studioIn("other");
  assert.deepEqual(await other.stop("SIGINT"), {code: null, signal: "SIGINT"});
});

function chunks(size) {
  const part = "x".repeat(65536);
  return `${part.length.toString(16)}\r\n${part}\r\n`.repeat(size / part.length + 1) + "0\r\n\r\n";
}

// Sends a request with headers that Node would not send. Returns the status of the answer.
function rawStatus(action, headers, body) {
  return new Promise((resolve, reject) => {
    const socket = connect();
    const lines = Object.entries(headers).map(([name, value]) => `${name}: ${value}\r\n`).join("");
    socket.write(`${head(`api/${action}`)}${lines}\r\n${body}`);
    let text = "";
    socket.on("data", (data) => {
      text += data;
      const found = text.match(/^HTTP\/1\.1 (\d+)/);
      if (found) {
        resolve(Number(found[1]));
        socket.destroy();
      }
    });
    socket.on("error", (error) => {
      if (!text) ["EPIPE", "ECONNRESET"].includes(error.code) ? resolve(400) : reject(error);
    });
    socket.on("close", () => resolve(text ? 0 : 400));
  });
}

// Sends a request whose header announces `promised` bytes, and closes the connection `ms` later.
function cut(action, body, ms, promised = body.length) {
  return new Promise((resolve) => {
    const socket = connect();
    socket.write(`${head(`api/${action}`)}Content-Length: ${promised}\r\n\r\n${body}`);
    setTimeout(() => {
      socket.destroy();
      resolve();
    }, ms);
  });
}

// After a change of the view, the first turn of a mesh takes longer than a picture, since it samples points on all
// sides of the mesh.
test("draws while the model is turned, and gives up a turn when another comes", async () => {
  const mesh = path.join(folder, "mesh.ply");
  run("make", scan, "-o", mesh, "--height", 4, "--width", 60, "--quiet");
  const input = {path: mesh}, {document} = await engine.json("open", {input, tab: "turning", points: 20000});
  const untilIdle = () => engine.until(({model, busy}) => model > 0 && !busy, document);
  await untilIdle();
  await engine.post("view", {document, view: "left", points: 20000}); // the first turn must sample points on all sides
  await untilIdle();
  const order = [], ask = async (name, part) => {
    const answer = await engine.post("picture", {...PICTURE, document, ...part});
    order.push(name);
    return answer.status;
  };
  const turned = (x) => ({turned: {towards: [x, 0.1, 1], up: [0, 1, 0]}});
  assert.equal(await ask("shown", {}), 200); // makes the next picture fast
  order.length = 0;
  const first = ask("first turn", turned(0.3));
  await sleep(150); // by then the turn has begun
  const shown = ask("shown", {}), second = ask("second turn", turned(0.4));
  assert.deepEqual([await first, await shown, await second], [202, 200, 200]);
  assert.ok(order.indexOf("shown") < order.indexOf("second turn"), `${order}`);
  assert.equal(await ask("second turn again", turned(0.4)), 200);
});
