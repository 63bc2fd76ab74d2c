// Makes instances of the package's own module.
import { compile } from "./compile.js";
import { Engine } from "./engine.js";
import { compressedModule } from "./module.js";

let module; // the compiled module, which all instances share

export async function newEngine() {
  module ??= compile(compressedModule);
  return Engine.create(await module);
}
