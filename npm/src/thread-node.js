import { parentPort } from "node:worker_threads";
import { answer } from "./thread.js";

parentPort.on("message", (data) => answer(data, (message) => parentPort.postMessage(message)));
