// Converts between a view's options and its directions. Directions are unit vectors: `towards` points to the viewer,
// and `up` points upwards.

import {about} from "./about.js";
import {sentence} from "./controls.js";
import {cross, dot, text, triple, turned, unit, upright} from "./vectors.js";

export const SIDES = Object.fromEntries(about.views.map(({name, towards, up}) => [name, {towards, up}]));

// Returns the directions of a document's view; null if the engine has not chosen the view yet.
export function directionsOf({view, up}) {
  if (view === "auto") return null;
  const towards = unit(SIDES[view]?.towards ?? triple(view));
  return {towards, up: upright(up ? triple(up) : SIDES[view]?.up ?? [0, 1, 0], towards)};
}

// Returns the options of a view: the name of a side, or the directions of any other view.
export function optionsOf({towards, up}) {
  const isAt = ([, side]) => dot(side.towards, towards) > 1 - 1e-9 && dot(side.up, up) > 1 - 1e-9;
  const side = Object.entries(SIDES).find(isAt);
  return side ? {view: side[0], up: ""} : {view: text(towards), up: text(up)};
}

// Returns the name of a view for users: "Front", for example, or "Turned by hand" if the view is not a side.
export const viewName = (view) =>
  (view === "auto" ? "Best side" : SIDES[view] ? sentence(view) : "Turned by hand");

// Returns the view after the user has turned the model, by angles in radians. Turning the model one way moves the
// viewer the other way.
export function turnedByHand({towards, up}, dx, dy, roll = 0) {
  for (const [axis, angle] of [[up, -dx], [cross(up, towards), -dy], [towards, -roll]]) {
    towards = unit(turned(towards, axis, angle));
    up = upright(turned(up, axis, angle), towards);
  }
  return {towards, up};
}

// Returns the options `view` and `up` after the model was rotated about the viewing direction, by an angle in degrees,
// counterclockwise if positive.
export function viewTurned(options, degrees) {
  const {towards, up} = turnedByHand(directionsOf(options), 0, 0, degrees * Math.PI / 180);
  return {view: text(towards), up: text(up)};
}
