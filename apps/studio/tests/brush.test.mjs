// Tests the brush of the studio's page: strokes are painted onto the relief, listed, undone, kept and exported.
import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
import path from "node:path";
import {DESK, PHONE, button, choose, engine, exported, folder, found, labelled, page, press, radio, scan, soon,
  takeBack, test, toast, touchScreen, undo, undoAll, untilTaken, withPage} from "./page_suite.mjs";
import {enter, run, untilReady} from "./support.mjs";

let sent; // the newest request for a picture

withPage("shell", 12000, async () => {
  await button("Dismiss").click(); // dismisses the offer of the tour
  await page.setViewportSize(DESK);
  await listen(page);
  await choose("Brush");
});

// Stores each request for a picture in `sent`. The page reports them, since Firefox's driver does not report bodies.
async function listen(of) {
  await of.exposeFunction("tellRequest", (body) => (sent = JSON.parse(body)));
  const tell = () => {
    const {fetch} = window;
    window.fetch = (url, options) => {
      if (url === "api/picture") window.tellRequest(options.body);
      return fetch(url, options);
    };
  };
  await of.addInitScript(tell);
  await of.evaluate(tell);
}

const kind = (of = page) => of.getByRole("combobox", {name: "Brush", exact: true});
const strokes = () => JSON.parse(sent.options.strokes ?? "[]");
const untilStrokes = (count) => soon.equal(() => strokes().length, count);
const names = (of = page) => of.locator("#stroke-list input[maxlength]").evaluateAll((all) =>
  all.map(({value}) => value));
const steps = async () => (await engine.kept({path: scan})).at;

async function pixel(u, v, of = page) {
  const {x, y, width, height} = await of.locator("#stage").boundingBox();
  return [x + u * width, y + v * height];
}

async function draw(brush, ...places) {
  await kind().selectOption(brush);
  const [from, ...through] = await Promise.all(places.map((place) => pixel(...place)));
  await page.mouse.move(...from);
  await page.mouse.down();
  for (const place of through) await page.mouse.move(...place, {steps: 8});
  await page.mouse.up();
}

async function drawUntil(count, ...drawing) {
  await draw(...drawing);
  await untilStrokes(count);
}

// Returns the heights of the relief along a line in mm, with the options of the newest picture or with others.
const profile = async (from, to, options = sent.options) =>
  (await engine.json("profile", {...sent, options, from, to})).heights_mm;

// Returns pairs of heights in mm along a line: without and with the strokes.
async function both(from, to) {
  const {strokes, ...plain} = sent.options;
  assert.ok(strokes);
  const [before, after] = [await profile(from, to, plain), await profile(from, to)];
  return before.map((height, i) => [height, after[i]]);
}

test("changes the relief where the mouse goes, and nowhere else", async () => {
  await labelled("Brush size").fill("10");
  for (const [brush, sign] of [["soften", 0], ["sharpen", 0], ["strengthen", 0], ["level", 0], ["sink", -1]]) {
    await draw(brush, [0.45, 0.5], [0.55, 0.5]);
    await untilStrokes(1);
    await untilReady(page);
    const [{points, radius, brush: told}] = strokes(), {options: {height}} = sent;
    assert.equal(told, brush);
    assert.ok(points.length > 1 && radius > 0);
    // The whole relief keeps its height. So a stroke that moves the highest point scales the rest of the relief.
    const far = await both([-40, 12], [40, 12]), sum = (part) => far.reduce((sum, pair) => sum + pair[part], 0);
    const scale = sum(1) / sum(0), changes = (pairs) => pairs.map(([before, after]) => after - scale * before);
    assert.ok(Math.abs(scale - 1) < 0.01, `${brush}: ${scale}`);
    for (const change of changes(far)) assert.ok(Math.abs(change) < 1e-3 * height, `${brush}: ${change}`);
    const across = changes(await both([-40, 0], [40, 0])), mm = (i) => -40 + 80 * i / (across.length - 1);
    const most = Math.max(...across.map(Math.abs)), middle = across[Math.round((across.length - 1) / 2)];
    assert.ok(most > 0.002 * height, `${brush}: ${most}`);
    assert.ok(sign === 0 || Math.sign(middle) === sign, `${brush}: ${middle}`);
    // The drag was a tenth of the picture's width, and the brush reaches 5 mm beyond. The points of this scan are 1 mm
    // apart.
    const {width} = await page.locator("#stage").boundingBox(), half = 0.05 * width / (await pixelsPerMm()) + 5;
    for (const [i, change] of across.entries())
      assert.ok(Math.abs(mm(i)) <= half + 1 || Math.abs(change) < 1e-3 * height, `${brush}: ${change} at ${mm(i)}`);
    await undoAll();
  }
});

