// Tests the panel of light and colour: the light for which a relief is made, and the dark lines of coloured scans.
import assert from "node:assert/strict";
import path from "node:path";
import {button, drag, engine, field, folder, labelled, middleOf, openFile, option, page, scan, slider, soon, takeBack,
  test, undo, untilTaken, withPage} from "./page_suite.mjs";
import {enter, untilReady, writeColouredBall} from "./support.mjs";

const coloured = path.join(folder, "coloured.ply");

withPage("still_life", 8000, () => {
  writeColouredBall(coloured);
});

const made = () => labelled("Made for one light");
const dial = () => slider("Direction of the light");
const newest = async (file = scan) => (await engine.newestStep(file)).options.light;
// Returns the direction of the lamp as azimuth and elevation in degrees.
const lamp = async () => {
  const {light: [x, y, z]} = await engine.newestStep(scan), degrees = (angle) => Math.round(angle * 180 / Math.PI);
  return `${(degrees(Math.atan2(y, x)) + 360) % 360},${degrees(Math.atan2(z, Math.hypot(x, y)))}`;
};

test("makes the relief for the light of the picture, and shows it under another light then", async () => {
  await soon.ok(() => dial().isHidden());
  await made().check();
  await soon.equal(() => newest(), "135,35");
  const stage = await middleOf(page.locator("#stage"));
  await drag(stage, [stage[0] + 150, stage[1]]);
  await soon.notEqual(lamp, "135,35");
  await soon.equal(() => newest(), "135,35");
  await button("As on the picture").click();
  await soon.equal(async () => (await newest()) === (await lamp()), true);
  await undo(3);
  await soon.equal(() => made().isChecked(), false);
});

test("sets the direction on the dial by the pointer, as one step of undo, and lights the picture so", async () => {
  await made().check();
  const {x, y, width} = await dial().boundingBox(), middle = [x + width / 2, y + width / 2];
  await drag(middle, [middle[0] + width / 4, middle[1]], [middle[0], middle[1] + 0.23 * width]);
  // A quarter of the dial's width is half of its radius. Firefox rounds places of the pointer to pixels, that is to 1
  // degree here.
  await soon.match(() => newest(), /^(269|270|271),4[456]$/);
  const [azimuth, elevation] = (await newest()).split(",");
  await soon.equal(lamp, `${azimuth},${elevation}`);
  await soon.equal(() => dial().getAttribute("aria-valuetext"), `from ${azimuth} degrees, ${elevation} degrees high`);
  await undo();
  await soon.equal(() => newest(), "135,35");
  await undo();
});

test("sets the direction by keys and by numbers", async () => {
  await made().check();
  await dial().focus();
  for (const key of ["ArrowLeft", "ArrowUp", "Shift+ArrowLeft"]) await page.keyboard.press(key);
  await soon.equal(() => newest(), "141,40");
  await enter(labelled("From (°) of the light"), "-90");
  await soon.equal(() => newest(), "270,40");
  await enter(labelled("Elevation (°) of the light"), "5");
  await soon.equal(() => newest(), "270,5");
  await enter(labelled("Elevation (°) of the light"), "90");
  await page.getByText(/^Elevation \(°\): expected a number from 5/).waitFor();
  await soon.equal(() => labelled("Elevation (°) of the light").inputValue(), "5");
  await undo(4);
  await soon.equal(() => made().isChecked(), false);
});

// Returns heights across the middle of the relief of a step with other options.
const heightsOf = async (step, options) => page.evaluate(async ([step, options]) => {
  const [{engineOptions}, {engine}] = await Promise.all(["document.js", "about.js"].map((name) =>
    import(new URL(name, location))));
  const all = engineOptions({...step, options: {...step.options, ...options}});
  return engine.profile({options: all, from: [-30, 0], to: [30, 0]});
}, [step, options]);
const mostChange = (a, b) => Math.max(...a.map((z, i) => Math.abs(z - b[i])));

test("changes the relief by the contrast", async () => {
  await made().check();
  await untilTaken();
  await enter(field("Contrast value"), "0.2");
  await soon.equal(async () => (await engine.newestStep(scan)).options["light-contrast"], 0.2);
  const step = await engine.newestStep(scan), [none, little, much] = [await heightsOf(step, {light: ""}),
    await heightsOf(step, {}), await heightsOf(step, {"light-contrast": 1})];
  for (const [a, b] of [[none, little], [little, much]])
    assert.ok(mostChange(a, b) > 0.01, `only ${mostChange(a, b)} mm differ`);
  await option("method").selectOption("paper");
  await untilReady(page);
  await soon.ok(() => made().isDisabled());
  await soon.ok(() => dial().isHidden());
  await takeBack(3);
  await soon.ok(() => made().isEnabled());
});

test("offers the depth of dark lines for scans with colours alone, and sinks them", async () => {
  await soon.ok(() => field("Dark lines in mm").isHidden());
  await openFile(coloured);
  await page.getByText("coloured.ply", {exact: true}).waitFor();
  await untilReady(page);
  await enter(field("Dark lines in mm"), "0.5");
  await untilReady(page);
  const newest = async () => {
    const {recent: [{input}]} = await engine.json("recent", {}), {steps, at} = await engine.kept(input);
    return steps[at];
  };
  await soon.equal(async () => (await newest()).options.colour, 0.5);
  const step = await newest();
  const [flat, sunk] = [await heightsOf(step, {colour: 0}), await heightsOf(step, {colour: 0.5})];
  const most = Math.min(...sunk.map((z, i) => z - flat[i]));
  assert.ok(most < -0.3, `only ${-most} mm at the lines`);
  await undo();
});

test("shows the attention on the model, beside the relief", async () => {
  const shown = labelled("Show it on the model"), isComparing = (is) =>
    page.getByRole("button", {name: "Compare", pressed: is}).waitFor();
  await shown.check();
  await isComparing(true);
  await untilReady(page);
  const colours = await page.locator("#before").evaluate((canvas) => { // returns the strongest blue and strongest red
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let [blue, red] = [0, 0];
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] < 255) continue;
      blue = Math.max(blue, data[i + 2] - data[i]);
      red = Math.max(red, data[i] - data[i + 2]);
    }
    return [blue, red];
  });
  assert.ok(colours.every((difference) => difference > 40), `${colours}`);
  await page.locator("#stage").press("Escape");
  await isComparing(false);
  await soon.equal(() => shown.isChecked(), false);
});
