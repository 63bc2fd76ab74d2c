// Lists the kinds of ornaments, and returns facts about where they are placed.

import {FIRST, ON_GROUND} from "../document.js";
import {fileNameOf} from "../file_field.js";

export const KINDS = {text: "Text", beads: "Beads", rope: "Rope", line: "Line", drawing: "Drawing"};
export const ARCS = {straight: "Straight", top: "Arc at the top", bottom: "Arc at the bottom", around: "All around"};

// Returns the changes that give a document this list of ornaments.
export const partOf = (list) => ({options: {...Object.fromEntries(ON_GROUND.map((name) => [name, FIRST.options[name]])),
  ornaments: list.length ? JSON.stringify({ornaments: list}) : ""}});

// Return whether an ornament is a text on a circle, and whether it is an ornament with a position of its own.
export const isOnArc = ({kind = "text", arc = "straight"}) => kind === "text" && arc !== "straight";
export const hasPlace = ({kind = "text", arc = "straight"}) => kind === "drawing" || (kind === "text" && arc === "straight");

// Returns the direction of the middle of a text on an arc, in degrees counterclockwise from the right.
export const angleOf = ({arc, angle}) => angle ?? (arc === "bottom" ? 270 : 90);

export const nameOf = ({kind = "text", text, file}) =>
  (kind === "text" ? `“${text}”` : kind === "drawing" && file ? fileNameOf(file) : KINDS[kind] ?? kind);

// The keys of the files that ornaments have, and the endings of such files.
export const FILES = {
  font: {what: "font", endings: ".ttf,.otf,.ttc"},
  file: {what: "drawing", endings: ".svg"},
};
export const keyOfFile = (name) => Object.keys(FILES).find((key) =>
  FILES[key].endings.split(",").some((ending) => name.toLowerCase().endsWith(ending)));