// Returns the scale of the picture in pixels per mm. On this relief the radius of the brush is 5 mm.
const pixelsPerMm = async () => Number(await page.locator("#overlay .brush").first().getAttribute("r")) / 5;

test("shows the stroke while it is drawn, in one step of undo", async () => {
  const before = await steps(), [from, to] = [await pixel(0.42, 0.45), await pixel(0.58, 0.45)];
  await kind().selectOption("raise");
  await press(from);
  await untilStrokes(1);
  await page.mouse.move(...to, {steps: 8});
  await soon.ok(() => strokes()[0].points.length > 1, "the picture shows the stroke so far");
  await page.mouse.up();
  await soon.ok(() => strokes()[0].points.length > 1);
  await soon.equal(steps, before + 1);
  await untilReady(page);
  const [drawn] = strokes();
  await undo();
  await untilStrokes(0);
  await soon.ok(async () => !await page.locator("#strokes").isVisible());
  await button("Redo").click();
  await untilStrokes(1);
  assert.deepEqual(strokes()[0], drawn);
  await press(from, to);
  await untilStrokes(2);
  await page.keyboard.press("Escape");
  await untilStrokes(1);
  await page.mouse.move(...from, {steps: 4});
  await page.mouse.up();
  await untilReady(page);
  assert.deepEqual(strokes(), [drawn], "Escape takes back the drag, and its rest paints nothing");
  await undoAll();
});

test("lists strokes, which can be named, muted and removed by keys", async () => {
  await drawUntil(1, "soften", [0.45, 0.4], [0.5, 0.4]);
  await drawUntil(2, "soften", [0.45, 0.6], [0.5, 0.6]);
  await drawUntil(3, "raise", [0.55, 0.5]);
  await soon.deepEqual(names, ["Soften 1", "Soften 2", "Raise 1"]);
  await enter(labelled("Name of Soften 2"), "cheek");
  await soon.deepEqual(names, ["Soften 1", "cheek", "Raise 1"]);
  const line = page.locator("#overlay path.stroke");
  await labelled("Name of cheek").hover();
  const [[from, middle], [to]] = [await pixel(0.45, 0.6), await pixel(0.5, 0.6)];
  await soon.ok(async () => { // repeated, since each picture replaces the marks, and a replaced mark has no position
    const off = await line.evaluate((path, [from, to, middle]) => { // Firefox's rectangle includes the line's width
      const {x, y, width, height} = path.getBBox(), stage = document.querySelector("#stage").getBoundingClientRect();
      return [stage.x + x - from, stage.x + x + width - to, stage.y + y + height / 2 - middle];
    }, [from, to, middle]);
    return off.every((x) => Math.abs(x) < 4);
  }, "the line is marked where it was drawn");
  await page.mouse.move(0, 0);
  await soon.equal(() => line.count(), 0);
  await labelled("Use cheek").focus();
  await soon.equal(() => line.count(), 1);
  await page.keyboard.press("Space");
  await soon.deepEqual(() => strokes().map(({muted}) => muted), [undefined, true, undefined]);
  await untilReady(page);
  await soon.equal(() => page.evaluate(() => document.activeElement.ariaLabel), "Use cheek");
  await page.reload();
  await untilReady(page);
  await soon.deepEqual(names, ["Soften 1", "cheek", "Raise 1"]);
  await soon.equal(() => labelled("Use cheek").isChecked(), false);
  await button("Remove Soften 1").focus();
  await page.keyboard.press("Enter");
  await soon.deepEqual(names, ["cheek", "Raise 1"]);
  await page.keyboard.press("Control+z");
  await soon.deepEqual(names, ["Soften 1", "cheek", "Raise 1"]);
  await choose("Brush");
  await undoAll();
});

