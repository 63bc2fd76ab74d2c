// Uses the studio as its users do, in Chromium or Firefox. Finds most elements by role and label.
import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
import path from "node:path";
import {DESK, PHONE, TABLET, browser, button, chooseView, drag, engine, exportDialog, exported, exportFiles, field,
  folder, found, middleOf, numbers, openExport, openFile, page, plateLength, preset, press, radio, savedProject, scan,
  set, slider, soon, startEngine, takeBack, test, text, toast, touchScreen, undo, withBrowser} from "./page_suite.mjs";
import {doubleClick, enter, eventually, openPanels, run, type, untilListening, untilReady, writeSample} from
  "./support.mjs";

const complaints = [];

withBrowser(async (isAnew) => {
  writeSample("still_life", 30000, scan);
  const first = await (await browser.newContext({viewport: DESK, acceptDownloads: true})).newPage();
  first.on("pageerror", (error) => complaints.push(error.message));
  first.on("console", (message) => message.type() === "error" &&
    complaints.push(`${message.text()} ${message.location().url}`));
  await first.goto((await startEngine()).address);
  await untilListening(first); // from then on the page remembers open panels
  await openPanels(first);
  if (isAnew) await showFile(scan, first);
  return first;
});

const kind = radio, stage = () => page.getByRole("application", {name: /^Relief/});
const value = async (name) => Number(await text(name));

async function pressKey(locator, key, times) {
  for (let i = 0; i < times; ++i) await locator.press(key);
}

// Returns the bytes of the relief's picture once it no longer changes.
async function picture() {
  const read = () => stage().locator("canvas").first().evaluate((canvas) => {
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let text = "";
    for (let i = 0; i < data.length; i += 4) text += String.fromCharCode(data[i]);
    return btoa(text);
  });
  await untilReady(page);
  return Buffer.from(await read(), "base64");
}

// Returns the mean difference between the red values of two pictures, from 0 to 255. Pictures of a locked height may
// differ a little, since the height of pictures is exact only to a thousandth.
function difference(a, b) {
  if (a.length !== b.length) return 255;
  let sum = 0;
  for (let i = 0; i < a.length; ++i) sum += Math.abs(a[i] - b[i]);
  return sum / a.length;
}

// Waits until the picture equals `other` or, if `isSame` is false, differs from it.
const becomes = (other, isSame) => eventually(async () => {
  const found = difference(await picture(), other);
  assert.ok(isSame ? found < 0.05 : found > 0.2, `pictures differ by ${found}`);
});
const becomesSame = (other) => becomes(other, true), becomesOther = (other) => becomes(other, false);

// Returns the height of the newest picture, which may differ from the requested height.
async function heightShown() {
  const title = await numbers().getAttribute("title");
  return Number(title.match(/reached ([\d.]+)/)[1]);
}

const untilHeight = (wanted, tolerance) => eventually(async () => {
  const shown = await heightShown();
  assert.ok(Math.abs(shown - wanted) <= tolerance, `the height stays at ${shown} instead of ${wanted}`);
});

async function show(side) {
  await chooseView(side);
  await untilReady(page);
}

test("opens a sample and shows its progress, and a coarse relief until the exact one is there", async () => {
  const areExact = page.evaluate(() => new Promise((resolve) => {
    const seen = [], stage = document.querySelector("#stage");
    stage.addEventListener("picture", () => {
      seen.push(!document.querySelector("#export").hidden);
      if (seen.at(-1)) resolve(seen);
    });
  }));
  await page.getByRole("list", {name: "Try a sample"}).getByRole("button", {name: /green man/i}).click();
  await page.getByRole("progressbar", {name: "Preparing"}).waitFor();
  await untilReady(page);
  await soon.match(() => numbers().innerText(), /[\d,]+ of 300,000 points/);
  assert.equal((await areExact)[0], false);
});

async function showFile(file, of) {
  await openFile(file, of);
  await of.getByText(path.basename(file), {exact: true}).waitFor();
  await untilReady(of);
}

test("opens a scan of the browser", async () => {
  await openFile(scan);
  await toast().getByText(/^Your work on .* is kept/).waitFor();
  await page.getByText("of 30,000 points").waitFor();
  await untilReady(page);
});

