// Helps the tests of the studio: runs the engine, runs the page in Chromium or Firefox, and makes temporary files.
import assert from "node:assert/strict";
import {spawn, spawnSync} from "node:child_process";
import {existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync} from "node:fs";
import http from "node:http";
import {tmpdir} from "node:os";
import path from "node:path";

export const PROGRAM = process.env.RELIEVO ?? path.resolve("build/release/apps/cli/relievo");
const CHROMIUM = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
const FIREFOX = [process.env.FIREFOX, "/usr/bin/firefox-esr", "/usr/bin/firefox"];
const CHROMIUM_FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-sync",
  "--disable-background-networking", "--disable-component-update"];

// The longest time that a test waits for anything. It is long because the machine may be busy.
export const PATIENCE_MS = 240000;

const folders = [];
const removeFolder = (folder) => rmSync(folder, {recursive: true, force: true, maxRetries: 5});
process.on("exit", () => folders.forEach(removeFolder));

// Returns a new folder, which is removed when this process ends.
export function temporaryFolder() {
  folders.push(mkdtempSync(path.join(tmpdir(), "relievo-studio-")));
  return folders.at(-1);
}

// Imports a module of the page that imports no other module. Imports its text, since Node 18 would treat the file as
// CommonJS.
export const pageModule = (name) => {
  const text = readFileSync(new URL(`../page/${name}`, import.meta.url), "utf8");
  return import(`data:text/javascript,${encodeURIComponent(text)}`);
};

export const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

// Runs `relievo studio` with its own state folder.
export class EngineProcess {
  constructor(state, ...args) {
    const page = process.env.RELIEVO_PAGE ? ["--page", process.env.RELIEVO_PAGE] : []; // the folder of another page
    this.child = spawn(PROGRAM, ["studio", "--no-browser", "--state", state, ...page, ...args]);
    this.errors = "";
    this.child.stderr.on("data", (data) => (this.errors += data));
    this.ended = new Promise((resolve) => this.child.on("exit", (code, signal) => resolve({code, signal})));
  }

  async ready() {
    let out = "";
    this.address = await new Promise((resolve, reject) => {
      this.child.stdout.on("data", (data) => {
        out += data;
        const found = out.match(/http:\/\/\S+/);
        if (found) resolve(found[0]);
      });
      this.child.on("exit", () => reject(new Error(`the engine ended: ${this.errors}`)));
    });
    this.url = new URL(this.address);
    return this;
  }

  // Sends one request and returns {status, headers, body}. `target` is sent unchanged: dots in its path are not
  // resolved.
  request(target, {method = "GET", headers = {}, body} = {}) {
    const {port} = this.url;
    const options = {host: "127.0.0.1", port, method, path: target, headers: {Connection: "close", ...headers}};
    return new Promise((resolve, reject) => {
      const request = http.request(options, (response) => {
        const parts = [], {statusCode: status, headers} = response;
        response.on("data", (part) => parts.push(part));
        response.on("error", reject);
        response.on("end", () => resolve({status, headers, body: Buffer.concat(parts)}));
      });
      request.on("error", reject);
      request.end(body);
    });
  }

  // Sends a request about the document that was opened last, unless the body names another document or is a text.
  post(action, json, options = {}) {
    const isText = typeof json === "string" || Buffer.isBuffer(json);
    const body = isText ? json : JSON.stringify({document: this.document, ...json});
    return this.request(`${this.url.pathname}api/${action}`, {method: "POST", body, ...options});
  }

  get(name) {
    return this.request(this.url.pathname + name);
  }

  async json(action, body = {}) {
    return JSON.parse((await this.post(action, body)).body);
  }

  // Opens an input and waits until its relief can be drawn.
  async open(input) {
    ({document: this.document} = await this.json("open", {input, tab: "test"}));
    return this.untilIdle();
  }

  // Prepares another view, {view, crop, ...}.
  async prepare(view) {
    const {status, body} = await this.post("view", view);
    assert.equal(status, 200, String(body));
    return this.untilIdle();
  }

  untilIdle() {
    return this.until(({busy, model, error}) => {
      if (!busy && !model && error) throw new Error(JSON.stringify(error));
      return !busy && model > 0;
    });
  }

