// Tests that the page takes entries in the order in which the user types and chooses them, and that exports and
// projects wait for them.
import assert from "node:assert/strict";
import path from "node:path";
import {button, choose, engine, exportDialog as dialog, exportFiles as files, folder, found, openExport, option, page,
  radio as kind, scan, soon, takeBack, test, undo, undoAll, untilTold, withPage} from "./page_suite.mjs";
import {enter, eventually, holdRequests, openPanels, readStl, savedFiles, type, untilReady,
  writeSample} from "./support.mjs";
import {runSequence, showSmallScan} from "./random_entries.mjs";

let tried; // requests that try entries and wait for release()

withPage("green_man", 4000, () => chooseResolution());

async function chooseResolution() {
  await enter(option("resolution"), "0.4");
  await untilReady(page);
}

const value = (name) => option(name).inputValue();
const waits = (text) => page.locator("#trying").getByText(text).waitFor();

// Holds back all requests that try entries until release().
async function hold() {
  tried = [];
  await page.route("**/api/profile", (route) => (tried ? tried.push(route) : route.continue()));
}

async function release() {
  const held = tried;
  tried = null;
  for (const route of held) await route.continue();
}

async function free() {
  if (tried) await release();
  await page.unroute("**/api/profile");
  await undoAll(page, async () => (await value("resolution")) === "");
  await chooseResolution();
}

const sizeOf = (bytes) => readStl(bytes).size.map((mm) => mm.toFixed(2));

test("exports a size that was typed just before", async () => {
  await choose("Coin");
  await hold();
  await enter(option("diameter"), "25");
  await page.keyboard.press("Control+e");
  await dialog().getByText("Waiting for what was entered").waitFor();
  await soon.ok(() => dialog().getByRole("button", {name: "Export"}).isDisabled());
  await waits("Trying Diameter …");
  await release();
  const [file] = await files();
  assert.deepEqual([file.name, ...sizeOf(file.bytes).slice(0, 2)], ["scan-coin.stl", "25.00", "25.00"]);
  await soon.equal(() => value("diameter"), "25");
  await free();
});

for (const [how, press] of Object.entries({
  "its button": () => page.locator("#export").click(), "its keys": () => page.keyboard.press("Control+e")}))
  test(`exports by ${how} what Enter has not confirmed`, async () => {
    await choose("Coin");
    await type(option("diameter"), "31");
    await press();
    const [{bytes}] = await files();
    assert.deepEqual(sizeOf(bytes).slice(0, 2), ["31.00", "31.00"]);
    await type(option("height"), "1.25"); // unlike the diameter, the height has a slider beside its field
    await press();
    await page.locator("#export-size").getByText(/triangles$/).waitFor();
    await soon.match(() => page.locator("#export-size").innerText(), /relief 1\.25 mm high/);
    await page.keyboard.press("Escape");
    await free();
  });

test("exports what arrow keys have stepped to", async () => {
  await enter(option("rim"), "3");
  await untilReady(page);
  await option("rim").press("ArrowUp");
  await page.keyboard.press("Control+e");
  await files();
  await soon.equal(() => value("rim"), "3.1");
  await undo();
  await soon.equal(() => value("rim"), "3");
  await free();
});

test("saves a project of what was typed just before", async () => {
  await choose("Coin");
  await hold();
  await enter(option("diameter"), "27");
  await type(option("thickness"), "2.75");
  await page.keyboard.press("Control+s");
  const save = page.getByRole("dialog", {name: "Save project"});
  await save.getByText("Settings alone").click();
  await save.getByRole("button", {name: "Save", exact: true}).click();
  const [{bytes}] = await savedFiles(found, page, 1, release);
  const {options} = JSON.parse(bytes);
  assert.deepEqual([options.diameter, options.thickness], [27, 2.75]);
  await free();
});

test("takes sizes in the order in which they were typed, each as one step", async () => {
  const longer = await value("width");
  await hold();
  await enter(option("plate"), "200x150");
  await enter(option("width"), "90");
  await enter(option("plate"), "abc");
  await enter(option("rim"), "2");
  await waits("Trying Plate size, Longer side, Rim width …");
  const plateWidthAndRim = () => Promise.all(["plate", "width", "rim"].map(value));
  await soon.deepEqual(plateWidthAndRim, ["abc", "90.0", "2"]);
  const refusal = page.getByText(/^Plate size: expected/), trying = page.locator("#trying");
  const staysAfterTheOthers = soon.ok(
    async () => (await refusal.isVisible()) && (await trying.textContent()) === "", "the refusal is shown");
  await release();
  await staysAfterTheOthers; // the entry after the refused one is taken
  await soon.deepEqual(plateWidthAndRim, ["200x150", "90.0", "2"]);
  await undo();
  await soon.equal(() => value("rim"), "");
  await takeBack();
  await soon.ok(async () => Number(await value("width")) > 120, "as large as fits");
  await undo();
  await soon.deepEqual(async () => [await value("plate"), await value("width")], ["", longer]);
  await free();
});

for (const name of ["thickness", "height"])
  test(`what was selected in the ${name} stays selected when a waiting kind is taken`, async () => {
    const before = await value(name);
    await hold();
    await enter(option("rim"), "2");
    await kind("Lithophane").click();
    await waits("Trying Rim width, Lithophane …");
    await option(name).focus();
    await page.keyboard.press("Control+a");
    await release();
    await soon.ok(async () => (await value(name)) !== before, "the value of a lithophane");
    await page.keyboard.type("2.98");
    await page.keyboard.press("Enter");
    await soon.equal(() => value(name), "2.98");
    await free();
  });