test("drags the height: number and picture change", async () => {
  const start = await value("Height in mm"), first = await picture();
  await pressKey(slider("Height"), "ArrowRight", 10);
  await soon.ok(async () => (await value("Height in mm")) > start);
  await untilHeight(await value("Height in mm"), 0.01);
  await becomesOther(first);
});

test("moves a slider that has the focus by wheel, and any by double click", async () => {
  const height = await value("Height in mm"), panel = page.getByRole("complementary", {name: "Adjustments"});
  await slider("Height").focus();
  await slider("Steepest wall").hover();
  const scrolled = await panel.evaluate((element) => element.scrollTop);
  await page.mouse.wheel(0, -100);
  await eventually(async () => assert.ok((await panel.evaluate((element) => element.scrollTop)) < scrolled));
  await soon.equal(() => value("Steepest wall in degrees"), 76);
  await slider("Steepest wall").focus();
  await slider("Steepest wall").hover();
  await page.mouse.wheel(0, 200);
  await eventually(async () => assert.ok((await value("Steepest wall in degrees")) < 76));
  await eventually(async () => { // repeated, since a slow machine may turn a double click into two clicks
    await doubleClick(slider("Steepest wall"));
    assert.equal(await value("Steepest wall in degrees"), 76);
  });
  await set("Height in mm", "nonsense");
  await soon.equal(() => value("Height in mm"), height);
});

test("takes numbers as people type them, and refuses others in one line", async () => {
  const width = await value("Longer side in mm"), typed = [["1/8in", "3.175"], ["4in", "101.6"], ["2,5", "2.5"],
    ["3+0.5", "3.5"], ["12 mm", "12.0"], ["1cm", "10.0"]];
  for (const [entered, shown] of typed) {
    await set("Longer side in mm", entered);
    await soon.equal(() => text("Longer side in mm"), shown, entered);
  }
  for (const entered of ["4ft", "1,234", "12mmm", "0", "1e9"]) {
    await set("Longer side in mm", entered);
    await toast().getByText(`Longer side: expected a number from 0.1 to 100000 mm, such as`).waitFor();
    await soon.ok(async () => (await toast().innerText()).endsWith(`found '${entered}'.`), entered);
    await soon.equal(() => text("Longer side in mm"), "10.0");
  }
  await set("Edge emphasis value", "1mm");
  await toast().getByText("Edge emphasis: expected a number from 0 to 100, such as").waitFor();
  await field("Longer side in mm").press("ArrowUp");
  await soon.ok(async () => (await value("Longer side in mm")) > 10);
  await set("Longer side in mm", width);
  await enter(page.getByLabel("Draft angle"), "15 degrees");
  await toast().getByText("Draft angle: expected a number from 1 to 80 °").waitFor();
  await soon.equal(() => page.getByLabel("Draft angle").inputValue(), "");
});

test("keeps a locked height while saturation moves", async () => {
  await set("Height in mm", 3);
  await untilHeight(3, 0.01);
  const first = await picture();
  await soon.equal(() => button("Lock the height").getAttribute("aria-pressed"), "true");
  await pressKey(slider("Edge emphasis"), "ArrowRight", 30);
  await soon.ok(async () => (await value("Edge emphasis value")) > 0.1);
  await becomesOther(first);
  await untilHeight(3, 0.01);
});

test("lets the height follow when it is not locked", async () => {
  await button("Lock the height").click();
  await set("Fine detail value", 0.3);
  await picture();
  await soon.ok(async () => Math.abs((await heightShown()) - 3) > 0.05);
  await soon.ok(async () => Math.abs((await value("Height in mm")) - (await heightShown())) < 0.01);
});

test("undoes and redoes, step by step", async () => {
  const last = await picture();
  await page.keyboard.press("Escape");
  await undo(2);
  await soon.equal(() => button("Lock the height").getAttribute("aria-pressed"), "true");
  await untilHeight(3, 0.01);
  const before = await picture();
  assert.ok(difference(before, last) > 0.2);
  let steps = 0; // a slow machine presses the keys with pauses, which makes several steps
  do await undo(); while (++steps < 30 && (await value("Edge emphasis value")) > 0);
  await soon.equal(() => value("Edge emphasis value"), 0);
  while (steps-- > 0) await button("Redo").click();
  await becomesSame(before);
});

