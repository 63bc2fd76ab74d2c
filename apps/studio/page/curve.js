// The tone curve: how much of a slope is kept, over the square root of its curvature. The same curve as the
// engine's ToneCurve, drawn here for the eye.

import {$, clamp, make} from "./controls.js";

const EVEN = 1 - Math.exp(-1); // of (6) where beta is 0
const WIDTH = 320, HEIGHT = 150, MOST_POINTS = 16, NEAREST = 0.02;

export const PRESETS = [
  {name: "The paper's formula (6)", tone: ""},
  {name: "Even", tone: "0,1;1,1"},
  {name: "Fine detail first", tone: "0,1;0.35,0.9;0.7,0.6;1,0.5"},
  {name: "Bold edges first", tone: "0,0.15;0.35,0.3;0.65,0.7;1,1"},
  {name: "Smooth skin, crisp folds", tone: "0,0.6;0.2,0.35;0.45,0.45;0.75,0.9;1,1"},
];

export const parse = (tone) => tone.split(";").map((pair) => pair.split(",").map(Number));
const round = (x) => Math.round(x * 1000) / 1000;
export const format = (points) => points.map(([x, y]) => `${round(x)},${round(y)}`).join(";");

// Fritsch and Butland's slopes: no piece leaves the values of its ends.
function slopes(points) {
  const chord = (i) => (points[i + 1][1] - points[i][1]) / (points[i + 1][0] - points[i][0]);
  return points.map((_, i) => {
    if (points.length < 2) return 0;
    if (i === 0) return chord(0);
    if (i === points.length - 1) return chord(i - 1);
    const a = points[i][0] - points[i - 1][0], b = points[i + 1][0] - points[i][0], d0 = chord(i - 1), d1 = chord(i);
    return d0 * d1 <= 0 ? 0 : (3 * (a + b)) / ((2 * b + a) / d0 + (b + 2 * a) / d1);
  });
}

export function evaluate(points, x) {
  const next = points.findIndex(([px]) => px > x);
  if (next === 0) return points[0][1];
  if (next < 0) return points.at(-1)[1];
  const [px, py] = points[next - 1], [qx, qy] = points[next], m = slopes(points);
  const width = qx - px, t = (x - px) / width, s = 1 - t;
  const y = s * s * (1 + 2 * t) * py + t * t * (1 + 2 * s) * qy + width * s * t * (s * m[next - 1] - t * m[next]);
  return clamp(y, Math.min(py, qy), Math.max(py, qy));
}

export class CurveEditor {
  // Calls onChange(tone) while a point moves, onEnd() after it.
  constructor(onChange, onEnd) {
    Object.assign(this, {onChange, onEnd, tone: "", saturation: 0, method: "ours", delta: 0.25, u: 1, histogram: []});
    this.svg = make("svg", {viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "group", "aria-label": "Tone curve"});
    this.marks = make("g");
    this.handles = make("g");
    this.svg.append(this.marks, this.handles);
    $("#curve").append(this.svg, make("div", {class: "legend", "aria-hidden": "true"}, make("span", {}, "flat"),
      make("span", {}, "curvature |k|"), make("span", {}, "sharp")));
    this.svg.ondblclick = (event) => this.add(event);
    this.preset = $("#preset");
    this.preset.append(...PRESETS.map(({name, tone}) => make("option", {value: tone}, name)), make("option", {value: "own", hidden: true}, "Drawn by hand"));
    this.preset.onchange = () => this.change(this.preset.value, true);
  }

  get drawnPoints() {
    if (this.parsedTone !== this.tone) this.parsed = parse(this.tone);
    this.parsedTone = this.tone;
    return this.parsed;
  }

  // What rules now: the drawn points, or those of the paper's formula, ready to be drawn anew.
  get points() {
    if (this.tone) return parse(this.tone);
    return [0.05, 0.25, 0.5, 0.75, 1].map((x) => [x, this.share(x)]);
  }

  share(x) {
    if (this.tone) return evaluate(this.drawnPoints, x);
    const weight = 1 - Math.exp(-(((x * x) / Math.max(this.delta, 1e-9)) ** this.saturation));
    return this.method === "paper" ? weight : Math.min(1, weight / EVEN);  // in layers 1 is no change
  }

  change(tone, isOver) {
    this.tone = tone;
    this.onChange(tone);
    this.show();
    if (isOver) this.onEnd();
  }

