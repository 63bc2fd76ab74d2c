// Opens the page of a test suite in a browser, and acts as its user: finds elements by role and label.
import assert from "node:assert/strict";
import {rmSync} from "node:fs";
import path from "node:path";
import {after, before, test as plainTest} from "node:test";
import {EngineProcess, enter, eventually, findBrowser, openPanels, readStl, savedFiles, showScan, temporaryFolder,
  untilReady, writeSample} from "./support.mjs";

export const found = await findBrowser(), {skip} = found;
export const folder = temporaryFolder(), scan = path.join(folder, "scan.ply"), state = path.join(folder, "state");
export const DESK = {width: 1280, height: 800}, TABLET = {width: 820, height: 1180}, PHONE = {width: 390, height: 844};
export let browser, engine, page;

let beginSuite; // starts the browser and everything else that the suite needs

// Gives the suite a browser. begin(isAnew) prepares everything else for the tests, and may return a page that the
// tests share. `isAnew` is true if the suite starts again after a failed test.
export function withBrowser(begin) {
  beginSuite = async (isAnew) => {
    browser = await found.launch();
    page = await begin(isAnew);
  };
  before(() => skip || beginSuite(false));
  after(endSuite);
}

async function endSuite() {
  await browser?.close();
  await engine?.stop();
}

// A test of the page. If it fails, the suite starts again, so that the next test finds the state that it expects.
export const test = (name, act) => plainTest(name, {skip}, async (context) => {
  try {
    await act(context);
  } catch (error) {
    await endSuite();
    rmSync(state, {recursive: true, force: true});
    await beginSuite(true);
    throw error;
  }
});

// Gives the suite a page that shows a sample of that many points, with all panels open.
export function withPage(sample, points, begin = () => {}) {
  withBrowser(async () => {
    writeSample(sample, points, scan);
    ({engine, page} = await showScan(browser, {state, scan}));
    engine.document = new URL(page.url()).hash.slice(1);
    await openPanels(page);
    await begin();
    return page;
  });
}

export async function startEngine(...args) {
  engine = await new EngineProcess(state, ...args).ready();
  return engine;
}

// Provides the assertions of node:assert for values that a function reads from the page. They are repeated until they
// succeed, because the page may handle a click or a key later than the browser reports it.
export const soon = Object.fromEntries(["equal", "notEqual", "ok", "deepEqual", "match", "doesNotMatch"].map((name) =>
  [name, (read, ...wanted) => eventually(async () => assert[name](await read(), ...wanted))]));

// ---------------------------------------------------------------------------------------------------- controls

export const button = (name, of = page) => of.getByRole("button", {name, exact: true});
export const radio = (name, of = page) => of.getByRole("radio", {name, exact: true});
export const slider = (name, of = page) => of.getByRole("slider", {name, exact: true});
export const field = (name, of = page) => of.getByRole("spinbutton", {name, exact: true});
export const labelled = (label, of = page) => of.getByLabel(label, {exact: true});
export const option = (name, of = page) => of.locator(`[data-option="${name}"]`).first();
export const preset = (of = page) => of.getByRole("combobox", {name: "Tone curve preset"});
export const toast = (of = page) => of.getByRole("alert");

export const text = (name) => field(name).inputValue();
export const set = (name, number) => enter(field(name), String(number));
export const untilText = (locator, wanted) => eventually(async () =>
  assert.equal(await locator.inputValue(), wanted));

export async function undo(times = 1, of = page) {
  for (let i = 0; i < times; ++i) await button("Undo", of).click();
}

// Undoes steps, and waits until the page is ready.
export async function takeBack(times = 1, of = page) {
  await undo(times, of);
  await untilReady(of);
}

// Undoes steps until none is left or isEnough() returns true, and waits until the page is ready. The button may become
// disabled meanwhile.
export async function undoAll(of = page, isEnough = () => false) {
  const once = button("Undo", of);
  while ((await once.isEnabled()) && !(await isEnough())) await once.click({timeout: 10000}).catch(() => {});
  await untilReady(of);
}

// Waits until the page has reacted to the present sizes of its parts, which the browser reports with the next frame.
// The time limit is for pages behind another one, which may get no frames.
export const untilLaidOut = (of = page) => of.evaluate(() => new Promise((resolve) => {
  requestAnimationFrame(() => requestAnimationFrame(resolve));
  setTimeout(resolve, 1000);
}));

// Waits until no entry is being tried, and the picture shows the piece as it is exported.
export async function untilTaken(of = page) {
  await soon.equal(() => of.locator("#trying").textContent(), "");
  await untilReady(of);
}

