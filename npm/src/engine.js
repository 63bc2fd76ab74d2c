// Runs one instance of the engine, with its memory, the files that it can read, and its calls, which use JSON.
import { asFile, wasi } from "./files.js";

// An error of the engine. `input` is the file or the option, `place` the position in the file, and `expected` what was
// expected there.
export class RelievoError extends Error {
  constructor({ kind, input = "", place = "", expected = "", message }) {
    super(message ?? expected);
    this.name = "RelievoError";
    Object.assign(this, { kind, input, place, expected });
  }
}

const MEMORY = "expected more memory: a program in WebAssembly has at most 4 GiB; a coarser scan needs less, and the native program has what the machine has";

// The memory of an instance is freed when nothing refers to the instance any more.
export class Engine {
  #exports;
  #files = new Map();
  #lastFailure;
  #log = "";
  progress = null; // a function (stage, fraction), which returns false to cancel the call

  // `module` is a compiled WebAssembly module. `statuses` is called with the text of each status report.
  static async create(module, statuses) {
    const engine = new Engine();
    const memory = () => engine.#exports.memory.buffer;
    const imports = {
      wasi_snapshot_preview1: wasi(engine.#files, memory, (text) => { engine.#log += text; }),
      relievo: {
        progress: (at, size, fraction) => (engine.progress?.(engine.#text(at, size), fraction) === false ? 1 : 0),
        statuses: (at, size) => statuses(engine.#text(at, size)),
        fail: (at, size) => { throw engine.#failure(engine.#text(at, size)); },
      },
    };
    const instance = await WebAssembly.instantiate(module, imports);
    engine.#exports = instance.exports;
    instance.exports._initialize();
    return engine;
  }

  // Gives the engine a file with that name. "/" separates folders.
  addFile(name, source) {
    this.#files.set(name.replace(/^\.?\/+/, ""), asFile(source));
  }

  // Calls a function of the engine. Returns its answer, in which the bytes are copied.
  call(name, options = {}) {
    if (this.#lastFailure) throw this.#lastFailure;
    const request = new TextEncoder().encode(JSON.stringify({ ...options, call: name }));
    let at, answer;
    try {
      at = this.#exports.relievo_allocate(request.length);
      new Uint8Array(this.#exports.memory.buffer, at, request.length).set(request);
      answer = this.#exports.relievo_call(at, request.length);
      this.#exports.relievo_free(at);
    } catch (error) {
      throw this.#lastFailure ?? this.#failure(this.#log || error.message, error);
    }
    const [isError, text, textSize, bytes, byteCount] = new Uint32Array(this.#exports.memory.buffer, answer, 5);
    const json = JSON.parse(this.#text(text, textSize) || "null");
    if (isError) throw new RelievoError(json);
    return { json, bytes: new Uint8Array(this.#exports.memory.buffer, bytes, byteCount).slice() };
  }

  #text(at, size) {
    return new TextDecoder().decode(new Uint8Array(this.#exports.memory.buffer, at, size));
  }

  // Returns the error for a failure of the engine. After a failure, the instance cannot be used any more.
  #failure(reason, cause) {
    const isMemory = reason === "memory" || cause instanceof RangeError;
    this.#lastFailure = new RelievoError({ kind: isMemory ? "memory" : "failure",
      expected: isMemory ? MEMORY : `expected to go on, but the engine ended: ${reason}` });
    this.#lastFailure.cause = cause;
    return this.#lastFailure;
  }
}
