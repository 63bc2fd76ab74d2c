import { Worker } from "node:worker_threads";
import { WorkerJobs } from "./jobs.js";

export class RelievoWorker extends WorkerJobs {
  constructor() {
    super((take, fail) => {
      const worker = new Worker(new URL("./thread-node.js", import.meta.url));
      worker.on("message", take);
      worker.on("error", fail);
      worker.unref();
      return {
        post: (message) => { worker.ref(); worker.postMessage(message); },
        end: () => worker.terminate(),
        rest: () => worker.unref(), // lets the program end
      };
    });
  }
}
