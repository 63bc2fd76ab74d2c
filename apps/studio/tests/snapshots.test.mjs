// Tests snapshots (named settings): they are taken, applied, compared, renamed and removed.
import assert from "node:assert/strict";
import {writeFileSync} from "node:fs";
import path from "node:path";
import {DESK, button, choose, engine, field, folder, labelled, option, page, savedProject, scan, set, soon, test, text,
  undo, untilTaken, withPage} from "./page_suite.mjs";
import {enter, untilReady} from "./support.mjs";

withPage("shell", 5000, () => page.setViewportSize(DESK));

const take = () => button("Take a snapshot").click();
const names = () => page.locator("#snapshot-list input").evaluateAll((all) => all.map(({value}) => value));
const height = () => text("Height in mm");
const pressed = (name) => button(`Compare ${name}`).getAttribute("aria-pressed");
const steps = async () => (await engine.kept({path: scan})).at;

// Returns the mean difference, in grey levels, between the pictures on both sides of the divider.
const difference = () => page.evaluate(() => {
  const pixels = ["#before", "#picture"].map((id) => document.querySelector(id)).map((canvas) =>
    canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data);
  return pixels[0].length === pixels[1].length
    ? pixels[0].reduce((sum, level, i) => sum + Math.abs(level - pixels[1][i]), 0) / pixels[0].length : Infinity;
});

test("takes snapshots, applies them as one step of undo, renames and removes them", async () => {
  await set("Height in mm", 3);
  await take();
  await soon.deepEqual(names, ["Snapshot 1"]);
  await page.keyboard.type("Flat"); // the name has the focus
  await page.keyboard.press("Enter");
  await soon.deepEqual(names, ["Flat"]);
  await set("Height in mm", 8);
  await choose("Coin");
  await take();
  await soon.deepEqual(names, ["Flat", "Snapshot 2"]);
  const before = await steps();
  await button("Apply Flat").click();
  await soon.equal(height, "3.00");
  await soon.equal(() => page.getByRole("radio", {name: "Coin", exact: true}).getAttribute("aria-checked"), "false");
  await soon.deepEqual(names, ["Flat", "Snapshot 2"], "a snapshot has no snapshots");
  await soon.equal(steps, before + 1);
  await undo();
  await soon.equal(height, "1.60");
  await button("Apply Snapshot 2").click(); // changes nothing
  await soon.equal(steps, before);
  await button("Remove Flat").click();
  await soon.deepEqual(names, ["Snapshot 2"]);
  await soon.equal(() => page.evaluate(() => document.activeElement.ariaLabel), "Remove Snapshot 2");
  await undo();
  await soon.deepEqual(names, ["Flat", "Snapshot 2"]);
  await page.reload();
  await untilReady(page);
  await soon.deepEqual(names, ["Flat", "Snapshot 2"]);
});

test("compares a snapshot with the present settings on both sides of the divider", async () => {
  await button("Apply Flat").click();
  await untilTaken();
  await button("Compare Flat").click();
  await soon.equal(() => pressed("Flat"), "true");
  await soon.deepEqual(() => page.locator("#labels span").allTextContents(), ["Flat", "Now"]);
  await untilReady(page);
  await soon.equal(difference, 0); // both sides show the same settings
  await set("Height in mm", 9);
  await untilReady(page);
  await soon.ok(async () => (await difference()) > 0.5);
  await set("Longer side in mm", 50); // both sides keep their scale
  await untilReady(page);
  await soon.ok(async () => (await difference()) > 0.5);
  await page.getByRole("slider", {name: "Divider between Flat and Now"}).press("ArrowLeft");
  await button("Compare Snapshot 2").click();
  await soon.equal(() => pressed("Flat"), "false");
  await soon.equal(() => pressed("Snapshot 2"), "true");
  await untilReady(page);
  await page.keyboard.press("Escape");
  await soon.equal(() => pressed("Snapshot 2"), "false");
  await soon.ok(() => page.locator("#before").isHidden());
  await button("Compare", page).click();
  await soon.deepEqual(() => page.locator("#labels span").allTextContents(), ["Model", "Relief"]);
  await button("Compare Flat").click();
  await button("Remove Flat").click();
  await soon.equal(() => button("Compare", page).getAttribute("aria-pressed"), "false");
  await undo(3);
});

test("does not compare settings of another view, and applies them with their view", async () => {
  await enter(option("crop"), "0,0,1,0.8");
  await untilTaken();
  await soon.ok(() => button("Compare Flat").isDisabled());
  await button("Apply Flat").click();
  await untilTaken();
  await soon.ok(() => button("Compare Flat").isEnabled());
  await undo(2);
  await untilTaken();
});

test("keeps snapshots in a project, without what is none", async () => {
  const project = JSON.parse(await savedProject());
  assert.deepEqual(project.studio.snapshots.map(({name}) => name), ["Flat", "Snapshot 2"]);
  assert.ok(JSON.stringify(project.studio.snapshots).length < 1500, "options that a new document has are left out");
  project.studio.snapshots.push({name: 3, options: {}}, {name: "none"}, "none",
    {name: "odd", options: {height: "high", width: 40, unknown: 3, crop: {}}, light: [0, 0, 0], u: -1},
    {name: "as wide as fits", options: {diameter: 60, outline: "circle", width: null}});
  const file = path.join(folder, "snapshots.relievo");
  writeFileSync(file, JSON.stringify(project));
  await page.locator("#file").setInputFiles(file);
  await soon.deepEqual(names, ["Flat", "Snapshot 2", "odd", "as wide as fits"]);
  const {snapshots} = JSON.parse(await savedProject()).studio;
  assert.equal(snapshots.at(-1).options.width, null);
  await untilTaken();
  await button("Apply odd").click();
  await soon.equal(() => text("Longer side in mm"), "40.0");
  await untilTaken();
  assert.ok(await field("Height in mm").isVisible());
  assert.ok(await labelled("Name of odd").isVisible());
});
