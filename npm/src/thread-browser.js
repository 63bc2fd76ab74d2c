import { answer } from "./thread.js";

self.onmessage = ({ data }) => answer(data, (message) => self.postMessage(message));
