// Gets the options with their ranges and defaults, and the names of views, materials and stages, from the engine. The
// page has no copy of them.

import {Engine} from "./engine.js";
import {toast} from "./messages.js";
import {Transport} from "./transport.js";

export const engine = new Engine(new Transport());

async function ask() {
  try {
    return await engine.about();
  } catch (error) {
    document.body.inert = false; // makes the error message accessible
    toast(error.message, true);
    throw error;
  }
}

export const about = await ask();

// Returns the facts about an option: {name, unit, help, stage, default, default_with, in_studio, is_stated, is_hidden}.
// Numbers also have min and max, and enumerations have choices.
export const optionOf = (name) => about.options.find((option) => option.name === name);

// Returns the default of an option; null if it has none. `by` is the name of a method or a form, or "diameter". If the
// option has a special default for `by`, returns that default.
export function defaultOf(name, by) {
  const option = optionOf(name), value = option.default ?? null;
  return option.default_with?.[by] ?? value?.[by] ?? value; // `value` is an object if methods have different defaults
}

export const namesOf = (...stages) =>
  about.options.filter(({stage}) => stages.includes(stage)).map(({name}) => name);
