// Reliefs in WebAssembly agree with those of the native program: the same triangles, heights within 1e-5 of the height.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { native, readPly, relievo, run, temporaryFolder } from "./support.mjs";

const SAMPLES = [
  ["shell", { heightMm: 2 }, ["--height", "2"]],
  ["still_life", { heightMm: 3, outline: "circle", draftDeg: 15 }, ["--height", "3", "--outline", "circle", "--draft", "15"]],
  ["still_life", { heightMm: 2, base: "dome" }, ["--height", "2", "--base", "dome"]],
  ["shell", { heightMm: 2, wrap: "cylinder" }, ["--height", "2", "--wrap", "cylinder"]],
];

const CELL = 0.002; // mm

// Returns for each point of `ours` the number of the nearest one of `theirs`, and the largest distance along an axis.
function matched(ours, theirs) {
  const cell = (x) => Math.round(x / CELL), cells = new Map(), numbers = [];
  theirs.forEach(([x, y], i) => {
    const name = `${cell(x)} ${cell(y)}`;
    cells.has(name) ? cells.get(name).push(i) : cells.set(name, [i]);
  });
  let worst = 0;
  for (const [x, y, z] of ours) {
    let nearest = Infinity, number = -1;
    for (const dx of [-1, 0, 1]) for (const dy of [-1, 0, 1])
      for (const i of cells.get(`${cell(x) + dx} ${cell(y) + dy}`) ?? []) {
        const p = theirs[i], away = Math.max(Math.abs(p[0] - x), Math.abs(p[1] - y), Math.abs(p[2] - z));
        if (away < nearest) [nearest, number] = [away, i];
      }
    numbers.push(number);
    worst = Math.max(worst, nearest);
  }
  return { numbers, worst };
}

// Returns the triangles as texts, wherever the file begins each.
function namesOf(faces) {
  return faces.map(([a, b, c]) => (a < b && a < c ? [a, b, c] : b < c ? [b, c, a] : [c, a, b]).join(" "));
}

// The order of points and triangles may differ, since corners that are equal but for their last digit may change places.
function compare(ours, theirs, height) {
  assert.equal(ours.points.length, theirs.points.length);
  assert.equal(ours.faces.length, theirs.faces.length);
  const { numbers, worst } = matched(ours.points, theirs.points);
  assert.ok(worst <= 1e-5 * height, `corners differ by ${worst} mm`);
  assert.equal(new Set(numbers).size, numbers.length, "each corner has one of its own");
  const known = new Set(namesOf(theirs.faces));
  const other = namesOf(ours.faces.map((face) => face.map((i) => numbers[i]))).filter((name) => !known.has(name)).length;
  assert.equal(other, 0, `${other} triangles differ`);
  return worst;
}

async function compareScan(t, scan, options, flags) {
  const folder = temporaryFolder(t);
  const ours = await relievo.make(new Uint8Array(fs.readFileSync(scan)), { ...options, name: path.basename(scan) });
  run(native, ["make", scan, "-o", path.join(folder, "native.ply"), "--threads", "1", "--quiet", ...flags]);
  const worst = compare(readPly(ours.solid("ply")), readPly(fs.readFileSync(path.join(folder, "native.ply"))), ours.report.height_mm);
  t.diagnostic(`${path.basename(scan)}: ${ours.report.visible_points} points, largest difference ${worst} mm`);
}

const skip = native && fs.existsSync(native) ? false : "SKIPPED: the native program is not there; ./check web builds it";

for (const [name, options, flags] of SAMPLES)
  test(`${name} ${flags.join(" ")}`, { skip }, async (t) => {
    const folder = temporaryFolder(t), scan = path.join(folder, `${name}.ply`);
    run(native, ["sample", name, "-o", scan, "--points", "60000"]);
    assert.deepEqual(Buffer.from(await relievo.sample(name, { points: 1000 })).subarray(0, 3).toString(), "ply");
    await compareScan(t, scan, options, flags);
  });

const data = process.env.RELIEVO_SHARED_DATA;
const SCANS = ["armadillo", "bimba", "falcon", "gargoyle", "gutenberg", "horse", "igea", "nefertiti", "squirrel"];
for (const name of data ? SCANS.filter((scan) => fs.existsSync(path.join(data, `${scan}.ply`))) : [])
  test(`the scan ${name}`, { skip }, (t) => compareScan(t, path.join(data, `${name}.ply`), { heightMm: 2 }, ["--height", "2"]));
