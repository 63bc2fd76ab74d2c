// Asks the engine for the options with their ranges and defaults, and for the names of views, materials and stages. The
// page has no copy of these.

import {Engine} from "./engine.js";
import {toast} from "./messages.js";
import {Transport} from "./transport.js";

export const engine = new Engine(new Transport());

async function ask() {
  try {
    return await engine.about();
  } catch (error) {
    document.body.inert = false; // the error must be readable
    toast(error.message, true);
    throw error;
  }
}

export const about = await ask();

// Returns the row of an option: {name, unit, help, stage, default, default_with, in_studio, is_stated, is_hidden}.
// Numbers also have min and max, and enumerations have choices.
export const optionOf = (name) => about.options.find((option) => option.name === name);

// Returns the default of an option; null if it has none. `by` is the method, or a form or "diameter" that has a default
// of its own.
export function defaultOf(name, by) {
  const option = optionOf(name), value = option.default ?? null;
  return option.default_with?.[by] ?? value?.[by] ?? value; // an object if methods have different defaults
}

// Returns the names of the options of some stages.
export const namesOf = (...stages) =>
  about.options.filter(({stage}) => stages.includes(stage)).map(({name}) => name);
