// Tests fonts and drawings that the studio takes by file, and projects that contain them.
import assert from "node:assert/strict";
import {readFileSync, rmSync, writeFileSync} from "node:fs";
import path from "node:path";
import {button, engine, exported, folder, found, labelled, page, savedProject, scan, set, soon, test, toast, withPage}
  from "./page_suite.mjs";
import {enter, run, untilReady} from "./support.mjs";

withPage("still_life", 5000, async () => {
  await enter(labelled("Margin in mm"), "9");
  await enter(labelled("Resolution"), "0.6"); // such a coarse piece is made quickly
  await set("Height in mm", 2);
  await untilReady(page);
});

const list = async () => JSON.parse((await engine.newestStep(scan)).options.ornaments || '{"ornaments":[]}').ornaments;
const note = () => page.locator("#ornaments-note");

// The file of the font that is built into the program. A text has the same outlines with this file and with the
// built-in font.
const FONT = readFileSync(new URL("../../../src/lettering/fonts/NotoSerif-Bold.subset.ttf", import.meta.url));
const SQUARE = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0h10v10h-10z"/></svg>';

const choose = (what, name, content) => labelled(`File of ${what}`).setInputFiles({name,
  mimeType: "application/octet-stream", buffer: Buffer.from(content)});

async function drop(name, content) {
  const transfer = await page.evaluateHandle(([name, bytes]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([Uint8Array.from(bytes)], name));
    return transfer;
  }, [name, [...Buffer.from(content)]]);
  await page.locator("#letters").dispatchEvent("drop", {dataTransfer: transfer});
}

test("takes fonts and drawings that are dropped, and says why it refuses a file", async () => {
  await drop("own.ttf", FONT);
  await toast().getByText("own.ttf: expected one chosen text, whose font it becomes.").waitFor();
  await drop("crest.svg", SQUARE);
  await soon.match(async () => (await list())[0].file, /\/crest\.svg$/);
  await button("Remove crest.svg").click();
  await button("Add a text").click();
  await drop("own.ttf", FONT);
  await soon.match(async () => (await list())[0].font, /\/own\.ttf$/);
  await button("Remove the font").click();
  await soon.deepEqual(list, [{kind: "text", text: "TEXT"}]);
  for (const [name, content, why] of [
    ["torn.ttf", FONT.subarray(0, 300), /^torn\.ttf cannot be used: .*expected a TrueType or OpenType font/],
    ["none.otf", "x".repeat(1000), /^none\.otf cannot be used: .*expected a TrueType or OpenType font/],
    ["round.svg", '<svg><circle r="3"/></svg>', /^round\.svg cannot be used: .*circle/],
    ["empty.svg", "", /^empty\.svg cannot be used: /],
    ["thin.svg", '<svg><path d="M0 0h10"/></svg>', /^thin\.svg cannot be used: .*expected a filled path, found none/],
    ["scan.obj", "v 0 0 0", /^scan\.obj: expected a font \(TTF, OTF\) or a drawing \(SVG\)/]]) {
    await drop(name, content);
    await toast().getByText(why).waitFor();
    await soon.deepEqual(list, [{kind: "text", text: "TEXT"}]);
  }
  await button("Remove “TEXT”").click();
});

test("sets a text in a font by file and adds a drawing, which are in the saved project", async () => {
  await button("Add a text").click();
  await enter(labelled("Text"), "ΔΗΜΟΣ");
  await enter(labelled("Size"), "3");
  await untilReady(page);
  const {bytes: before} = await exported();
  await choose("the font", "own.ttf", FONT);
  await soon.match(async () => (await list())[0].font, /\/own\.ttf$/);
  await button("Font own.ttf: choose another").waitFor();
  await untilReady(page);
  assert.ok((await exported()).bytes.equals(before), "the same font by file gives other bytes");
  await choose("a drawing", "crest.svg", SQUARE);
  await soon.match(async () => (await list())[1].file, /\/crest\.svg$/);
  await enter(labelled("Size"), "4");
  await page.getByRole("button", {name: /^Move crest/}).focus();
  for (let i = 0; i < 24; ++i) await page.keyboard.press("ArrowLeft"); // moves the drawing away from the text
  await soon.equal(() => note().textContent(), "");
  await untilReady(page);
  const {bytes: with_drawing} = await exported();
  assert.ok(!with_drawing.equals(before));
  const project = path.join(folder, "files.relievo"), made = path.join(folder, "files.stl");
  writeFileSync(project, await savedProject("With the scan"));
  for (const {font, file} of await list()) // `make` must not need the studio's copies of the files
    rmSync(path.dirname(font ?? file), {recursive: true});
  run("make", project, "-o", made);
  assert.ok(readFileSync(made).equals(with_drawing), "the bytes differ");
  await enter(labelled("Size"), "4.5");
  await note().getByText(/own\.ttf: expected a file that can be read/).waitFor();
  await untilReady(page); // pictures are drawn without the missing files
  await page.locator("#file").setInputFiles(project); // the project contains the files
  await soon.equal(() => button("crest.svg").getAttribute("aria-expanded"), "false"); // the project is open now
  await button("crest.svg").click();
  await soon.equal(() => labelled("Size").inputValue(), "4");
  await soon.equal(() => note().textContent(), "");
  await untilReady(page);
  assert.ok((await exported()).bytes.equals(with_drawing), "the bytes differ");
});
