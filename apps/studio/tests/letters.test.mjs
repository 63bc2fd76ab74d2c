// Tests the panel of letters and borders, the outlines and the handle on the picture, and the bytes of exported files.
import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
import path from "node:path";
import {button, drag, engine, exported, folder, labelled, middleOf, page, savedProject, scan, set, soon, test, undo,
  withPage} from "./page_suite.mjs";
import {enter, eventually, run, untilReady} from "./support.mjs";

withPage("still_life", 5000, async () => {
  await enter(labelled("Margin in mm"), "9");
  await enter(labelled("Resolution"), "0.6"); // such a coarse piece is made quickly
  await page.evaluate(() => document.querySelector("#stage").addEventListener("picture", ({detail}) => {
    window.shown = detail.facts;
    window.scale = document.querySelector("#stage").clientWidth / detail.facts.width * detail.facts.pixels_per_mm;
  }));
  await untilReady(page);
});

const list = async () => JSON.parse((await engine.newestStep(scan)).options.ornaments || '{"ornaments":[]}').ornaments;
const hasList = (...wanted) => soon.deepEqual(list, wanted);
const add = (what) => button(`Add ${what}`).click();
const text = () => labelled("Text");
const handle = () => page.getByRole("button", {name: /^Move “.*” by dragging or arrow keys$/});
const outlines = () => page.locator("#overlay .letter");
const note = () => page.locator("#ornaments-note");
const untilShown = () => soon.ok(() => page.evaluate(() => window.shown.has_ornaments));

test("adds a text whose outlines follow each letter, and shows the letters themselves at rest", async () => {
  await add("a text");
  await hasList({kind: "text", text: "TEXT"});
  await untilShown();
  await soon.equal(() => outlines().count(), 0);
  await text().fill("");
  for (const [i, letter] of [..."LEX"].entries()) {
    await text().press(letter);
    await hasList({kind: "text", text: "LEX".slice(0, i + 1)});
    await outlines().waitFor();
  }
  await text().press("Tab");
  await untilShown();
  await undo(); // all letters are one step
  await hasList({kind: "text", text: "TEXT"});
  await undo();
  await hasList();
  await soon.equal(() => handle().isVisible(), false);
});

test("takes kind, line and numbers of texts and borders, and removes them one by one", async () => {
  await add("a line");
  await add("beads");
  await enter(labelled("Number"), "40");
  await enter(labelled("Size"), "0.8");
  await add("a text");
  await enter(text(), "ΝΟΜΟΣ");
  await labelled("Line of the text").selectOption({label: "Arc at the top"});
  await enter(labelled("Size"), "3");
  await enter(labelled("Above ground"), "-0.4");
  await enter(labelled("Above ground"), "high");
  await page.getByText(/^Above ground: expected a number/).waitFor();
  await hasList({kind: "line"}, {kind: "beads", count: 40, size: 0.8},
    {kind: "text", text: "ΝΟΜΟΣ", arc: "top", size: 3, height: -0.4});
  await button("Remove Beads").click();
  await button("“ΝΟΜΟΣ”").click();
  await enter(labelled("Size"), ""); // an empty field restores the default
  await hasList({kind: "line"}, {kind: "text", text: "ΝΟΜΟΣ", arc: "top", height: -0.4});
  await button("Remove “ΝΟΜΟΣ”").click();
  await button("Remove Line").click();
  await hasList();
});

test("moves a straight text by its handle as far as the pointer, and by keys", async () => {
  await add("a text");
  await enter(text(), "I");
  await untilShown();
  const [x, y] = await middleOf(handle()), scale = await page.evaluate(() => window.scale);
  await drag([x, y], [x + 40, y], [x + 80, y]);
  await eventually(async () => {
    const [{at: [right]}] = await list();
    assert.ok(Math.abs(right - 80 / scale) < 0.05, `${right} mm for ${80 / scale}`);
  });
  const [moved] = await middleOf(handle()), [{at}] = await list();
  assert.ok(Math.abs(moved - x - 80) < 2, `${moved - x} pixels for 80`);
  await handle().focus();
  for (const key of ["ArrowUp", "ArrowLeft", "Shift+ArrowLeft"]) await page.keyboard.press(key);
  await soon.deepEqual(async () => (await list())[0].at.map((mm, i) => Math.round(100 * (mm - at[i]))), [-60, 50]);
  await undo(3);
  await hasList({kind: "text", text: "TEXT"});
  await undo();
});

test("turns a text on an arc around the middle of the piece", async () => {
  await add("a text");
  await labelled("Line of the text").selectOption({label: "Arc at the bottom"});
  await enter(labelled("Size"), "3");
  await untilShown();
  const [x, y] = await middleOf(handle()), [middleX, middleY] = await middleOf(page.locator("#stage"));
  const far = y - middleY, turned = (degrees) => [middleX + far * Math.sin(degrees * Math.PI / 180),
    middleY + far * Math.cos(degrees * Math.PI / 180)];
  assert.ok(Math.abs(x - middleX) < 1);
  await drag([x, y], turned(10), turned(20));
  await soon.equal(async () => (await list())[0].angle, 290);
  await handle().focus();
  await page.keyboard.press("ArrowRight");
  await soon.equal(async () => (await list())[0].angle, 285);
  await undo(5);
  await hasList();
});

test("says what a text lacks, and goes on showing the piece without it", async () => {
  await add("a text");
  await enter(text(), "漢");
  await note().getByText(/^Letters: .*漢/).waitFor();
  await untilReady(page);
  await soon.equal(() => page.evaluate(() => window.shown.has_ornaments), false);
  await enter(text(), "I");
  await soon.equal(() => note().textContent(), "");
  await enter(labelled("Size"), "40");
  await note().getByText(/^Letters: expected room for the text 'I'/).waitFor();
  await soon.ok(() => page.locator("#overlay .letter.refused").isVisible());
  await enter(labelled("Size"), "3");
  await soon.equal(() => note().textContent(), "");
  await untilShown();
  await labelled("Outline").selectOption("none");
  await note().getByText("There is no ground around the relief for them.").waitFor();
  await untilReady(page);
  await soon.ok(() => button("Add a text").isDisabled());
  await undo(6);
  await hasList();
});

test("exports the bytes that make writes of the saved project, which has the letters inside", async () => {
  await add("a line");
  await add("a text");
  await enter(text(), "ΔΗΜΟΣ");
  await enter(labelled("Size"), "3");
  await set("Height in mm", 2);
  await untilShown();
  const file = await exported();
  assert.ok(file.isClosed);
  const project = path.join(folder, "letters.relievo"), made = path.join(folder, "letters.stl");
  writeFileSync(project, await savedProject("With the scan"));
  run("make", project, "-o", made);
  assert.ok(readFileSync(made).equals(file.bytes), "the bytes differ");
  await undo(5);
});

test("shows the text that a project gives by options of its own, and changes it", async () => {
  const project = {relievo: 1, input: {path: scan}, options: {text: "LIBERTAS", "text-size": 3,
    "text-inset": 2, margin: 9}};
  await page.locator("#file").setInputFiles({name: "own.relievo", mimeType: "application/json",
    buffer: Buffer.from(JSON.stringify(project))});
  await button("“LIBERTAS”").click();
  await enter(text(), "LEX");
  await hasList({kind: "text", text: "LEX", arc: "straight", size: 3, inset: 2});
  await soon.equal(async () => (await engine.newestStep(scan)).options.text, "");
});
