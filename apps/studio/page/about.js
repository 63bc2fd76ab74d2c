// The engine, and its answer when the page began: options with their ranges and defaults, names of views, materials and
// stages. The page spells none of these itself.

import {Engine} from "./engine.js";
import {toast} from "./messages.js";
import {Transport} from "./transport.js";

export const engine = new Engine(new Transport());

async function ask() {
  try {
    return await engine.about();
  } catch (error) {
    document.body.inert = false; // the line is there to be read
    toast(error.message, true);
    throw error;
  }
}

export const about = await ask();

// Returns {name, unit, help, min, max, choices, default} of an option; min and max of numbers only, choices of
// enumerations only.
export const optionOf = (name) => about.options.find((option) => option.name === name);

// Returns the value that rules with a method where the option is not given; null if it has none.
export function defaultOf(name, method) {
  const value = optionOf(name).default ?? null;
  return value?.[method] ?? value; // an object where methods differ
}
