// Measures in the front view: draws the dimensions of the piece, the height under the pointer, distances, and the line
// of a section. Positions are in mm from the centre of the piece.

import {clamp, make, oneAtATime, scaleOfType} from "../controls.js";
import {withUnit} from "../lengths.js";

const NEAR = 12; // the pointer grabs an end of a line within this distance, in pixels
const ROW = 22; // height of a label in pixels, at the usual font size
const GAP = 14; // distance from the piece to its dimension lines, in pixels
const STROKE = 5; // half the length of the end strokes of a dimension line, in pixels

const sub = (a, b) => [a[0] - b[0], a[1] - b[1]], dot = (a, b) => a[0] * b[0] + a[1] * b[1];
const length = (a, b) => Math.hypot(b[0] - a[0], b[1] - a[1]);

let labels = []; // {x, y, width} of each drawn label; x and y are its centre

// Returns the y coordinate nearest to `y` at which a label lies within the picture and covers no other label; `y` if
// there is none.
function freeHeight(x, y, width, row, picture) {
  const isFree = (y) => y >= row / 2 && y <= picture.height - row / 2 && labels.every((other) =>
    Math.abs(other.x - x) >= (other.width + width) / 2 || Math.abs(other.y - y) >= row);
  const steps = Array.from({length: Math.ceil(picture.height / 2)}, (_, i) => 2 * i);
  return steps.flatMap((step) => [y - step, y + step]).find(isFree) ?? y;
}

const widthOf = (text) => (7.6 * text.length + 12) * scaleOfType(); // width of a label in pixels

// Returns the centre of a line's label, in pixels. The label is above the line and does not cover it.
function beside([x1, y1], [x2, y2], text) {
  const size = Math.hypot(x2 - x1, y2 - y1) || 1, [right, up] = [(y2 - y1) / size, Math.abs(x2 - x1) / size];
  const side = x2 < x1 ? -right : right, gap = (Math.abs(right) * widthOf(text) + up * ROW * scaleOfType()) / 2 + NEAR;
  return [(x1 + x2) / 2 + side * gap, (y1 + y2) / 2 - up * gap];
}

function rise(from, to) {
  const text = withUnit(Math.abs(to - from));
  return text === withUnit(0) ? "level" : `${text} ${to > from ? "higher" : "lower"}`;
}

// Draws a line between two pixels with a text at the pixel `at`, by default the line's centre. A background keeps the
// text readable. The text stays within the picture and covers no earlier label.
function labelled([x1, y1], [x2, y2], text, kind, picture, at = [(x1 + x2) / 2, (y1 + y2) / 2]) {
  const scale = scaleOfType(), width = widthOf(text), row = ROW * scale, height = row - 2;
  const x = clamp(at[0], width / 2, picture.width - width / 2);
  const y = freeHeight(x, clamp(at[1], row / 2, picture.height - row / 2), width, row, picture);
  labels.push({x, y, width});
  const label = make("text", {x, y: y + 4 * scale, "text-anchor": "middle"}, text);
  return [make("line", {class: kind, x1, y1, x2, y2}),
    make("rect", {class: "ground", x: x - width / 2, y: y - height / 2, width, height, rx: 5}), label];
}

// Returns the x or y coordinate of a dimension line beside the edge `end` of a piece. If that edge is within the
// picture, so is the dimension line.
const besideEnd = (end, size) => (end <= size ? Math.min(end + GAP, size - STROKE - 1) : end + GAP);

// Returns the centre of a dimension's label, which must not cover the figure. The label of a horizontal line is above
// the line. The label of a vertical line is beside the line, on the side away from the piece. If there is not enough
// space, the label is at the lower end of the line.
function besideDimension([x1, y1], [x2, y2], text, picture, isRight) {
  const scale = scaleOfType(), half = widthOf(text) / 2 + STROKE, middle = [(x1 + x2) / 2, (y1 + y2) / 2];
  if (y1 === y2) return [middle[0], y1 - ROW * scale / 2];
  const x = isRight ? x1 + half : x1 - half, hasRoom = x - half >= 0 && x + half <= picture.width;
  return hasRoom ? [x, middle[1]] : [x, Math.max(y1, y2) - ROW * scale / 2];
}

function dimension(from, to, text, picture, at) {
  const [dx, dy] = [to[0] - from[0], to[1] - from[1]], size = Math.hypot(dx, dy) || 1;
  const [ax, ay] = [-dy / size * STROKE, dx / size * STROKE];
  const strokes = [from, to].map(([x, y]) =>
    make("line", {class: "dimension", x1: x - ax, y1: y - ay, x2: x + ax, y2: y + ay}));
  return [...strokes, ...labelled(from, to, text, "dimension", picture, at)];
}

export const isRound = (outline) => outline === "circle" || outline === "ellipse";

// Returns the part of a line that lies on a plate of the given size; null if the line misses the plate.
function onPlate({from, to}, [width, height], isEllipse) {
  const scaled = ([x, y]) => [2 * x / width, 2 * y / height], a = scaled(from), d = scaled(sub(to, from));
  let low = 0, high = 1;
  const within = (enters, leaves) => ([low, high] = [Math.max(low, enters), Math.min(high, leaves)]);
  if (isEllipse) {
    const square = dot(d, d), nearest = -dot(a, d) / square, rest = dot(a, a) - 1;
    const half = Math.sqrt(nearest * nearest - rest / square);
    within(nearest - half, nearest + half);
  } else for (const i of [0, 1]) within(...[(-1 - a[i]) / d[i], (1 - a[i]) / d[i]].sort((p, q) => p - q));
  const at = (t) => [0, 1].map((i) => from[i] + t * (to[i] - from[i]));
  return low < high ? {from: at(low), to: at(high)} : null;
}

