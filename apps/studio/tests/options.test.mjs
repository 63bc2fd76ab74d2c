// Tests that every option in the engine's table has a control on the page, and that values set there reach the engine.
import assert from "node:assert/strict";
import {readFileSync, rmSync, writeFileSync} from "node:fs";
import path from "node:path";
import {DESK, browser, button, engine, folder, found, page, savedProject, scan, showFile, soon, startEngine, test, toast,
  undo, undoAll, untilText, withBrowser} from "./page_suite.mjs";
import {areKindsDrawn, enter, eventually, openPanels, run, untilReady, writeBallBeforeWall, writeColouredBall, writeSample}
  from "./support.mjs";

const depth = path.join(folder, "depth.tif"), coloured = path.join(folder, "coloured.ply");

withBrowser(async () => {
  writeSample("still_life", 5000, scan);
  writeBallBeforeWall(depth);
  writeColouredBall(coloured);
  // These tests compare requests and not pictures, so pictures have a quarter of the pixels.
  const fewer = found.name === "chromium" ? {deviceScaleFactor: 0.5} : {}; // Firefox's driver may not support this
  const first = await (await browser.newContext({viewport: DESK, ...fewer})).newPage();
  await first.addInitScript(() => { // Firefox's driver does not report the bodies of requests
    const {fetch} = window;
    window.fetch = (url, options) => {
      if (url === "api/picture") window.request = JSON.parse(options.body);
      return fetch(url, options);
    };
  });
  await startEngine(scan);
  await first.goto(engine.address);
  await untilReady(first);
  await openPanels(first);
  return first;
});

const options = JSON.parse(run("options", "--json")), shown = options.filter(({is_hidden: isHidden}) => !isHidden);

// Returns a value other than the default: another choice, or a number between the default and a limit.
const otherValue = ({choices, default: usual, min, max}) => choices ? choices.find((choice) => choice !== usual)
  : Number((0.9 * usual + 0.1 * (usual < max ? max : min)).toFixed(2));

// Options that otherValue() does not suit. `value` is a value that is not the default. If the control is shown only
// after other options are set, `first` has these options. If it is shown only for one kind of work, `kind` is its name.
const CASES = {
  width: {value: 61}, height: {value: 3.5}, saturation: {value: 0.7}, detail: {value: 0.21}, boundary: {value: 7},
  alpha: {value: 3, first: {saturation: 0.5}}, method: {value: "paper"}, planes: {value: 0.1}, draft: {value: 12},
  light: {value: "135,35"}, "light-contrast": {value: 0.5, first: {light: "135,35"}},
  colour: {value: 0.2, isColoured: true}, tone: {value: "0,0.8;0.5,0.6;1,0.45"},
  view: {value: "left"}, up: {value: "1,0,0"},
  crop: {value: "0,0,0.9,1"}, denoise: {value: "0.5"},
  points: {value: 20000},
  outline: {value: "ellipse"}, corner: {value: 9, first: {outline: "round"}}, diameter: {value: 77, kind: "coin"},
  plate: {value: "140x120"}, shift: {value: "5,-3", first: {plate: "180x160"}},
  margin: {value: 6}, thickness: {value: 4}, rim: {value: 3, kind: "coin"},
  "rim-height": {value: 1.5, kind: "coin"}, "rim-bevel": {value: 0.5, kind: "coin"},
  ornaments: {value: '{"ornaments":[{"kind":"beads"}]}'}, base: {value: "dome:height=5"},
  wrap: {value: "cylinder:turn=90", kind: "shell"}, form: {value: "mirror"}, tool: {value: "ball:3"},
  finish: {value: "reachable", first: {tool: "ball:3"}}, resolution: {value: 0.5}, tolerance: {value: 0.02},
  triangles: {value: 5000},
  "depth-values": {value: "height", isDepth: true}, background: {value: "keep", isDepth: true},
  "depth-range": {value: 0.8, isDepth: true},
  blur: {value: "drop", isDepth: true}, camera: {value: "300,300,60,45", isDepth: true},
  channel: {value: 1, isDepth: true}, "mm-per-value": {value: 0.01, isDepth: true},
  ground: {value: 3000, first: {"mm-per-value": 0.01}, isDepth: true},
};

const control = (name) => page.locator(`[data-option="${name}"]`);

// Sets a shape with the menu, and its parameters with the fields below it.
async function setShape(option, text) {
  const {name, first, values, labels} = await page.evaluate(async ([option, text]) => {
    const {FIRST_TEXTS, SHAPES, parseShape} = await import("./panels/shapes.js"), {name, values} = parseShape(option, text);
    const labels = [...SHAPES[option][name].parameters].map(([parameter, {label}]) => [parameter, label]);
    return {name, first: FIRST_TEXTS[name] ?? name, values: [...values], labels: Object.fromEntries(labels)};
  }, [option, text]);
  await control(option).selectOption(name);
  await reaches(({options}) => options[option] === first);
  const row = page.locator(".shape").filter({has: control(option)});
  for (const [parameter, value] of values) await enter(row.getByLabel(labels[parameter]), value);
}

