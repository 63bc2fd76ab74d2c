// Keys on the relief: arrows move what the tool in hand moves, finely with shift, and + and - zoom.

import {angles} from "./lights.js";

const STEPS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};

// Moves by one step, which has a size of x or y, what the stage's tool moves.
function move(stage, x, y) {
  const {tool, pixelsPerMm, on} = stage;
  if (tool === "light") {
    const {azimuth, elevation} = angles(stage.doc.now.light);
    stage.setLight(azimuth - x * 10, elevation + y * 5);
  }
  if (tool === "turn") stage.turning.step(x, y);
  if (tool === "orbit") stage.orbit(x * 5, -y * 5);
  if (tool === "pan") stage.shift(x * 20 / pixelsPerMm, y * 20 / pixelsPerMm);
  if (tool === "place" && stage.about && on.placing.begin(stage.about.size_mm)) on.placing.move(x, y);
  if (tool === "crop") on.cropFrame.step(x, y);
  if (tool === "section" && stage.line) {
    const moved = ([px, py]) => [px + x, py + y];
    stage.setLine({from: moved(stage.line.from), to: moved(stage.line.to)});
  }
}

export function takeKey(stage, event) {
  const {width, height} = stage.size, step = STEPS[event.key], size = event.shiftKey ? 0.2 : 1;
  if (event.key === "+") return stage.zoomBy(1.2, width / 2, height / 2);
  if (event.key === "-") return stage.zoomBy(1 / 1.2, width / 2, height / 2);
  if (!step || event.target !== stage.element) return;
  event.preventDefault();
  move(stage, step[0] * size, step[1] * size);
}
