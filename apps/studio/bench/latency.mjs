// Measures three durations in Chromium at 1280 x 800, in milliseconds: from an event of the mouse to the picture that
// shows its effect; from the choice of a file to the first relief; and from that choice to the relief of all points.
//   node apps/studio/bench/latency.mjs [relievo.html] SCAN...
// With relievo.html, the page in one file, the engine inside that file is measured. Each movement is a drag of 4
// seconds with 60 events a second, sent without waiting for pictures. If several events arrive while one picture is
// made, the next picture shows all of them.
import path from "node:path";
import {pathToFileURL} from "node:url";
import {EngineProcess, areKindsDrawn, findBrowser, openPanels, temporaryFolder} from "../tests/support.mjs";

const SECONDS = 4, EVENTS_PER_SECOND = 60;
// The patterns match the current and the former labels of a slider. `from` and `to` are fractions of the slider or of
// the picture.
const MOVEMENTS = {
  height: {slider: /^Height$/, from: 0.45, to: 0.6},
  detail: {slider: /^(Fine d|D)etail$/, from: 0.1, to: 0.5},
  width: {slider: /^(Longer side|Width)$/, from: 0.5, to: 0.65},
  light: {tool: "Light", from: 0.3, to: 0.7},
  orbit: {tool: "Orbit", from: 0.45, to: 0.6},
  turn: {tool: "Turn", from: 0.45, to: 0.6},
  // The brush moves in a circle and never stops, because an event near the last position paints nothing and so causes
  // no picture.
  brush: {tool: "Brush", isRound: true, from: 0.45, to: 0.6},
  handle: {isHandle: true, from: 0.45, to: 0.6}, // drags a text that is set on an arc; the page itself draws the text's outlines
};

const found = await findBrowser();
if (found.skip) throw new Error(found.skip);
const browser = await found.launch();
const row = (cells) => console.log(`| ${cells.join(" | ")} |`);
const isPage = (file) => path.extname(file) === ".html";
const [html] = process.argv.slice(2).filter(isPage);
const columns = ["scan, visible points", "movement", "p50", "p95", "pictures/s", "pixels"];
row(columns);
row(columns.map(() => "---"));
for (const scan of process.argv.slice(2).filter((file) => !isPage(file))) await measure(scan);
await browser.close();

async function measure(scan) {
  if (!html) await measureOpening(scan);
  const page = await newPage();
  const end = await (html ? openInPage(page, scan) : openInProgram(page, scan));
  await page.getByText(/points.*height/).waitFor({timeout: 120000});
  await openPanels(page);
  await page.waitForFunction(areKindsDrawn, null, {timeout: 120000});
  await page.waitForTimeout(2000);
  const points = (await page.getByRole("contentinfo", {name: "Numbers"}).innerText()).match(/[\d,]+/)[0];
  for (const [name, movement] of Object.entries(MOVEMENTS)) {
    const {events, pictures, pixels} = await drag(page, movement);
    const times = latencies(events, pictures), at = (share) => times[Math.floor(times.length * share)].toFixed(0);
    row([`${path.basename(scan, path.extname(scan))}, ${points}`, name, at(0.5), at(0.95),
      (pictures.length / SECONDS).toFixed(0), pixels]);
  }
  await page.close();
  await end();
}

async function newPage() {
  return (await browser.newContext({viewport: {width: 1280, height: 800}})).newPage();
}

// Opens the scan five times, each time in a new engine, and prints the median durations.
async function measureOpening(scan) {
  const first = [], exact = [];
  for (let i = 0; i < 5; ++i) {
    const page = await newPage(), state = temporaryFolder(), engine = await new EngineProcess(state).ready();
    await page.goto(engine.address);
    await page.getByRole("button", {name: "Open", exact: true}).waitFor();
    await page.evaluate(listen, "change");
    await page.locator("#file").setInputFiles(scan);
    await page.getByText(/points.*height/).waitFor({timeout: 120000});
    const [end, {events, pictures}] = await page.evaluate(() => [performance.now(), window.heard]);
    first.push(pictures[0].at - events[0]);
    exact.push(end - events[0]);
    await page.close();
    await engine.stop();
  }
  for (const [name, times] of Object.entries({"opening, first relief": first, "opening, exact relief": exact}))
    row([path.basename(scan, path.extname(scan)), name, times.sort((a, b) => a - b)[2].toFixed(0), "", "", ""]);
}

