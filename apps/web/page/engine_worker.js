// A worker that has an instance of the engine, and the requests that it has not answered yet.
import {CANCELLED, EngineError} from "../../studio/page/engine.js";

export class EngineWorker {
  #worker;
  #on;
  #waiting = new Map(); // unanswered requests by the number of their message
  #last = 0;

  // Calls on.statuses(statuses) when a status has changed, and on.over(error) when the engine cannot continue.
  constructor(address, module, on) {
    this.#worker = new Worker(address);
    this.#on = on;
    this.#worker.onmessage = ({data}) => this.#take(data);
    this.#worker.onerror = (event) => {
      event.preventDefault();
      const text = `The engine cannot run here: ${event.message ?? "workers are forbidden"}.`;
      on.over(new EngineError({kind: "failure", text}));
    };
    this.#worker.postMessage({module});
  }

  get isMaking() {
    return [...this.#waiting.values()].some(({isMaking}) => isMaking);
  }

  // Sends a call. The buffers in `transfer` belong to the worker afterwards.
  send(call, request = {}, files = [], transfer = []) {
    const id = ++this.#last, isMaking = call === "piece" || call === "export";
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, {isMaking, resolve, reject});
      this.#worker.postMessage({id, call, request, files}, transfer);
    });
  }

  // Ends the worker. Rejects unanswered requests: those for pieces and files with `error`, all others with `others`.
  end(error, others = error) {
    this.#worker.terminate();
    this.#worker.onmessage = this.#worker.onerror = null;
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const {isMaking, reject} of waiting) reject(isMaking ? error : others);
  }

  #take({id, statuses, error, isOver, status, facts, type, body}) {
    if (statuses) return this.#on.statuses(statuses);
    const waiting = this.#waiting.get(id);
    this.#waiting.delete(id);
    if (isOver) this.#on.over(new EngineError(error));
    const refusal = error ?? (status >= 400 || status === CANCELLED ? body.error : null);
    if (refusal) return waiting?.reject(new EngineError(refusal));
    const isFile = body instanceof Uint8Array && !facts;
    waiting?.resolve({facts, body: isFile ? new Blob([body], {type}) : body});
  }
}