test("shapes the tone curve with presets and keys", async () => {
  const first = await picture();
  await preset().selectOption("Bold edges first");
  await becomesOther(first);
  await soon.ok(() => slider("Edge emphasis").isDisabled());
  const point = page.getByRole("slider", {name: /Curve point 2 of/});
  await pressKey(point, "ArrowUp", 5);
  await preset().waitFor();
  await soon.match(() => point.getAttribute("aria-valuetext"), /keeps 40 percent/);
  await point.press("Delete");
  await page.getByRole("slider", {name: "Curve point 3 of 3"}).waitFor();
  await untilHeight(3, 0.01);
});

test("has sliders, defaults and units of the engine's options", async () => {
  const {fields, first, options} = await page.evaluate(async () => {
    const from = (name) => import(new URL(name, location));
    const [{FIELDS}, {FIRST}, {about}] = await Promise.all([from("panels/fields.js"), from("document.js"), from("about.js")]);
    return {fields: FIELDS, first: FIRST.options, options: about.options};
  });
  const option = (name) => options.find((o) => o.name === name) ?? assert.fail(`there is no option ${name}`);
  for (const [name, {label, hand, unit, decimals}] of Object.entries(fields)) {
    const {min, max, unit: engineUnit} = option(name);
    assert.ok(min <= hand[0] && hand[0] < hand[1] && hand[1] <= max, `${name} ${hand} in ${min} to ${max}`);
    assert.equal(Boolean(unit), ["MM", "DEG", "W"].includes(engineUnit), name);
    assert.ok(first[name] >= hand[0] && first[name] <= hand[1], `${name} ${first[name]}`);
    assert.equal(first[name], Number(first[name].toFixed(decimals)), name);
    const number = page.getByRole("spinbutton", {name: new RegExp(`^${label} `), includeHidden: true});
    const range = [await number.getAttribute("aria-valuemin"), await number.getAttribute("aria-valuemax")];
    assert.deepEqual(range, [`${min}`, `${max}`], name);
  }
  const {"base-image": image, ...ofTable} = first; // an image is a file, and the table has no option for files
  assert.equal(image, "");
  for (const name of Object.keys(ofTable)) option(name);
  for (const name of Object.keys(fields)) {
    const {default: value} = option(name);
    if (name !== "height") assert.equal(first[name], value.layered ?? value, name);
  }
});

test("names what it reads and offers each outline, form and format of the engine, added ones too", async () => {
  const added = await page.context().newPage();
  await added.route("**/api/about", async (route) => {
    const response = await route.fetch(), json = await response.json();
    for (const {name, choices} of json.options) if (["outline", "form"].includes(name)) choices.push("added");
    json.formats.push({name: "added", label: "Added", use: "tests", ending: ".added", type: "model/added"});
    json.readable = "point cloud (ADDED)";
    await route.fulfill({response, json});
  });
  await added.goto(engine.address);
  await untilReady(added);
  await soon.equal(() => added.locator("#readable").textContent(), "point cloud (ADDED)");
  const {options, formats} = await engine.about();
  for (const name of ["outline", "form"]) {
    const values = await added.locator(`#${name} option`).evaluateAll((all) => all.map(({value}) => value));
    assert.deepEqual(values, [...options.find((o) => o.name === name).choices, "added"]);
  }
  const shown = await added.locator("#formats label").allInnerTexts();
  assert.equal(shown.length, formats.length + 1);
  for (const [i, {label, use}] of [...formats, {label: "Added", use: "tests"}].entries())
    assert.ok(shown[i].startsWith(label) && shown[i].includes(use), shown[i]);
  await added.close();
});

const curveShown = async (name) => (await page.locator(`#curve .${name}`).getAttribute("d")).split(/[ML]/).slice(1)
  .map((place) => 1 - Number(place.split(" ")[1]) / 150);

