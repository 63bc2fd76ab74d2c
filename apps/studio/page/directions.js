// Views as directions: the unit vectors {towards, up} point to the viewer and upwards.

import {about} from "./about.js";
import {sentence} from "./controls.js";
import {cross, dot, text, triple, turned, unit, upright} from "./vectors.js";

export const SIDES = Object.fromEntries(about.views.map(({name, towards, up}) => [name, {towards, up}]));

// Returns the directions of a document's view; nothing where the engine is still to choose it.
export function directionsOf({view, up}) {
  if (view === "auto") return null;
  const towards = unit(SIDES[view]?.towards ?? triple(view));
  return {towards, up: upright(up ? triple(up) : SIDES[view]?.up ?? [0, 1, 0], towards)};
}

// Returns the view as options: a side by its name, others by their directions.
export function optionsOf({towards, up}) {
  const isAt = ([, side]) => dot(side.towards, towards) > 1 - 1e-9 && dot(side.up, up) > 1 - 1e-9;
  const side = Object.entries(SIDES).find(isAt);
  return side ? {view: side[0], up: ""} : {view: text(towards), up: text(up)};
}

// Returns "Front", or "Turned by hand" for other directions.
export const viewName = (view) =>
  (view === "auto" ? "Best side" : SIDES[view] ? sentence(view) : "Turned by hand");

// Returns a view after the model was turned by the hand, which is to turn the viewer the other way. Angles in radians.
export function turnedByHand({towards, up}, dx, dy, roll = 0) {
  for (const [axis, angle] of [[up, -dx], [cross(up, towards), -dy], [towards, -roll]]) {
    towards = unit(turned(towards, axis, angle));
    up = upright(turned(up, axis, angle), towards);
  }
  return {towards, up};
}

// Returns the view of options with the model turned by degrees, to the left for positive ones.
export function viewTurned(options, degrees) {
  const {towards, up} = turnedByHand(directionsOf(options), 0, 0, degrees * Math.PI / 180);
  return {view: text(towards), up: text(up)};
}
