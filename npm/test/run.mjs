// Runs a WebAssembly program: run.mjs PROGRAM. Prints the program's output. The program cannot read files.
import fs from "node:fs";
import { wasi } from "../src/files.js";

class Exit extends Error {
  constructor(code) {
    super(`ended with ${code}`);
    this.code = code;
  }
}

let instance;
const system = wasi(new Map(), () => instance.exports.memory.buffer, (text) => fs.writeSync(1, text));
system.proc_exit = (code) => { throw new Exit(code); };
const host = { fail: () => { throw new Error("the program threw an exception, or its memory was not enough"); } };
const known = { wasi_snapshot_preview1: system, relievo: host };
const module = await WebAssembly.compile(fs.readFileSync(process.argv[2]));
for (const { module: from, name } of WebAssembly.Module.imports(module)) known[from][name] ??= () => 52; // unsupported
instance = await WebAssembly.instantiate(module, known);
try {
  instance.exports._start();
} catch (error) {
  if (!(error instanceof Exit)) throw error;
  process.exitCode = error.code;
}
