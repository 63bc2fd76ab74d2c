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
  ["shell", { heightMm: 2, text: "LIBERTAS fi" }, ["--height", "2", "--text", "LIBERTAS fi"]],
  ["still_life", { heightMm: 2, diameterMm: 40, rimMm: 2, text: "ΔΗΜΟΣ", textArc: "top", textHeightMm: -0.3 },
    ["--height", "2", "--diameter", "40", "--rim", "2", "--text", "ΔΗΜΟΣ", "--text-arc", "top", "--text-height", "-0.3"]],
  ["shell", { heightMm: 2, diameterMm: 40, text: "СВОБОДА 1848", textArc: "around" },
    ["--height", "2", "--diameter", "40", "--text", "СВОБОДА 1848", "--text-arc", "around"]],
];

// Font files with TrueType outlines, joined letters, reordered letters, and PostScript outlines, and a text for each.
const NOTO = "/usr/share/fonts/truetype/noto", FONTS = [
  [`${NOTO}/NotoNaskhArabic-Regular.ttf`, "السلام عليكم ١٢"],
  [`${NOTO}/NotoSerifHebrew-Regular.ttf`, "שָׁלוֹם עולם"],
  [`${NOTO}/NotoSerifDevanagari-Regular.ttf`, "क्षत्रिय हिन्दी"],
  ["/usr/share/fonts/opentype/ebgaramond/EBGaramond12-Regular.otf", "Quem fiſte"],
  ["/usr/share/PrusaSlicer/fonts/NotoSansCJK-Regular.ttc", "自由民主"],
];

async function compare(t, scan, options, flags, files = {}) {
  const theirs = path.join(temporaryFolder(), "native.ply");
  run(native, ["make", scan, "-o", theirs, "--quiet", ...flags]);
  const ours = await relievo.make({ [path.basename(scan)]: new Uint8Array(fs.readFileSync(scan)), ...files }, options);
  t.diagnostic(`${path.basename(scan)}: ${ours.report.visible_points} visible points`);
  assert.ok(Buffer.from(ours.solid("ply")).equals(fs.readFileSync(theirs)), "the bytes differ");
}

const skip = native && fs.existsSync(native) ? false : "SKIPPED: the native program is not there; ./check web builds it";

for (const [name, options, flags] of SAMPLES)
  test(`${name} ${flags.join(" ")}`, { skip }, async (t) => {
    const scan = path.join(temporaryFolder(), `${name}.ply`);
    run(native, ["sample", name, "-o", scan, "--points", "60000"]);
    await compare(t, scan, options, flags);
  });

for (const [font, text] of FONTS.filter(([file]) => fs.existsSync(file)))
  test(`a text in ${path.basename(font)}`, { skip }, async (t) => {
    const scan = path.join(temporaryFolder(), "shell.ply"), name = path.basename(font);
    run(native, ["sample", "shell", "-o", scan, "--points", "20000"]);
    await compare(t, scan, { heightMm: 2, text, font: name }, ["--height", "2", "--text", text, "--font", font],
      { [name]: new Uint8Array(fs.readFileSync(font)) });
  });

const data = process.env.RELIEVO_SHARED_DATA;
const SCANS = [
  "armadillo", "bimba", "dragon", "falcon", "gargoyle", "gutenberg", "happy_buddha", "horse", "igea", "lion_takanawa",
  "nefertiti", "squirrel",
];
for (const name of data ? SCANS.filter((scan) => fs.existsSync(path.join(data, `${scan}.ply`))) : [])
  test(`the scan ${name}`, { skip }, (t) => compare(t, path.join(data, `${name}.ply`), { heightMm: 2 }, ["--height", "2"]));