  // Draws all; `part` holds what has changed.
  show(part = {}) {
    Object.assign(this, part);
    const key = [this.method, this.tone, this.saturation, this.delta, this.u.toPrecision(3), this.histogram.length].join(" ");
    if (key === this.drawnKey && this.histogram === this.drawnHistogram) return; // it is drawn for every picture
    this.drawnKey = key;
    this.drawnHistogram = this.histogram;
    const isPreset = PRESETS.some(({tone}) => tone === this.tone);
    this.preset.value = isPreset ? this.tone : "own";
    const path = (f) => {
      let d = "";
      for (let i = 0; i <= 80; ++i) d += `${i ? "L" : "M"}${(i / 80 * WIDTH).toFixed(1)} ${(HEIGHT * (1 - f(i / 80))).toFixed(1)}`;
      return d;
    };
    // With the paper's method the height moves the weights; layers take the curve as it is.
    const kept = (x) => this.method !== "paper" ? this.share(x) : 1 - (1 - Math.min(this.share(x), 1 - 1e-9)) ** this.u;
    const grid = [0.25, 0.5, 0.75].map((t) => make("path", {class: "grid", d: `M${t * WIDTH} 0V${HEIGHT}M0 ${t * HEIGHT}H${WIDTH}`}));
    this.marks.replaceChildren(...grid, make("path", {class: "histogram", d: this.histogramPath()}),
      make("path", {class: "kept", d: path(kept)}), make("path", {class: "drawn", d: path((x) => this.share(x))}));
    this.showHandles();
  }

  histogramPath() {
    const most = Math.max(1, ...this.histogram), n = this.histogram.length || 1;
    const tops = this.histogram.map((count, i) => `L${(i + 0.5) / n * WIDTH} ${HEIGHT * (1 - 0.85 * count / most)}`);
    return `M0 ${HEIGHT}${tops.join("")}L${WIDTH} ${HEIGHT}Z`;
  }

  showHandles() {
    const {points} = this;
    while (this.handles.children.length > points.length) this.handles.lastChild.remove();
    while (this.handles.children.length < points.length) this.handles.append(this.handle());
    points.forEach(([x, y], i) => {
      const handle = this.handles.children[i];
      handle.setAttribute("cx", x * WIDTH);
      handle.setAttribute("cy", HEIGHT * (1 - y));
      handle.setAttribute("aria-label", `Curve point ${i + 1} of ${points.length}`);
      handle.setAttribute("aria-valuenow", Math.round(y * 100));
      handle.setAttribute("aria-valuetext", `keeps ${Math.round(y * 100)} percent`);
    });
  }

  handle() {
    const handle = make("circle", {r: 5.5, tabindex: 0, role: "slider", "aria-valuemin": 0, "aria-valuemax": 100});
    const at = () => [...this.handles.children].indexOf(handle);
    handle.onpointerdown = (event) => {
      event.preventDefault();
      handle.focus();
      handle.setPointerCapture(event.pointerId);
      handle.onpointermove = (e) => this.movePoint(at(), ...this.place(e));
    };
    handle.onpointerup = handle.onpointercancel = () => {
      handle.onpointermove = null;
      this.onEnd();
    };
    handle.ondblclick = (event) => event.stopPropagation();
    handle.onkeydown = (event) => this.key(event, at());
    return handle;
  }

  place(event) {
    const box = this.svg.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
  }

  movePoint(i, x, y) {
    const {points} = this;
    const low = i > 0 ? points[i - 1][0] + NEAREST : 0, high = i + 1 < points.length ? points[i + 1][0] - NEAREST : 1;
    points[i] = [clamp(x, low, high), clamp(y, 0, 1)];
    this.change(format(points), false);
  }

  add(event) {
    const {points} = this, [x, y] = this.place(event);
    const isFree = points.every(([px]) => Math.abs(px - x) > NEAREST);
    if (!isFree || points.length >= MOST_POINTS) return;
    this.change(format([...points, [clamp(x, 0, 1), clamp(y, 0, 1)]].sort(([a], [b]) => a - b)), true);
  }

  key(event, i) {
    const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]}[event.key];
    const {points} = this;
    if (step) {
      event.preventDefault();
      const size = event.shiftKey ? 0.002 : 0.02;
      this.movePoint(i, points[i][0] + step[0] * size, points[i][1] + step[1] * size);
      clearTimeout(this.rest);
      this.rest = setTimeout(() => this.onEnd(), 400);
    } else if ((event.key === "Delete" || event.key === "Backspace") && points.length > 1) {
      event.preventDefault();
      this.change(format(points.filter((_, j) => j !== i)), true);
      this.handles.children[Math.min(i, points.length - 2)].focus();
    }
  }
}
