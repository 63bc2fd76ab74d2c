// Starts the engine of a test suite, and provides functions for requests and files.
import assert from "node:assert/strict";
import net from "node:net";
import path from "node:path";
import {after, before} from "node:test";
import {EngineProcess, temporaryFolder, writeSample} from "./support.mjs";

export const folder = temporaryFolder(), scan = path.join(folder, "scan.ply"), state = path.join(folder, "state");
export let engine;

export const OPTIONS = {width: 60, height: 2, view: "front"};
export const PICTURE = {options: OPTIONS, width: 200, height: 150};

// Gives the suite an engine and a scan, which is a sample of `points` points. begin() prepares everything else that the
// tests need; by default it opens the scan.
export function withEngine(sample, points, begin = () => engine.open({path: scan})) {
  before(async () => {
    writeSample(sample, points, scan);
    engine = await new EngineProcess(state).ready();
    await begin();
  });
  after(() => engine?.stop());
}

// Starts another studio. `name` is the name of its state folder.
export const studioIn = (name, ...args) => new EngineProcess(path.join(folder, name), ...args).ready();

export function connect() {
  const socket = net.connect(engine.url.port, "127.0.0.1");
  socket.on("error", () => {});
  return socket;
}

// Returns the first line and the header Host of an HTTP request.
export const head = (place, method = "POST", {pathname, host} = engine.url) =>
  `${method} ${pathname}${place} HTTP/1.1\r\nHost: ${host}\r\n`;

export const stillWorks = async () => assert.equal((await engine.post("picture", PICTURE)).status, 200);
