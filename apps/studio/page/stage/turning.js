// Turns the model on the picture. A drag shows the relief from other sides, and the last view becomes the view
// of the document.

import {SIDES, cross, directionsOf, dot, optionsOf, turnedByHand, upright} from "../directions.js";

const NEAR = Math.cos(6 * Math.PI / 180); // a view within 6 degrees of a side or of level snaps to it
const HALF_TURN = 0.9; // drag length for half a turn, as a fraction of the picture's shorter side

// Returns the nearest side if the view is close to that side. Otherwise returns the view itself, levelled if its roll
// is small.
function snapped({towards, up}) {
  for (const side of Object.values(SIDES)) {
    if (dot(side.towards, towards) < NEAR) continue;
    const axes = [side.up, cross(side.towards, side.up)].flatMap((a) => [a, a.map((x) => -x)]);
    const near = axes.find((axis) => dot(axis, up) > NEAR);
    if (near) return {towards: side.towards, up: near.map((x) => x + 0)};
  }
  for (const axis of [[0, 1, 0], [0, 0, 1]]) {
    const level = upright(axis, towards);
    if (dot(level, up) > NEAR) return {towards, up: level};
  }
  return {towards, up};
}

export class Turning {
  constructor(stage) {
    this.stage = stage;
    this.shown = null; // directions of the shown view if it is not prepared yet
  }

  show(directions) {
    this.shown = directions;
    this.stage.invalidate();
  }

  // Shows a turned relief in the document's view while that view is being prepared.
  await(isAwaiting) {
    if (this.stage.drag?.tool === "turn") return;
    this.shown = isAwaiting ? directionsOf(this.stage.doc.now.options) : null;
  }

  begin() {
    this.view = directionsOf(this.stage.doc.now.options) ?? SIDES.front;
  }

  turn(...angles) {
    this.view = turnedByHand(this.view, ...angles);
    this.show(snapped(this.view));
  }

  drag(dx, dy, isRoll) {
    const {width, height} = this.stage.size, scale = Math.PI / (HALF_TURN * Math.min(width, height));
    isRoll ? this.turn(0, 0, dx * scale) : this.turn(dx * scale, dy * scale);
  }

  // Turns the model by arrow keys, 10 degrees each time.
  step(x, y) {
    this.begin();
    this.turn(x * Math.PI / 18, -y * Math.PI / 18);
    this.end();
  }

  // Sets the document's view to the last view of the turn. If the document already has this view, but another view is
  // being prepared, requests the document's view again.
  end() {
    const {stage} = this, {doc} = stage;
    if (!this.shown) return;
    const options = optionsOf(this.shown), {view, up} = doc.now.options;
    if (view !== options.view || up !== options.up) doc.change({options});
    else if (stage.isAwaiting) stage.on.viewRests();
    else this.show(null);
  }
}
