// Reads the list of ornaments (texts, borders and drawings) of a document. The list is the JSON text of the option
// `ornaments`, so projects contain it. This file imports no other file of the page, because transports import it, and
// the other files need the facts that a transport provides.

const isPath = (source) => !/^(?:[{[]|$)/.test(source);

// Returns the path if the option `ornaments` names a file with the list; "" if the option itself has the list. The page
// can stop using such a file, but cannot change it.
export const fileOf = ({ornaments}) => (isPath(ornaments) ? ornaments : "");

// Returns the text that the options `text`, `font` and `text-...` describe, as a list of at most one ornament. Projects
// and the command line may have these options instead of a list.
function ownText({text, font, ...options}) {
  const own = Object.fromEntries(["arc", "size", "height", "inset"].map((key) => [key, options[`text-${key}`]]));
  return text ? [withoutEmpty({kind: "text", text, ...own, font})] : [];
}

function parsed(source) {
  if (source === "" || isPath(source)) return [];
  try {
    const json = JSON.parse(source), list = Array.isArray(json) ? json : json.ornaments;
    return Array.isArray(list) ? list.filter((each) => each && typeof each === "object") : [];
  } catch {
    return []; // the engine reports the error
  }
}

// Returns the ornaments of a document in the engine's order.
export const listOf = (options) => [...ownText(options), ...parsed(options.ornaments)];

// Returns an ornament without the keys that have no value.
export const withoutEmpty = (ornament) => Object.fromEntries(Object.entries(ornament).filter(([, value]) =>
  value !== null && value !== undefined && value !== "" && value !== false));

// Returns the paths of the fonts and drawings of a document.
export const filesIn = (options) => listOf(options).flatMap(({font, file}) => [font, file])
  .filter((path) => path && typeof path === "string");
