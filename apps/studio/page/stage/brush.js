// Paints strokes: a drag of the brush on the picture paints a stroke onto the model. The engine converts the pointer's
// positions to points of the model. The unfinished stroke is already in the document, so that pictures show it.

import {$, clamp, make, pair} from "../controls.js";
import {hasScale, isMirrored} from "../document.js";
import {AREAS, KINDS, Painting} from "./painting.js";

const SLIDERS = {
  size: {label: "Size", name: "Brush size", min: 1, max: 30, first: 8,
    help: "Width, in shares of the longer side  [ ]"},
  strength: {label: "Strength", name: "Brush strength", min: 1, max: 100, first: 60,
    help: "A pen's pressure lowers it"},
  softness: {label: "Fall-off", name: "Brush fall-off", min: 5, max: 100, first: 100,
    help: "Share of the radius over which the change fades"},
  tolerance: {label: "Tolerance", name: "Tolerance of the region", min: 1, max: 30, first: 6, unit: "°",
    help: "A region ends where the surface turns more than this within 1 % of the longer side"},
};
const KEPT = "brush"; // key of the settings in localStorage
const KEY_STEP = 12, RESIZE = 1.15; // an arrow key moves by 12 pixels; the keys [ and ] resize by this factor

// Returns the stored settings. Missing and wrong ones get their initial values.
function keptSettings() {
  const kept = JSON.parse(localStorage.getItem(KEPT) ?? "{}"), kind = kept.kind in KINDS ? kept.kind : "soften";
  const area = kept.area in AREAS ? kept.area : "line";
  const values = Object.entries(SLIDERS).map(([key, {min, max, first}]) =>
    [key, kept[key] >= min && kept[key] <= max ? kept[key] : first]);
  return {kind, area, isMirrored: kept.isMirrored === true, ...Object.fromEntries(values)};
}

