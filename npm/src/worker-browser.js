import { WorkerJobs } from "./jobs.js";

export class RelievoWorker extends WorkerJobs {
  constructor() {
    super((take, fail) => {
      const worker = new Worker(new URL("./thread-browser.js", import.meta.url), { type: "module" });
      worker.onmessage = ({ data }) => take(data);
      worker.onerror = (event) => fail(new Error(event.message));
      return { post: (message) => worker.postMessage(message), end: () => worker.terminate() };
    });
  }
}
