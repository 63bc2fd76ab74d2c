// Computes with vectors, which are arrays of three numbers, and converts between a view's options and its directions.
// Directions are unit vectors: `towards` points to the viewer, and `up` points upwards.

import {about, namesOf} from "./about.js";
import {sentence} from "./controls.js";

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

// Returns `a` rotated about a unit axis.
const turned = (a, axis, angle) => {
  const c = Math.cos(angle), s = Math.sin(angle), side = cross(axis, a), along = dot(axis, a) * (1 - c);
  return a.map((x, i) => x * c + side[i] * s + axis[i] * along);
};

// Returns the unit vector along the part of `up` that is perpendicular to the unit vector `towards`. If `up` is
// parallel to `towards`, uses another axis in its place.
export const upright = (up, towards) => {
  let right = cross(up, towards);
  const other = Math.abs(towards[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0];
  if (Math.hypot(...right) < 1e-6) right = cross(other, towards);
  return cross(towards, unit(right));
};

// Convert directions to the text of the command line, and back.
const text = (a) => a.map((x) => Number(x.toFixed(4))).join(",");
const triple = (t) => t.split(",").map(Number);

export const SIDES = Object.fromEntries(about.views.map(({name, towards, up}) => [name, {towards, up}]));

// Returns the directions of a document's view; null if the engine has not chosen the view yet.
export function directionsOf({view, up}) {
  if (view === "auto") return null;
  const towards = unit(SIDES[view]?.towards ?? triple(view));
  return {towards, up: upright(up ? triple(up) : SIDES[view]?.up ?? [0, 1, 0], towards)};
}

// Returns a text that identifies the picture of a scan seen from these directions. The text includes the options for
// reading the scan, such as the channel of a picture, because the scan's box depends on them.
export const pictureKey = (directions, {input, options}) =>
  JSON.stringify([directions, input, namesOf("input").map((name) => options[name])]);

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
