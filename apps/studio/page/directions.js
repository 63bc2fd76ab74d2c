// Converts views to directions and back. The directions are unit vectors: `towards` points to the viewer, and `up`
// upwards.

import {about} from "./about.js";
import {sentence} from "./controls.js";
import {cross, dot, text, triple, turned, unit, upright} from "./vectors.js";

export const SIDES = Object.fromEntries(about.views.map(({name, towards, up}) => [name, {towards, up}]));

// Returns the directions of a document's view; null if the engine has yet to choose it.
export function directionsOf({view, up}) {
  if (view === "auto") return null;
  const towards = unit(SIDES[view]?.towards ?? triple(view));
  return {towards, up: upright(up ? triple(up) : SIDES[view]?.up ?? [0, 1, 0], towards)};
}

// Returns the view as options: a side by its name, other views by their directions.
export function optionsOf({towards, up}) {
  const isAt = ([, side]) => dot(side.towards, towards) > 1 - 1e-9 && dot(side.up, up) > 1 - 1e-9;
  const side = Object.entries(SIDES).find(isAt);
  return side ? {view: side[0], up: ""} : {view: text(towards), up: text(up)};
}

// Returns the name of a view for users, such as "Front"; "Turned by hand" for other directions than sides.
export const viewName = (view) =>
  (view === "auto" ? "Best side" : SIDES[view] ? sentence(view) : "Turned by hand");

// Returns the view after the user has turned the model: the viewer turns the opposite way. Angles are in radians.
export function turnedByHand({towards, up}, dx, dy, roll = 0) {
  for (const [axis, angle] of [[up, -dx], [cross(up, towards), -dy], [towards, -roll]]) {
    towards = unit(turned(towards, axis, angle));
    up = upright(turned(up, axis, angle), towards);
  }
  return {towards, up};
}

// Returns the options `view` and `up` after the model was turned in the plane of the picture by an angle in degrees,
// counterclockwise if it is positive.
export function viewTurned(options, degrees) {
  const {towards, up} = turnedByHand(directionsOf(options), 0, 0, degrees * Math.PI / 180);
  return {view: text(towards), up: text(up)};
}
