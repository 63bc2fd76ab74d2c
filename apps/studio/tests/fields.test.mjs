// Numbers, keys and the reach of heights on the page, in Chromium or Firefox.
import assert from "node:assert/strict";
import path from "node:path";
import {after, before, test} from "node:test";
import {EngineProcess, enter, findBrowser, removeFolder, savedFiles, temporaryFolder, type,
  writeSample} from "./support.mjs";

const found = await findBrowser();
const skip = found.missing ? `${found.missing}: the page is not tested` : false;
if (skip) console.log(`SKIPPED: ${skip}`);

const folder = temporaryFolder(), scan = path.join(folder, "scan.ply");
let browser, engine, page;

before(async () => {
  if (skip) return;
  writeSample("still_life", 8000, scan);
  browser = await found.launch();
  page = await (await browser.newContext({viewport: {width: 1280, height: 800}, acceptDownloads: true})).newPage();
  page.setDefaultTimeout(30000);
  engine = await new EngineProcess(path.join(folder, "state"), scan).ready();
  await page.goto(engine.address);
  await page.getByText(/points.*height/).waitFor();
  await page.locator(".inspector details").evaluateAll((all) => all.forEach((panel) => (panel.open = true)));
});

after(async () => {
  await browser?.close();
  await engine?.stop();
  removeFolder(folder);
});

const field = (name) => page.getByRole("spinbutton", {name, exact: true});
const slider = (name) => page.getByRole("slider", {name, exact: true});
const text = (name) => field(name).inputValue();

async function set(name, number) {
  await enter(field(name), String(number));
}

test("steps by round numbers with arrow keys", {skip}, async () => {
  const next = (...args) => page.evaluate(async (values) =>
    (await import(new URL("controls.js", location))).nextValue(...values), args);
  for (const [value, direction, isFine, least, wanted] of [[4, 1, false, 0.1, 4.1], [4.13, 1, false, 0.1, 4.2],
    [4.13, -1, false, 0.1, 4.1], [12.3, 1, false, 0.1, 13], [10, -1, false, 0.1, 9.9], [10, 1, false, 0.1, 11],
    [0, 1, false, 0.01, 0.01], [0.25, 1, false, 0.01, 0.26], [4, 1, true, 0.1, 4.01], [76, -1, false, 1, 75]])
    assert.equal((await next(value, direction, isFine, least)).toFixed(6), wanted.toFixed(6), `${value} ${direction}`);
  await set("Height in mm", 4);
  await slider("Height").press("ArrowRight");
  assert.equal(await text("Height in mm"), "4.10");
  await field("Height in mm").press("Shift+ArrowDown");
  assert.equal(await text("Height in mm"), "4.09");
  await slider("Steepest wall").press("ArrowLeft");
  assert.equal(await text("Steepest wall in degrees"), "75");
  await slider("Steepest wall").press("ArrowRight");
});

test("takes back with Escape what is typed or dragged, and undoes in fields", {skip}, async () => {
  await set("Height in mm", 4);
  await set("Height in mm", 5);
  await type(field("Height in mm"), "17");
  await field("Height in mm").press("Escape");
  assert.equal(await text("Height in mm"), "5.00");
  await field("Height in mm").press("Control+z");
  assert.equal(await text("Height in mm"), "4.00");
  await field("Height in mm").press("Control+Shift+Z");
  assert.equal(await text("Height in mm"), "5.00");

  const box = await slider("Fine detail").boundingBox(), y = box.y + box.height / 2;
  await page.mouse.move(box.x + box.width / 2, y);
  const before = await text("Fine detail value");
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 3, y, {steps: 4});
  assert.notEqual(await text("Fine detail value"), before);
  await page.keyboard.press("Escape");
  assert.equal(await text("Fine detail value"), before);
  await page.mouse.move(box.x + box.width / 4, y, {steps: 4});
  await page.mouse.up();
  assert.equal(await text("Fine detail value"), before);
  await page.getByRole("button", {name: "Undo"}).click();
  assert.equal(await text("Height in mm"), "4.00");
});

test("takes back with Escape what a point of the tone curve is dragged to, and draws no refused one", {skip}, async () => {
  await page.getByRole("combobox", {name: "Tone curve preset"}).selectOption("Bold edges first");
  const point = page.getByRole("slider", {name: "Curve point 2 of 4", exact: true});
  await point.evaluate((element) => element.scrollIntoView({block: "center"}));
  const value = () => point.getAttribute("aria-valuenow"), before = await value();
  const box = await point.boundingBox(), x = box.x + box.width / 2, y = box.y + box.height / 2;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - 30, {steps: 4});
  assert.notEqual(await value(), before);
  await page.keyboard.press("Escape");
  assert.equal(await value(), before);
  await page.mouse.move(x, y - 50, {steps: 4});
  assert.equal(await value(), before);
  await page.mouse.up();
  assert.equal(await value(), before);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x, y - 20, {steps: 4});
  await page.mouse.up();
  assert.notEqual(await value(), before, "the next drag counts again");
  await page.getByRole("combobox", {name: "Tone curve preset"}).selectOption("The paper's formula (6)");
});

