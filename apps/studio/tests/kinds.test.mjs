// Tests that the page shows the same numbers as the files for each kind of work, and that each kind has its own
// settings.
import assert from "node:assert/strict";
import {choose, chooseView, engine, exportFiles, middleOf, numbers, openExport, option, page, press, radio, scan, soon,
  takeBack, test, undo, undoAll, untilTaken, untilText, withPage} from "./page_suite.mjs";
import {enter, eventually, readStl, untilReady} from "./support.mjs";

withPage("green_man", 5000, async () => {
  await chooseView("Back");
  await enter(option("resolution"), "0.3");
  await untilReady(page);
});

const sizeIn = (text) => text.match(/[\d.]+ × [\d.]+ × [\d.]+/)[0].split(" × ");

async function set(values) {
  for (const [name, text] of Object.entries(values)) await enter(option(name), text);
  await untilTaken();
}

const kept = async () => (await engine.newestStep(scan)).options;

// Exports the shown piece. Returns the name and the size of the file, and the size that the dialog states.
async function exported() {
  await openExport();
  const told = sizeIn(await page.locator("#export-size").innerText()), [{name, bytes}] = await exportFiles();
  return {name, told, size: readStl(bytes).size.map((mm) => mm.toFixed(2))};
}

test("tells the thickness of a coin whose rim stands above its relief, as its file has it", async () => {
  await choose("Coin");
  await set({width: "20", "rim-height": "2"});
  const status = sizeIn(await numbers().innerText()), {told, size} = await exported();
  assert.ok(Number(size[2]) > 3.7, `the rim stands above plate and relief: ${size}`);
  assert.deepEqual([status, told], [size, size]);
  await choose("Measure");
  await page.locator("#overlay").getByText(`${size[2]} mm thick`).waitFor();
  await choose("Light");
  await undo(2);
});

test("makes the die of exactly the piece that is shown, and takes it back", async () => {
  await choose("Coin");
  await set({diameter: "30", rim: "2", height: "0.9", width: "18", shift: "1,-1"});
  const coin = await exported(), before = await kept(), line = {from: [-15.5, -1], to: [15.5, -1], samples: 400};
  const profile = async (form) => (await engine.json("profile", {options: {...ask(before), form}, ...line})).heights_mm;
  await page.getByRole("button", {name: "Make the die of this coin"}).click();
  await page.getByRole("heading", {name: "Die of the coin"}).waitFor();
  await untilReady(page);
  const die = await exported();
  await eventually(async () => assert.deepEqual({...(await kept()), form: before.form}, before)); // only form differs
  await soon.equal(async () => (await kept()).form, "die");
  assert.deepEqual([coin.name, die.name], ["scan-coin.stl", "scan-die.stl"]);
  await page.getByText(`The die itself is ${die.told.join(" × ")} mm.`).waitFor();
  assert.deepEqual(die.told, die.size);
  assert.ok(Number(die.size[0]) > Number(coin.size[0]), "the die is larger than its coin");
  const [relief, hollow] = [await profile("relief"), (await profile("die")).reverse()];
  const inner = relief.flatMap((z, i) => (i > 30 && i < 370 ? [Math.abs(z + hollow[i])] : []));
  assert.ok(inner.filter((gap) => gap < 0.02).length > 0.97 * inner.length, `${Math.max(...inner)}`);
  await soon.ok(async () => await radio("Coin").isChecked() && !(await radio("Seal").isChecked()));
  await undo();
  await page.getByRole("heading", {name: "Coin", exact: true}).waitFor();
  await eventually(async () => assert.deepEqual(await kept(), before));
  await page.getByRole("button", {name: "Make the die of this coin"}).click();
  await page.getByRole("button", {name: "Back to the coin"}).click();
  await eventually(async () => assert.deepEqual(await kept(), before));
  await undo(8);
  await soon.ok(() => radio("Plaque").isChecked());
});

// Returns those options of a document that determine the heights, and a fine resolution.
const ask = ({view, up, outline, diameter, width, height, rim, shift, thickness, margin}) =>
  ({view, up, outline, diameter, width, height, rim, shift, thickness, margin, resolution: 0.1});

test("says in its hint what a seal is, and begins one of its own beside the die of a coin", async () => {
  assert.match(await radio("Seal").getAttribute("title"), /^Seal: a hollow of its own .* that piece's panel: 30 mm across/);
  await choose("Coin");
  await soon.match(() => radio("Coin").getAttribute("title"), /40 mm across, 1.6 mm high$/);
  await set({diameter: "33"});
  await soon.match(() => radio("Coin").getAttribute("title"), /33 mm across, 1.6 mm high$/);
  await page.getByRole("button", {name: "Make the die of this coin"}).click();
  await page.getByRole("heading", {name: "Die of the coin"}).waitFor();
  await choose("Seal");
  await page.getByRole("heading", {name: "Seal", exact: true}).waitFor();
  const {form, rim, draft, diameter} = await kept();
  assert.deepEqual([form, rim, draft, diameter], ["die", 1.2, 15, 33]);
  await undo(4);
});

test("uses no tool for a lithophane, and has it again for a coin", async () => {
  await set({resolution: "1"}); // coarse, since computing the reach of a tool takes long
  await option("tool").selectOption("Ball end");
  await page.getByText(/^The tool reaches/).waitFor();
  await option("finish").selectOption("Reachable");
  await choose("Lithophane");
  await page.getByText(/^The tool reaches/).waitFor({state: "hidden"});
  await soon.ok(async () => !(await option("tool").isVisible()) && !(await option("finish").isVisible()));
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
  await untilText(option("tool"), "ball");
  await untilText(option("finish"), "reachable");
  await takeBack(5);
});

test("names the files of each kind", async () => {
  const isNamed = async (file) => {
    await page.keyboard.press("Control+e");
    await untilText(page.locator("#export-name"), file);
    await page.keyboard.press("Escape");
  };
  const names = {Plaque: "scan", Coin: "scan-coin", Carving: "scan-carving", Seal: "scan-die",
    Lithophane: "scan-lithophane", Bent: "scan-bent"};
  for (const [name, file] of Object.entries(names)) {
    await radio(name).click();
    await isNamed(file);
  }
  await radio("Coin").click();
  await option("form").selectOption("Mirror");
  await isNamed("scan-coin-mirror");
  await undoAll(page, () => radio("Plaque").isChecked());
});

test("says why a figure that fills its plate does not move", async () => {
  await set({plate: "90x120"});
  const longer = (Number(await option("width").inputValue()) - 0.02).toFixed(2); // just less than the longest that fits
  await set({width: longer});
  await choose("Place");
  const [x, y] = await middleOf(page.locator("#stage"));
  await press([x, y], [1.4 * x, y]);
  await page.getByText(/^The plate has no room for the figure there/).waitFor();
  await page.mouse.up();
  await untilText(option("shift"), "");
  await choose("Light");
});
