// Tests depth images and photos on the page: the pixels that are left out are reported and shown, and can be put back.
// Projects store how the images are read.
import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import {readFileSync, writeFileSync} from "node:fs";
import path from "node:path";
import {DESK, browser, button, exported, folder, numbers, openFile, page, savedProject, showFile, soon, startEngine,
  test, toast, undo, visiblePoints, withBrowser} from "./page_suite.mjs";
import {PROGRAM, enter, eventually, openPanels, run, untilReady, writeBallBeforeWall, writeDepths, writeSample} from
  "./support.mjs";

const depth = path.join(folder, "depth.tif"), terrain = path.join(folder, "terrain.tif");
const photo = path.join(folder, "photo.png"), scan = path.join(folder, "scan.ply");

withBrowser(async () => {
  writeBallBeforeWall(depth);
  writeDepths(terrain, 80, 60, (x, y) => 1000 + Math.round(400 * Math.sin(x / 12) * Math.cos(y / 9)));
  writeSample("still_life", 5000, scan);
  run("make", scan, "-o", path.join(folder, "r.stl"), "--preview", photo, "--preview-size", 100);
  const first = await (await browser.newContext({viewport: DESK, acceptDownloads: true})).newPage();
  await first.goto((await startEngine(depth)).address);
  await untilReady(first);
  await openPanels(first);
  return first;
});

const row = (name) => page.locator(`[data-option="${name}"]`);
const panel = () => page.locator("#depth");
const use = (name) => panel().getByRole("listitem").filter({hasText: name});

// Returns the colour of a pixel in the picture that shows the uses of pixels. x and y are fractions of its width and
// height.
const colourAt = (x, y) => page.locator("#depth-picture").evaluate((canvas, [x, y]) => {
  const {width, height} = canvas;
  return [...canvas.getContext("2d").getImageData(Math.floor(x * width), Math.floor(y * height), 1, 1).data.slice(0, 3)];
}, [x, y]);
const isGrey = ([r, g, b]) => r === g && g === b;
const colourOf = (name) => use(name).locator(".dot").evaluate((dot) =>
  getComputedStyle(dot).backgroundColor.match(/\d+/g).map(Number));

// Saves the project, and returns the path of its file.
async function projectFile() {
  const file = path.join(folder, "saved.relievo");
  writeFileSync(file, await savedProject());
  return file;
}

// Makes the relief of a project by the command line. Returns the bytes of the solid, and the printed text.
function madeOf(project) {
  const solid = path.join(folder, "made.stl");
  const {status, stderr} = spawnSync(PROGRAM, ["make", project, "-o", solid]);
  assert.equal(status, 0, String(stderr));
  return {bytes: readFileSync(solid), told: String(stderr)};
}

