// The brush: a drag on the picture paints a stroke onto the model. The pointer's places become points of the model, and
// the stroke so far is a change of the document, so that the picture follows.

import {$, clamp, make, oneAtATime, pair} from "./controls.js";
import {hasScale} from "./document.js";
import {erased, simplified, strokesOf, textOf} from "./strokes.js";

// `most` is the largest amount of a brush that the strength reaches.
export const KINDS = {
  soften: {label: "Soften", most: 1}, sharpen: {label: "Sharpen", most: 2}, strengthen: {label: "Strengthen", most: 2},
  raise: {label: "Raise", most: 0.3}, sink: {label: "Sink", most: 0.3}, level: {label: "Level", most: 1},
  erase: {label: "Erase strokes"},
};
const SLIDERS = {
  size: {label: "Size", name: "Brush size", min: 1, max: 30, first: 8,
    help: "Width, in shares of the longer side  [ ]"},
  strength: {label: "Strength", name: "Brush strength", min: 1, max: 100, first: 60,
    help: "A pen's pressure lowers it"},
  softness: {label: "Fall-off", name: "Brush fall-off", min: 5, max: 100, first: 100,
    help: "Share of the radius over which the change fades"},
};
const KEPT = "brush"; // key of the kept settings
const APART = 1 / 6, LEAST_APART = 2; // of places along a stroke, in radii and in pixels
const TOLERANCE = 1 / 40; // by which a line may differ from the drawn one, in radii
const DIGITS = 1e5; // points are rounded to this part of the longer side
const KEY_STEP = 12, RESIZE = 1.15; // pixels of an arrow key, factor of a bracket

// Returns the settings that were kept; those that are missing or wrong get their first values.
function keptSettings() {
  const kept = JSON.parse(localStorage.getItem(KEPT) ?? "{}"), kind = kept.kind in KINDS ? kept.kind : "soften";
  const values = Object.entries(SLIDERS).map(([key, {min, max, first}]) =>
    [key, kept[key] >= min && kept[key] <= max ? kept[key] : first]);
  return {kind, isMirrored: kept.isMirrored === true, ...Object.fromEntries(values)};
}

// Returns a new name such as "Soften 2".
function newName({label}, strokes) {
  const numbers = strokes.map(({name}) => Number(name?.match(/^(\D+) (\d+)$/)?.[1] === label && name.match(/\d+$/)[0]));
  return `${label} ${1 + Math.max(0, ...numbers)}`;
}

// One drag of the brush. It changes the document in one step.
class Painting {
  static count = 0;

  constructor(brush, stage) {
    const {engine: {document}, doc, settings} = brush;
    Object.assign(this, {brush, doc, document, settings: {...settings}, id: `brush ${++Painting.count}`,
      before: strokesOf(doc.now), ...brush.scaleOf(stage), waiting: [], lines: [[], []], pressures: []});
    this.radius = this.longer * settings.size / 200;
    this.name = newName(KINDS[settings.kind], this.before);
    this.look = oneAtATime(() => this.lookUp());
  }

  // Continues the stroke at a pixel, unless the last place is near.
  follow(stage, [x, y], pressure) {
    const least = Math.max(LEAST_APART, APART * this.brush.radiusIn(stage));
    if (this.last && Math.hypot(x - this.last[0], y - this.last[1]) < least) return;
    this.last = [x, y];
    this.pressures.push(pressure);
    this.waiting.push(this.brush.shareOf(stage, [x, y]));
    this.look();
  }

  // Finds the points of the model under the places that wait, and changes the document.
  async lookUp() {
    const places = this.waiting.splice(0), {isMirrored} = this.settings;
    const mirrored = isMirrored ? places.map(([u, v]) => [1 - u, v]) : [];
    if (places.length > 0) {
      const points = await this.brush.engine.pointsUnder([...places, ...mirrored]).catch(() => []);
      const found = (part) => part.filter(Boolean).map((point) => point.map((x) => this.rounded(x)));
      this.lines[0].push(...found(points.slice(0, places.length)));
      this.lines[1].push(...found(points.slice(places.length)));
      this.show();
    }
    if (this.isOver && this.waiting.length === 0) this.doc.endStroke(this.id);
  }

