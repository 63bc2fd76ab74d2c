// Types, chooses, undoes and exports at random times and speeds, and compares the fields, the status line, the dialog
// and the file:
//   node apps/studio/tests/random_entries.mjs SEQUENCES SEED
// Sequence i of seed S is the first sequence of seed S + i.
import assert from "node:assert/strict";
import path from "node:path";
import {fileURLToPath} from "node:url";
import {button, exportFiles, found, option, radio} from "./page_suite.mjs";
import {areKindsDrawn, enter, eventually, openPanels, readStl, showScan, temporaryFolder, untilReady,
  writeSample} from "./support.mjs";

// Returns a generator of random numbers between 0 and 1, which depend only on the seed.
export function randomNumbers(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let x = Math.imul(state ^ (state >>> 15), state | 1);
    x ^= x + Math.imul(x ^ (x >>> 7), x | 61);
    return ((x ^ (x >>> 14)) >>> 0) / 2 ** 32;
  };
}

const KINDS = ["Plaque", "Coin", "Carving", "Seal", "Lithophane", "Bent"];
// The engine accepts any combination of numbers in these ranges.
const RANGES = {height: [0.5, 2.5], width: [4, 9], thickness: [1, 5], margin: [0.5, 2], diameter: [24, 60], rim: [0.5, 1.5],
  "rim-height": [0.3, 2]};
const REFUSED = {plate: "abc", diameter: "0", rim: "-1", height: "high", shift: "9", thickness: "-1"};
const NUMBERS = [...Object.keys(RANGES), "plate", "shift"];
// For each of these fields, the other fields that an entry in it changes.
const BESIDES = {diameter: ["plate", "width", "shift"], plate: ["diameter", "width", "shift"]};

export class RandomEntries {
  constructor({page, random}) {
    Object.assign(this, {page, random, done: [], typed: {}});
  }

  between(low, high) {
    return low + this.random() * (high - low);
  }

  oneOf(list) {
    return list[Math.floor(this.random() * list.length)];
  }

  // Makes a random number of entries, then checks that the page shows and exports everything that was entered.
  async run() {
    const {page} = this, first = await this.snapshot();
    for (let n = Math.floor(this.between(3, 8)); n > 0; --n) await this.act();
    await this.exported();
    await untilReady(page);
    const last = await this.snapshot(), steps = await this.pressAll("Undo");
    await untilReady(page);
    assert.deepEqual(await this.snapshot(), first, "the first state, after all was undone");
    await this.pressAll("Redo", steps); // `steps` does not include entries that were undone earlier
    await untilReady(page);
    assert.deepEqual(await this.snapshot(), last, "the last state, after all was redone");
    await this.pressAll("Undo");
  }

  async act() {
    const acts = [this.type, this.type, this.type, this.refuse, this.choose, this.undo, this.redo, this.look];
    await this.oneOf(acts).call(this);
    if (this.random() < 0.6) await this.page.waitForTimeout(this.between(0, 700));
  }

  valueFor(name) {
    const number = ([low, high]) => Number(this.between(low, high).toFixed(2));
    if (name === "plate") return `${number([40, 90])}x${number([40, 90])}`;
    if (name === "shift") return `${number([-2, 2])},${number([-2, 2])}`;
    return String(number(RANGES[name]));
  }

  // Types into a field if it is shown, and usually confirms the entry.
  async type() {
    const name = this.oneOf(NUMBERS), text = this.valueFor(name);
    if (!(await this.enter(name, text))) return;
    for (const other of BESIDES[name] ?? []) delete this.typed[other];
    const isMeant = name !== "shift" || this.typed.plate || this.typed.diameter; // a shift needs a plate with a size
    if (isMeant) this.typed[name] = text;
  }

  async refuse() {
    const name = this.oneOf(Object.keys(REFUSED));
    await this.enter(name, REFUSED[name]);
  }

  async enter(name, text) {
    const field = option(name, this.page), {keyboard} = this.page;
    if (!(await field.isVisible()) || !(await field.isEnabled())) return false;
    const isConfirmed = this.random() < 0.7;
    this.done.push(`${name} ${text}${isConfirmed ? " Enter" : ""}`);
    // An entry that was not confirmed is lost if another one is typed over it.
    if (this.unconfirmed?.name === name) this.typed = this.unconfirmed.before;
    this.unconfirmed = isConfirmed ? null : {name, before: {...this.typed}};
    await field.focus();
    await keyboard.press("Control+a");
    await keyboard.type(text, {delay: this.oneOf([0, 0, 30])});
    if (isConfirmed) await keyboard.press("Enter");
    return true;
  }

  async choose() {
    this.unconfirmed = null;
    const name = this.oneOf(KINDS);
    this.done.push(name);
    await radio(name, this.page).click();
    this.typed = {};
  }

  async undo() {
    await this.press("Undo");
  }

  async redo() {
    await this.press("Redo");
  }

  // Presses a button. First leaves the field, so that the page takes the text; this may enable or disable the button.
  async press(name) {
    const pressed = button(name, this.page);
    this.done.push(name);
    this.unconfirmed = null;
    await this.page.evaluate(() => document.activeElement.blur());
    if (await pressed.isDisabled()) return;
    await pressed.click({timeout: 1000}).catch(() => {}); // the button may be disabled by then
    this.typed = {};
  }

  // Presses a button until it is disabled, at most `most` times. Returns the number of presses.
  async pressAll(name, most = Infinity) {
    const pressed = button(name, this.page);
    let steps = 0;
    for (; steps < most && (await pressed.isEnabled()); ++steps) await pressed.click();
    return steps;
  }

