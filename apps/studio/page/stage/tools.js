// Lists the tools of the picture, with their functions for drags and keys. A tool has
//   does                    description of a drag, for the label of the picture
//   isLevel                 whether choosing the tool turns the relief to the front view
//   isStepwise              whether move() gets the movement since the last event, not since the start of the drag
//   press(stage, event)     called when a drag begins
//   move(stage, to)         called during a drag; `to` is {x, y, dx, dy, event}: the pointer's position and movement
//   release(stage, drag)    called when a drag has ended
//   step(stage, x, y)       called for arrow keys, with smaller steps if Shift is pressed
//   strike(stage)           called for Space

import {ARROWS, clamp} from "../controls.js";
import {angles, degrees, direction} from "../lights.js";

function setLight(stage, azimuth, elevation) {
  const light = direction(azimuth, clamp(elevation, 8, 88)).map((x) => Math.round(x * 1e4) / 1e4);
  stage.doc.change({light}, "light");
}

// Sets the light by the position of the pointer. At the centre of the picture the light comes from the viewer; towards
// the edge it gets lower.
function lightFrom(stage, {x, y}) {
  const {width, height} = stage.size, radius = Math.min(width, height) / 2;
  const dx = (x - width / 2) / radius, dy = (height / 2 - y) / radius;
  stage.sun = [x, y];
  setLight(stage, degrees(Math.atan2(dy, dx)), 82 - 72 * Math.min(1, Math.hypot(dx, dy)));
  stage.drawOverlay();
}

// Moves the figure. With Shift, rotates it about its centre; the rotation is applied when the drag ends, because the
// model must then be prepared again.
function place(stage, {dx, dy, event}) {
  const {drag, pixelsPerMm} = stage, [x, y] = stage.toPixels(stage.figureMiddle());
  const angleAt = (px, py) => degrees(Math.atan2(y - py, px - x));
  if (event.shiftKey) drag.angle = angleAt(event.offsetX, event.offsetY) - angleAt(drag.x, drag.y);
  else if (!drag.angle) stage.on.placing.move(dx / pixelsPerMm, -dy / pixelsPerMm);
  stage.drawOverlay();
}

// Calls set(line) while the user draws a line or drags one of its ends.
function drawLine(stage, line, {x, y, dx, dy}, set) {
  if (Math.hypot(dx, dy) > 3) set(stage.measure.dragged(line, stage.drag, stage.toPlace(x, y)));
}

export const TOOLS = {
  light: {
    does: "move the light", move: lightFrom,
    press: (stage, {offsetX: x, offsetY: y}) => lightFrom(stage, {x, y}),
    step(stage, x, y) {
      const {azimuth, elevation} = angles(stage.doc.now.light);
      setLight(stage, azimuth - x * 10, elevation + y * 5);
    },
  },
  turn: {
    does: "turn the model", isStepwise: true, press: ({turning}) => turning.begin(),
    move: ({turning}, {dx, dy, event}) => turning.drag(dx, dy, event.shiftKey), release: ({turning}) => turning.end(),
    step: ({turning}, x, y) => turning.step(x, y),
  },
  orbit: {
    does: "orbit the relief", isStepwise: true, move: (stage, {dx, dy}) => stage.orbit(dx * 0.4, dy * 0.4),
    step: (stage, x, y) => stage.orbit(x * 5, -y * 5),
  },
  pan: {
    does: "move the picture", isStepwise: true,
    move: (stage, {dx, dy}) => stage.shift(-dx / stage.pixelsPerMm, dy / stage.pixelsPerMm),
    step: (stage, x, y) => stage.shift(x * 20 / stage.pixelsPerMm, y * 20 / stage.pixelsPerMm),
  },
  place: {
    does: "move the figure on its plate", isLevel: true, move: place,
    release: ({on: {placing}}, {angle}) => angle && placing.turn(angle),
    step({facts, on: {placing}}, x, y) {
      if (facts && placing.begin(facts.size_mm)) placing.move(x, y);
    },
  },
  brush: {
    does: "paint; Space sets the brush down and lifts it", isLevel: true,
    press: (stage, event) => stage.on.brush.press(stage, event), move: (stage, to) => stage.on.brush.move(stage, to),
    release: ({on: {brush}}) => brush.end(), step: (stage, x, y) => stage.on.brush.step(stage, x, y),
    strike: (stage) => stage.on.brush.toggle(stage),
  },
  crop: {does: "move the frame of the crop", step: ({on: {cropFrame}}, x, y) => cropFrame.step(x, y)},
  section: {
    does: "move the section", isLevel: true,
    move: (stage, to) => drawLine(stage, stage.line, to, (line) => stage.setLine(line)),
    step(stage, x, y) {
      const {line} = stage, moved = ([px, py]) => [px + x, py + y];
      if (line) stage.setLine({from: moved(line.from), to: moved(line.to)});
    },
  },
  measure: {
    does: "measure", isLevel: true,
    move: (stage, to) => drawLine(stage, stage.measure.line, to, (line) => stage.measure.setLine(line)),
  },
  divider: {move: ({comparing}, {x}) => comparing.drag(x)},
  none: {}, // for a drag that was cancelled
};

// Handles keys on the relief: arrow keys apply to the chosen tool, + and - zoom.
export function takeKey(stage, event) {
  const {width, height} = stage.size, step = ARROWS[event.key], size = event.shiftKey ? 0.2 : 1;
  if (event.key === "+") return stage.zoomBy(1.2, width / 2, height / 2);
  if (event.key === "-") return stage.zoomBy(1 / 1.2, width / 2, height / 2);
  if (event.target !== stage.element || !(step || (event.key === " " && TOOLS[stage.tool].strike))) return;
  event.preventDefault();
  if (!step) return TOOLS[stage.tool].strike(stage);
  TOOLS[stage.tool].step?.(stage, step[0] * size, step[1] * size);
}
