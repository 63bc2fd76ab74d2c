// Makes instances of the package's own module.
import { compile } from "./compile.js";
import { Engine } from "./engine.js";
import { compressedModule } from "./module.js";

let module; // the compiled module; all instances share it

export async function newEngine() {
  module ??= compile(compressedModule);
  return Engine.create(await module);
}
