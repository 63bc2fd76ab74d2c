// Tests that WebAssembly and the native program make solids with the same bytes.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { native, relievo, run, temporaryFolder } from "./support.mjs";

const SAMPLES = [
  ["shell", { heightMm: 2 }, ["--height", "2"]],
  ["still_life", { heightMm: 3, outline: "circle", draftDeg: 15 }, ["--height", "3", "--outline", "circle", "--draft", "15"]],
  ["still_life", { heightMm: 2, base: "dome" }, ["--height", "2", "--base", "dome"]],
  ["shell", { heightMm: 2, wrap: "cylinder" }, ["--height", "2", "--wrap", "cylinder"]],
];

async function compare(t, scan, options, flags) {
  const theirs = path.join(temporaryFolder(t), "native.ply");
  run(native, ["make", scan, "-o", theirs, "--quiet", ...flags]);
  const ours = await relievo.make(new Uint8Array(fs.readFileSync(scan)), { ...options, name: path.basename(scan) });
  t.diagnostic(`${path.basename(scan)}: ${ours.report.visible_points} visible points`);
  assert.ok(Buffer.from(ours.solid("ply")).equals(fs.readFileSync(theirs)), "the bytes differ");
}

const skip = native && fs.existsSync(native) ? false : "SKIPPED: the native program is not there; ./check web builds it";

for (const [name, options, flags] of SAMPLES)
  test(`${name} ${flags.join(" ")}`, { skip }, async (t) => {
    const scan = path.join(temporaryFolder(t), `${name}.ply`);
    run(native, ["sample", name, "-o", scan, "--points", "60000"]);
    await compare(t, scan, options, flags);
  });

const data = process.env.RELIEVO_SHARED_DATA;
const SCANS = [
  "armadillo", "bimba", "dragon", "falcon", "gargoyle", "gutenberg", "happy_buddha", "horse", "igea", "lion_takanawa",
  "nefertiti", "squirrel",
];
for (const name of data ? SCANS.filter((scan) => fs.existsSync(path.join(data, `${scan}.ply`))) : [])
  test(`the scan ${name}`, { skip }, (t) => compare(t, path.join(data, `${name}.ply`), { heightMm: 2 }, ["--height", "2"]));