  // Requests the status of a document repeatedly until isMeant(status) is true; by default, until nothing is being
  // prepared.
  async until(isMeant = ({busy}) => !busy, document = this.document, pauseMs = 20) {
    for (const end = Date.now() + PATIENCE_MS; Date.now() < end; await sleep(pauseMs)) {
      const status = await this.json("status", {document});
      if (isMeant(status)) return status;
    }
    throw new Error(`the status did not come in time: ${isMeant}`);
  }

  async about() {
    return JSON.parse((await this.get("api/about")).body);
  }

  // Sends a file as the page does. Returns the answer and its status.
  async upload(name, body, action = "upload") {
    const target = `${this.url.pathname}api/${action}?name=${encodeURIComponent(name)}`;
    const answer = await this.request(target, {method: "POST", body});
    return {status: answer.status, ...JSON.parse(answer.body)};
  }

  async kept(input) {
    return (await this.json("document", {input})).kept;
  }

  async newestStep(scan) {
    const {steps, at} = await this.kept({path: scan});
    return steps[at];
  }

  async stop(signal = "SIGINT") {
    this.child.kill(signal);
    return this.ended;
  }
}

// Runs the program, and returns what it prints.
export function run(...args) {
  const made = spawnSync(PROGRAM, args.map(String));
  assert.equal(made.status, 0, String(made.stderr));
  return String(made.stdout);
}

export const writeSample = (sample, points, file) => run("sample", sample, "-o", file, "--points", points);

// Writes two scans into a folder, with names other than those of samples. Returns their paths.
export function writeScans(folder, points) {
  const scans = ["urn", "ammonite"].map((name) => path.join(folder, `${name}.ply`));
  for (const [i, scan] of scans.entries()) writeSample(["still_life", "shell"][i], points, scan);
  return scans;
}

// Writes a depth image as a TIFF with 16 bits of grey.
export function writeDepths(file, width, height, depthAt) {
  const depths = Uint16Array.from({length: width * height}, (_, i) => depthAt(i % width, Math.floor(i / width)));
  const FIRST = 8, end = FIRST + depths.byteLength, SHORT = 3;
  const tags = [[256, width], [257, height], [258, 16], [259, 1], [262, 1], [273, FIRST], [277, 1], [278, height],
    [279, depths.byteLength]].flatMap(([tag, value]) => [tag, SHORT, 1, 0, value, 0]);
  const numbers = Uint16Array.from([0x4949, 42, end, 0, ...depths, tags.length / 6, ...tags, 0, 0]);
  writeFileSync(file, Buffer.from(numbers.buffer));
}

// Writes a depth image of a ball in front of a wall. The ball is a disc of radius 30 pixels with depths from 810 to
// 900; the wall has the depth 4000.
export const writeBallBeforeWall = (file) => writeDepths(file, 120, 90, (x, y) => {
  const off = Math.hypot(x - 60, y - 45);
  return off < 30 ? 900 - Math.round(3 * Math.sqrt(900 - off * off)) : 4000;
});

// Writes a coloured half ball of radius 1 as a PLY file: grey, with dark lines at x and y of -0.3 and 0.3.
export function writeColouredBall(file, points = 20000) {
  const rows = Array.from({length: points}, (_, i) => {
    const z = 1 - (i + 0.5) / points, r = Math.sqrt(1 - z * z), turn = i * Math.PI * (3 - Math.sqrt(5));
    const [x, y] = [r * Math.cos(turn), r * Math.sin(turn)];
    const grey = [x, y].some((side) => Math.abs(Math.abs(side) - 0.3) < 0.03) ? 20 : 200;
    const place = [x, y, z].map((side) => side.toFixed(5)).join(" ");
    return `${place} ${place} ${grey} ${grey} ${grey}`;
  });
  const properties = (type, names) => names.map((name) => `property ${type} ${name}`);
  writeFileSync(file, ["ply", "format ascii 1.0", `element vertex ${points}`,
    ...properties("float", ["x", "y", "z", "nx", "ny", "nz"]), ...properties("uchar", ["red", "green", "blue"]),
    "end_header", ...rows, ""].join("\n"));
}

