// Makes reliefs in a worker, so that the page stays responsive. Cancelling ends the worker; the next job starts a new
// one.
import { RelievoError } from "./engine.js";

export class WorkerJobs {
  #start;
  #worker = null;
  #waiting = new Map();
  #last = 0;

  // start() starts a worker. It takes a function that handles messages and one that handles errors. It returns
  // { post, end, rest }; rest() is called when no job is left.
  constructor(start) {
    this.#start = start;
  }

  // Makes a relief. `results` names the results to send back, such as
  // { solids: ["stl"], heightMap: { size }, preview: { size } }.
  make(source, { progress, signal, ...options } = {}, results = {}) {
    return this.#send({ job: "make", source, options, results }, progress, signal);
  }

  sample(name, options = {}) {
    return this.#send({ job: "sample", name, options });
  }

  // Ends the worker. All unfinished jobs fail with `reason`.
  terminate(reason = new RelievoError({ kind: "cancelled", expected: "cancelled" })) {
    this.#worker?.end();
    this.#worker = null;
    for (const { reject } of this.#waiting.values()) reject(reason);
    this.#waiting.clear();
  }

  #send(message, progress, signal) {
    signal?.throwIfAborted();
    this.#worker ??= this.#start((data) => this.#take(data), (error) => this.terminate(error));
    const id = ++this.#last;
    const abort = () => this.terminate();
    signal?.addEventListener("abort", abort, { once: true });
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject, progress });
      this.#worker.post({ id, ...message });
    }).finally(() => signal?.removeEventListener("abort", abort));
  }

  // Ends the worker if the callback returns false or throws.
  #report({ progress }, stage, fraction) {
    try {
      if (progress?.(stage, fraction) === false) this.terminate();
    } catch (error) {
      this.terminate(error);
    }
  }

  #take({ id, value, error, stage, fraction }) {
    const waiting = this.#waiting.get(id);
    if (!waiting) return;
    if (stage !== undefined) return this.#report(waiting, stage, fraction);
    this.#waiting.delete(id);
    if (this.#waiting.size === 0) this.#worker?.rest?.();
    error ? waiting.reject(error.kind ? new RelievoError(error) : new Error(error.message)) : waiting.resolve(value);
  }
}