test("exports the very bytes that make writes from the saved project", async () => {
  await drawUntil(1, "raise", [0.45, 0.4], [0.52, 0.45]);
  await drawUntil(2, "sharpen", [0.5, 0.6]);
  await untilTaken();
  const project = path.join(folder, "painted.relievo"), made = path.join(folder, "made.stl");
  const saved = await page.evaluate(async (path) => { // returns the project that "Settings alone" saves
    const {Document, projectOf} = await import(new URL("document.js", location)), doc = new Document(() => {});
    const {engine} = await import(new URL("about.js", location));
    doc.restore((await engine.find({path})).kept);
    return projectOf(doc.now);
  }, scan);
  writeFileSync(project, JSON.stringify(saved));
  run("make", project, "-o", made);
  const {bytes, isClosed} = await exported();
  assert.ok(isClosed && bytes.equals(readFileSync(made)));
  await undoAll();
});

test("paints on both sides of the figure's middle", async () => {
  await labelled("Mirror").check();
  await drawUntil(2, "soften", [0.44, 0.45], [0.46, 0.5]);
  await untilReady(page);
  const [[first], [other]] = strokes().map(({points}) => points), {size, rotation} = await engine.json("facts");
  const inView = (point) => [0, 1].map((row) => point.reduce((sum, x, i) => sum + rotation[3 * row + i] * x, 0));
  const [[x, y], [otherX, otherY]] = [first, other].map(inView);
  await labelled("Mirror").uncheck();
  await drawUntil(3, "soften", [0.5, 0.5]); // the figure is in the middle of the picture
  const [middle] = inView(strokes()[2].points[0]), near = 0.01 * Math.max(...size);
  assert.ok(Math.abs(y - otherY) < near && Math.abs(x + otherX - 2 * middle) < near, `${x} ${otherX} about ${middle}`);
  await soon.deepEqual(names, ["Soften 1", "Soften 1, mirrored", "Soften 2"]);
  await undoAll();
});

const shape = () => labelled("Shape of the stroke");

test("changes what a lasso encloses, and the region around a click", async () => {
  await shape().selectOption("lasso");
  await drawUntil(1, "sink", [0.45, 0.45], [0.55, 0.45], [0.55, 0.55], [0.45, 0.55]);
  await untilReady(page);
  const [{area, direction, points}] = strokes(), {rotation} = await engine.json("facts"), {options: {height}} = sent;
  assert.equal(area, "lasso");
  assert.ok(points.length >= 4 && direction.every((x, i) => Math.abs(x - rotation[6 + i]) < 1e-5), `${direction}`);
  const across = await both([-40, 0], [40, 0]), changes = across.map(([before, after]) => after - before);
  assert.ok(changes[Math.round(changes.length / 2)] < -0.05 * height, `${changes}`);
  assert.ok(Math.abs(changes[2]) < 1e-3 * height && Math.abs(changes.at(-3)) < 1e-3 * height);
  await soon.ok(() => labelled("Tolerance of the region").isHidden());
  await shape().selectOption("region");
  await labelled("Tolerance of the region").fill("12");
  await drawUntil(2, "soften", [0.5, 0.5], [0.55, 0.5]);
  const {area: other, tolerance, points: seed} = strokes()[1];
  assert.deepEqual([other, tolerance, seed.length], ["region", 12, 1]);
  await soon.deepEqual(names, ["Sink 1", "Soften 1"]);
  await shape().selectOption("line");
  await undoAll();
});