test("draws the curve that the engine has sampled", async () => {
  let sampled = null;
  const listen = (response) => {
    const text = response.url().endsWith("api/picture") && response.headers()["x-relievo"];
    if (text) sampled = JSON.parse(text).curve;
  };
  page.on("response", listen);
  await set("Height in mm", 3.5);
  await untilHeight(3.5, 0.01);
  await picture();
  page.off("response", listen);
  for (const [name, shares] of [["drawn", sampled.share], ["kept", sampled.kept]]) {
    const shown = await curveShown(name);
    assert.equal(shown.length, shares.length);
    shown.forEach((y, i) => assert.ok(Math.abs(y - shares[i]) < 5e-4, `${name} ${i}: ${y} for ${shares[i]}`));
  }
  await undo();
  await untilHeight(3, 0.01);
});

test("changes the method, and its own rim with it, and no other", async () => {
  const rim = page.getByRole("slider", {name: "Soft outline"});
  const method = page.getByRole("combobox", {name: "Method"});
  const first = await picture();
  await soon.equal(() => rim.getAttribute("aria-valuetext"), "0.3 points of the scan");
  await method.selectOption("All forms alike");
  await becomesOther(first);
  await untilHeight(3, 0.01);
  await soon.equal(() => rim.getAttribute("aria-valuetext"), "2.0 points of the scan");
  await rim.press("ArrowRight");
  const touched = await rim.getAttribute("aria-valuetext");
  await method.selectOption("Fine forms first");
  await soon.equal(() => rim.getAttribute("aria-valuetext"), touched);
  await undo(3);
  await becomesSame(first);
});

test("turns, lights, cuts and compares", async () => {
  const change = async (act) => {
    const before = await picture();
    await act();
    await becomesOther(before);
  };
  await change(() => pressKey(stage(), "ArrowLeft", 3));
  await change(() => radio("Struck silver").click());
  await radio("Orbit").click();
  await change(() => pressKey(stage(), "ArrowLeft", 5));
  await button("Fit").click();
  await radio("Section").click();
  await page.getByText(/Section, 110\.0 mm long, from -?[\d.]+ to [\d.]+ mm/).waitFor();
  const box = await stage().boundingBox(), middle = await middleOf(stage()), overlay = page.locator("#overlay");
  const ends = async () => overlay.locator("circle.end").evaluateAll((all) =>
    all.map((circle) => ["cx", "cy"].map((name) => Number(circle.getAttribute(name)))));
  const [[x1, y1], [x2, y2]] = await ends();
  await drag([box.x + x2, box.y + y2], middle); // moves the second end of the line, but not the first
  await eventually(async () => {
    const [[x, y], [x3]] = await ends();
    assert.ok(Math.hypot(x - x1, y - y1) < 2, `${x} ${y} for ${x1} ${y1}`); // positions are rounded to pixels
    assert.ok(Math.abs(x3 - box.width / 2) < 2, `${x3} of ${x2}`);
  });
  await page.getByText(/Section, 55\.\d mm long.* heights are drawn [\d.]+ times as large as lengths/).waitFor();
  await soon.ok(async () => (await page.locator("#section-chart text").count()) > 6);
  await page.locator("#section-chart").hover();
  await page.getByText(/^2\d\.\d+ mm along, height -?[\d.]+ mm$/).waitFor();
  await drag(middle, [box.x + box.width - 4, middle[1]]); // ends outside the plate, where there are no heights
  await page.getByText(/Section, 110\.0 mm long/).waitFor();
  await radio("Measure").click();
  await overlay.getByText("110.00 mm", {exact: true}).waitFor();
  await overlay.getByText("100.00 mm", {exact: true}).waitFor();
  await page.mouse.move(...middle);
  await overlay.getByText(/^Height [\d.]+ mm$/).waitFor();
  let y = middle[1];
  await eventually(async () => { // repeated, since the picture may still be as small as beside a section
    await drag([middle[0] - 50, y += 20], [middle[0] + 50, y]);
    const told = await overlay.getByText(/^[\d.]+ mm apart, [\d.]+ mm (higher|lower)$/).textContent();
    const plate = await plateLength(); // in pixels; the plate is 110 mm long
    assert.ok(Math.abs(Number(told.match(/^[\d.]+/)[0]) - 110 * 100 / plate) < 0.6, told);
    const line = await overlay.locator("line.cut").boundingBox();
    const label = await overlay.getByText(told, {exact: true}).boundingBox();
    assert.ok(label.y + label.height < line.y, JSON.stringify([label, line]));
  });
  await radio("Light").click();
  await button("Compare").click();
  await slider("Divider between model and relief").press("ArrowRight");
  await button("Compare").click();
  await button("Light table").click();
  await change(() => button("Light from: Raking, above").click());
});

