// Tests that errors name the file or the option, the position, and what was expected.
import assert from "node:assert/strict";
import { test } from "node:test";
import { relievo } from "./support.mjs";

const { make, sample, Session, RelievoError } = relievo;
const text = (lines) => new TextEncoder().encode(lines.join("\n") + "\n");

async function errorOf(work) {
  try {
    await work();
  } catch (error) {
    assert.ok(error instanceof RelievoError, error.stack);
    return error;
  }
  assert.fail("expected an error");
}

test("a broken file has its name, the place and what was expected", async () => {
  const broken = text(["ply", "format ascii 1.0", "element vertex 2", "property float x", "property float y",
    "property float z", "end_header", "1 2 3", "1 2 abc"]);
  const error = await errorOf(() => make({ "scan.ply": broken }));
  assert.equal(error.kind, "input");
  assert.equal(error.input, "scan.ply");
  assert.equal(error.place, "line 9");
  assert.match(error.message, /^scan\.ply, line 9: expected .*abc/);
});

test("broken pictures end in errors, not in the end of the engine", async () => {
  const png = new Uint8Array(200).fill(7);
  png.set([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13, 0x49, 0x48, 0x44, 0x52]);
  assert.equal((await errorOf(() => make({ "depth.png": png }))).kind, "input");
  const tiff = new Uint8Array(300).fill(255);
  tiff.set([0x49, 0x49, 0x2a, 0, 8, 0, 0, 0]);
  assert.equal((await errorOf(() => make({ "depth.tif": tiff }))).kind, "input");
});

test("a file of 3 GB that cannot be read by pieces is refused before it is read", async () => {
  let bytesRead = 0;
  const huge = { size: 3e9, read: (_, to) => { bytesRead += to.length; return to.length; } };
  const error = await errorOf(() => make({ "scan.obj": huge }));
  assert.match(error.message, /^scan\.obj: expected at most 2048 MiB/);
  assert.ok(bytesRead <= 2 ** 21, `${bytesRead} bytes were read`);
});

test("options have names and ranges", async () => {
  const cloud = await sample("shell", { points: 20000 });
  assert.match((await errorOf(() => make(cloud, { heigthMm: 2 }))).message, /^heigthMm: expected the name of an option, the nearest is heightMm$/);
  assert.match((await errorOf(() => make(cloud, { height: 2 }))).message, /, the nearest is heightMm$/);
  assert.match((await errorOf(() => make(cloud, { verbose: 2 }))).message, /^verbose: expected the name of an option$/);
  const range = await errorOf(() => make(cloud, { heightMm: -1 }));
  assert.equal(range.kind, "option");
  assert.equal(range.input, "heightMm");
  assert.equal((await errorOf(() => make(cloud, { heightMm: "two" }))).kind, "option");
  await assert.rejects(() => make("scan.ply"), TypeError);
});

test("numbers are finite, wherever they stand", async () => {
  const cloud = await sample("shell", { points: 20000 });
  for (const value of [NaN, Infinity, -Infinity])
    for (const keyword of ["heightMm", "steepestDeg", "points", "view", "streamAboveMb"]) {
      const error = await errorOf(() => make(cloud, { [keyword]: value }));
      assert.equal(error.kind, "option");
      assert.match(error.message, new RegExp(`expected a finite number, found ${value}$`));
    }
  await errorOf(() => make(cloud, { view: [1, NaN, 0] }));
  const relief = await make(cloud), session = await Session.open(cloud);
  await errorOf(() => relief.heightMap({ size: NaN }));
  await errorOf(() => relief.preview({ size: Infinity }));
  await errorOf(() => session.picture(session.frame(), { yawDeg: NaN }));
  await errorOf(() => sample("shell", { points: NaN }));
});

test("numbers may stand in arrays where the command line has commas", async () => {
  const cloud = await sample("shell", { points: 20000 });
  const bytes = async (options) => (await make(cloud, options)).solid("stl");
  assert.deepEqual(await bytes({ view: [1, 0, 3], tone: [[0, 1], [1, 0.5]], denoise: 0 }), await bytes({ view: "1,0,3", tone: "0,1;1,0.5", denoise: "0" }));
});

test("texts are refused in the words of the native program", async () => {
  const cloud = await sample("shell", { points: 20000 }), font = new Uint8Array(500).fill(7);
  for (const [options, message] of [
    [{ text: "aאb" }, "text: expected characters of the font inside, Noto Serif, found others: 'א' (U+05D0); font names another font"],
    [{ text: "a\nb" }, "text: expected one line of text, found a control character"],
    [{ text: " " }, "text: expected visible characters, found none"],
    [{ text: "a", font: "f.ttf" }, "font: expected a TrueType or OpenType font of at most 64 MiB, found 'f.ttf', which is none"],
    [{ text: "a", font: "g.ttf" }, /^g\.ttf: expected a file that can be read/]])
    assert.match((await errorOf(() => make({ "scan.ply": cloud, "f.ttf": font }, options))).message, typeof message === "string"
      ? new RegExp(`^${message.replace(/[()+]/g, "\\$&")}$`) : message);
});

