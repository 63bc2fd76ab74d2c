// Shows the scale of the picture: a bar of a round length in the picture's corner. While the user measures or moves the
// figure, shows rulers along the picture's edges instead, which start at the lower left corner of the piece.

import {make, scaleOfType} from "../controls.js";
import {millimetresPerUnit, shortLength, shown} from "../lengths.js";

const BAR = 150; // greatest length of the bar in pixels, at the usual font size
const APART = 64, FINE = 6; // least distance in pixels between the numbers of a ruler, and between its strokes
const EDGE = 14, STROKE = 5;

// Returns the largest length, in mm, that does not exceed `mm` and is 1, 2, 5, 10 ... in the page's unit.
function roundBelow(mm) {
  const units = mm / millimetresPerUnit(), power = 10 ** Math.floor(Math.log10(units));
  return [5, 2, 1].find((digit) => digit * power <= units * (1 + 1e-9)) * power * millimetresPerUnit();
}

function scaleBar({pixelsPerMm, size: {height}}) {
  const type = scaleOfType(), mm = roundBelow(BAR * type / pixelsPerMm), length = mm * pixelsPerMm, y = height - EDGE;
  return [make("path", {class: "scale", d: `M${EDGE} ${y - STROKE}V${y}H${EDGE + length}v${-STROKE}`}),
    make("text", {class: "scale", x: EDGE + 6, y: y - 6}, `${shortLength(mm)} ${shown.unit}`)];
}

// Returns the strokes of a ruler: the pixel of each, and its number or null. The ruler is `pixels` long, and its zero
// is at the pixel `zero`. Its numbers increase to the right or, if `sign` is -1, upwards.
function strokes({pixelsPerMm}, zero, sign, pixels) {
  const step = 2 * roundBelow(APART * scaleOfType() / pixelsPerMm);
  const parts = [10, 5, 2, 1].find((n) => step * pixelsPerMm / n >= FINE), apart = sign * step / parts * pixelsPerMm;
  const [first, last] = [-zero / apart, (pixels - zero) / apart].sort((a, b) => a - b), all = [];
  for (let i = Math.ceil(first); i <= last; ++i)
    all.push({at: zero + i * apart, number: i % parts === 0 ? shortLength(i / parts * step) : null});
  return all;
}

// Returns the marks of the two rulers. The numbers do not cover the piece, unless it fills the picture.
function rulers(stage) {
  const {size: {width, height}, facts: {size_mm: [wide, high]}, camera} = stage, type = scaleOfType();
  const [left, bottom] = stage.toPixels([-wide / 2, -high / 2]), [, top] = stage.toPixels([0, high / 2]);
  const size = ({number}) => (number === null ? STROKE : 2 * STROKE);
  const across = strokes(stage, left, 1, width), upwards = strokes(stage, bottom, -1, height);
  const lines = [...across.map((it) => `M${it.at.toFixed(1)} 0v${size(it)}`),
    ...upwards.map((it) => `M0 ${it.at.toFixed(1)}h${size(it)}`)];
  const told = (all, room, least) => all.filter(({number, at}) => number !== null && at > APART / 2 &&
    (camera.zoom > 1 || room > least * type));
  return [make("path", {class: "scale", d: lines.join("")}),
    ...told(across, top, 32).map(({at, number}) =>
      make("text", {class: "scale", x: at, y: 2 * STROKE + 12 * type, "text-anchor": "middle"}, number)),
    ...told(upwards, left, 44).map(({at, number}) =>
      make("text", {class: "scale", x: 2 * STROKE + 4, y: at + 4 * type}, number))];
}

// Returns the marks that show the size of the piece; none if there is no piece yet.
export function scaleMarks(stage) {
  if (!stage.facts) return [];
  return ["section", "measure", "place"].includes(stage.tool) ? rulers(stage) : scaleBar(stage);
}