test("draws lassos and regions by keys", async () => {
  await kind().selectOption("protect");
  await shape().selectOption("lasso");
  const stage = page.locator("#stage"), side = (key) => Array(6).fill(key);
  await page.mouse.move(0, 0);
  await stage.focus();
  for (const key of [" ", ...side("ArrowRight"), ...side("ArrowUp"), ...side("ArrowLeft"), " "]) await page.keyboard.press(key);
  await untilStrokes(1);
  assert.deepEqual([strokes()[0].area, strokes()[0].brush], ["lasso", "protect"]);
  await shape().selectOption("region");
  await stage.focus();
  await page.keyboard.press("Space");
  await untilStrokes(2);
  await page.keyboard.press("ArrowUp"); // changes nothing, as the region is finished already
  await untilReady(page);
  assert.deepEqual(strokes().map(({points, area}) => area === "region" ? points.length : area), ["lasso", 1]);
  await shape().selectOption("line");
  await undoAll();
});

test("erases what the brush crosses", async () => {
  await drawUntil(1, "raise", [0.44, 0.5], [0.56, 0.5]);
  await drawUntil(2, "erase", [0.5, 0.47], [0.5, 0.53]);
  await soon.deepEqual(names, ["Raise 1", "Raise 1, part 2"]);
  await drawUntil(0, "erase", [0.43, 0.5], [0.57, 0.5]);
  await undo(2);
  await untilStrokes(1);
  await undoAll();
});

test("paints less strongly where a pen presses less", async (context) => {
  if (found.name !== "chromium") return context.skip("only Chromium takes made-up pens");
  const cdp = await page.context().newCDPSession(page), [x, y] = await pixel(0.5, 0.5);
  await kind().selectOption("soften");
  for (const [pressure, count] of [[0.25, 1], [0.75, 2]]) {
    const pen = (type, buttons) => cdp.send("Input.dispatchMouseEvent",
      {type, x, y, pointerType: "pen", button: "left", buttons, force: pressure, clickCount: 1});
    await pen("mousePressed", 1);
    await pen("mouseReleased", 0);
    await untilStrokes(count);
  }
  const [light, firm] = strokes().map(({amount}) => amount);
  assert.ok(Math.abs(firm / light - 3) < 0.02, `${light} ${firm}`);
  await undoAll();
});

test("paints by keys", async () => {
  await kind().selectOption("soften");
  const stage = page.locator("#stage");
  await page.mouse.move(0, 0);
  await stage.focus();
  for (const key of ["ArrowLeft", "ArrowUp", " ", "ArrowRight", "ArrowRight", "ArrowRight", " ", "ArrowRight"])
    await page.keyboard.press(key);
  await untilStrokes(1);
  await untilReady(page);
  const line = strokes()[0].points.map(([x]) => x);
  assert.ok(line.length > 1 && line.every((x, i) => i === 0 || x > line[i - 1]), `${line}`);
  const {size} = JSON.parse(await page.evaluate(() => localStorage.getItem("brush")));
  await page.keyboard.press("]");
  await soon.ok(async () => JSON.parse(await page.evaluate(() => localStorage.getItem("brush"))).size > size);
  await page.keyboard.press("[");
  await undoAll();
});

test("paints on a phone with one finger, and moves the picture with two", async (context) => {
  if (found.name !== "chromium") return context.skip("only Chromium takes made-up touches");
  const {touched: phone, send, fingers, close} = await touchScreen(PHONE, true);
  await listen(phone);
  await radio("Brush", phone).click();
  await untilReady(phone);
  await send("touchStart", fingers(60));
  await send("touchMove", fingers(90));
  await send("touchEnd", []);
  await untilReady(phone);
  await untilStrokes(0);
  await button("Fit", phone).click();
  const [x, y] = await pixel(0.5, 0.5, phone), at = (dx) => [{x: x + dx, y, id: 0}];
  await send("touchStart", at(0));
  for (const dx of [8, 16, 24]) await send("touchMove", at(dx));
  await send("touchEnd", []);
  await untilStrokes(1);
  await soon.equal(async () => (await names(phone)).length, 1);
  await takeBack(1, phone);
  await close();
});

test("says why a piece cannot be painted", async () => {
  await choose("Bent");
  await draw("raise", [0.5, 0.5]);
  await toast().getByText(/bent cannot be painted/).waitFor();
  await takeBack();
  await choose("Lithophane");
  await draw("raise", [0.5, 0.5]);
  await toast().getByText(/lithophane is made from light and colours/).waitFor();
  await takeBack();
});