async function set(name, value) {
  const it = control(name);
  if (["base", "wrap", "tool"].includes(name)) return setShape(name, value);
  if (name === "view") {
    await it.click();
    await page.locator(`#sides [data-side="${value}"]`).click();
    return button("Use this view").click();
  }
  if (name === "light") return it.check(); // sets the option to the light of the picture
  if (name === "ornaments") return it.click(); // adds beads
  if (["crumbs", "plane", "doubtful"].includes(name)) return it.setChecked(value === "keep");
  const kind = await it.evaluate((element) => (element.matches("select") ? "select" : element.type));
  if (kind === "select") return name === "tone" ? it.selectOption({index: 1}) : it.selectOption(value);
  await (kind === "range" ? it.fill(String(value)) : enter(it, String(value)));
}

const sent = () => page.evaluate(() => window.request);

const reaches = (check) => eventually(async () => {
  const request = await sent();
  assert.ok(check(request), JSON.stringify(request));
});

test("has a control for each option of the table", async () => {
  for (const {name} of shown) await soon.equal(() => control(name).count(), 1, `the page has no control of ${name}`);
  const beyond = await page.locator("label [data-option]").evaluateAll((all) => all.filter((input) =>
    input.getBoundingClientRect().right > input.closest("label").getBoundingClientRect().right + 0.5)
    .map((input) => input.dataset.option));
  assert.deepEqual(beyond, [], "fields stick out of their rows");
});

// Browsers differ only in how their controls are operated, so in Firefox one control of each kind is enough.
const KINDS = ["width", "alpha", "method", "tone", "view", "crop", "crumbs", "plane", "denoise", "plate", "rim"];
const cases = shown.filter(({name}) => found.name !== "firefox" || KINDS.includes(name))
  .map((option) => [option.name, CASES[option.name] ?? {value: otherValue(option)}]);

// Opens a file unless the page shows it.
async function show(file) {
  if (await page.locator("#title").textContent() !== path.basename(file)) await showFile(file);
}

for (const [name, {value, first = {}, kind, isDepth, isColoured}] of cases)
  test(`passes ${name} on to the engine`, async () => {
    await show(isDepth ? depth : isColoured ? coloured : scan);
    if (kind) await page.locator(`[data-kind="${kind}"]`).click();
    for (const [other, set_to] of Object.entries(first)) {
      await set(other, set_to);
      await reaches((request) => request.options[other] === set_to);
    }
    await soon.notEqual(async () => (await sent()).options[name], value);
    await set(name, value);
    if (name === "alpha") await reaches((request) => Math.abs(request.u / value ** -first.saturation - 1) < 1e-9);
    else if (name === "tone") await reaches((request) => /^0,[\d.]+;/.test(request.options.tone ?? ""));
    else await reaches((request) => request.options[name] === value);
    await undoAll(); // restores the defaults
  });

test("has a field for each parameter of each shape that the engine takes", async () => {
  await show(scan);
  for (const option of ["base", "wrap"]) {
    const shapes = await page.evaluate(async (option) => Object.entries((await import("./panels/shapes.js")).SHAPES[option])
      .map(([name, {parameters}]) => [name, [...parameters.keys()]]), option);
    const {choices} = options.find(({name}) => name === option);
    assert.deepEqual(shapes.map(([name]) => name).sort(), [...choices].sort());
    for (const [name, parameters] of shapes) {
      const {error} = await engine.json("check", {options: {[option]: `${name}:?`}});
      const [, expected] = error.text.match(/expected (.*) after/);
      const names = expected.replace(/=(MM|DEG)/g, "").split(", ").sort();
      assert.deepEqual(parameters.length ? parameters.sort() : ["nothing"], names, `${option} ${name}`);
    }
  }
});

test("gives any size to plates of the outlines of which the engine takes one", async () => {
  const known = await page.evaluate(async () => (await import("./panels/kinds.js")).FREE_OUTLINES), taken = [];
  for (const outline of options.find(({name}) => name === "outline").choices)
    if (!(await engine.json("check", {options: {outline, plate: "300x200"}})).error) taken.push(outline);
  assert.deepEqual([...known].sort(), taken.sort());
});