  rounded(x) {
    const digits = clamp(Math.ceil(Math.log10(DIGITS / this.longer)), 0, 20);
    return Number(x.toFixed(digits));
  }

  // Ends the drag. The stroke is finished when all its points are found.
  end() {
    this.isOver = true;
    this.look();
  }

  // Returns the strokes of the document with this one.
  strokes() {
    const {kind, strength, softness} = this.settings, lines = this.lines.filter((line) => line.length > 0);
    if (kind === "erase")
      return lines.flat().reduce((strokes, point) => erased(strokes, point, this.radius), this.before);
    const pressure = this.pressures.reduce((sum, x) => sum + x, 0) / this.pressures.length;
    const amount = Number((KINDS[kind].most * strength / 100 * pressure).toPrecision(3));
    const radius = Number(this.radius.toPrecision(5));
    return [...this.before, ...lines.map((line, i) => ({name: i === 0 ? this.name : `${this.name}, mirrored`,
      brush: kind, amount, radius, softness: softness / 100, points: simplified(line, TOLERANCE * this.radius)}))];
  }

  // Changes the document, unless another change came between.
  show() {
    const isOther = this.isBegun ? this.doc.stroke !== this.id : this.doc.now.options.strokes !== textOf(this.before);
    if (isOther || this.document !== this.brush.engine.document) this.isGivenUp = true;
    if (this.isGivenUp || this.lines.every((line) => line.length === 0)) return;
    this.doc.change({options: {strokes: textOf(this.strokes())}}, this.id);
    this.isBegun = this.doc.stroke === this.id;
  }
}

export class Brush {
  // `facts` returns the facts of the shown model; `say` shows a line to the user.
  constructor({engine, doc, facts, say}) {
    Object.assign(this, {engine, doc, facts, say, settings: keptSettings(), at: null, painting: null});
    this.kind = make("select", {"aria-label": "Brush"}, ...Object.entries(KINDS).map(([value, {label}]) =>
      make("option", {value}, label)));
    this.kind.onchange = () => this.set({kind: this.kind.value});
    this.mirror = make("input", {type: "checkbox"});
    this.mirror.onchange = () => this.set({isMirrored: this.mirror.checked});
    this.ranges = Object.entries(SLIDERS).map(([key, slider]) => this.slider(key, slider));
    $("#brush").append(make("div", {class: "kind"}, this.kind, pair("Mirror", this.mirror,
      {title: "Paint on the other side of the figure's middle, too"})), ...this.ranges.map(({element}) => element));
    this.set({});
  }

  slider(key, {label, name, min, max, help}) {
    const range = make("input", {type: "range", min, max, step: 1, "aria-label": name}), shown = make("output");
    range.oninput = () => this.set({[key]: Number(range.value)});
    const element = make("label", {class: "brush-slider", title: help}, make("span", {}, label), shown, range);
    return {key, range, shown, element};
  }

  set(part) {
    const settings = Object.assign(this.settings, part);
    localStorage.setItem(KEPT, JSON.stringify(settings));
    this.kind.value = settings.kind;
    this.mirror.checked = settings.isMirrored;
    for (const {key, range, shown, element} of this.ranges) {
      const {min, max} = SLIDERS[key], text = `${Math.round(settings[key])} %`;
      range.value = settings[key];
      range.style.setProperty("--filled", `${100 * (settings[key] - min) / (max - min)}%`);
      range.setAttribute("aria-valuetext", shown.textContent = text);
      element.hidden = key !== "size" && settings.kind === "erase";
    }
    this.stage?.drawOverlay();
  }