test("turns the model by hand, shows its relief meanwhile, and undoes the view", async () => {
  const first = await picture();
  const viewIs = (name) => page.locator("#view-name").getByText(name, {exact: true}).waitFor();
  await radio("Turn").click();
  const middle = await middleOf(stage()), turned = [middle[0] + 80, middle[1] + 30];
  await press(middle, turned);
  await becomesOther(first);
  await viewIs("Front"); // the name does not change while the view changes
  await page.keyboard.press("Escape");
  await page.mouse.move(middle[0] + 90, middle[1], {steps: 3});
  await page.mouse.up();
  await becomesSame(first);
  await viewIs("Front");
  await press(middle, turned);
  await becomesOther(first);
  const coarse = await picture();
  await page.mouse.up();
  await viewIs("Turned by hand");
  await untilReady(page);
  await becomesOther(coarse);
  const exact = await picture();
  await undo();
  await viewIs("Front");
  await becomesSame(first);
  await button("Redo").click();
  await viewIs("Turned by hand");
  await becomesSame(exact);
  await undo();
  await viewIs("Front");
  await stage().press("ArrowRight");
  await viewIs("Turned by hand");
  await stage().press("ArrowLeft"); // the view snaps to the side from which it came
  await viewIs("Front");
  await becomesSame(first);
  await radio("Light").click();
});

test("chooses another view in the background", async () => {
  const first = await picture();
  await show("Left");
  await becomesOther(first);
  await button("Choose view").click();
  await button("Suggest a view").click();
  await page.getByText(/The \w+ suits a relief best, then the \w+/).waitFor();
  await page.getByRole("application", {name: /^Model/}).press("ArrowRight");
  await button("Use this view").click();
  await page.getByText("Turned by hand").waitFor();
  await untilReady(page);
});

test("saves a project, opens it again, and makes the same bytes of it", async () => {
  await set("Height in mm", 2.5);
  await untilHeight(2.5, 0.01);
  const shown = await picture(), file = path.join(folder, "work.relievo"), made = path.join(folder, "make.stl");
  const bytes = await savedProject(), saved = JSON.parse(bytes);
  writeFileSync(file, bytes);
  assert.equal(saved.options.height, 2.5);
  await toast().getByText("Saved: scan.relievo.").waitFor();
  await set("Height in mm", 5);
  await show("Front");
  await openFile(file);
  await page.getByText("Turned by hand").waitFor();
  await untilReady(page);
  await soon.equal(() => value("Height in mm"), 2.5);
  await untilHeight(2.5, 0.01);
  await becomesSame(shown);

  const {bytes: stl, isClosed, size, count} = await exported();
  run("make", file, "-o", made);
  assert.ok(stl.equals(readFileSync(made)));
  assert.ok(isClosed);
  assert.ok(Math.abs(size[2] - (2.5 + saved.options.thickness)) < 0.01, `${size}`);
  assert.ok(count > 10000);
});

// Asserts that a file has the size that a text such as "about 1.2 MB" states.
function hasSizeTold(told, {length}) {
  const [, word, number, unit] = told.match(/^(about|at most)? ?([\d.]+) (kB|MB)$/);
  const share = Number(number) * (unit === "MB" ? 1e6 : 1e3) / length;
  const [low, high] = {about: [0.8, 1.25], "at most": [0.95, Infinity]}[word] ?? [0.94, 1.06];
  assert.ok(share > low && share < high, `${told} for ${length} bytes`);
}