test("shows the parameters of shapes as they were typed, in the unit of the page", async () => {
  const field = (label) => page.getByRole("textbox", {name: label, exact: true});
  await control("tool").selectOption({label: "V bit"});
  await soon.equal(() => field("Tool: Angle").inputValue(), "60");
  await enter(field("Tool: Tip"), "0.5");
  await reaches(({options}) => options.tool === "v:60:0.5");
  await enter(field("Tool: Angle"), ""); // a V bit needs an angle
  await untilText(field("Tool: Angle"), "60");
  await control("tool").selectOption({label: "Ball end"});
  await enter(field("Tool: Diameter"), "1/8in");
  await reaches(({options}) => options.tool === "ball:3.175");
  await enter(field("Tool: Diameter"), "wide");
  await page.getByText(/^Diameter: expected a number from/).waitFor();
  await soon.equal(() => field("Tool: Diameter").inputValue(), "3.175");
  await control("tool").selectOption({label: "None"});
  await reaches(({options}) => !("tool" in options));
  await undo();
  await page.locator("#unit").selectOption("inch");
  await untilText(field("Tool: Diameter"), "0.125");
  await page.locator("#unit").selectOption("mm");
  await page.locator('[data-kind="shell"]').click();
  await soon.equal(() => field("Bent around: Around by").inputValue(), "180");
  await enter(field("Bent around: Diameter"), "200"); // replaces the angle
  await reaches(({options}) => options.wrap === "cylinder:diameter=200");
  await page.getByLabel("Bent around: On the inside").check();
  await reaches(({options}) => options.wrap === "cylinder:diameter=200,inside");
  await page.locator('[data-kind="relief"]').click();
  await control("base").selectOption({label: "Wave"});
  await reaches(({options}) => options.base === "wave");
  await page.locator(".shape").filter({has: control("base")}).evaluate((row) => { // sets both parameters at once
    for (const [i, value] of ["3", "40"].entries()) {
      const [, input] = [...row.querySelectorAll(".parameter")][i].children;
      input.value = value;
      input.dispatchEvent(new Event("change"));
    }
  });
  await reaches(({options}) => options.base === "wave:height=3,length=40");
  await control("base").selectOption({label: "Dome"});
  await reaches(({options}) => options.base === "dome");
  await enter(field("Base: Diameter"), "300");
  await reaches(({options}) => options.base === "dome:diameter=300");
  await enter(field("Base: Height"), "4"); // replaces the diameter
  await reaches(({options}) => options.base === "dome:height=4");
  await undoAll();
});

const makeMaps = (...files) => files.forEach((file) =>
  run("make", scan, "-o", path.join(folder, "r.stl"), "--heightmap", file, "--heightmap-size", 64));

const baseImage = () => page.locator("label, div").filter({has: control("base-image")}).last();

test("lays the relief on an image that is chosen or dropped, names it and removes it", async () => {
  const files = ["map.png", "map.tif"].map((name) => path.join(folder, name));
  makeMaps(...files);
  await soon.equal(() => control("base-image").count(), 1);
  await baseImage().locator("input").setInputFiles(files[0]);
  await reaches(({options: {base, "base-image": map}}) => base === "image" && map?.endsWith("/map.png"));
  await baseImage().getByText("map.png").waitFor();

  const bytes = [...readFileSync(files[1])];
  await baseImage().evaluate((row, bytes) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([new Uint8Array(bytes)], "map.tif"));
    row.dispatchEvent(new DragEvent("drop", {bubbles: true, cancelable: true, dataTransfer}));
  }, bytes);
  await reaches(({options}) => options["base-image"]?.endsWith("/map.tif"));
  await baseImage().getByText("map.tif").waitFor();

  await baseImage().locator("input").setInputFiles(scan); // a scan is no image, so it is refused and changes nothing
  await page.getByText("expected a picture of depths (PNG, TIFF").waitFor();
  await soon.match(async () => (await sent()).options["base-image"], /map\.tif$/);
  await baseImage().getByRole("button", {name: "Remove the base image"}).click();
  await reaches(({options}) => !("base" in options) && !("base-image" in options));
  await undo();
  await reaches(({options}) => options["base-image"]?.endsWith("/map.tif"));
  await set("base", "dome:height=5"); // a dome has no image
  await reaches(({options}) => options.base === "dome:height=5" && !("base-image" in options));
});