test("shows and takes inches, and keeps millimetres", {skip}, async () => {
  await set("Longer side in mm", 101.6);
  await page.getByRole("combobox", {name: "Unit of lengths"}).selectOption("inch");
  assert.equal(await text("Longer side in inches"), "4.000");
  await set("Longer side in inches", "2 1/2".replace(" ", "+"));
  await set("Height in inches", "1/8");
  assert.equal(await text("Height in inches"), "0.125");
  await page.getByText(/points.*height 0\.125 in/).waitFor();
  await field("Height in inches").press("ArrowUp");
  assert.equal(await text("Height in inches"), "0.130");
  await set("Height in inches", "4mm");
  assert.equal(await text("Height in inches"), "0.157");
  await page.reload();
  await page.getByText(/points.*height/).waitFor();
  await page.getByRole("combobox", {name: "Unit of lengths"}).selectOption("mm");
  assert.equal(await text("Longer side in mm"), "63.5");
  assert.equal(await text("Height in mm"), "4.00");
});

test("exports when Enter is pressed", {skip}, async () => {
  await page.keyboard.press("Control+e");
  const dialog = page.getByRole("dialog", {name: "Export"});
  await dialog.getByText(/triangles/).waitFor();
  const [file] = await savedFiles(found, page, 1, () => enter(dialog.getByLabel("File name"), "medal"));
  assert.equal(file.name, "medal.stl");
  await dialog.waitFor({state: "hidden"});
});

test("marks the height that can be reached, and loosens what limits it", {skip}, async () => {
  const mark = page.getByTitle(/^Reach(able|ed) with(out)? steps at depth jumps: [\d.]+ mm$/);
  const reach = page.locator("#reach");
  await set("Longer side in mm", 60);
  await mark.waitFor();
  const reachable = async () => Number((await mark.getAttribute("title")).match(/[\d.]+/)[0]), most = await reachable();
  await set("Steepest wall in degrees", 30);
  for (let i = 0; i < 100 && (await reachable()) >= most; ++i) await page.waitForTimeout(50);
  const limited = await reachable();
  assert.ok(limited < most, `${limited} of ${most}`);
  await set("Height in mm", 300); // more than steps at depth jumps can make up for
  await reach.getByText(/The steepest wall keeps it at [\d.]+ mm/).waitFor();
  await page.keyboard.press("Control+e"); // the file has another height than the one that was asked for
  const dialog = page.getByRole("dialog", {name: "Export"});
  await dialog.getByText(/^A height of [\d.]+ mm is out of reach here\.$/).waitFor();
  await dialog.getByRole("button", {name: "Cancel"}).click();
  await reach.getByRole("button", {name: "Allow steeper walls"}).click();
  assert.equal(await text("Steepest wall in degrees"), "85");
  await page.locator('[role="application"][aria-busy="false"]').first().waitFor();
  for (let i = 0; i < 100 && (await reachable()) <= limited; ++i) await page.waitForTimeout(50);
  assert.ok((await reachable()) > most, `${await reachable()} of ${most}`);
});

test("names the tone curve and the view where they limit the height, and loosens them", {skip}, async () => {
  const reach = page.locator("#reach"), preset = page.getByRole("combobox", {name: "Tone curve preset"});
  await preset.selectOption("Fine detail first");
  await set("Height in mm", 2000);
  await reach.getByText(/^The tone curve keeps it at [\d.]+ mm\./).waitFor();
  await reach.getByRole("button", {name: "Drop the tone curve"}).click();
  assert.equal(await preset.inputValue(), "");
  await reach.getByText(/^This view reaches [\d.]+ mm at most\./).waitFor();
  await reach.getByRole("button", {name: "Choose view"}).click();
  await page.getByRole("dialog", {name: "Choose the view"}).waitFor();
  await page.keyboard.press("Escape");
  for (let step = 0; step < 3; ++step) await page.getByRole("button", {name: "Undo"}).click();
});

test("ends no drag when the pause after another slider's step is over", {skip}, async () => {
  const steps = await page.evaluate(async () => {
    const {Document, FIRST} = await import(new URL("document.js", location));
    const doc = new Document(() => {}), counts = [];
    doc.begin(FIRST);
    for (const [height, ended] of [[6, "width"], [7, "height"], [8, null]]) {
      doc.change({options: {height}}, "height");
      counts.push(doc.steps.length);
      doc.endStroke(ended);
    }
    return counts;
  });
  assert.deepEqual(steps, [2, 2, 3]);
});
