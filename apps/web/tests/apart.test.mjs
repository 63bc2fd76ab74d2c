// Tests that a frame has the same pixels whether the same instance of the module solves and draws it, or one instance
// solves it and another one draws it.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import {pathToFileURL} from "node:url";
import {before, test} from "node:test";
import {Engine} from "../../../npm/src/engine.js";

const relievo = await import(pathToFileURL(path.join(process.env.PACKAGE ?? "build/web/npm", "src/index.js")));
const studioModule = process.env.MODULES?.split(":")[1] ?? path.resolve("build/web/apps/web/studio");
const SIZE = {width: 240, height: 180};
let solver, drawer;

// Opens a sample of few points. Returns its document.
async function open(sample) {
  solver.addFile(sample, await relievo.sample(sample, {points: 20000}));
  const input = {path: sample, name: sample}, {bytes} = solver.call("open", {input, tab: "test"});
  solver.call("work");
  return JSON.parse(new TextDecoder().decode(bytes)).document;
}

before(async () => {
  const module = await WebAssembly.compile(fs.readFileSync(studioModule));
  [solver, drawer] = [await Engine.create(module, () => {}), await Engine.create(module, () => {})];
});

// Returns the facts and the bytes of a frame that the instance `drawer` may draw.
function undrawn(request) {
  const {json, bytes} = solver.call("picture", {...request, apart: true});
  return {facts: json.facts, bytes};
}

function assertDrawnAlike(request) {
  const alone = solver.call("picture", request), apart = undrawn(request);
  assert.equal(apart.facts.is_undrawn, true);
  drawer.addFile("frame", apart.bytes);
  const {options: _, ...picture} = request, drawn = drawer.call("draw", picture);
  assert.ok(Buffer.from(drawn.bytes).equals(Buffer.from(alone.bytes)), JSON.stringify(request));
  for (const fact of ["width", "height", "pixels_per_mm"]) assert.equal(drawn.json.facts[fact], alone.json.facts[fact]);
  assert.equal(apart.facts.height_mm, alone.json.facts.height_mm);
  return drawn.bytes;
}

test("frames of several scans, heights, cameras and materials have the same pixels", async () => {
  const pictures = new Set();
  for (const sample of ["shell", "still_life"]) {
    const document = await open(sample);
    for (const change of [{}, {options: {height: 5}}, {fine: true}, {camera: {yaw: 30, pitch: 20}, material: "bronze"},
      {light: [1, 0, 1], options: {margin: 9, width: 50}}])
      pictures.add(Buffer.from(assertDrawnAlike({...SIZE, document, ...change})).toString("base64"));
  }
  assert.equal(pictures.size, 10);
});

test("surface and heights are sent only if the other instance does not have them", async () => {
  const document = await open("shell");
  const size = (change) => undrawn({...SIZE, document, ...change}).bytes.length, first = size({});
  const [other, same] = [size({options: {height: 3}}), size({options: {height: 3}, light: [1, 0, 1]})];
  assert.ok(other < first / 2 && same < other / 100, `${first}, ${other} and ${same} bytes`);
});

test("pictures that are no frames of a plate are drawn where they are solved", async () => {
  const document = await open("shell");
  for (const other of [{original: true}, {options: {rim: 1.5, outline: "circle"}}]) {
    const {facts, bytes} = undrawn({...SIZE, document, ...other});
    assert.equal(facts.is_undrawn, undefined);
    assert.equal(bytes.length, 4 * SIZE.width * SIZE.height);
  }
});