test("opens projects as make makes them, whose height, width or height coefficient they name or not", async () => {
  const stepsOf = (...all) => page.evaluate(async (all) => {
    const [{stepOfProject}, {engine}] = await Promise.all(["document.js", "about.js"].map((file) =>
      import(new URL(file, location))));
    const opened = (options) => engine.readProject(new File([JSON.stringify({relievo: 1, input: {sample: "still_life"},
      options})], "a.relievo"));
    return Promise.all(all.map(async (options) => stepOfProject(await opened(options))));
  }, all);
  const steps = await stepsOf({width: 60}, {method: "paper"}, {alpha: 2}, {form: "lithophane"});
  assert.deepEqual(steps.map(({options: {height, thickness, method, detail}}) => [height, thickness, method, detail]),
    [[3, 3, "layered", 0.04], [5, 3, "paper", 0.02], [5, 3, "paper", 0.02], [2.4, 0.8, "layered", 0.04]]);
  assert.deepEqual(steps.map(({isHeightLocked}) => isHeightLocked), [true, false, false, true]);
  assert.ok(Math.abs(steps[1].u / 4 ** -0.01 - 1) < 1e-12 && Math.abs(steps[2].u / 2 ** -0.01 - 1) < 1e-12);
  const [paper, plate, both] = await stepsOf({alpha: 4, saturation: 0.5}, {diameter: 40}, {diameter: 40, width: 30});
  assert.deepEqual([paper.isHeightLocked, paper.u, "alpha" in paper.options], [false, 0.5, false]);
  assert.deepEqual([plate.options.width, both.options.width], [null, 30]);
});

test("opens a project whose height is a share of the diagonal, and has that height in mm from then on", async () => {
  const file = path.join(folder, "share.relievo"), report = path.join(folder, "report.json");
  const own = {"height-of-diagonal": 0.02, mode: "subspace", "control-points": 1000};
  writeFileSync(file, JSON.stringify({relievo: 1, input: {path: scan}, options: own}));
  run("make", file, "-o", path.join(folder, "r.stl"), "--report", report);
  const {height_requested_mm: height} = JSON.parse(readFileSync(report));
  await page.locator("#file").setInputFiles(file);
  await reaches(({options}) => options["control-points"] === 1000);
  await untilReady(page);
  const inMm = page.getByRole("spinbutton", {name: /^Height/}).first();
  await soon.equal(async () => Number(await inMm.inputValue()).toFixed(1), height.toFixed(1));
  await reaches(({options}) => !("height-of-diagonal" in options)); // also in requests for the kinds' pictures
});

test("keeps tone curve and steps, which the paper's method does not have, for the other method", async () => {
  const file = path.join(folder, "tone.relievo"), tone = "0,0.2;1,0.9";
  const hasBoth = ({options}) => options.tone === tone && options.steps === 0.2;
  writeFileSync(file, JSON.stringify({relievo: 1, input: {path: scan}, options: {tone, steps: 0.2}}));
  await page.locator("#file").setInputFiles(file);
  await reaches(hasBoth);
  await set("method", "paper");
  await reaches(({options}) => options.method === "paper" && !("tone" in options) && !("steps" in options));
  await untilReady(page);
  assert.equal(await control("steps").isDisabled(), true);
  assert.equal(await page.locator("#tone-curve").isVisible(), false);
  writeFileSync(file, await savedProject());
  assert.equal(JSON.parse(readFileSync(file)).options.tone, undefined);
  await page.locator("#file").setInputFiles(file);
  await untilReady(page);
  await set("method", "layered");
  await reaches(hasBoth);
});

test("opens a project whose light is as far as numbers go", async () => {
  const file = path.join(folder, "light.relievo"), pixels = async (light) => {
    writeFileSync(file, JSON.stringify({relievo: 1, input: {path: scan}, options: {}, studio: {light}}));
    await page.locator("#file").setInputFiles(file);
    await reaches((request) => JSON.stringify(request.light) === JSON.stringify(light));
    await untilReady(page);
    return page.locator("#picture").evaluate((canvas) => canvas.toDataURL());
  };
  const [aside, middle, far] = [await pixels([1, -1, 1]), await pixels([1, 1, 1]), await pixels([1e300, 1e300, 1e300])];
  assert.equal(far, middle);
  assert.notEqual(far, aside);
  await page.locator("#stage").press("ArrowUp");
  await reaches(({light}) => Math.abs(Math.hypot(...light) - 1) < 1e-3 && light[2] > Math.sin(38 * Math.PI / 180));
  await untilReady(page);
  await soon.ok(async () => !await toast().getByText(/expected/).isVisible());
});

test("shows a relief without its base image when that is gone, says so, and takes another", async () => {
  const image = path.join(folder, "image.png");
  makeMaps(image);
  await baseImage().locator("input").setInputFiles(image);
  await reaches(({options}) => options["base-image"]?.endsWith("/image.png"));
  rmSync((await sent()).options["base-image"]);
  await page.reload();
  await page.getByText("The base image image.png is gone: the relief is shown without it.").waitFor();
  await reaches(({options}) => !("base" in options) && !("base-image" in options));
  await untilReady(page);
  await page.getByText("image.png is gone", {exact: true}).waitFor({state: "attached"});
  await page.waitForFunction(areKindsDrawn); // drawing the pictures of the kinds sends requests, too
  await baseImage().locator("input").setInputFiles(image);
  await reaches(({options}) => options.base === "image" && options["base-image"]?.endsWith("/image.png"));
});