export class Brush {
  // `modelFacts` returns the facts about the shown model; `say` shows a line to the user.
  constructor({engine, doc, modelFacts, say}) {
    Object.assign(this, {engine, doc, modelFacts, say, settings: keptSettings(), at: null, painting: null});
    this.kind = make("select", {"aria-label": "Brush"}, ...Object.entries(KINDS).map(([value, {label}]) =>
      make("option", {value}, label)));
    this.kind.onchange = () => this.set({kind: this.kind.value});
    this.area = make("select", {"aria-label": "Shape of the stroke",
      title: "A line, what a closed line encloses, or the surface around a click up to creases"},
      ...Object.entries(AREAS).map(([value, label]) => make("option", {value}, label)));
    this.area.onchange = () => this.set({area: this.area.value});
    this.mirror = make("input", {type: "checkbox"});
    this.mirror.onchange = () => this.set({isMirrored: this.mirror.checked});
    this.ranges = Object.entries(SLIDERS).map(([key, slider]) => this.slider(key, slider));
    $("#brush").append(make("div", {class: "kind"}, this.kind, this.area, pair("Mirror", this.mirror,
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
    this.area.value = settings.area;
    this.area.hidden = settings.kind === "erase";
    this.mirror.checked = settings.isMirrored;
    for (const {key, range, shown, element} of this.ranges) {
      const {min, max, unit = " %"} = SLIDERS[key], text = `${Math.round(settings[key])}${unit}`;
      range.value = settings[key];
      range.style.setProperty("--filled", `${100 * (settings[key] - min) / (max - min)}%`);
      range.setAttribute("aria-valuetext", shown.textContent = text);
      element.hidden = (key !== "size" && settings.kind === "erase") || (key === "tolerance" && settings.area !== "region");
    }
    this.stage?.drawOverlay();
  }

  resize(by) {
    const {min, max} = SLIDERS.size;
    this.set({size: clamp(this.settings.size * RESIZE ** by, min, max)});
  }

  // -------------------------------------------------------------------------------------------------- the picture

  // Returns the longer side of the figure, in the scan's units (`longer`) and in mm on the piece (`longerMm`).
  scaleOf({facts: {relief_mm: [low, high]}}) {
    return {longer: Math.max(...this.modelFacts().size), longerMm: Math.max(high[0] - low[0], high[1] - low[1])};
  }

  radiusIn = (stage) => this.scaleOf(stage).longerMm * this.settings.size / 200 * stage.pixelsPerMm;

  // Converts a pixel to a position in the figure's box: shares of the box's width and height, from the lower left
  // corner. On a mirrored piece, x counts from the right, because the model itself is not mirrored.
  shareOf(stage, [px, py]) {
    const {relief_mm: [low, high]} = stage.facts, place = stage.toPlace(px, py);
    const [u, v] = place.map((x, i) => (x - low[i]) / (high[i] - low[i]));
    return [isMirrored(this.doc.now) ? 1 - u : u, v];
  }

  // Returns the reason why nothing can be painted now; an empty text if painting is possible.
  refusal({facts, isAwaiting, turning}) {
    const {now} = this.doc;
    if (isAwaiting || turning.shown || !this.modelFacts())
      return "Wait until the view is prepared: then the relief can be painted.";
    if (now.options.method === "paper")
      return "The method “All forms alike” takes no strokes: choose the other method to paint.";
    if (now.options.form === "lithophane")
      return "A lithophane is made from light and colours, not from heights: choose another kind to paint.";
    if (hasScale(now)) return "One vertical scale gives the heights: they cannot be painted.";
    return facts.relief_mm ? "" : "A piece that is bent cannot be painted: choose another kind, paint, and come back.";
  }

  // Returns the pixel at which the picture from the front shows a point of the model.
  pixelOf(stage, point) {
    const {relief_mm: [low, high]} = stage.facts, {rotation, origin, size} = this.modelFacts();
    const [u, v] = [0, 1].map((row) =>
      (point.reduce((sum, x, i) => sum + rotation[3 * row + i] * x, -origin[row])) / size[row]);
    return stage.toPixels([isMirrored(this.doc.now) ? 1 - u : u, v].map((x, i) => low[i] + x * (high[i] - low[i])));
  }

  // Returns a point in scan coordinates. Seen from the viewer, it has the position `place` in the figure's box and the
  // same depth as the point `other`, which is also in scan coordinates.
  pointAt(place, other) {
    const {rotation, origin, size} = this.modelFacts(), row = (i) => rotation.slice(3 * i, 3 * i + 3);
    const depth = row(2).reduce((sum, x, i) => sum + x * other[i], 0);
    const seen = [...place.map((share, i) => origin[i] + share * size[i]), depth];
    return [0, 1, 2].map((axis) => seen.reduce((sum, x, i) => sum + x * row(i)[axis], 0));
  }

  // The direction towards the viewer in the scan's coordinates.
  get toViewer() {
    return this.modelFacts().rotation.slice(6, 9).map((x) => Number(x.toFixed(6)));
  }

  // Highlights a stroke of the document on the picture; null removes the highlight.
  highlight(stroke) {
    this.highlighted = stroke;
    this.stage?.drawOverlay();
  }

  strokeMarks(stage) {
    const {highlighted: stroke} = this, {yaw, pitch} = stage.camera;
    if (!stroke || yaw !== 0 || pitch !== 0) return [];
    const {longer, longerMm} = this.scaleOf(stage), width = 2 * stroke.radius * longerMm / longer * stage.pixelsPerMm;
    const corners = stroke.points.map((point) => this.pixelOf(stage, point).map((x) => x.toFixed(1)).join(" "));
    const d = `M${corners.join("L")}${corners.length === 1 ? "h0" : stroke.area === "lasso" ? "Z" : ""}`;
    return [make("path", {class: "stroke", d, "stroke-width": width.toFixed(1)}), make("path", {class: "cut", d})];
  }

  // Returns SVG elements: the highlighted stroke, the outline of the brush, and the outline of the part of the brush
  // that has its full effect.
  marks(stage) {
    this.stage = stage;
    if (!stage.facts?.relief_mm || !this.modelFacts() || stage.isAwaiting) return [];
    return [...this.strokeMarks(stage), ...(stage.tool === "brush" ? this.brushMarks(stage) : [])];
  }

  brushMarks(stage) {
    const {width, height} = stage.size, [cx, cy] = this.at ?? [];
    if (!(cx <= width && cy <= height)) return [];
    if (this.painting?.isLasso) return [make("path", {class: "brush", d: `M${this.painting.trail.join("L")}Z`})];
    const r = this.radiusIn(stage), full = r * (1 - this.settings.softness / 100);
    const circle = (r, name) => make("circle", {class: name, cx, cy, r});
    return [circle(r, "brush"), ...(full > 2 && this.settings.kind !== "erase" ? [circle(full, "brush full")] : [])];
  }

  // Shows the brush at a pixel; null hides it.
  point(stage, at) {
    this.at = at;
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

  // Discards the stroke that is being painted. Returns whether there was one.
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

  // Starts a stroke at the brush's position, or ends the running stroke, for users of the keyboard.
  toggle(stage) {
    if (this.painting) return this.end();
    const {width, height} = stage.size, [offsetX, offsetY] = this.at ?? [width / 2, height / 2];
    this.doc.endGesture();
    this.press(stage, {offsetX, offsetY});
    if (this.painting?.settings.area === "region") this.end();
  }
}
