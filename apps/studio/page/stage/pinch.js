// Two fingers on the relief move the picture and zoom. With the tool Place they scale and turn the figure.

import {placeIn} from "../controls.js";

const SLACK = 8; // two fingers that turn by less than this angle in degrees only scale

const within180 = (angle) => angle - 360 * Math.round(angle / 360);

// Calls begin() when the second finger touches the element, and end() when a finger is lifted. In between calls
// move(from, to, ratio, turn) for each movement. `from` and `to` are the old and the new midpoint of the fingers, in
// pixels of the element. `ratio` is the new distance of the fingers divided by the old one. `turn` is the
// counterclockwise angle in degrees.
function takePinches(element, {begin, move, end}) {
  const fingers = new Map();
  let last = null; // the last measurement; null unless two fingers touch
  const measure = () => {
    if (fingers.size !== 2) return null;
    const [a, b] = fingers.values(), [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    return {middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], apart: Math.max(1, Math.hypot(dx, dy)),
      angle: Math.atan2(-dy, dx) * 180 / Math.PI};
  };
  element.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "touch") return;
    fingers.set(event.pointerId, placeIn(element, event));
    last = measure();
    if (last) begin();
  });
  element.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    fingers.set(event.pointerId, placeIn(element, event));
    const now = measure();
    if (now) move(last.middle, now.middle, now.apart / last.apart, within180(now.angle - last.angle));
    last = now;
  });
  const lift = ({pointerId}) => {
    if (!fingers.delete(pointerId)) return;
    last = measure();
    if (fingers.size === 1) end();
  };
  for (const type of ["pointerup", "pointercancel"]) element.addEventListener(type, lift);
}

// Scales the figure at once. The rotation follows when the fingers are lifted, in the same step of the document.
function placeFigure(stage, ratio, turn) {
  const {drag, facts} = stage, {placing} = stage.on;
  if (drag?.tool !== "place") return; // placing is impossible, or Escape has ended the drag
  drag.ratio *= ratio;
  drag.turned += turn;
  drag.angle = Math.abs(drag.turned) > SLACK ? drag.turned : 0;
  placing.scale(drag.ratio, facts.size_mm, drag.width);
  stage.drawOverlay();
}

export function takeFingers(stage) {
  takePinches(stage.element, {
    begin() {
      stage.takeBack(); // undoes the drag of the first finger
      stage.release();
      const {placing} = stage.on;
      if (stage.tool === "place" && stage.facts && placing.begin(stage.facts.size_mm))
        stage.drag = {tool: "place", ratio: 1, turned: 0, angle: 0, width: placing.shownWidth()};
    },
    move([fromX, fromY], [x, y], ratio, turn) {
      if (stage.tool === "place") return placeFigure(stage, ratio, turn);
      stage.zoomBy(ratio, x, y);
      stage.shift((fromX - x) / stage.pixelsPerMm, (y - fromY) / stage.pixelsPerMm);
    },
    end: () => stage.release(),
  });
}