test("bytes without a name are what they look like", async () => {
  const names = [["garbage\nnothing else", "scan.xyz"], ["v 0 0 0\nv 1 1\n", "scan.obj"], ["solid a\nfacet\n", "scan.stl"]];
  for (const [content, name] of names) assert.equal((await errorOf(() => make(text([content])))).input, name);
});

test("what the progress callback throws is thrown on", async () => {
  const cloud = await sample("shell", { points: 20000 }), mine = new Error("mine");
  await assert.rejects(() => make(cloud, { progress: () => { throw mine; } }), (error) => error === mine);
});

test("a cloud of more points than fit is read piece by piece", async () => {
  const side = 1800, head = new TextEncoder().encode("ply\nformat binary_little_endian 1.0\n" +
    `element vertex ${side * side}\nproperty float x\nproperty float y\nproperty float z\nend_header\n`);
  const bytes = new Uint8Array(head.length + 12 * side * side), view = new DataView(bytes.buffer);
  bytes.set(head);
  for (let i = 0, at = head.length; i < side * side; i++, at += 12) {
    const x = i % side, y = Math.floor(i / side);
    [x, y, 60 * Math.sin(x / 150) * Math.cos(y / 170)].forEach((value, k) => view.setFloat32(at + 4 * k, value, true));
  }
  const relief = await make({ "big.ply": bytes }, { points: 50000 });
  assert.match(relief.remarks.join("\n"), /big\.ply: \d+ points for the 3240000 of the file/);
});

test("progress names stages and cancels", async () => {
  const cloud = await sample("shell", { points: 20000 });
  const fractions = [];
  await make(cloud, { progress: (_, fraction) => { fractions.push(fraction); } });
  assert.ok(fractions.length > 5);
  assert.deepEqual(fractions, [...fractions].sort((a, b) => a - b));
  const error = await errorOf(() => make(cloud, { progress: (stage) => stage !== "normals" }));
  assert.equal(error.kind, "cancelled");
});

test("lengths may have units, and arrays are scans", async () => {
  const points = [], n = 120;
  for (let y = 0; y < n; y++) for (let x = 0; x < n; x++) points.push(x, y, 8 * Math.sin(x / 9) * Math.cos(y / 11));
  const relief = await make({ points }, { heightMm: "0.1in" });
  const rows = Array.from({ length: points.length / 3 }, (_, i) => points.slice(3 * i, 3 * i + 3));
  assert.deepEqual((await make({ points: rows }, { heightMm: "0.1in" })).solid("stl"), relief.solid("stl"));
  assert.ok(Math.abs(relief.report.height_mm - 2.54) < 1e-6);
  const { vertices, faces } = relief;
  const z = vertices.filter((_, i) => i % 3 === 2);
  assert.ok(faces.every((corner) => corner < vertices.length / 3));
  assert.ok(Math.min(...faces.subarray(0, 1000)) >= 0 && z.reduce((a, b) => Math.max(a, b), 0) > 2.54);
  const map = relief.heightMap({ size: 200 });
  assert.equal(Math.max(map.width, map.height), 200);
  assert.ok(Math.abs(map.heights.reduce((a, b) => Math.max(a, b), 0) - 2.54) < 0.2);
  const png = relief.heightMapFile("png", { dpi: 254, bits: 8, area: "relief", high: "black", zero: "ground" });
  const header = new DataView(png.buffer, png.byteOffset); // has width, height and bits of the PNG
  assert.deepEqual([header.getUint32(16), header.getUint32(20), header.getUint8(24)], [1000, 1000, 8]);
  assert.equal((await errorOf(async () => relief.heightMapFile("png", { dpi: 254, pixel: "0.1mm" }))).input, "dpi");
  const depths = new Float32Array(n * n).map((_, i) => 100 + points[3 * i + 2]);
  const fromDepths = await make({ depths, width: n, height: n }, { heightMm: 1, background: "keep" });
  assert.ok(Math.abs(fromDepths.report.height_mm - 1) < 1e-6);
});

test("a session makes frames, pictures and the relief of make()", async () => {
  const cloud = await sample("still_life", { points: 20000 });
  const session = await Session.open(cloud);
  const frame = session.frame({ heightMm: 3 });
  assert.ok(frame.isHeightMet && Math.abs(frame.heightMm - 3) < 0.1);
  assert.equal(frame.heights.length, session.pointCount);
  const { width, height, pixels } = session.picture(frame, { width: 320, height: 200 });
  assert.equal(pixels.length, 4 * width * height);
  frame.release();
  const relief = session.make({ heightMm: 3 });
  assert.deepEqual(relief.solid("stl"), (await make(cloud, { heightMm: 3 })).solid("stl"));
  const coins = await Session.open(cloud, { diameterMm: 40, rimMm: 1, heightMm: 3 });
  assert.deepEqual(coins.make({ heightMm: 2 }).solid("stl"),
    (await make(cloud, { diameterMm: 40, rimMm: 1, heightMm: 2 })).solid("stl"));
  assert.deepEqual(coins.make({ rimMm: null }).solid("stl"), (await make(cloud, { diameterMm: 40, heightMm: 3 })).solid("stl"));
  assert.equal((await errorOf(async () => coins.make({ baseImage: cloud }))).input, "baseImage");
});
