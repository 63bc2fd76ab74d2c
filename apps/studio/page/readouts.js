// The numbers in the status line, and the chart of the section.

import {$, count, make, scaleOfType} from "./controls.js";
import {lengthText, millimetresPerUnit, shown} from "./lengths.js";

const FEWEST = 6; // pictures in a second from which their number is told

let times = []; // of the newest pictures

// Shows the numbers that come with a picture: `height` is the one to show, `facts` those of the model.
export function showNumbers({about, ms, isFine, height, facts}) {
  const now = performance.now();
  times = isFine ? [] : [...times.filter((time) => now - time < 1000), now];
  const parts = [facts && `${count(facts.visible_points)} of ${count(facts.input_points)} points`,
    `height ${lengthText(height)} ${shown.unit}`,
    `piece ${about.size_mm.map((mm) => lengthText(mm)).join(" × ")} ${shown.unit}`,
    times.length >= FEWEST ? `${times.length} frames/s` : "", !isFine && ms ? `${ms.toFixed(0)} ms` : ""];
  $("#numbers").textContent = parts.filter(Boolean).join("   ·   ");
  const time = (name, spent) => `${name} ${spent.toFixed(1)} ms`;
  const spent = [`${time("heights", about.heights_ms)} in ${about.solves} solves`, time("detail", about.detail_ms),
    time("normals", about.normals_ms), time("picture", about.drawing_ms)];
  $("#numbers").title = `height reached ${about.height_mm.toFixed(4)} mm; ${spent.join(", ")}`;
}

// Returns the parameters of a picture in the symbols of the paper.
export function paperWords({alpha, beta, u}, gamma) {
  const text = (x) => (x === null ? "–" : Number(x.toPrecision(4)).toString());
  const words = Object.entries({alpha, beta, gamma, u}).map(([name, value]) => `${name} ${text(value)}`);
  return `In the paper's words: ${words.join(", ")}`;
}

// Says what the tool leaves standing, which is coloured on the piece.
export function showToolReach(tool) {
  $("#tool-reach").textContent = !tool ? "" :
    `The tool reaches ${(100 * tool.share).toFixed(1)} % of the front, and leaves up to ` +
    `${lengthText(tool.left_mm)} ${shown.unit}: orange to red on the piece.`;
}

// Returns round values between two, about so many.
function ticks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((x) => x * power).find((x) => x >= rough), all = [];
  for (let i = Math.ceil(low / step); i * step <= high; ++i) all.push(i * step);
  return {all, decimals: Math.max(0, -Math.floor(Math.log10(step)))};
}

const AROUND = {left: 44, bottom: 20, top: 6, right: 14}; // pixels beside the chart, where type has its usual size

export function showSection(heights, from, to) {
  const svg = $("#section-chart"), box = svg.getBoundingClientRect();
  if (!box.width) return;
  const type = scaleOfType(), [left, base, top, right] = Object.values(AROUND).map((pixels) => pixels * type);
  const width = box.width - left - right, height = box.height - top - base, scale = millimetresPerUnit();
  const low = Math.min(0, ...heights), high = Math.max(0.01, ...heights);
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
  const x = (mm) => left + mm / length * width, y = (z) => top + height * (1 - (z - low) / (high - low));
  const place = (z, i) => `${x(i / (heights.length - 1) * length).toFixed(1)} ${y(z).toFixed(1)}`;
  const points = heights.map(place).join("L");
  const across = ticks(0, length / scale, 8), upwards = ticks(low / scale, high / scale, 3), end = left + width;
  const bottom = top + height;
  svg.setAttribute("viewBox", `0 0 ${box.width} ${box.height}`);
  svg.replaceChildren(
    make("path", {class: "area", d: `M${left} ${y(low)}L${points}L${end} ${y(low)}Z`}),
    ...upwards.all.flatMap((z) => [make("path", {class: "ground", d: `M${left} ${y(z * scale)}H${end}`}),
      make("text", {x: left - 6, y: y(z * scale) + 4 * type, "text-anchor": "end"}, z.toFixed(upwards.decimals))]),
    ...across.all.flatMap((mm) => [make("path", {class: "ground", d: `M${x(mm * scale)} ${bottom}v4`}),
      make("text", {x: x(mm * scale), y: bottom + 15 * type, "text-anchor": "middle"}, mm.toFixed(across.decimals))]),
    make("path", {class: "line", d: `M${points}`}));
  const times = (height / (high - low)) / (width / length), text = (z) => lengthText(z);
  $("#section-text").textContent = `Section, ${lengthText(length, 1)} ${shown.unit} long, ` +
    `from ${text(low)} to ${text(high)} ${shown.unit}; heights are drawn ${times.toFixed(1)} times as large as lengths`;
}