  async open() {
    this.unconfirmed = null; // leaving the field confirms the entry
    const isByKey = this.random() < 0.5;
    this.done.push(isByKey ? "Ctrl E" : "Export");
    await (isByKey ? this.page.keyboard.press("Control+e") : this.page.locator("#export").click());
    await this.page.locator("#export-size").getByText(/triangles$/).waitFor();
  }

  // Opens the export dialog, compares its numbers with the page, and cancels the dialog.
  async look() {
    await this.open();
    await this.compare();
    await this.page.locator("#export-cancel").click();
  }

  async exported() {
    await this.open();
    const told = await this.compare(), [{bytes}] = await exportFiles(1, this.page), {size, isClosed} = readStl(bytes);
    assert.ok(isClosed);
    this.near(size, told.size, "the file and the dialog");
  }

  near(found, wanted, text) {
    assert.ok(found.every((x, i) => Math.abs(x - wanted[i]) < 0.0051), `${text}: ${found} is not ${wanted}`);
  }

  numbers(text) {
    const size = text.match(/([\d.]+) × ([\d.]+) × ([\d.]+) mm/).slice(1).map(Number);
    return {size, height: Number(text.match(/(?:height|relief) ([\d.]+)/)[1])};
  }

  // Compares the numbers in the dialog, the status line and the fields. Returns those in the dialog.
  async compare() {
    const dialog = this.numbers(await this.page.locator("#export-size").innerText());
    const status = this.numbers(await this.page.locator("#numbers").innerText());
    assert.deepEqual(status, dialog, "the status line and the dialog");
    const fields = await this.snapshot();
    for (const [name, text] of Object.entries(this.typed).filter(([name]) => fields[name] !== undefined))
      this.sameText(fields[name], text, name);
    const isReached = (await option("height", this.page).getAttribute("aria-invalid")) !== "true";
    if (isReached) this.near([dialog.height], [Number(fields.height)], "height and its field");
    if (["Seal", "Bent"].includes(fields.kind)) return dialog;
    const [x, y, z] = dialog.size, plate = fields.plate?.split("x").map(Number);
    if (fields.diameter) this.near([x, y], [fields.diameter, fields.diameter].map(Number), "diameter and its field");
    if (plate?.length === 2) this.near([x, y], plate, "plate and its field");
    if (!fields.rim) this.near([z], [Number(fields.thickness) + dialog.height], "thickness and its field");
    return dialog;
  }

  sameText(found, wanted, name) {
    const numbers = (text) => text.split(/[x,]/).map(Number);
    this.near(numbers(found), numbers(wanted), `what was typed as ${name}`);
  }

  // Returns the kind of work, and the texts of those fields of NUMBERS that are shown.
  snapshot() {
    return this.page.evaluate((names) => {
      const seen = {kind: document.querySelector('#kinds [aria-checked="true"]').textContent};
      for (const name of names) {
        const input = document.querySelector(`[data-option="${name}"]`), isThere = input.checkVisibility();
        if (isThere && !input.disabled) seen[name] = input.value;
      }
      return seen;
    }, NUMBERS);
  }
}

// Shows a small scan, of which pieces are made quickly. Returns {page, close}.
export async function showSmallScan() {
  const folder = temporaryFolder(), scan = path.join(folder, "scan.ply"), state = path.join(folder, "state");
  writeSample("green_man", 2000, scan);
  const browser = await found.launch(), screen = {width: 900, height: 600}; // small pictures are drawn quickly
  const {engine, page} = await showScan(browser, {state, scan, screen});
  await openPanels(page);
  await page.waitForFunction(areKindsDrawn);
  await enter(page.locator("#resolution"), "1");
  for (const [name, text] of [["height", "1.5"], ["width", "30"]]) await enter(page.locator(`[data-option="${name}"]`), text);
  await untilReady(page);
  // The steps so far do not belong to a sequence, so a single step replaces them. The page shows it after it is
  // reloaded.
  const begun = await eventually(async () => {
    const step = await engine.newestStep(scan);
    assert.equal(step.options.width, 30);
    return step;
  });
  engine.document = new URL(page.url()).hash.slice(1);
  await engine.post("state", {state: {version: 1, changed: Date.now() + 1, at: 0, steps: [begun]}, tab: "test"});
  await page.getByRole("button", {name: "Undo"}).and(page.locator(":disabled")).waitFor();
  await untilReady(page);
  const close = async () => {
    await browser.close();
    await engine.stop();
  };
  return {page, close};
}

export async function runSequence({page}, seed) {
  const entries = new RandomEntries({page, random: randomNumbers(seed)});
  try {
    await entries.run();
  } catch (error) {
    error.message = `seed ${seed}: ${entries.done.join("; ")}\n${error.message}`;
    throw error;
  }
}

async function main(sequences, seed) {
  if (found.skip) return;
  let failed = 0, shown = await showSmallScan();
  for (let i = 0; i < sequences; ++i) {
    try {
      await runSequence(shown, seed + i);
    } catch (error) {
      ++failed;
      console.log(`FAILED ${error.message}`);
      await shown.close();
      shown = await showSmallScan();
    }
    if ((i + 1) % 25 === 0) console.log(`${i + 1} sequences, ${failed} failed`);
  }
  await shown.close();
  console.log(`${sequences} sequences from seed ${seed}: ${failed} failed`);
  process.exitCode = failed > 0 ? 1 : 0;
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [sequences = 500, seed = 1] = process.argv.slice(2).map(Number);
  await main(sequences, seed);
}
