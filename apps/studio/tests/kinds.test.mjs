// Kinds of work: their numbers are those of their files, and what each takes along.
import assert from "node:assert/strict";
import path from "node:path";
import {after, before, test} from "node:test";
import {enter, eventually, findBrowser, readStl, removeFolder, savedFiles, showScan, temporaryFolder, untilReady,
  writeSample} from "./support.mjs";

const found = await findBrowser(), {skip} = found;
const folder = temporaryFolder(), scan = path.join(folder, "scan.ply");
let browser, engine, page;

before(async () => {
  if (skip) return;
  writeSample("green_man", 5000, scan);
  browser = await found.launch();
  ({engine, page} = await showScan(browser, {state: path.join(folder, "state"), scan}));
  engine.document = new URL(page.url()).hash.slice(1);
  await page.locator(".inspector details").evaluateAll((all) => all.forEach((panel) => (panel.open = true)));
  await page.getByRole("button", {name: "Choose view"}).first().click();
  const dialog = page.getByRole("dialog", {name: "Choose the view"}); // from behind parts lie below the ground
  await dialog.getByRole("button", {name: "Back", exact: true}).click();
  await dialog.getByRole("button", {name: "Use this view"}).click();
  await enter(option("resolution"), "0.3");
  await untilReady(page);
});

after(async () => {
  await browser?.close();
  await engine?.stop();
  removeFolder(folder);
});

const option = (name) => page.locator(`[data-option="${name}"]`).first();
const kind = (name) => page.getByRole("radio", {name, exact: true});
const undo = () => page.getByRole("button", {name: "Undo", exact: true}).click();
const numbers = (text) => text.match(/[\d.]+ × [\d.]+ × [\d.]+/)[0].split(" × ");

// Waits until nothing is tried, and the piece is shown as its file will be.
async function untilTaken() {
  await page.waitForFunction(() => !document.querySelector('[aria-busy="true"]'));
  await untilReady(page);
}

async function choose(name) {
  await kind(name).click();
  await untilTaken();
}

async function set(values) {
  for (const [name, text] of Object.entries(values)) await enter(option(name), text);
  await untilTaken();
}

// Returns the document's options as they are kept.
const kept = () => eventually(async () => {
  const {steps, at} = (await engine.json("document", {input: {path: scan}})).kept;
  return steps[at].options;
});

// Exports the piece that is shown. Returns its name, its size and what the dialog says of it.
async function exported() {
  await page.keyboard.press("Control+e");
  const size = page.locator("#export-size"), dialog = page.getByRole("dialog", {name: "Export"});
  await size.getByText(/triangles$/).waitFor();
  const told = numbers(await size.innerText());
  const [{name, bytes}] = await savedFiles(found, page, 1, () => page.locator("#export-go").click());
  await dialog.waitFor({state: "hidden"});
  return {name, told, size: readStl(bytes).size.map((mm) => mm.toFixed(2))};
}

test("tells the thickness of a coin with parts below the ground, as its file has it", {skip}, async () => {
  await choose("Coin");
  await set({width: "20"});
  const status = numbers(await page.locator("#numbers").innerText()), {told, size} = await exported();
  assert.ok(Number(size[2]) > 3.7, `the rim stands above plate and relief: ${size}`);
  assert.deepEqual([status, told], [size, size]);
  await page.getByRole("radio", {name: "Measure"}).click();
  await page.locator("#overlay").getByText(`${size[2]} mm thick`).waitFor();
  await page.getByRole("radio", {name: "Light", exact: true}).click();
  for (let step = 0; step < 2; ++step) await undo();
});

test("makes the die of exactly the piece that is shown, and takes it back", {skip}, async () => {
  await choose("Coin");
  await set({diameter: "30", rim: "2", height: "0.9", width: "18", shift: "1,-1"});
  const coin = await exported(), before = await kept(), line = {from: [-15.5, -1], to: [15.5, -1], samples: 400};
  const profile = async (form) => (await engine.json("profile", {options: {...ask(before), form}, ...line})).heights_mm;
  await page.getByRole("button", {name: "Make the die of this coin"}).click();
  await page.getByRole("heading", {name: "Die of the coin"}).waitFor();
  await untilReady(page);
  const die = await exported();
  await eventually(async () => assert.deepEqual({...(await kept()), form: before.form}, before)); // all but the form
  assert.equal((await kept()).form, "die");
  assert.deepEqual([coin.name, die.name], ["scan-coin.stl", "scan-die.stl"]);
  await page.getByText(`The die itself is ${die.told.join(" × ")} mm.`).waitFor();
  assert.deepEqual(die.told, die.size);
  const [relief, hollow] = [await profile("relief"), (await profile("die")).reverse()];
  const inner = relief.flatMap((z, i) => (i > 30 && i < 370 ? [Math.abs(z + hollow[i])] : []));
  assert.ok(inner.filter((gap) => gap < 0.02).length > 0.97 * inner.length, `${Math.max(...inner)}`);
  assert.ok(await kind("Coin").isChecked() && !(await kind("Seal").isChecked()));
  await undo();
  await page.getByRole("heading", {name: "Coin", exact: true}).waitFor();
  await eventually(async () => assert.deepEqual(await kept(), before));
  await page.getByRole("button", {name: "Make the die of this coin"}).click();
  await page.getByRole("button", {name: "Back to the coin"}).click();
  await eventually(async () => assert.deepEqual(await kept(), before));
  for (let step = 0; step < 8; ++step) await undo();
  assert.ok(await kind("Plaque").isChecked());
});

