// Edits the tone curve: the fraction of a slope that is kept, as a function of the square root of the curvature. The
// engine samples the curve, or the paper's formula if there is no curve, and sends the samples with each picture.

import {about} from "../about.js";
import {$, ARROWS, Pause, clamp, make} from "../controls.js";
import {GESTURE_END_MS} from "./slider.js";

const WIDTH = 320, HEIGHT = 150, NEAREST = 0.02;
const AROUND = 9; // margin of the diagram in its units, so that handles at its ends are not cut off
const FORMULA_POINTS = [0.05, 0.25, 0.5, 0.75, 1]; // positions of the handles on the paper's formula

const PRESETS = [
  {name: "As Edge emphasis says", tone: ""},
  {name: "Even", tone: "0,1;1,1"},
  {name: "Fine detail first", tone: "0,1;0.35,0.9;0.7,0.6;1,0.5"},
  {name: "Bold edges first", tone: "0,0.15;0.35,0.3;0.65,0.7;1,1"},
  {name: "Smooth skin, crisp folds", tone: "0,0.6;0.2,0.35;0.45,0.45;0.75,0.9;1,1"},
];

export const parse = (tone) => tone.split(";").map((pair) => pair.split(",").map(Number));
const round = (x) => Math.round(x * 1000) / 1000;
export const format = (points) => points.map(([x, y]) => `${round(x)},${round(y)}`).join(";");

export class CurveEditor {
  // Calls onChange(tone) while the user moves a point, and then onEnd(). onChange() returns the tone curve to show.
  constructor(onChange, onEnd) {
    Object.assign(this, {onChange, onEnd, tone: "", samples: {share: [], kept: []}, histogram: []});
    this.rest = new Pause(onEnd, GESTURE_END_MS);
    this.svg = make("svg", {
      viewBox: [-AROUND, -AROUND, WIDTH + 2 * AROUND, HEIGHT + 2 * AROUND].join(" "), role: "group", "aria-label": "Tone curve",
    });
    this.marks = make("g");
    this.handles = make("g");
    this.svg.append(this.marks, this.handles);
    $("#curve").append(this.svg, make("div", {class: "legend", "aria-hidden": "true"}, make("span", {}, "flat"),
      make("span", {}, "how sharply it bends"), make("span", {}, "sharp")));
    this.svg.ondblclick = (event) => this.add(event);
    this.preset = $("#preset");
    this.preset.append(...PRESETS.map(({name, tone}) => make("option", {value: tone}, name)),
      make("option", {value: "own", hidden: true}, "Drawn by hand"));
    this.preset.onchange = () => this.change(this.preset.value, true);
  }

  // Returns the points of the curve. If there is no curve, returns points on the paper's formula; these become a curve
  // when the user moves one of them.
  get points() {
    if (this.tone) return parse(this.tone);
    const {share} = this.samples;
    return share.length ? FORMULA_POINTS.map((x) => [x, share[Math.round(x * (share.length - 1))]]) : [];
  }

  change(tone, isOver) {
    this.show({tone: this.onChange(tone)});
    if (isOver) this.onEnd();
  }

  // Draws the diagram. `part` has the changed members of {tone, samples, histogram}.
  show(part = {}) {
    Object.assign(this, part);
    const key = JSON.stringify([this.tone, this.samples, this.histogram]);
    if (key === this.drawnKey) return; // nothing has changed; this method runs for every picture
    this.drawnKey = key;
    const isPreset = PRESETS.some(({tone}) => tone === this.tone);
    this.preset.value = isPreset ? this.tone : "own";
    const place = (y, i, all) =>
      `${i ? "L" : "M"}${(i / (all.length - 1) * WIDTH).toFixed(1)} ${(HEIGHT * (1 - y)).toFixed(1)}`;
    const path = (samples) => samples.map(place).join("");
    const grid = [0.25, 0.5, 0.75].map((t) =>
      make("path", {class: "grid", d: `M${t * WIDTH} 0V${HEIGHT}M0 ${t * HEIGHT}H${WIDTH}`}));
    const {share, kept} = this.samples;
    this.marks.replaceChildren(...grid, make("path", {class: "histogram", d: this.histogramPath()}),
      make("path", {class: "kept", d: path(kept)}), make("path", {class: "drawn", d: path(share)}));
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
    const units = (pixels, size, whole) => (pixels / size * (whole + 2 * AROUND) - AROUND) / whole;
    return [units(event.clientX - box.left, box.width, WIDTH), 1 - units(event.clientY - box.top, box.height, HEIGHT)];
  }

  movePoint(i, x, y) {
    const {points} = this;
    const low = i > 0 ? points[i - 1][0] + NEAREST : 0;
    const high = i + 1 < points.length ? points[i + 1][0] - NEAREST : 1;
    points[i] = [clamp(x, low, high), clamp(y, 0, 1)];
    this.change(format(points), false);
  }

  add(event) {
    const {points} = this, [x, y] = this.place(event);
    const isFree = points.every(([px]) => Math.abs(px - x) > NEAREST);
    if (!isFree || points.length >= about.curve.most_points) return;
    const added = [clamp(x, 0, 1), clamp(y, 0, 1)], all = [...points, added].sort(([a], [b]) => a - b);
    this.change(format(all), true);
    this.handles.children[all.indexOf(added)].focus(); // keys can then move or delete the new point
  }

  key(event, i) {
    const step = ARROWS[event.key];
    const {points} = this;
    if (step) {
      event.preventDefault();
      const size = event.shiftKey ? 0.002 : 0.02;
      this.movePoint(i, points[i][0] + step[0] * size, points[i][1] + step[1] * size);
      this.rest.begin();
    } else if ((event.key === "Delete" || event.key === "Backspace") && points.length > 1) {
      event.preventDefault();
      this.change(format(points.filter((_, j) => j !== i)), true);
      this.handles.children[Math.min(i, points.length - 2)].focus();
    }
  }
}
