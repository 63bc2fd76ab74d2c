// The two workers that have an instance of the engine (worker.js), and the requests that they have not answered yet.
import {CANCELLED, EngineError} from "../../studio/page/engine.js";

export class EngineWorkers {
  #workers; // the solver and the drawer, see worker.js
  #on;
  #waiting = new Map(); // unanswered requests by the number of their message
  #last = 0;

  // Calls on.statuses(statuses) when a status has changed, and on.over({kind, text}) when the engine cannot continue.
  constructor(address, module, on) {
    this.#on = on;
    const {port1, port2} = new MessageChannel();
    this.#workers = [port1, port2].map((port) => this.#start(new Worker(address), {module, port}));
  }

  #start(worker, first) {
    worker.onmessage = ({data}) => this.#take(data);
    worker.onerror = (event) => {
      event.preventDefault();
      const text = `The engine cannot run here: ${event.message ?? "workers are forbidden"}.`;
      this.#on.over({kind: "failure", text});
    };
    worker.postMessage(first, [first.port]);
    return worker;
  }

  get isMaking() {
    return [...this.#waiting.values()].some(({isMaking}) => isMaking);
  }

  // Sends a call. Calls onSolved when a picture's heights are solved, so that the heights of the next picture can be
  // solved.
  send(call, request = {}, files = [], onSolved = () => {}) {
    const id = ++this.#last, isMaking = call === "piece" || call === "export";
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, {isMaking, onSolved, resolve, reject});
      this.#workers[0].postMessage({id, call, request: {...request, apart: true}, files});
    });
  }

  // Ends the workers. Rejects unanswered requests: those for pieces and files with `error`, all others with `others`.
  end(error, others = error) {
    for (const worker of this.#workers) {
      worker.terminate();
      worker.onmessage = worker.onerror = null;
    }
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const {isMaking, reject} of waiting) reject(isMaking ? error : others);
  }

  #take({id, statuses, isSolved, error, isOver, status, facts, type, body}) {
    if (statuses) return this.#on.statuses(statuses);
    const waiting = this.#waiting.get(id);
    if (isSolved) return waiting?.onSolved();
    this.#waiting.delete(id);
    if (isOver) this.#on.over(error);
    const refusal = error ?? (status >= 400 || status === CANCELLED ? body.error : null);
    if (refusal) return waiting?.reject(new EngineError(refusal));
    const isFile = body instanceof Uint8Array && !facts;
    waiting?.resolve({facts, body: isFile ? new Blob([body], {type}) : body});
  }
}