export class Measure {
  // `stage` converts positions to pixels and back, and has {size_mm, relief_mm} of the newest picture.
  constructor(stage) {
    this.stage = stage;
    this.askHeight = oneAtATime(() => this.tellHeight());
    this.clear();
  }

  // Removes the measuring line and the height under the pointer.
  clear() {
    this.line = this.pointer = this.wanted = null;
  }

  // ------------------------------------------------------------------------------------------------- the section

  middleLine() {
    const half = this.stage.facts.size_mm[0] / 2;
    return {from: [-half, 0], to: [half, 0]};
  }

  // Shows the section along the part of a line that lies on the piece.
  async cut(line) {
    const {stage} = this, {outline, wrap} = stage.doc.now.options;
    const isEllipse = isRound(outline) && wrap === "none";
    const {from, to} = onPlate(line, stage.facts.size_mm, isEllipse) ?? {};
    stage.on.section(from ? await stage.heights(from, to) : [], from, to);
  }

  // Returns the end of the line that is near a pixel: "from", "to", or null.
  endAt(line, x, y) {
    const near = (end) => line && length(this.stage.toPixels(line[end]), [x, y]) < NEAR;
    return ["from", "to"].find(near) ?? null;
  }

  // Returns the line after the user has dragged to `place`. If the drag began at an end of the line, that end is moved;
  // otherwise a new line from the beginning of the drag replaces it.
  dragged = (line, {end, from}, place) => (end ? {...line, [end]: place} : {from, to: place});

  lineMarks({from, to}, kind = "cut") {
    const [x1, y1] = this.stage.toPixels(from), [x2, y2] = this.stage.toPixels(to);
    return [make("line", {class: kind, x1, y1, x2, y2}), make("circle", {class: "end", cx: x1, cy: y1, r: 5}),
      make("circle", {class: "end", cx: x2, cy: y2, r: 5})];
  }

  // --------------------------------------------------------------------------------------------------- dimensions

  dimensionMarks() {
    const {facts, size: picture} = this.stage;
    if (!facts) return [];
    const [width, height, thickness] = facts.size_mm, at = (x, y) => this.stage.toPixels([x, y]);
    const [left, bottom] = at(-width / 2, -height / 2), [right, top] = at(width / 2, height / 2);
    const below = besideEnd(bottom, picture.height), aside = besideEnd(right, picture.width);
    const side = (from, to, mm, isRight) => dimension(from, to, withUnit(mm), picture,
      besideDimension(from, to, withUnit(mm), picture, isRight));
    const marks = [...dimension([left, below], [right, below], withUnit(width), picture),
      ...side([aside, bottom], [aside, top], height, true),
      ...labelled([left + 60, below], [left + 60, below], `${withUnit(thickness)} thick`, "none", picture)];
    if (!facts.relief_mm) return marks;
    const [low, high] = facts.relief_mm, [x1, y1] = at(...low), [x2, y2] = at(...high);
    if (x1 - left < 2 && right - x2 < 2) return marks; // the relief reaches the plate's edges
    return [make("rect", {class: "bounds", x: x1, y: y2, width: x2 - x1, height: y1 - y2}),
      ...side([x1, y2 - 8], [x2, y2 - 8], high[0] - low[0]),
      ...side([x1 - 8, y1], [x1 - 8, y2], high[1] - low[1]), ...marks];
  }

  marks() {
    labels = [];
    const marks = this.dimensionMarks(), {angle} = this.stage.drag ?? {};
    if (angle) {
      const middle = this.stage.toPixels(this.stage.figureMiddle());
      const text = `${Math.round(Math.abs(angle))}° to the ${angle > 0 ? "left" : "right"}`;
      marks.push(...labelled(middle, middle, text, "none", this.stage.size));
    }
    if (this.stage.tool === "place") return marks;
    const {line, pointer, stage: {size}} = this;
    if (line) {
      const [from, to] = [line.from, line.to].map((place) => this.stage.toPixels(place));
      const text = `${withUnit(length(line.from, line.to))} apart${line.heights ? `, ${rise(...line.heights)}` : ""}`;
      const at = beside(from, to, text);
      marks.push(...this.lineMarks(line), ...labelled(at, at, text, "none", size));
    }
    if (pointer?.height !== undefined) {
      const [x, y] = this.stage.toPixels(pointer.place), text = `Height ${withUnit(pointer.height)}`;
      marks.push(make("circle", {class: "point", cx: x, cy: y, r: 3}),
        ...labelled([x, y - 20], [x, y - 20], text, "none", size));
    }
    return marks;
  }

  // -------------------------------------------------------------------------------------------------- the pointer

  // Requests the height at `place` under the pointer. There is one request at a time, always for the newest position.
  // `place` is null if the pointer has left the picture.
  point(place) {
    this.wanted = place;
    if (place) return this.askHeight();
    this.pointer = null;
    this.stage.drawOverlay();
  }

  async tellHeight() {
    const {wanted: place, stage} = this, [height] = place ? await stage.heights(place, place).catch(() => []) : [];
    if (!this.wanted || stage.tool !== "measure") return; // the pointer has left the picture
    this.pointer = {place, height};
    stage.drawOverlay();
  }

  async setLine(line) {
    this.line = line;
    this.stage.drawOverlay();
    const heights = await this.stage.heights(line.from, line.to).catch(() => []);
    if (this.line !== line || heights.length === 0) return; // the user has drawn another line meanwhile
    line.heights = [heights[0], heights.at(-1)];
    this.stage.drawOverlay();
  }

  // Must be called for each new picture, whose heights may differ from those of the last one.
  pictured() {
    if (this.line) this.setLine({...this.line, heights: null});
  }
}
