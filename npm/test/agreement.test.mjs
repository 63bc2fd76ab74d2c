// Reliefs in WebAssembly agree with those of the native program: the same triangles, heights within 1e-5 of the height.
// docs/web.md names the cases that do not agree.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { native, readPly, relievo, run, temporaryFolder } from "./support.mjs";

const SAMPLES = [
  ["shell", { heightMm: 2 }, ["--height", "2"]],
  ["still_life", { heightMm: 3, outline: "circle", draftDeg: 15 }, ["--height", "3", "--outline", "circle", "--draft", "15"]],
];

// Returns the solid as a set: each triangle by its corners, wherever the file begins it.
function shapeOf({ points, faces }) {
  const name = (i) => points[i].map((x) => x.toFixed(3)).join(" ");
  const names = points.map((_, i) => name(i));
  return { names: new Set(names), triangles: new Set(faces.map((face) => face.map((i) => names[i]).sort().join("|"))) };
}

// The corners that have no equal in `other` are compared with their neighbours there: rounding to a thousandth may differ.
function compare(ours, theirs, height) {
  assert.equal(ours.points.length, theirs.points.length);
  assert.equal(ours.faces.length, theirs.faces.length);
  const cell = ([x, y]) => `${Math.round(x * 500)} ${Math.round(y * 500)}`;
  const cells = new Map();
  for (const p of theirs.points) cells.has(cell(p)) ? cells.get(cell(p)).push(p) : cells.set(cell(p), [p]);
  let worst = 0;
  for (const [x, y, z] of ours.points) {
    let nearest = Infinity;
    for (const dx of [-1, 0, 1]) for (const dy of [-1, 0, 1])
      for (const p of cells.get(`${Math.round(x * 500) + dx} ${Math.round(y * 500) + dy}`) ?? [])
        nearest = Math.min(nearest, Math.max(Math.abs(p[0] - x), Math.abs(p[1] - y), Math.abs(p[2] - z)));
    worst = Math.max(worst, nearest);
  }
  assert.ok(worst <= 1e-5 * height, `corners differ by ${worst} mm`);
  const a = shapeOf(ours), b = shapeOf(theirs);
  if ([...a.names].every((name) => b.names.has(name))) {
    const other = [...a.triangles].filter((triangle) => !b.triangles.has(triangle)).length;
    assert.equal(other, 0, `${other} triangles differ`);
  }
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
const scans = data && fs.existsSync(data) ? ["bimba", "falcon", "igea", "squirrel", "gargoyle"] : [];
for (const name of scans.filter((scan) => fs.existsSync(path.join(data, `${scan}.ply`))))
  test(`the scan ${name}`, { skip }, (t) => compareScan(t, path.join(data, `${name}.ply`), { heightMm: 2 }, ["--height", "2"]));
