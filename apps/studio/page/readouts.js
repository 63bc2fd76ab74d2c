// The numbers in the status line, and the chart of the section.

import {$, count, make} from "./controls.js";

let times = [], frames = ""; // of the newest pictures

// Shows the numbers that come with a picture: `height` is the one to show, `facts` those of the model.
export function showNumbers({about, ms, isFine, height, facts}) {
  const now = performance.now();
  if (!isFine) times = [...times.filter((time) => now - time < 1000), now];
  if (!isFine && times.length > 5) frames = `${times.length} frames/s`;
  const parts = [facts && `${count(facts.visible_points)} of ${count(facts.input_points)} points`,
    `height ${height.toFixed(2)} mm`, frames, !isFine && ms ? `${ms.toFixed(0)} ms` : ""];
  $("#numbers").textContent = parts.filter(Boolean).join("   ·   ");
  const time = (name, spent) => `${name} ${spent.toFixed(1)} ms`;
  const spent = [`${time("heights", about.heights_ms)} in ${about.solves} solves`, time("detail", about.detail_ms),
    time("normals", about.normals_ms), time("picture", about.drawing_ms)];
  $("#numbers").title = `height reached ${about.height_mm.toFixed(4)} mm; ${spent.join(", ")}`;
}

export function showSection(heights, from, to) {
  const svg = $("#section-chart"), {width, height} = svg.getBoundingClientRect();
  if (!width) return;
  const low = Math.min(0, ...heights), high = Math.max(0.01, ...heights);
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]), mm = (z) => z.toFixed(2);
  const x = (i) => i / (heights.length - 1) * width, y = (z) => height - 4 - (z - low) / (high - low) * (height - 8);
  const points = heights.map((z, i) => `${x(i).toFixed(1)} ${y(z).toFixed(1)}`).join("L");
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.replaceChildren(
    make("path", {class: "area", d: `M0 ${y(low)}L${points}L${width} ${y(low)}Z`}),
    make("path", {class: "ground", d: `M0 ${y(0)}H${width}`}), make("path", {class: "line", d: `M${points}`}));
  $("#section-text").textContent = `Section, ${length.toFixed(1)} mm long, from ${mm(low)} to ${mm(high)} mm`;
}
