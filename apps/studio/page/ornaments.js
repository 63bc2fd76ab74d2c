// The list of texts and borders in a document. It is the JSON of the option `ornaments`, so that projects have it inside.

import {FIRST, ON_GROUND} from "./document.js";
import {fileNameOf} from "./file_field.js";

export const KINDS = {text: "Text", beads: "Beads", rope: "Rope", line: "Line", drawing: "Drawing"};
export const ARCS = {straight: "Straight", top: "Arc at the top", bottom: "Arc at the bottom", around: "All around"};

const isPath = (source) => !/^(?:[{[]|$)/.test(source);

// Returns the file that has the list, or "". The page cannot change such a list, only remove it.
export const fileOf = ({ornaments}) => (isPath(ornaments) ? ornaments : "");

// Returns the text that a project or the command line gives by options of its own.
function ownText({text, font, ...options}) {
  const [arc, size, height] = ["arc", "size", "height"].map((key) => options[`text-${key}`]);
  return text ? [withoutEmpty({kind: "text", text, arc, size, height, font})] : [];
}

function parsed(source) {
  if (source === "" || isPath(source)) return [];
  try {
    const json = JSON.parse(source);
    return Array.isArray(json) ? json : json.ornaments ?? [];
  } catch {
    return []; // the engine says what is wrong with it
  }
}

// Returns the ornaments of a document in the order in which the engine has them.
export const listOf = (options) => [...ownText(options), ...parsed(options.ornaments)];

// Returns an ornament without the keys that have no value.
export const withoutEmpty = (ornament) => Object.fromEntries(Object.entries(ornament).filter(([, value]) =>
  value !== null && value !== undefined && value !== "" && value !== false));

// Returns the change of a document to another list.
export const partOf = (list) => ({options: {...Object.fromEntries(ON_GROUND.map((name) => [name, FIRST.options[name]])),
  ornaments: list.length ? JSON.stringify({ornaments: list}) : ""}});

// Returns whether an ornament is a text that stands on a circle, or one that lies at a place.
export const isOnArc = ({kind = "text", arc = "straight"}) => kind === "text" && arc !== "straight";
export const hasPlace = ({kind = "text", arc = "straight"}) => kind === "drawing" || (kind === "text" && arc === "straight");

// Returns the angle in degrees, counter-clockwise from the right, of the middle of a text on an arc.
export const angleOf = ({arc, angle}) => angle ?? (arc === "bottom" ? 270 : 90);

export const nameOf = ({kind = "text", text, file}) =>
  (kind === "text" ? `“${text}”` : kind === "drawing" && file ? fileNameOf(file) : KINDS[kind] ?? kind);

// The keys of the files that ornaments have, and the endings of such files.
export const FILES = {
  font: {what: "font", endings: ".ttf,.otf,.ttc"},
  file: {what: "drawing", endings: ".svg"},
};
export const namesFiles = (options) => listOf(options).some(({font, file}) => font || file);
export const keyOfFile = (name) => Object.keys(FILES).find((key) =>
  FILES[key].endings.split(",").some((ending) => name.toLowerCase().endsWith(ending)));