export const openPanels = (page) => page.locator("details").evaluateAll((all) =>
  all.forEach((panel) => (panel.open = true)));

// Waits until the picture shows the relief as it is exported.
export async function untilReady(page) {
  await page.getByText(/points.*height/).waitFor();
  await page.locator('[role="application"][aria-busy="false"]').first().waitFor();
}

// Waits until the page has started. Before that, the page takes no clicks, although scripts could already change its
// fields.
export const untilListening = (page) => page.locator("body:not([inert])").waitFor();

// Holds back all requests of a page to an address. Returns a function that lets these and all later requests go.
export async function holdRequests(page, address) {
  let letGo;
  const held = new Promise((resolve) => (letGo = resolve));
  await page.route(address, async (route) => {
    await held;
    await route.continue();
  });
  return letGo;
}

// Waits by the clock of the page, so that all its timers of at most `ms` have run, however busy the machine is.
export const untilTimersRan = (page, ms) =>
  page.evaluate((ms) => new Promise((resolve) => setTimeout(resolve, ms)), ms);

// Runs in the page. From now on timers of `leastMs` or more do nothing, so that a message stays until something else
// removes it. ignoreTimers(Infinity) restores all timers.
export const ignoreTimers = (leastMs) => {
  const all = (window.allTimers ??= window.setTimeout.bind(window));
  window.setTimeout = (act, ms, ...args) => (ms >= leastMs ? 0 : all(act, ms, ...args));
};

// Starts an engine with a scan, and opens its page in the browser. Returns {engine, page}.
export async function showScan(browser, {state, scan, screen = {width: 1280, height: 800}}) {
  const page = await (await browser.newContext({viewport: screen})).newPage();
  const engine = await new EngineProcess(state, scan).ready();
  await page.goto(engine.address);
  await untilReady(page);
  return {engine, page};
}

// Runs in the page. Returns whether each kind of work shows a picture of the exact relief.
export const areKindsDrawn = () => [...document.querySelectorAll("#kinds button")].every((card) =>
  card.dataset.drawn === "exact");

// Replaces the text of a field key by key, because browsers distinguish typed text from text that a script sets. First
// waits until the field is enabled, because before that the keys would go to the field that had the focus.
export async function type(field, text) {
  await field.page().bringToFront(); // Firefox sends keys only to the page in front
  await eventually(async () => {
    await field.selectText({timeout: 2000});
    const isSelected = await field.evaluate((input) => document.activeElement === input &&
      !input.disabled && input.selectionEnd - input.selectionStart === input.value.length);
    if (!isSelected) throw new Error(`not selected: ${field}`);
  });
  // The keys are sent to the page and not to the field, because Playwright clears the selection of fields on a page
  // without focus.
  const {keyboard} = field.page();
  await (text === "" ? keyboard.press("Delete") : keyboard.type(text));
}

// Clicks twice. Firefox's driver counts clicks only within one chain of actions, so in Firefox this makes two single
// clicks, and the event of a double click is sent separately.
export async function doubleClick(locator) {
  await locator.dblclick();
  if (locator.page().context().browser().browserType().name() === "firefox") await locator.dispatchEvent("dblclick");
}

export async function enter(field, text) {
  await type(field, text);
  await field.press("Enter");
}

// Repeats a check until it no longer throws, because a page shows the effects of an event a little later.
export async function eventually(check) {
  for (const end = Date.now() + PATIENCE_MS; ;) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() > end) throw error;
    }
    await sleep(50);
  }
}

// Prints which tool is missing, and returns this text as the reason for skipping the tests of the page.
function without(missing) {
  const skip = `${missing}: the page is not tested`;
  console.log(`SKIPPED: ${skip}`);
  return {skip};
}

