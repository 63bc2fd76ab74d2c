// Shows the numbers in the status line, the chart of the section, and the progress of the engine's work in the
// background.

import {about} from "./about.js";
import {$, clamp, count, make, scaleOfType} from "./controls.js";
import {lengthText, millimetresPerUnit, shown, sizeText, withUnit} from "./lengths.js";

const FEWEST = 6; // fewer pictures per second are not shown as a number

let times = []; // times of the pictures in the last second

// Returns the size of the piece in a picture as text. It is approximate until the piece is finished.
const pieceText = ({size_mm: size, is_size_exact: isExact}) => `piece ${isExact ? "" : "≈ "}${sizeText(size)}`;

// Shows the numbers that come with a picture. `height` is a text, and `modelFacts` has facts about the model.
export function showNumbers({facts, ms, isFine, height, modelFacts}) {
  const now = performance.now();
  times = isFine ? [] : [...times.filter((time) => now - time < 1000), now];
  const parts = [
    [modelFacts && `${count(modelFacts.visible_points)} of ${count(modelFacts.input_points)} points visible`, "minor"],
    [`height ${height} ${shown.unit}`], [pieceText(facts)],
    [times.length >= FEWEST && `${times.length} frames/s`, "minor"],
    [!isFine && ms && `${ms.toFixed(0)} ms`, "minor"]];
  $("#numbers").replaceChildren(...parts.filter(([text]) => text).map(([text, kind]) =>
    make("span", {class: kind}, text)));
  const time = (name, spent) => `${name} ${spent.toFixed(1)} ms`;
  const solves = facts.solves > 0 ? [`${time("heights", facts.heights_ms)} in ${facts.solves} solves`] : [];
  const spent = [...solves, time("detail or correction", facts.after_solve_ms), time("normals", facts.normals_ms),
    time("picture", facts.drawing_ms)];
  $("#numbers").title = `height reached ${facts.height_mm.toFixed(4)} mm; ${spent.join(", ")}`;
}

// Returns the parameters of a picture, named by the paper's symbols.
export function paperWords({alpha, beta, u}, gamma) {
  const text = (x) => (x === null ? "–" : Number(x.toPrecision(4)).toString());
  const words = Object.entries({alpha, beta, gamma, u}).map(([name, value]) => `${name} ${text(value)}`);
  return `In the paper's words: ${words.join(", ")}`;
}

// Shows the share of the front that the milling tool reaches. The picture colours the areas where the
// tool leaves material.
export function showToolReach(tool) {
  $("#tool-reach").textContent = !tool ? "" :
    `The tool reaches ${(100 * tool.share).toFixed(1)} % of the front, and leaves up to ` +
    `${withUnit(tool.left_mm)}: orange to red on the piece.`;
}

// Returns about `count` round values between `low` and `high`.
function ticks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((x) => x * power).find((x) => x >= rough), all = [];
  for (let i = Math.ceil(low / step); i * step <= high; ++i) all.push(i * step);
  return {all, decimals: Math.max(0, -Math.floor(Math.log10(step)))};
}

const AROUND = {left: 44, bottom: 20, top: 6, right: 14}; // margins of the chart in pixels, at the usual font size

// Shows the heights along a line. `heights` is empty if the line does not cross the piece.
export function showSection(heights, from, to) {
  const svg = $("#section-chart"), box = svg.getBoundingClientRect();
  svg.replaceChildren();
  $("#section-text").textContent = "The line passes the piece by.";
  if (!box.width || heights.length === 0) return;
  const type = scaleOfType(), [left, base, top, right] = Object.values(AROUND).map((pixels) => pixels * type);
  const width = box.width - left - right, height = box.height - top - base, scale = millimetresPerUnit();
  const low = Math.min(0, ...heights), high = Math.max(0.01, ...heights);
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const x = (mm) => left + mm / length * width, y = (z) => top + height * (1 - (z - low) / (high - low));
  const place = (z, i) => `${x(i / (heights.length - 1) * length).toFixed(1)} ${y(z).toFixed(1)}`;
  const points = heights.map(place).join("L");
  const across = ticks(0, length / scale, 8), upwards = ticks(low / scale, high / scale, 3), end = left + width;
  const bottom = top + height, reading = make("g");
  svg.setAttribute("viewBox", `0 0 ${box.width} ${box.height}`);
  svg.replaceChildren(
    make("path", {class: "area", d: `M${left} ${y(low)}L${points}L${end} ${y(low)}Z`}),
    ...upwards.all.flatMap((z) => [make("path", {class: "ground", d: `M${left} ${y(z * scale)}H${end}`}),
      make("text", {x: left - 6, y: y(z * scale) + 4 * type, "text-anchor": "end"}, z.toFixed(upwards.decimals))]),
    ...across.all.flatMap((mm) => [make("path", {class: "ground", d: `M${x(mm * scale)} ${bottom}v4`}),
      make("text", {x: x(mm * scale), y: bottom + 15 * type, "text-anchor": "middle"}, mm.toFixed(across.decimals))]),
    make("path", {class: "line", d: `M${points}`}), reading);
  showReadings(svg, reading, {heights, length, x, y, top, bottom});
  const times = (height / (high - low)) / (width / length), text = (z) => lengthText(z);
  $("#section-text").textContent = `Section, ${withUnit(length, 1)} long, ` +
    `from ${text(low)} to ${text(high)} ${shown.unit}; heights are drawn ${times.toFixed(1)} times as large as lengths`;
}

let pointed = null; // x coordinate of the pointer over the chart; kept while the chart is redrawn under the pointer

// Shows the pointer's position and the height of the section there, in the element `reading` of the chart.
function showReadings(svg, reading, {heights, length, x, y, top, bottom}) {
  const show = () => {
    if (pointed === null) return reading.replaceChildren();
    const share = (pointed - svg.getBoundingClientRect().left - x(0)) / (x(length) - x(0));
    const i = Math.round(clamp(share, 0, 1) * (heights.length - 1)), mm = i / (heights.length - 1) * length;
    const text = `${withUnit(mm)} along, height ${withUnit(heights[i])}`;
    const [gap, anchor] = share < 0.5 ? [8, "start"] : [-8, "end"];
    reading.replaceChildren(make("path", {class: "line", d: `M${x(mm)} ${top}V${bottom}`}),
      make("circle", {class: "line", cx: x(mm), cy: y(heights[i]), r: 3}),
      make("text", {class: "reading", x: x(mm) + gap, y: top + 10, "text-anchor": anchor}, text));
  };
  const point = (to) => {
    pointed = to;
    show();
  };
  svg.onpointermove = ({clientX}) => point(clientX);
  svg.onpointerleave = () => point(null);
  show();
}

// `isAlone` is true while no relief is shown.
export function showProgress({busy, stage, fraction = 0}, isAlone) {
  const box = $("#progress"), percent = Math.round(fraction * 100), name = about.stages[stage] ?? stage;
  box.hidden = !busy;
  box.classList.toggle("alone", isAlone);
  $(".track", box).setAttribute("aria-valuenow", percent);
  $(".track", box).setAttribute("aria-valuetext", `${name}, ${percent} percent`);
  $(".fill", box).style.width = `${Math.max(4, percent)}%`;
  $("#stage-name").textContent = `${name} …`;
}