  // Makes the brush smaller or larger.
  resize(by) {
    const {min, max} = SLIDERS.size;
    this.set({size: clamp(this.settings.size * RESIZE ** by, min, max)});
  }

  // -------------------------------------------------------------------------------------------------- the picture

  // Returns the longer side of the figure in the scan's units and in mm of the picture.
  scaleOf({about: {relief_mm: [low, high]}}) {
    return {longer: Math.max(...this.facts().size), longerMm: Math.max(high[0] - low[0], high[1] - low[1])};
  }

  radiusIn = (stage) => this.scaleOf(stage).longerMm * this.settings.size / 200 * stage.pixelsPerMm;

  // Returns the place of a pixel in shares of the figure's box, as the engine has it: in pieces that are mirrored, from
  // the right.
  shareOf(stage, [px, py]) {
    const {relief_mm: [low, high]} = stage.about, place = stage.toPlace(px, py);
    const [u, v] = place.map((x, i) => (x - low[i]) / (high[i] - low[i]));
    return [["mirror", "die"].includes(this.doc.now.options.form) ? 1 - u : u, v];
  }

  // Returns why nothing can be painted now; an empty text if it can.
  refusal({about, isAwaiting, turning}) {
    const {now} = this.doc;
    if (isAwaiting || turning.shown || !this.facts())
      return "Wait until the view is prepared: then the relief can be painted.";
    if (now.options.method === "paper")
      return "The method “All forms alike” takes no strokes: choose the other method to paint.";
    if (hasScale(now)) return "One vertical scale gives the heights: they cannot be painted.";
    return about.relief_mm ? "" : "A piece that is bent cannot be painted: choose another kind, paint, and come back.";
  }

  // Returns the brush as SVG elements: its outline, and the part that it changes fully.
  marks(stage) {
    const {about, size: {width, height}} = stage, [cx, cy] = this.at ?? [];
    if (!(cx <= width && cy <= height) || !about?.relief_mm || !this.facts()) return [];
    const r = this.radiusIn(stage), full = r * (1 - this.settings.softness / 100);
    const circle = (r, name) => make("circle", {class: name, cx, cy, r});
    return [circle(r, "brush"), ...(full > 2 && this.settings.kind !== "erase" ? [circle(full, "brush full")] : [])];
  }

  // Shows the brush at a pixel, or not if that is null.
  point(stage, at) {
    Object.assign(this, {stage, at});
    stage.drawOverlay();
  }

  // ------------------------------------------------------------------------------------------------------- drags

  press(stage, {offsetX: x, offsetY: y, pointerType, pressure}) {
    this.cancel();
    const why = this.refusal(stage);
    if (why) return this.say(why);
    this.painting = new Painting(this, stage);
    this.move(stage, {x, y, event: {pointerType, pressure}});
  }

  move(stage, {x, y, event: {pointerType, pressure}}) {
    this.point(stage, [x, y]);
    this.painting?.follow(stage, [x, y], pointerType === "pen" && pressure > 0 ? pressure : 1);
  }

  end() {
    this.painting?.end();
    this.painting = null;
  }

  // Takes back the stroke that is being painted. Returns whether there was one.
  cancel() {
    const {painting} = this;
    this.painting = null;
    if (painting) painting.isGivenUp = true;
    return painting !== null;
  }

  // -------------------------------------------------------------------------------------------------------- keys

  step(stage, x, y) {
    const {width, height} = stage.size, [px, py] = this.at ?? [width / 2, height / 2];
    const at = {x: clamp(px + x * KEY_STEP, 0, width), y: clamp(py - y * KEY_STEP, 0, height), event: {}};
    this.move(stage, at);
  }

  // Sets the brush down where it is, or lifts it.
  toggle(stage) {
    if (this.painting) return this.end();
    const {width, height} = stage.size, [offsetX, offsetY] = this.at ?? [width / 2, height / 2];
    this.doc.endStroke();
    this.press(stage, {offsetX, offsetY});
  }
}