// Sets the time limit PATIENCE_MS for all pages of a browser, and delays their requests by RELIEVO_SLOW_MS. With a
// delay, a test fails if it does not wait for the values that it checks. Such a test would also fail on a busy machine.
function patient(browser) {
  const newContext = browser.newContext.bind(browser), delayMs = Number(process.env.RELIEVO_SLOW_MS ?? 0);
  const later = (route) => sleep(delayMs).then(() => route.continue()).catch(() => {}); // the page may be closed
  browser.newContext = async (options) => {
    const context = await newContext(options);
    context.setDefaultTimeout(PATIENCE_MS);
    if (delayMs > 0) await context.route(/\/api\//, later);
    return context;
  };
  return browser;
}

// Returns {launch, skip} for the browser that the environment names, by default Chromium. `skip` is false, or a text
// that names what is missing. The option `channel` makes Playwright drive Firefox by WebDriver BiDi.
export async function findBrowser(name = process.env.BROWSER || "chromium") {
  const isFirefox = name === "firefox";
  const executablePath = (isFirefox ? FIREFOX : CHROMIUM).find((candidate) => candidate && existsSync(candidate));
  if (!executablePath)
    return without(`${name} is not installed (apt-get install ${isFirefox ? "firefox-esr" : "chromium"})`);
  try {
    const {default: {chromium, firefox}} = await import(process.env.PLAYWRIGHT ?? "playwright-core");
    const folder = isFirefox ? temporaryFolder() : null; // for downloads
    const firefoxUserPrefs = {"browser.download.alwaysOpenPanel": false}; // its panel would take the focus
    const settings = {executablePath, timeout: PATIENCE_MS}, start = () => (isFirefox
      ? firefox.launch({...settings, channel: "moz-firefox", downloadsPath: folder, firefoxUserPrefs})
      : chromium.launch({...settings, args: CHROMIUM_FLAGS}));
    return {name, folder, launch: async () => patient(await start()), skip: false};
  } catch {
    return without("playwright-core is not installed (npm ci --prefix apps/studio/tests)");
  }
}

// Returns {name, bytes} of the files that a page saves after `trigger`, sorted by name. Firefox's driver does not
// report downloads, so in Firefox the files are read from the folder of downloads.
export async function savedFiles({folder}, page, count, trigger) {
  if (folder) {
    await trigger();
    const names = await eventually(() => {
      const all = readdirSync(folder).sort(), sizes = all.map((name) => readFileSync(path.join(folder, name)).length);
      if (all.length < count || all.some((name, i) => name.endsWith(".part") || sizes[i] === 0))
        throw new Error(`files: ${all}`);
      return all;
    });
    return names.map((name) => {
      const file = path.join(folder, name), bytes = readFileSync(file);
      rmSync(file);
      return {name, bytes};
    });
  }
  const downloads = [], listen = (download) => downloads.push(download);
  page.on("download", listen);
  await trigger();
  await eventually(() => {
    if (downloads.length < count) throw new Error(`${downloads.length} files of ${count}`);
  });
  page.off("download", listen);
  const files = downloads.map(async (download) =>
    ({name: download.suggestedFilename(), bytes: readFileSync(await download.path())}));
  return (await Promise.all(files)).sort((a, b) => (a.name < b.name ? -1 : 1));
}

// Returns the number of triangles in a binary STL, the size of their bounding box, and whether every edge has two
// triangles.
export function readStl(bytes) {
  const count = bytes.readUInt32LE(80), box = {min: Array(3).fill(Infinity), max: Array(3).fill(-Infinity)};
  const edges = new Map(), at = (offset) => [0, 4, 8].map((i) => bytes.readFloatLE(offset + i));
  const balance = (a, b, by) => edges.set(a + b, (edges.get(a + b) ?? 0) + by);
  for (let t = 0; t < count; ++t) {
    const corners = [12, 24, 36].map((offset) => at(84 + 50 * t + offset));
    for (const corner of corners)
      for (let i = 0; i < 3; ++i) {
        box.min[i] = Math.min(box.min[i], corner[i]);
        box.max[i] = Math.max(box.max[i], corner[i]);
      }
    const [a, b, c] = corners.map((corner) => corner.join(","));
    for (const [p, q] of [[a, b], [b, c], [c, a]]) p < q ? balance(`${p} `, q, 1) : balance(`${q} `, p, -1);
  }
  const isClosed = bytes.length === 84 + 50 * count && [...edges.values()].every((n) => n === 0);
  return {count, size: box.max.map((x, i) => x - box.min[i]), isClosed};
}
