// The worker that runs the WebAssembly engine for the page. It receives {id, call, request, files}, and answers {id,
// status, type, facts, body} or {id, error}, or {id, error, isOver} if the engine cannot continue. It also sends
// {statuses} when a status has changed.
import { Engine } from "../../../npm/src/engine.js";
import { fileOf } from "./blob_file.js";

const BEGINS_WORK = new Set(["open", "view"]);

let engine, timer;
let isDue = false; // whether a preparation was requested and has not begun

// Prepares the view that was requested last. It first lets waiting messages be handled, as they may request another
// view.
function work() {
  isDue = false;
  try {
    engine.call("work");
  } catch (error) {
    fail(undefined, error);
  }
}

function fail(id, { kind = "failure", input, message }) {
  postMessage({ id, error: { kind, input, text: message }, isOver: kind === "memory" || kind === "failure" });
}

function bodyOf({ type }, bytes) {
  if (type !== "application/json") return bytes;
  return JSON.parse(new TextDecoder().decode(bytes));
}

function addFiles(files) {
  try {
    for (const [path, file] of files) engine.addFile(path, file instanceof Blob ? fileOf(file) : file);
  } catch {
    throw Object.assign(new Error("expected a file that can be read"), { kind: "unreadable" });
  }
}

function answer({ id, call, request, files = [] }) {
  try {
    addFiles(files);
    const { json: { facts, status = 200, ...json }, bytes } = engine.call(call, request);
    const body = json.type ? bodyOf(json, bytes) : bytes.length > 0 ? bytes : json;
    postMessage({ id, status, type: json.type, facts, body }, body.buffer ? [body.buffer] : []);
  } catch (error) {
    fail(id, error);
  }
  isDue ||= BEGINS_WORK.has(call);
  clearTimeout(timer);
  if (isDue) timer = setTimeout(work);
}

const started = new Promise((resolve) => {
  addEventListener("message", ({ data }) => resolve(data.module), { once: true });
}).then(async (module) => {
  engine = await Engine.create(module, (text) => postMessage({ statuses: JSON.parse(text) }));
}).catch((error) => fail(undefined, error));

addEventListener("message", ({ data }) => data.call && started.then(() => answer(data)));