// openInPage() and openInProgram() open a scan, and return a function that ends its engine.
async function openInPage(page, scan) {
  await page.goto(pathToFileURL(html).href);
  await page.locator("#samples button").first().waitFor({state: "attached"}); // shows that the page is ready
  await page.locator("#file").setInputFiles(scan);
  return () => {};
}

async function openInProgram(page, scan) {
  const engine = await new EngineProcess(temporaryFolder(), path.resolve(scan)).ready();
  await page.goto(engine.address);
  return () => engine.stop();
}

async function addText(page) {
  await page.getByRole("button", {name: "Add a text", exact: true}).click();
  await page.getByLabel("Line of the text", {exact: true}).selectOption({label: "Arc at the top"});
  return page.locator(".letter-handle");
}

async function drag(page, {slider, tool, isHandle, isRound, from, to}) {
  if (tool) await page.getByRole("radio", {name: tool, exact: true}).click();
  const tooled = () => (tool ? page.locator("#stage") : page.getByRole("slider", {name: slider}));
  const target = isHandle ? await addText(page) : tooled();
  await target.scrollIntoViewIfNeeded();
  await page.locator('[role="application"][aria-busy="false"]').first().waitFor();
  const isRange = !tool && !isHandle, box = await target.boundingBox();
  if (isHandle) Object.assign(box, {x: box.x + box.width / 2 - from * 600, width: 600});
  const grip = isRange ? await target.evaluate((range) => range.value / range.max) : from; // where the thumb is
  const place = (share, above = 0) => [box.x + box.width * share, box.y + box.height / 2 - above * box.width];
  await page.mouse.move(...place(grip));
  await page.mouse.down();
  await page.evaluate(listen, isRange ? "input" : "pointermove");
  const begin = performance.now();
  for (let i = 0; i < SECONDS * EVENTS_PER_SECOND; ++i) {
    const wait = begin + 1000 * i / EVENTS_PER_SECOND - performance.now();
    if (wait > 0) await new Promise((resolve) => setTimeout(resolve, wait));
    const angle = i / EVENTS_PER_SECOND * Math.PI, half = (to - from) / 2; // the pointer returns every 2 s
    const share = from + half * (1 - Math.cos(angle));
    await page.mouse.move(...place(share, isRound ? half * Math.sin(angle) : 0));
  }
  const heard = await page.evaluate(() => window.heard);
  await page.mouse.up();
  return heard;
}

// Runs in the page. Records the times of events and of pictures, and for each picture the time of the newest event
// whose effect it shows.
function listen(type) {
  const heard = window.heard = {events: [], pictures: [], pixels: 0};
  addEventListener(type, (event) => heard.events.push(event.timeStamp), {capture: true});
  // The browser calls the function just before it draws the picture. The timer runs after that, when the picture is on
  // its way to the screen.
  const drawn = (shows) =>
    requestAnimationFrame(() => setTimeout(() => heard.pictures.push({shows, at: performance.now()})));
  const handle = document.querySelector(".letter-handle");
  if (handle && !handle.hidden)
    return new MutationObserver(() => drawn(performance.now())).observe(handle, {attributeFilter: ["style"]});
  document.querySelector("#stage").addEventListener("picture", ({detail: {facts, ms}}) => {
    heard.pixels = facts.width * facts.height;
    drawn(performance.now() - ms);
  });
}

// Returns the sorted times from each event to the first picture that shows the event's effect.
function latencies(events, pictures) {
  const times = events.map((event) => pictures.find(({shows}) => shows >= event)?.at - event);
  return times.filter(Number.isFinite).sort((a, b) => a - b);
}