test("exports several files at once, named for their form", async () => {
  await page.locator("#form").selectOption("mirror");
  await untilReady(page);
  await openExport();
  const dialog = exportDialog();
  await dialog.getByRole("checkbox", {name: /^3MF/}).check();
  await dialog.getByRole("checkbox", {name: /^Height map/}).check();
  await type(dialog.getByLabel("Longer side of height maps, in pixels"), "300");
  const told = await Promise.all(["heightmap", "3mf", "stl"].map((name) => page.locator(`#size-${name}`).innerText()));
  const files = await exportFiles(3);
  assert.deepEqual(files.map(({name}) => name), ["scan-mirror-heights.png", "scan-mirror.3mf", "scan-mirror.stl"]);
  files.forEach(({bytes}, i) => hasSizeTold(told[i], bytes));
  const saved = /^Saved: scan-mirror.stl, .* mm, relief .* high, [\d,]+ triangles\.$/;
  await toast().getByText(saved).waitFor();
  for (const name of ["3mf", "heightmap"])
    await page.locator(`#formats [value="${name}"]`).evaluate((box) => (box.checked = false));
  await takeBack();
});

test("exports height maps of an exact pixel, inverted, of 8 bits and of the relief alone", async () => {
  await openExport();
  const dialog = exportDialog(), map = dialog.getByRole("checkbox", {name: /^Height map/});
  await map.check();
  await dialog.getByRole("checkbox", {name: /^STL/}).uncheck();
  const pixel = dialog.getByLabel("Exact size of a pixel instead");
  await type(pixel, "0.2 furlongs");
  await page.keyboard.press("Tab");
  await dialog.getByText(/^Exact size of a pixel: expected a number from 0.001 to 100 mm/).waitFor();
  await type(pixel, "0.25mm");
  await page.keyboard.press("Tab");
  await dialog.getByLabel("Grey levels of the PNG").selectOption("8");
  await dialog.getByText(/a grey level of 8 bits is 0\.\d+ mm or less/).waitFor();
  await dialog.getByLabel("Black is").selectOption("highest");
  const [{bytes: plate}] = await exportFiles();
  await openExport();
  await dialog.getByLabel("Shown in height maps").selectOption("relief");
  const [{bytes: relief}] = await exportFiles();
  const side = (bytes, at) => bytes.readUInt32BE(at), phys = plate.indexOf("pHYs") + 4;
  assert.equal(plate[24], 8);
  assert.equal(side(plate, phys), 4000);
  for (const at of [16, 20]) assert.ok(side(relief, at) > 100 && side(relief, at) < side(plate, at), `${at}`);
  await openExport();
  await type(pixel, "127 dpi");
  const [{bytes: coarse}] = await exportFiles();
  assert.equal(side(coarse, coarse.indexOf("pHYs") + 4), 5000); // pixels per metre
  await openExport();
  await map.uncheck();
  await dialog.getByRole("checkbox", {name: /^STL/}).check();
  await page.keyboard.press("Escape");
});

test("can be used by the keyboard alone", async () => {
  await page.locator("#home").focus();
  const missed = () => page.evaluate(() => [...document.querySelectorAll(
    "header button, #studio button, #studio input, #studio select, #studio summary, #stage")]
    .filter((element) => element.checkVisibility() && !element.disabled && element.tabIndex >= 0 &&
      element.dataset.reached !== "yes").map((element) => element.outerHTML.slice(0, 90)));
  const all = (await missed()).length;
  // After the last element of the page, Tab would move to the browser's own controls.
  for (let i = 0; i < all + 30 && (await missed()).length > 0; ++i) {
    await page.evaluate(() => (document.activeElement.dataset.reached = "yes"));
    if ((await missed()).length > 0) await page.keyboard.press("Tab");
  }
  await soon.deepEqual(() => missed(), [], `of ${all}`);
  const material = () => page.locator("#materials [aria-checked=true]").getAttribute("data-material");
  const before = await material();
  await page.locator("#materials [aria-checked=true]").focus(); // arrow keys choose within a group
  await page.keyboard.press("ArrowRight");
  await soon.notEqual(() => material(), before);
  await button("Undo").focus();
  await page.keyboard.press("Enter");
  await eventually(async () => assert.equal(await material(), before));
  await page.keyboard.press("?");
  await page.getByRole("dialog", {name: "Help"}).waitFor();
  await page.keyboard.press("Escape");
});

