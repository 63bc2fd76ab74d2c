// Tests what the page computes with strokes: it simplifies, cuts and packs them.
import assert from "node:assert/strict";
import {test} from "node:test";
import {pageModule} from "./support.mjs";

const {erased, packed, simplified, strokesOf, textOf, unpacked} = await pageModule("strokes.js");

// Returns `count` points of a wavy line in space.
const wave = (count) => Array.from({length: count}, (_, i) =>
  [i / 10, Math.sin(i * 0.37), 0.3 * Math.cos(i * 0.71)]);

const along = (a, b, t) => a.map((x, i) => x + t * (b[i] - x));
const apart = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

// Returns densely spaced points on a line.
const placesOn = (line) => line.length === 1 ? line : line.slice(1).flatMap((b, i) =>
  Array.from({length: 51}, (_, k) => along(line[i], b, k / 50)));
const distanceTo = (places, place) => Math.min(...places.map((p) => apart(p, place)));

test("simplifies a line within the tolerance, and keeps its ends", () => {
  const line = wave(60);
  for (const tolerance of [0.01, 0.1, 0.5]) {
    const few = simplified(line, tolerance);
    assert.ok(few.length < line.length && few.every((point) => line.includes(point)));
    assert.deepEqual([few[0], few.at(-1)], [line[0], line.at(-1)]);
    const places = placesOn(few);
    for (const place of placesOn(line)) assert.ok(distanceTo(places, place) <= tolerance + 0.02, `${place}`);
  }
  assert.deepEqual(simplified([[1, 2, 3]], 1), [[1, 2, 3]]);
  assert.deepEqual(simplified([[0, 0, 0], [1, 0, 0], [2, 0, 0]], 0), [[0, 0, 0], [2, 0, 0]]);
});

test("erases exactly what is within the radius", () => {
  const line = wave(30), radius = 0.4, strokes = [{name: "a", brush: "raise", amount: 1, radius: 1, points: line}];
  for (const point of [[1.5, 0, 0], [0, 0, 0], [2.9, -1, 0], [1, 0.9, 0.2], [0.3, 5, 0]]) {
    const left = erased(strokes, point, radius);
    const places = left.flatMap(({points}) => placesOn(points));
    for (const place of placesOn(line)) {
      const isLeft = distanceTo(places, place) < 0.02;
      const isOutside = apart(place, point) - radius;
      assert.ok(Math.abs(isOutside) < 0.03 || isLeft === isOutside > 0, `${place} beside ${point}: ${isLeft}`);
    }
    for (const {brush, points} of left) assert.ok(brush === "raise" && points.length > 1);
  }
  assert.deepEqual(erased(strokes, [0, 9, 0], radius), strokes);
  const [first, second] = erased([{...strokes[0], points: [[0, 0, 0], [4, 0, 0]]}], [2, 0, 0], 1);
  assert.deepEqual([first.points, second.points], [[[0, 0, 0], [1, 0, 0]], [[3, 0, 0], [4, 0, 0]]]);
  assert.deepEqual([first.name, second.name], ["a", "a, part 2"]);
  const dab = [{...strokes[0], points: [[1, 0, 0]]}];
  assert.deepEqual([erased(dab, [1.3, 0, 0], radius), erased(dab, [1.5, 0, 0], radius)], [[], dab]);
});

test("erases lassos and regions as a whole, at their edge or point", () => {
  const lasso = {area: "lasso", points: [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]};
  const region = {area: "region", points: [[9, 9, 0]]};
  for (const [point, left] of [[[2, 2, 0], [lasso, region]], [[0, 2, 0], [region]], [[4, 1, 0], [region]],
    [[9, 9.5, 0], [lasso]]])
    assert.deepEqual(erased([lasso, region], point, 1), left);
});

test("keeps each stroke once, however many steps have it", () => {
  const strokes = Array.from({length: 40}, (_, i) => ({name: `Soften ${i}`, radius: i + 0.125, points: wave(9)}));
  const steps = strokes.map((_, i) => ({u: i, options: {height: 3, strokes: textOf(strokes.slice(0, i))}}));
  const kept = JSON.parse(JSON.stringify(packed(steps)));
  assert.deepEqual(kept.steps.map((step) => ({...step, options: unpacked(step.options, kept.strokes)})), steps);
  assert.ok(JSON.stringify(kept).length < 0.1 * JSON.stringify(steps).length);
  for (const text of ["", "strokes.json", "{}"]) {
    const step = {options: {strokes: text}};
    assert.deepEqual([strokesOf(step), packed([step])], [[], {steps: [step]}]);
  }
  assert.deepEqual(unpacked({height: 3}), {height: 3});
});