test("shows which pixels of a depth picture are left out, and puts them back", async () => {
  await soon.match(() => panel().innerText(), /read as depths/);
  const told = await use("Background").innerText(), [left] = told.match(/[\d,]+(?= \()/);
  const outside = 120 * 90 - Math.PI * 30 * 30; // pixels of the wall
  assert.ok(Math.abs(Number(left.replace(",", "")) / outside - 1) < 0.02, told);
  await soon.deepEqual(() => colourAt(0.02, 0.02), await colourOf("Background"));
  assert.ok(isGrey(await colourAt(0.5, 0.5)));
  const before = await visiblePoints();
  await button("Keep the background", panel()).click();
  await soon.equal(visiblePoints, 120 * 90);
  await soon.equal(() => row("background").inputValue(), "keep");
  await soon.match(() => panel().innerText(), /All pixels are used/);
  await soon.equal(() => use("Background").count(), 0);
  await soon.ok(async () => await page.locator("#depth-picture").isHidden());
  await undo();
  await soon.equal(visiblePoints, before);
  await soon.equal(() => row("background").inputValue(), "auto");
  await untilReady(page);
});

test("has a project that make reads as the page does", async () => {
  assert.match(madeOf(await projectFile()).told, /points of background taken out/);
  await row("background").selectOption("keep");
  await row("depth-values").selectOption("height");
  await soon.match(() => panel().innerText(), /read as heights/);
  await untilReady(page);
  const {bytes, told} = madeOf(await projectFile());
  assert.doesNotMatch(told, /taken out/);
  assert.ok(bytes.equals((await exported()).bytes));
  await undo(2);
  await soon.match(() => panel().innerText(), /read as depths/);
  await untilReady(page);
});

test("takes the depth of the picture in its widths, where that has an effect", async () => {
  await enter(row("depth-range"), "0.1");
  await untilReady(page);
  const project = await projectFile();
  assert.equal(JSON.parse(readFileSync(project, "utf8")).options["depth-range"], 0.1);
  assert.ok(madeOf(project).bytes.equals((await exported()).bytes));
  await row("depth-values").selectOption("inverse"); // a camera is assumed for inverse depths
  await soon.ok(async () => await row("depth-range").isHidden());
  await untilReady(page);
  await undo(2);
  await soon.equal(() => row("depth-range").inputValue(), "0.5");
  await untilReady(page);
});

test("reads depths by the camera that is entered, and so does make with the project", async () => {
  await enter(row("camera"), "100,100,59.5,44.5");
  await soon.match(() => panel().innerText(), /All pixels are used/); // with a camera, the background is kept
  await soon.ok(async () => await row("depth-range").isHidden()); // with a camera, depths are exact
  await untilReady(page);
  const project = await projectFile();
  assert.equal(JSON.parse(readFileSync(project, "utf8")).options.camera, "100,100,59.5,44.5");
  assert.ok(madeOf(project).bytes.equals((await exported()).bytes));
  await enter(row("camera"), "100,-1,59.5,44.5");
  await soon.match(() => toast().innerText(), /Camera: expected FX,FY,CX,CY with positive focal lengths/);
  await soon.equal(() => row("camera").inputValue(), "100,100,59.5,44.5");
  await undo();
  await soon.match(() => panel().innerText(), /Background/);
  await untilReady(page);
});

// Writes a dome of splats as a .splat file; `faint` of them are nearly transparent.
function writeSplats(file, faint) {
  const side = 50, bytes = Buffer.alloc(32 * side * side);
  for (let i = 0; i < side * side; ++i) {
    const x = (i % side) / side - 0.5, y = Math.floor(i / side) / side - 0.5, splat = 32 * i;
    [x, y, 0.5 * Math.cos(2 * x) * Math.cos(2 * y), 0.02, 0.02, 0.002].forEach((n, k) => bytes.writeFloatLE(n, splat + 4 * k));
    bytes.set([200, 200, 200, i % 7 === 0 && i < 7 * faint ? 5 : 255, 255, 128, 128, 128], splat + 24);
  }
  writeFileSync(file, bytes);
}

test("brings back points that the file marks as doubtful", async () => {
  const file = path.join(folder, "dome.splat");
  writeSplats(file, 300);
  await showFile(file);
  const note = page.locator("#notes").getByText("Left out 300 points of splats that are less than half opaque");
  await soon.doesNotMatch(() => note.innerText(), /--/);
  await button("Keep them", note).click();
  await soon.ok(() => page.locator("#doubtful").isChecked());
  await soon.equal(() => note.count(), 0);
  await untilReady(page);
  await page.locator("#doubtful").uncheck();
  await soon.equal(() => note.count(), 1);
  await untilReady(page);
});

test("has the panel for depth pictures alone", async () => {
  await showFile(scan);
  await soon.ok(async () => await panel().isHidden());
  await showFile(depth);
  await soon.ok(async () => await panel().isVisible());
});

test("makes a lithophane of a photo pixel by pixel, as the command line does", async () => {
  await showFile(photo);
  await soon.match(() => panel().innerText(), /read as brightness/);
  await page.locator('[data-kind="lithophane"]').click();
  await soon.match(() => panel().innerText(), /brightness becomes thickness/);
  await soon.ok(async () => await row("background").isHidden() && await row("mm-per-value").isHidden());
  await untilReady(page);
  const {bytes} = await exported(), solid = path.join(folder, "photo.stl");
  run("make", photo, "-o", solid, "--form", "lithophane", "--depth-values", "luminance");
  assert.ok(bytes.equals(readFileSync(solid)));
  assert.ok(bytes.equals(madeOf(await projectFile()).bytes));
  await page.locator('[data-kind="relief"]').click();
  await soon.match(() => panel().innerText(), /read as brightness/);
  await untilReady(page);
  await undo();
  await soon.match(() => panel().innerText(), /brightness becomes thickness/);
  await untilReady(page);
});

test("takes a photo that only the browser can read", async () => {
  const jpeg = await page.evaluate(() => { // its left half is black, and its right half is white
    const canvas = document.createElement("canvas"), context = canvas.getContext("2d");
    canvas.width = canvas.height = 64;
    context.fillRect(0, 0, 64, 64);
    context.fillStyle = "white";
    context.fillRect(32, 0, 32, 64);
    return canvas.toDataURL("image/jpeg", 0.9).split(",")[1];
  });
  const file = path.join(folder, "bright.jpg");
  writeFileSync(file, Buffer.from(jpeg, "base64"));
  await page.locator("#file").setInputFiles(file);
  await page.getByText("bright.png", {exact: true}).waitFor();
  await untilReady(page);
  await soon.ok(async () => await panel().isVisible());
});

test("gives heights one vertical scale, whose height follows from the values", async () => {
  await showFile(terrain);
  await row("depth-values").selectOption("height");
  await untilReady(page);
  await enter(row("mm-per-value"), "0.01");
  await enter(row("ground"), "700");
  const highest = 1400; // largest value, up to rounding
  await eventually(async () => {
    const height = Number((await numbers().innerText()).match(/height ([\d.]+)/)[1]);
    assert.ok(Math.abs(height - 0.01 * (highest - 700)) < 0.1, height);
  });
  await untilReady(page);
  assert.ok(await page.getByRole("spinbutton", {name: "Height in mm"}).isDisabled());
  const project = await projectFile();
  assert.ok(madeOf(project).bytes.equals((await exported()).bytes));
  await openFile(project);
  await soon.equal(() => row("ground").inputValue(), "700");
  await untilReady(page);
  await enter(row("mm-per-value"), "");
  await soon.ok(async () => await row("ground").isHidden());
  await untilReady(page);
  await soon.equal(async () => (await numbers().innerText()).match(/height ([\d.]+)/)[1], "5.00");
  await soon.equal(() => toast().filter({hasText: /expected/}).count(), 0);
});