test("takes a kind, and what is typed for it, after the entries before", async () => {
  await hold();
  await enter(option("plate"), "140x110");
  await kind("Coin").click();
  await waits("Trying Plate size, Coin …");
  await soon.equal(() => value("plate"), "140x110");
  await release();
  await page.getByText("The size of the plate stays with Plaque, and comes back with it.").waitFor();
  await soon.ok(() => kind("Coin").isChecked());
  await kind("Plaque").click();
  await soon.equal(() => value("plate"), "140x110");
  await kind("Lithophane").click(); // the plate of a lithophane begins with the size of the plaque
  await soon.equal(() => value("plate"), "140x110");
  await free();
});

test("takes back the newest entry that is waiting, and redoes nothing over it", async () => {
  const rim = await value("rim");
  await enter(option("height"), "4");
  await undo();
  await hold();
  await enter(option("plate"), "150x120");
  await enter(option("rim"), "1");
  await soon.ok(() => button("Redo").isDisabled());
  await page.keyboard.press("Control+Shift+Z");
  await undo();
  await soon.equal(() => value("rim"), rim);
  await release();
  await untilTold(/piece 150\.00 × 120\.00/);
  await soon.deepEqual(async () => [await value("rim"), await value("height")], [rim, "5.00"]);
  await free();
});

test("keeps a height that is typed while the picture of the one before is drawn, also without a lock", async () => {
  await button("Lock the height").click();
  await untilReady(page);
  const letGo = await holdRequests(page, "**/api/picture"), asked = page.waitForRequest("**/api/picture");
  await enter(option("detail"), "0.1");
  await asked;
  await enter(option("height"), "4");
  const next = page.waitForRequest("**/api/picture");
  await letGo();
  assert.equal((await next).postDataJSON().options.height, 4);
  await untilReady(page);
  // Before this entry the height was 3.2. A height that is not locked is met only roughly.
  assert.ok(Math.abs((await value("height")) - 4) < 0.2);
  assert.match(await option("height").inputValue(), /^\d+\.\d\d$/);
  await free();
});

test("goes on with what is being typed while the panel of another kind comes", async () => {
  await hold();
  await enter(option("plate"), "140x110");
  await kind("Coin").click();
  await type(option("thickness"), "2.");
  await release();
  await page.getByRole("heading", {name: "Coin", exact: true}).waitFor();
  await soon.ok(() => kind("Coin").isChecked());
  await page.keyboard.type("75");
  await page.keyboard.press("Enter");
  await soon.equal(() => value("thickness"), "2.75");
  await page.locator("#kind-rows").getByLabel("Rim width").waitFor(); // the panel now shows the fields of a coin
  await free();
});

test("types over the text of a field to which a closed dialog gives the focus back", async () => {
  await option("thickness").focus();
  await openExport();
  await button("Cancel", dialog()).click();
  await dialog().waitFor({state: "hidden"});
  await soon.ok(() => option("thickness").evaluate((input) => document.activeElement === input));
  await page.keyboard.press("Control+a");
  await page.keyboard.type("4.3");
  await page.keyboard.press("Enter");
  await soon.equal(() => value("thickness"), "4.3");
  await free();
});

test("makes the piece of an export that is opened right after another one was given up", async () => {
  await page.locator("#export").click();
  await page.locator("#export-size").getByText(/triangles$/).waitFor();
  await page.evaluate(() => {
    document.querySelector("#export-cancel").click(); // the page receives the dialog's close event later
    document.querySelector("#export").click();
  });
  await files();
});

test("gives what was typed to the scan that it was typed for, when another one is opened", async () => {
  const other = path.join(folder, "other.ply");
  writeSample("shell", 3000, other);
  await hold();
  await enter(option("plate"), "170x130");
  await page.locator("#file").setInputFiles(other);
  await waits("Trying Plate size …");
  await eventually(() => assert.ok(tried.length > 0));
  await release();
  await page.getByText("other.ply", {exact: true}).waitFor();
  await untilReady(page);
  await soon.equal(() => value("plate"), "");
  await page.locator("#file").setInputFiles(scan);
  await page.locator("#title").getByText("scan.ply", {exact: true}).waitFor();
  await untilReady(page);
  assert.equal((await engine.newestStep(scan)).options.plate, "170x130");
});

test("waits with an export for a view that is being prepared", async () => {
  await page.goto(`${engine.address}#`);
  await untilReady(page);
  await openPanels(page);
  await enter(option("resolution"), "0.4");
  await type(option("crop"), "0,0,0.5,1");
  await page.keyboard.press("Control+e");
  const [{bytes}] = await files();
  assert.ok(readStl(bytes).isClosed);
  await soon.equal(() => value("crop"), "0,0,0.5,1");
  await takeBack();
});

const SEED = 7, SEQUENCES = 15; // random_entries.mjs can run hundreds of sequences

test("takes random sequences of entries, and exports what it shows", async () => {
  const shown = await showSmallScan();
  try {
    for (let i = 0; i < SEQUENCES; ++i) await runSequence(shown, SEED + i);
  } finally {
    await shown.close();
  }
});