test("moves nothing by itself where motion is to be reduced", async (context) => {
  const longest = () => page.evaluate(() => Math.max(...[...document.querySelectorAll("*")].map((element) =>
    parseFloat(getComputedStyle(element).transitionDuration))));
  await soon.ok(async () => (await longest()) > 0);
  await page.emulateMedia({reducedMotion: "reduce"});
  if (!await page.evaluate(() => matchMedia("(prefers-reduced-motion: reduce)").matches))
    return context.skip("the browser's driver does not reduce motion");
  await soon.equal(() => longest(), 0);
  await page.emulateMedia({reducedMotion: "no-preference"});
});

test("says in plain words what is wrong with a file", async () => {
  const wrong = path.join(folder, "wrong.ply");
  writeFileSync(wrong, "ply\nformat ascii 1.0\nelement vertex 3\n");
  await openFile(wrong);
  await toast().getByText(/^wrong\.ply.*expected/).waitFor();
  const kept = (await engine.json("recent")).recent.map(({input}) => input.name);
  assert.ok(kept.includes("scan.ply") && !kept.includes("wrong.ply"), `${kept}`);
  const project = path.join(folder, "wrong.relievo");
  writeFileSync(project, "{}");
  await openFile(project);
  await toast().getByText(/expected a project/).waitFor();
  complaints.length = 0;
});

test("cancels", async () => {
  await button("Relievo, start page").click();
  await page.getByRole("button", {name: /still life/i}).first().click();
  await button("Cancel").click();
  await page.getByRole("progressbar", {name: "Preparing"}).waitFor({state: "hidden"});
  await page.getByText("scan.ply", {exact: true}).first().waitFor();  // the scan that was open before
  await soon.equal(() => value("Height in mm"), 2.5);
});

test("shows whole names, the top of the help and the whole first picture on a phone", async () => {
  await page.setViewportSize(PHONE);
  await untilReady(page);
  await button("Relievo, start page").click();
  // Reads all styles in one call, since the page may replace its cards between two calls.
  await eventually(async () => assert.deepEqual(await page.evaluate(() => {
    const styles = [...document.querySelectorAll("#recent span")].map((name) => getComputedStyle(name));
    return [...new Set(styles.map(({display, textOverflow}) => `${display} ${textOverflow}`))];
  }), ["block ellipsis"]));
  await button("Back to the relief").click();
  await button("Help").click();
  await soon.equal(() => page.locator("#help-dialog").evaluate((dialog) => dialog.scrollTop), 0);
  await page.keyboard.press("Escape");
  const covered = await page.locator("#progress").evaluate((box) => {
    box.hidden = false;
    box.classList.remove("alone"); // as if a relief were shown
    const stage = document.querySelector("#stage").getBoundingClientRect();
    const {top, right, bottom} = box.getBoundingClientRect();
    box.hidden = true;
    return top < stage.bottom || right > innerWidth || bottom > innerHeight;
  });
  assert.ok(!covered, "the progress covers the picture");
  await page.setViewportSize(DESK);
});

test("takes two fingers for a closer look, which move nothing else", async (context) => {
  if (found.name !== "chromium") return context.skip("only Chromium takes made-up touches");
  const {touched: tablet, send, fingers, close} = await touchScreen(TABLET), plate = () => plateLength(tablet);
  await radio("Measure", tablet).click();
  await eventually(async () => assert.ok((await plate()) > 100));
  const before = await plate(), canUndo = await button("Undo", tablet).isEnabled();
  await send("touchStart", fingers(50).slice(0, 1));
  await send("touchStart", fingers(50));
  for (let apart = 60; apart <= 100; apart += 10) await send("touchMove", fingers(apart));
  await send("touchEnd", []);
  await eventually(async () => {
    const now = await plate();
    assert.ok(Math.abs(now / before - 2) < 0.05, `${now} of ${before}`);
  });
  await soon.equal(() => button("Undo", tablet).isEnabled(), canUndo);
  await close();
});

test("complains about nothing", () => assert.deepEqual(complaints, []));