// Returns the options of a document that the engine needs for heights.
const ask = ({view, up, outline, diameter, width, height, rim, shift, thickness, margin}) =>
  ({view, up, outline, diameter, width, height, rim, shift, thickness, margin, resolution: 0.1});

test("says in its hint what a seal is, and begins one of its own beside the die of a coin", {skip}, async () => {
  assert.match(await kind("Seal").getAttribute("title"), /^Seal: a hollow of its own .* that piece's panel: 30 mm across/);
  await choose("Coin");
  assert.match(await kind("Coin").getAttribute("title"), /40 mm across, 1.6 mm high$/);
  await set({diameter: "33"});
  assert.match(await kind("Coin").getAttribute("title"), /33 mm across, 1.6 mm high$/);
  await page.getByRole("button", {name: "Make the die of this coin"}).click();
  await page.getByRole("heading", {name: "Die of the coin"}).waitFor();
  await choose("Seal");
  await page.getByRole("heading", {name: "Seal", exact: true}).waitFor();
  const {form, rim, draft, diameter} = await kept();
  assert.deepEqual([form, rim, draft, diameter], ["die", 1.2, 15, 33]);
  for (let step = 0; step < 4; ++step) await undo();
});

test("uses no tool for a lithophane, and has it again for a coin", {skip}, async () => {
  await set({resolution: "1"}); // a tool's reach takes long
  await option("tool").selectOption("Ball end");
  await page.getByText(/^The tool reaches/).waitFor();
  await option("finish").selectOption("Reachable");
  await choose("Lithophane");
  await page.getByText(/^The tool reaches/).waitFor({state: "hidden"});
  assert.ok(!(await option("tool").isVisible()) && !(await option("finish").isVisible()));
  const asked = [];
  await page.route("**/api/export", (route) => {
    asked.push(route.request().postDataJSON().options);
    route.continue();
  });
  const {name} = await exported();
  await page.unroute("**/api/export");
  assert.equal(name, "scan-lithophane.stl");
  assert.deepEqual([asked[0].form, asked[0].tool, asked[0].finish], ["lithophane", undefined, undefined]);
  await choose("Coin");
  await page.getByText(/^The tool reaches/).waitFor();
  assert.deepEqual([await option("tool").inputValue(), await option("finish").inputValue()], ["ball", "reachable"]);
  for (let step = 0; step < 5; ++step) await undo();
  await untilReady(page);
});

test("names the files of each kind", {skip}, async () => {
  const names = {Plaque: "scan", Coin: "scan-coin", Carving: "scan-carving", Seal: "scan-die", Bent: "scan-bent"};
  for (const [name, file] of Object.entries(names)) {
    await kind(name).click();
    await page.keyboard.press("Control+e");
    await eventually(async () => assert.equal(await page.locator("#export-name").inputValue(), file));
    await page.keyboard.press("Escape");
  }
  await kind("Coin").click();
  await option("form").selectOption("Mirror");
  await page.keyboard.press("Control+e");
  await eventually(async () => assert.equal(await page.locator("#export-name").inputValue(), "scan-coin-mirror"));
  await page.keyboard.press("Escape");
  const button = page.getByRole("button", {name: "Undo", exact: true});
  while (!(await kind("Plaque").isChecked())) await button.click();
});

test("says why a figure that fills its plate does not move", {skip}, async () => {
  await set({plate: "90x120"});
  const longer = (Number(await option("width").inputValue()) - 0.02).toFixed(2); // nearly as large as fits
  await set({width: longer});
  await page.getByRole("radio", {name: "Place", exact: true}).click();
  await untilReady(page);
  const {x, y, width, height} = await page.locator("#stage").boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 0.7 * width, y + height / 2, {steps: 3});
  await page.getByText(/^The plate has no room for the figure there/).waitFor();
  await page.mouse.up();
  assert.equal(await option("shift").inputValue(), "");
  await page.getByRole("radio", {name: "Light", exact: true}).click();
});