export async function choose(name, of = page) {
  await radio(name, of).click();
  await untilLaidOut(of); // the settings of a tool make the picture smaller
  await untilTaken(of);
}

export async function chooseView(side, of = page) {
  await button("Choose view", of).click();
  await button(side, of.getByRole("group", {name: "Sides"})).click();
  await button("Use this view", of).click();
  await of.locator("#view-name").getByText(side, {exact: true}).waitFor();
}

// Opens a scan or a project with the browser's dialog. Firefox's driver reports only the first such dialog, so in
// Firefox the file is set directly.
export async function openFile(file, of = page) {
  if (found.name === "firefox") return of.locator("#file").setInputFiles(file);
  const chooser = of.waitForEvent("filechooser");
  await button("Open", of).click();
  await (await chooser).setFiles(file);
}

// Opens a file, and waits until its relief is shown.
export async function showFile(file, of = page) {
  await of.locator("#file").setInputFiles(file);
  await of.getByText(path.basename(file), {exact: true}).waitFor();
  await untilReady(of);
}

// Saves the project, and returns the bytes of its file. `how` is "Settings alone" or "With the scan".
export async function savedProject(how = "Settings alone", of = page) {
  const dialog = of.getByRole("dialog", {name: "Save project"});
  await button("Save project", of).click();
  await dialog.getByText(how).click();
  const [{bytes}] = await savedFiles(found, of, 1, () => button("Save", dialog).click());
  return bytes;
}

// -------------------------------------------------------------------------------------------------- the pointer

export async function middleOf(locator) {
  const {x, y, width, height} = await locator.boundingBox();
  return [x + width / 2, y + height / 2];
}

// Presses the mouse button at `from` and moves through other positions. Does not release the button.
export async function press(from, ...through) {
  await page.mouse.move(...from);
  await page.mouse.down();
  for (const place of through) await page.mouse.move(...place, {steps: 4});
}

export async function drag(from, ...through) {
  await press(from, ...through);
  await page.mouse.up();
}

// Shows the relief on a touch screen. Returns the page `touched`, its DevTools session `cdp`, and functions:
// send(type, points) sends a touch event; fingers(apart, degrees) returns the positions of two fingers around the
// centre of the picture; close() closes the page.
export async function touchScreen(viewport, isMobile = false) {
  const context = await browser.newContext({viewport, hasTouch: true, isMobile}), touched = await context.newPage();
  const cdp = await context.newCDPSession(touched);
  await touched.goto(engine.address);
  await untilReady(touched);
  const send = (type, touchPoints) => cdp.send("Input.dispatchTouchEvent", {type, touchPoints});
  const [x, y] = await middleOf(touched.locator("#stage")), fingers = (apart, degrees = 0) => [1, -1].map((side, id) => {
    const angle = degrees * Math.PI / 180, [dx, dy] = [apart * Math.cos(angle), -apart * Math.sin(angle)];
    return {x: x + side * dx, y: y + side * dy, id};
  });
  return {touched, cdp, send, fingers, close: () => context.close()};
}

// -------------------------------------------------------------------------------------------- texts on the page

export const numbers = (of = page) => of.locator("#numbers");
export const untilTold = (pattern, of = page) => of.locator("footer").getByText(pattern).waitFor();

export const visiblePoints = async (of = page) =>
  Number((await numbers(of).innerText()).match(/^[\d,]+/)[0].replaceAll(",", ""));

export const pieceSize = async () =>
  (await numbers().innerText()).match(/piece ([\d.]+) × ([\d.]+)/).slice(1).map(Number);

// Returns the length of the plate's dimension line in pixels.
export const plateLength = (of = page) => of.locator("#overlay line.dimension").evaluateAll((lines) =>
  Math.max(...lines.map((line) => line.getAttribute("x2") - line.getAttribute("x1"))));

export const exportDialog = (of = page) => of.getByRole("dialog", {name: "Export"});

export async function openExport(of = page) {
  await of.keyboard.press("Control+e");
  await of.locator("#export-size").getByText(/triangles$/).waitFor();
}

// Exports from the dialog, which must be open. Returns {name, bytes} of each file.
export async function exportFiles(count = 1, of = page) {
  await of.locator("#export-size").getByText(/triangles$/).waitFor();
  const saved = await savedFiles(found, of, count, () => of.locator("#export-go").click());
  await exportDialog(of).waitFor({state: "hidden"});
  return saved;
}

// Exports the shown piece. Returns the name and the bytes of its file, and the results of readStl().
export async function exported(of = page) {
  await openExport(of);
  const [file] = await exportFiles(1, of);
  return {...file, ...readStl(file.bytes)};
}
