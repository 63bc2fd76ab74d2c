// A worker that runs the WebAssembly engine for the page. The page starts two workers, the solver and the drawer. The
// drawer draws frames of plates, while the solver can solve the next frame. The solver draws all other pictures. Both
// first receive {module, port}; the port connects them. The solver then receives {id, call, request, files}. Either
// worker answers {id, status, type, facts, body} or {id, error}, or {id, error, isOver} if the engine cannot continue.
// The solver also sends {id, isSolved} when the drawer draws a frame, and {statuses} when a status has changed.
import { Engine } from "../../../npm/src/engine.js";
import { fileOf } from "./blob_file.js";

const BEGINS_WORK = new Set(["open", "view"]);

let engine, port, timer;
let isDue = false; // whether a preparation was requested and has not begun

// Prepares the view that was requested last. It runs after the waiting messages, as they may request another view.
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
    if (facts?.is_undrawn) return handOver({ id, request, facts, frame: body });
    postMessage({ id, status, type: json.type, facts, body }, body.buffer ? [body.buffer] : []);
  } catch (error) {
    fail(id, error);
  }
  isDue ||= BEGINS_WORK.has(call);
  clearTimeout(timer);
  if (isDue) timer = setTimeout(work);
}

// Sends a frame to the drawer.
function handOver({ id, request: { options, ...picture }, facts, frame }) {
  port.postMessage({ id, picture, facts, frame }, [frame.buffer]);
  postMessage({ id, isSolved: true });
}

// Draws a frame that the solver has sent.
function draw({ id, picture, facts, frame }) {
  try {
    engine.addFile("frame", frame);
    const { json, bytes } = engine.call("draw", picture);
    postMessage({ id, status: json.status, facts: { ...facts, ...json.facts }, body: bytes }, [bytes.buffer]);
  } catch (error) {
    fail(id, error);
  }
}

const started = new Promise((resolve) => {
  addEventListener("message", ({ data }) => resolve(data), { once: true });
}).then(async (data) => {
  engine = await Engine.create(data.module, (text) => postMessage({ statuses: JSON.parse(text) }));
  port = data.port;
  port.onmessage = ({ data: frame }) => draw(frame);
}).catch((error) => fail(undefined, error));

addEventListener("message", ({ data }) => data.call && started.then(() => answer(data)));
