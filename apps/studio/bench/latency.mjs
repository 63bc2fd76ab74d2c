// Milliseconds from a slider's event to the new picture on screen, in Chromium at 1280 x 800.
//   node apps/studio/bench/latency.mjs SCAN...
// A movement is 150 events, each sent when the picture of the one before is there.
import path from "node:path";
import {EngineProcess, findBrowser, removeFolder, temporaryFolder} from "../tests/support.mjs";

const MOVEMENTS = {
  "height, locked": {slider: "Height", from: 300, to: 500},
  "saturation, height locked": {slider: "Saturation", from: 100, to: 400},
  "detail, height locked": {slider: "Detail", from: 100, to: 500},
  "detail, height free": {slider: "Detail", from: 100, to: 500, isFree: true},
  light: {light: true},
};

const found = await findBrowser();
if (found.missing) throw new Error(found.missing);
const browser = await found.launch();
const row = (cells) => console.log(`| ${cells.join(" | ")} |`);
const columns = ["scan, visible points", "movement", "p50", "p95", "engine: heights", "normals", "picture", "wire",
  "page", "pixels"];
row(columns);
row(columns.map(() => "---"));
for (const scan of process.argv.slice(2)) await measure(scan);
await browser.close();

async function measure(scan) {
  const state = temporaryFolder(), engine = await new EngineProcess(state, path.resolve(scan)).ready();
  const page = await (await browser.newContext({viewport: {width: 1280, height: 800}})).newPage();
  await page.goto(engine.address);
  await page.getByText(/points.*height/).waitFor({timeout: 120000});
  await page.waitForTimeout(2000);
  const points = (await page.getByRole("contentinfo", {name: "Numbers"}).innerText()).match(/[\d,]+/)[0];
  for (const [name, movement] of Object.entries(MOVEMENTS)) {
    if (movement.isFree) await page.getByRole("button", {name: "Lock the height"}).click();
    await page.waitForTimeout(1000);
    const times = await page.evaluate(run, movement);
    if (movement.isFree) await page.getByRole("button", {name: "Lock the height"}).click();
    const at = (key, share) => times.map((t) => t[key]).sort((a, b) => a - b)[Math.floor(times.length * share)];
    const ms = (x) => x.toFixed(1), mid = (key) => at(key, 0.5);
    const rest = mid("all") - mid("heights") - mid("normals") - mid("picture") - mid("wire");
    row([`${path.basename(scan, path.extname(scan))}, ${points}`, name, ms(mid("all")), ms(at("all", 0.95)),
      ...["heights", "normals", "picture", "wire"].map((key) => ms(mid(key))), ms(rest), mid("pixels")]);
  }
  await page.close();
  await engine.stop();
  removeFolder(state);
}

// Runs in the page.
async function run({slider, from, to, light}) {
  const stage = document.querySelector("#stage"), EVENTS = 150, times = [];
  const input = slider && document.querySelector(`input[type=range][aria-label="${slider}"]`);
  const box = stage.getBoundingClientRect();
  const pointer = (type, x, y) => stage.dispatchEvent(
    new PointerEvent(type, {bubbles: true, pointerId: 1, clientX: box.left + x, clientY: box.top + y}));
  stage.setPointerCapture = () => {};
  if (light) pointer("pointerdown", box.width / 3, box.height / 3);
  for (let i = 0; i < EVENTS; ++i) {
    const share = 1 - Math.abs(1 - 2 * i / EVENTS), start = performance.now();
    const drawn = new Promise((resolve) =>
      stage.addEventListener("picture", (event) => resolve(event.detail), {once: true}));
    if (light) pointer("pointermove", box.width * (0.3 + 0.4 * share), box.height * (0.3 + 0.1 * share));
    else {
      input.value = Math.round(from + (to - from) * share);
      input.dispatchEvent(new Event("input", {bubbles: true}));
    }
    const late = new Promise((_, reject) => setTimeout(() => reject(new Error("no picture came")), 5000));
    const {about} = await Promise.race([drawn, late]);
    // The frame after the one that shows the picture begins when that one is on its way to the screen.
    await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    const [wire] = performance.getEntriesByType("resource").filter(({name}) => name.endsWith("api/frame")).slice(-1);
    performance.clearResourceTimings();
    const heights = about.heights_ms + about.detail_ms, normals = about.normals_ms, picture = about.drawing_ms;
    times.push({all: performance.now() - start, heights, normals, picture, pixels: about.width * about.height,
      wire: wire ? wire.duration - heights - normals - picture : NaN});
  }
  if (light) pointer("pointerup", 0, 0);
  else input.dispatchEvent(new Event("change", {bubbles: true}));
  return times.slice(10);
}
