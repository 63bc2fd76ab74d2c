// Tests that pictures, the finished piece and its file have the same sizes.
import assert from "node:assert/strict";
import {test} from "node:test";
import {engine, scan, withEngine} from "./engine_suite.mjs";
import {readStl} from "./support.mjs";

const PICTURE = {width: 200, height: 150, light: [-1, 1, 1], material: "plaster", camera: {}};
const VIEW = {view: "front", height: 2, width: 40, margin: 2, thickness: 2, mode: "auto", method: "layered",
  resolution: 0.5};
const COIN = {...VIEW, outline: "circle", diameter: 40, width: 20, height: 1.6, rim: 1.5};
const PIECES = {
  plaque: VIEW,
  "round corners": {...VIEW, outline: "round", corner: 3},
  "circle without a rim": {...VIEW, outline: "circle"},
  "plate with a size": {...VIEW, plate: "60x50", shift: "3,-2"},
  "coin whose rim is as high as the relief": COIN,
  "coin with a low rim": {...COIN, "rim-height": 0.3},
  "coin with a draft angle": {...COIN, draft: 20, height: 1},
  "die of a coin": {...COIN, form: "die"},
  mirror: {...COIN, form: "mirror"},
  lithophane: {...VIEW, form: "lithophane", height: 2.4, thickness: 0.8},
  "thick lithophane": {...VIEW, form: "lithophane", height: 60, thickness: 0.8},
  "height out of reach": {...VIEW, height: 500},
  "mirrored height out of reach": {...VIEW, form: "mirror", height: 500},
  "draft angle that limits the height": {...VIEW, draft: 20, height: 30},
  "coin whose height is out of reach": {...COIN, height: 300},
  wave: {...VIEW, base: "wave:height=3,length=20"},
  bent: {...VIEW, wrap: "cylinder:turn=180"},
  "milled by a ball": {...VIEW, tool: "ball:2", finish: "reachable"},
  "no plate": {...VIEW, outline: "none"},
};

withEngine("still_life", 6000, async () => {
  await engine.open({path: scan});
  await engine.prepare({view: "front"});
});

async function picture(request) {
  const {status, headers, body} = await engine.post("picture", {...PICTURE, ...request});
  assert.equal(status, 200, String(body));
  return JSON.parse(headers["x-relievo"]);
}

const near = (a, b, within, text) =>
  assert.ok(a.every((x, i) => Math.abs(x - b[i]) <= within), `${text}: ${a} is not ${b}`);

// For these pieces, the size is known before the piece is finished, because they have no base, rim or wrap.
const LEVEL = ["plaque", "round corners", "circle without a rim", "plate with a size", "lithophane", "height out of reach"];

async function compare(name, options, extra = {}) {
  const quick = await picture({options, ...extra}), fine = await picture({options, fine: true, ...extra});
  const last = await picture({options, fine: true, finished: true, ...extra});
  assert.ok(last.is_finished && last.is_size_exact);
  const wanted = {...options, height: last.height_mm}; // the options with which the page requests the file
  const piece = await engine.json("piece", {options: wanted});
  const stl = readStl((await engine.post("export", {options: wanted, format: "stl"})).body);
  near(piece.size_mm, stl.size, 2e-5, "piece and file");
  near(last.size_mm, stl.size, 2e-5, "last picture and file");
  assert.equal(last.relief_height_mm, piece.height_mm);
  if (LEVEL.includes(name)) assert.ok(quick.is_size_exact && fine.is_size_exact);
  for (const picture of [quick, fine].filter(({is_size_exact: isExact}) => isExact))
    near(picture.size_mm, stl.size, 2e-5, "earlier picture and file");
  return last;
}

for (const [name, options] of Object.entries(PIECES)) test(`tells one size of a ${name}`, () => compare(name, options));

test("tells one size of a relief whose height is not locked", async () => {
  const {height_mm: height, is_height_met: isMet} = await compare("plaque", VIEW, {u: 3});
  assert.ok(isMet && height !== VIEW.height);
});

test("makes a lithophane of any height", async () => {
  const options = PIECES["thick lithophane"], {is_height_met: isMet, height_mm: height} = await picture({options});
  assert.deepEqual([isMet, height], [true, 60]);
});
