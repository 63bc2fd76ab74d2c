// The list of texts and borders in a document. It is the JSON of the option `ornaments`, so that projects have it inside.
// Imports nothing, because transports use it, and other files wait for what a transport gets.

const isPath = (source) => !/^(?:[{[]|$)/.test(source);

// Returns the file that has the list, or "". The page cannot change such a list, only remove it.
export const fileOf = ({ornaments}) => (isPath(ornaments) ? ornaments : "");

// Returns the text that a project or the command line gives by options of its own.
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
    return []; // the engine says what is wrong with it
  }
}

// Returns the ornaments of a document in the order in which the engine has them.
export const listOf = (options) => [...ownText(options), ...parsed(options.ornaments)];

// Returns an ornament without the keys that have no value.
export const withoutEmpty = (ornament) => Object.fromEntries(Object.entries(ornament).filter(([, value]) =>
  value !== null && value !== undefined && value !== "" && value !== false));

// Returns the paths of the fonts and drawings of a document.
export const filesIn = (options) => listOf(options).flatMap(({font, file}) => [font, file])
  .filter((path) => path && typeof path === "string");
