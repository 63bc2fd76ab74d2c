// Tests the first minute with a scan: choosing a kind of work, the tour, the notes about the scan, and several files as
// one scene.
import assert from "node:assert/strict";
import {writeFileSync} from "node:fs";
import path from "node:path";
import {DESK, browser, button, choose, drag, engine, field, folder, middleOf, openFile, option, page, pieceSize, press,
  radio, showFile, skip, slider, soon, startEngine, takeBack, test, text, toast, undo, undoAll, untilText, untilTold,
  visiblePoints as points, withBrowser} from "./page_suite.mjs";
import {randomNumbers} from "./random_entries.mjs";
import {EngineProcess, areKindsDrawn, enter, eventually, holdRequests, ignoreTimers, openPanels, run, untilListening,
  untilReady, untilTimersRan, writeBallBeforeWall, writeSample, writeScans} from "./support.mjs";

const scans = skip ? [] : writeScans(folder, 6000);

withBrowser(async () => {
  const first = await (await browser.newContext({viewport: DESK})).newPage();
  await first.goto((await startEngine(scans[0])).address);
  await untilReady(first);
  return first;
});

const kind = radio;
const offered = (name) => page.getByRole("group", {name: "Found on the scan"}).getByRole("button", {name});
const note = (text) => page.locator("#notes").getByText(text);

async function openScan(file, points, of = page) {
  await of.locator("#file").setInputFiles(file);
  await of.getByText(`of ${points} points`).waitFor();
  await untilReady(of);
}

// Returns, for the picture of each kind of work, the number of opaque pixels and a weighted sum of all colours.
const pictures = () => page.locator("#kinds canvas").evaluateAll((all) => all.map((canvas) => {
  const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let shown = 0, sum = 0;
  for (let i = 0; i < data.length; i += 4) {
    shown += data[i + 3] > 128;
    sum += data[i] + 3 * data[i + 1] + 7 * data[i + 2];
  }
  return {shown, sum};
}));

test("leads through five steps, once by itself and then from the help", async () => {
  await button("Show me", toast()).click();
  const tour = page.getByRole("dialog", {name: "Tour"});
  for (let step = 1; step <= 5; ++step) {
    await tour.getByText(`${step} of 5`).waitFor();
    const box = await tour.boundingBox();
    assert.ok(box.x >= 0 && box.y >= 0 && box.x + box.width <= 1280 && box.y + box.height <= 800, JSON.stringify(box));
    await tour.getByRole("button", {name: step < 5 ? "Next" : "Done"}).click();
  }
  await tour.waitFor({state: "hidden"});
  await button("Help").click();
  await button("Take the tour").click();
  await tour.getByText("1 of 5").waitFor();
  await page.keyboard.press("Escape");
  await tour.waitFor({state: "hidden"});
  await page.reload();
  await untilReady(page);
  await soon.ok(async () => !await button("Show me").isVisible());
});

test("leads back to the relief for the tour, and says that it needs one", async () => {
  const tour = page.getByRole("dialog", {name: "Tour"});
  await button("Relievo, start page").click();
  await button("Help").click();
  await button("Take the tour").click();
  await tour.getByText("1 of 5").waitFor();
  await page.locator("#kinds.toured").waitFor();
  await page.keyboard.press("Escape");
  const empty = await new EngineProcess(path.join(folder, "empty")).ready();
  const other = await (await browser.newContext()).newPage();
  await other.goto(empty.address);
  await button("Help", other).click();
  await button("Take the tour", other).click();
  await other.getByText("The tour leads through a relief: open a scan or a sample first.").waitFor();
  await other.close();
  await empty.stop();
});

test("takes no click before its program has begun, and none is lost", async () => {
  const other = await (await browser.newContext()).newPage(), begin = await holdRequests(other, "**/api/about");
  await other.goto(engine.address, {waitUntil: "commit"});
  const box = await eventually(async () => {
    const found = await other.locator("#help").boundingBox();
    assert.ok(found);
    return found;
  });
  const isHit = () => other.evaluate(({x, y, width, height}) =>
    document.querySelector("#help").contains(document.elementFromPoint(x + width / 2, y + height / 2)), box);
  await soon.equal(() => isHit(), false);
  const clicked = button("Help", other).click(); // Playwright waits until the button can be clicked
  begin();
  await clicked;
  await button("Take the tour", other).waitFor();
  await other.close();
});

test("shows nothing of the document on the start page, and changes nothing there by keys", async () => {
  const parts = ["title", "undo", "redo", "save", "export", "numbers", "remarks"], shown = () => page.evaluate((ids) =>
    ids.filter((id) => document.getElementById(id).checkVisibility()), parts);
  const bronze = radio("Bronze");
  await bronze.click();
  assert.deepEqual(await shown(), parts);
  await button("Relievo, start page").click();
  await page.getByRole("heading", {name: "From scan to bas-relief"}).waitFor();
  assert.deepEqual(await shown(), []);
  for (const key of ["z", "e", "s"]) await page.keyboard.press(`Control+${key}`);
  await soon.equal(() => page.locator("dialog[open]").count(), 0);
  await button("Back to the relief").click();
  assert.deepEqual(await shown(), parts);
  await soon.ok(() => bronze.isChecked());
  await undo();
  await soon.ok(async () => !await bronze.isChecked());
});

test("offers the tour no longer to whoever begins to work", async () => {
  const other = await (await browser.newContext()).newPage();
  await other.addInitScript(ignoreTimers, 30000); // the offer would disappear after 30 s
  await other.goto(engine.address);
  const offered = button("Show me", other);
  await offered.waitFor();
  await untilReady(other);
  await soon.ok(() => offered.isVisible());
  await radio("Bronze", other).click();
  await offered.waitFor({state: "hidden"});
  await undo(1, other);
  await other.close();
});

// The page learns from its request for facts that the exact relief is ready. The test holds this request back.
test("shows the kinds of work before the exact relief is there", async () => {
  const other = await page.context().newPage(), letGo = await holdRequests(other, "**/api/facts");
  const large = path.join(folder, "large.ply");
  writeSample("still_life", 150000, large);
  await other.goto(engine.address.replace(/#.*/, ""));
  await untilListening(other);
  await other.locator("#file").setInputFiles(large);
  await other.getByText("large.ply", {exact: true}).waitFor();
  await soon.equal(() => other.locator("#kinds svg:visible, #kinds [data-drawn]").count(), 6, "none is blank");
  await other.waitForFunction(() => [...document.querySelectorAll("#kinds canvas")].every((canvas) =>
    canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1).data[3] > 0));
  letGo();
  await other.waitForFunction(areKindsDrawn);
  await other.close();
});

test("shows what the view and the six sides look like", async () => {
  const shown = (canvases) => canvases.evaluateAll((all) => all.map((canvas) => {
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((value, i) => i % 4 === 3 && value > 0).length;
  }));
  await eventually(async () => assert.ok((await shown(page.locator("#view-picture")))[0] > 300));
  await button("Choose view").click();
  await eventually(async () => {
    const all = await shown(page.locator("#sides canvas"));
    assert.ok(all.length === 6 && all.every((count) => count > 100), String(all));
  });
  await page.keyboard.press("Escape");
});

test("shows this scan as each kind of work", async () => {
  const first = await eventually(async () => {
    const all = await pictures();
    assert.equal(all.length, 6);
    for (const {shown} of all) assert.ok(shown > 2000, JSON.stringify(all));
    return all;
  });
  assert.equal(new Set(first.map(({sum}) => sum)).size, 6, "each picture is another");
});

test("sets size and material with a kind, and takes all of it back at once", async () => {
  await kind("Coin").click();
  await untilTold(/height 1\.60 mm.*piece 40\.00 × 40\.00/);
  await soon.ok(() => radio("Struck silver").isChecked());
  await kind("Seal").click(); // a seal has the same diameter
  await untilTold(/height 1\.20 mm/);
  await soon.ok(() => radio("Bronze").isChecked());
  await kind("Lithophane").click();
  await untilTold(/height 2\.40 mm/);
  await soon.ok(() => slider("Fine detail").isDisabled(), "depths alone make a lithophane");
  await undo(3);
  await untilTold(/height 5\.00 mm/);
  await soon.ok(() => kind("Plaque").isChecked());
  await soon.ok(() => slider("Fine detail").isEnabled());
});

test("names a kind by its form, whatever its material", async () => {
  await radio("Walnut").click();
  await soon.ok(() => kind("Plaque").isChecked());
  await kind("Carving").click();
  await radio("Bronze").click();
  await soon.ok(() => kind("Carving").isChecked());
  await undo(3);
});

test("brings a kind back as it was left", async () => {
  await kind("Coin").click();
  await enter(option("diameter"), "30");
  await untilTold(/piece 30\.00 × 30\.00/);
  await kind("Lithophane").click();
  await untilTold(/height 2\.40 mm/);
  await kind("Coin").click();
  await untilTold(/piece 30\.00 × 30\.00/);
  await option("outline").selectOption("ellipse"); // an ellipse has no diameter
  for (const name of ["Seal", "Coin"]) await choose(name);
  await soon.ok(async () => !await toast().isVisible(), "the piece can be made");
  await soon.equal(() => option("outline").inputValue(), "ellipse");
  await undo(7);
  await soon.ok(() => kind("Plaque").isChecked());
});

test("says what the eye sees, and the paper's symbol in the tip", async () => {
  for (const [name, symbol] of [["Fine detail", "γ"], ["Edge emphasis", "β"]])
    await soon.match(() => page.locator(".slider .name", {hasText: name}).getAttribute("title"), new RegExp(symbol));
  await soon.match(() => page.locator(".slider .name", {hasText: "Height"}).getAttribute("title"), /alpha .* u [\d.]+/);
  const tip = await page.getByText("Plate thickness", {exact: true}).getAttribute("title");
  assert.equal(tip, "Smallest thickness of the plate, without the relief");
  await soon.deepEqual(() => option("alpha").evaluate((input) => [input.ariaLabel, input.placeholder, input.value]),
    ["Flatness", "no effect", ""]);
  await soon.equal(() => page.getByLabel("Precision", {exact: true}).getAttribute("data-option"), "mode");
  const words = await page.locator("body *").evaluateAll((all) => all.flatMap((element) =>
    [element.textContent, element.title, element.ariaLabel, element.placeholder]).join(" "));
  for (const word of [/Solver/i, /Height coefficient/i, /\|k\|/]) assert.doesNotMatch(words, word);
});

const PANELS = {
  Plaque: ["plate", "outline", "margin", "thickness"],
  Coin: ["diameter", "outline", "rim", "rim-height", "rim-bevel", "margin", "thickness", "form"],
  Carving: ["plate", "outline", "corner", "margin", "thickness"],
  Seal: ["diameter", "draft", "rim", "rim-height", "rim-bevel", "margin", "thickness", "form"],
  Lithophane: ["thickness", "plate", "margin", "form"],
  Bent: ["wrap", "thickness", "plate", "margin", "form"],
};

test("shows first, with each kind, the controls that matter for it", async () => {
  const panel = page.locator("#kind"), outline = option("outline"), height = option("height");
  const shown = () => panel.locator("[data-option]:visible").evaluateAll((all) =>
    all.map((input) => input.dataset.option));
  for (const [name, options] of Object.entries(PANELS)) {
    await kind(name).click();
    await panel.getByRole("heading", {name, exact: true}).waitFor();
    assert.deepEqual(await shown(), options, name);
    const [box, below] = [await panel.boundingBox(), await height.boundingBox()];
    assert.ok(box.y + box.height <= below.y && below.y + below.height < 772, `${name} and the height fit the page`);
  }
  await kind("Coin").click();
  const answered = page.waitForResponse("**/api/check");
  await outline.selectOption("hexagon"); // a medal with another outline is still a medal
  await answered;
  await page.locator('#kind-rows [aria-busy="true"]').waitFor({state: "detached"}); // the page has taken the outline
  await soon.equal(() => outline.inputValue(), "hexagon");
  await soon.ok(() => kind("Coin").isChecked());
  const untilKind = (name) => page.getByRole("radio", {name, exact: true, checked: true}).waitFor();
  await outline.selectOption({label: "Round corners"});
  await untilKind("Plaque");
  await outline.focus();
  await outline.selectOption("circle"); // this choice moves the control into another panel
  await untilKind("Coin");
  await soon.equal(() => page.evaluate(() => document.activeElement.id), "outline");
  assert.deepEqual(await shown(), PANELS.Coin);
  await undoAll();
  await soon.ok(() => kind("Plaque").isChecked());
});

test("offers what can be done about the scan, and cuts it", async () => {
  const before = await points();
  await page.getByRole("button", {name: /notes? on the scan/}).click();
  await page.getByText(/^Removed noise of [\d.]+ sampling distances\./).waitFor();
  const noise = page.locator("#denoise");
  await soon.ok(async () => Number(await noise.inputValue()) > 0);
  await button("Keep the noise").click();
  await untilText(noise, "0");
  await untilReady(page);
  await undo();
  await page.getByText(/^Removed noise of/).waitFor();
  const bottom = slider("Cut away: Bottom");
  await bottom.fill("40");
  await eventually(async () => assert.ok((await points()) < 0.85 * before, `${await points()} of ${before}`));
  await soon.equal(() => page.locator("#crop").inputValue(), "0,0.4,1,1");
  await undo();
  await eventually(async () => assert.equal(await points(), before));
  await soon.equal(() => bottom.inputValue(), "0");
});

test("crops the scan by a frame on the picture", async () => {
  const crop = async () => (await page.locator("#crop").inputValue()).split(",").map(Number);
  const before = await points(), frame = page.locator("#crop-frame .frame"), box = async () => frame.boundingBox();
  await openPanels(page);
  await button("Crop on the picture").click();
  await frame.waitFor();
  const whole = await box(), at = (x, y) => [whole.x + x * whole.width, whole.y + (1 - y) * whole.height];
  const dragIn = (from, to) => drag(at(...from), at(...to));
  const untilCrop = async (...wanted) => eventually(async () => {
    const found = await crop();
    assert.ok(wanted.every((x, i) => Math.abs(x - found[i]) < 0.02), `${found} for ${wanted}`);
    const {x, y, width, height} = await box(), drawn = [...at(wanted[0], wanted[3]), ...at(wanted[2], wanted[1])];
    for (const [i, side] of [x, y, x + width, y + height].entries()) assert.ok(Math.abs(side - drawn[i]) < 8);
  });
  await dragIn([0.2, 0.2], [0.7, 0.8]); // draws a frame
  await untilCrop(0.2, 0.2, 0.7, 0.8);
  await dragIn([0.7, 0.5], [0.9, 0.5]); // moves a side
  await untilCrop(0.2, 0.2, 0.9, 0.8);
  await dragIn([0.2, 0.2], [0.1, 0.3]); // moves a corner
  await untilCrop(0.1, 0.3, 0.9, 0.8);
  await dragIn([0.5, 0.5], [0.6, 0.4]); // moves the frame
  await untilCrop(0.2, 0.2, 1, 0.7);
  await press(at(0.5, 0.5), at(0.3, 0.6));
  await page.keyboard.press("Escape");
  await page.mouse.up();
  await untilCrop(0.2, 0.2, 1, 0.7);
  await page.locator("#stage").focus();
  await page.keyboard.press("ArrowLeft");
  await untilCrop(0.19, 0.2, 0.99, 0.7);
  await button("Done").click();
  await page.locator("#crop-frame").waitFor({state: "hidden"});
  await eventually(async () => assert.ok((await points()) < 0.85 * before, `${await points()} of ${before}`));
  await radio("Crop").click();
  await button("Whole scan").click();
  await eventually(async () => assert.equal(await points(), before));
  await soon.equal(() => page.locator("#crop").inputValue(), "");
  await button("Done").click();
  await takeBack(6);
});

test("colours on the piece what a tool leaves standing", async () => {
  const orange = () => page.locator("#picture").evaluate((canvas) => {
    const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) count += data[i] > 150 && data[i + 2] < 0.6 * data[i];
    return count;
  });
  const before = await orange();
  await page.locator("#tool").selectOption("Ball end");
  await enter(page.getByLabel("Tool: Diameter"), "8");
  await page.getByText(/^The tool reaches [\d.]+ % of the front, and leaves up to [\d.]+ mm/).waitFor();
  let marked;
  await eventually(async () => assert.ok((marked = await orange()) > before + 5000, `${marked} after ${before}`));
  await radio("Orbit").click(); // the parts with notes stay orange in every view
  await page.locator("#stage").focus();
  for (let step = 0; step < 4; ++step) await page.keyboard.press("ArrowRight");
  await untilReady(page);
  await soon.ok(async () => (await orange()) > marked / 2);
  await page.locator("#finish").selectOption("reachable");
  await page.getByText(/^The tool reaches (9[89]|100)[\d.]* %/).waitFor();
  await takeBack(3);
  await soon.ok(async () => (await orange()) < before + 500);
  await button("Fit").click();
});

test("moves, scales and turns the figure on its plate by hand", async () => {
  const before = await pieceSize();
  const longer = async () => Number(await text("Longer side in mm")), whole = await longer();
  await choose("Place");
  const [x, y] = await middleOf(page.locator("#stage")), shift = async () =>
    (await option("shift").inputValue()).split(",").map(Number);
  await page.mouse.move(x, y);
  for (let notch = 0; notch < 5; ++notch) await page.mouse.wheel(0, 200);
  await eventually(async () => assert.ok((await longer()) < 0.8 * whole));
  await drag([x, y], [x + 30, y - 20]);
  await untilReady(page);
  const [right, up] = await shift();
  assert.ok(right > 2 && up > 1, `${right},${up}`);
  await soon.deepEqual(() => pieceSize(), before, "the plate stays as large as it was");
  await soon.equal(() => page.locator("#toast").getByText(/expected/).count(), 0);
  const kept = await longer(); // the next drag goes too far, so the figure returns to the plate and keeps its size
  await drag([x + 30, y - 20], ...[100, 200, 300, 400].map((across) => [x + across, y - 20]));
  await untilReady(page);
  await soon.equal(() => longer(), kept);
  const [farthest] = await shift();
  assert.ok(farthest >= right && farthest + kept / 2 <= before[0] / 2, `${farthest} on ${before}`);
  await page.keyboard.down("Shift");
  await press([x + 120, y], [x + 110, y - 60]);
  await page.locator("#overlay").getByText(/^\d+° to the left$/).waitFor();
  await page.mouse.up();
  await page.keyboard.up("Shift");
  await page.getByText("Turned by hand").waitFor();
  await untilReady(page);
  await undoAll(page, async () => (await longer()) === whole);
  await radio("Light").click();
});

test("puts several files side by side, and turns, scales and removes them", async () => {
  await openFile(scans);
  await page.getByText("urn + ammonite.json", {exact: true}).waitFor();
  await untilReady(page);
  await page.locator("#scene li").nth(1).getByText("ammonite.ply").waitFor();
  const [across, up] = await pieceSize();
  await enter(page.getByLabel("Size (%) of ammonite.ply"), "50");
  await eventually(async () => {
    const [x, y] = await pieceSize();
    assert.ok(x / y < 0.95 * across / up, `${x} × ${y} after ${across} × ${up}`);
  });
  await soon.equal(() => page.getByLabel("Size (%) of ammonite.ply").inputValue(), "50");
  await soon.equal(() => text("Height in mm"), "5.00");
  await button("Remove urn.ply").click();
  await page.getByText("ammonite.json", {exact: true}).waitFor();
  await untilReady(page);
  await soon.equal(() => page.locator("#scene li").count(), 1);
  await engine.stop(); // the engine stores the scans of a scene as long as it stores the scene
  await page.goto((await startEngine()).address);
  await page.getByText("ammonite.json", {exact: true}).first().waitFor();
  await untilReady(page);
});

// The engine refuses to prepare a view before the document is open. The page knows that the document is open only when
// the engine has answered.
test("takes what is changed while a scan is still opening", async () => {
  const other = await page.context().newPage(), answers = [];
  other.on("response", (response) => answers.push(response.status()));
  await other.addInitScript(() => {
    const {fetch} = window;
    window.fetch = async (url, options) => {
      if (url === "api/open") await new Promise((resolve) => (window.letOpen = resolve));
      return fetch(url, options);
    };
  });
  await other.goto(engine.address.replace(/#.*/, ""));
  await untilListening(other);
  await other.locator("#file").setInputFiles(scans[1]);
  await other.getByText("ammonite.ply", {exact: true}).waitFor();
  await eventually(async () => assert.ok(await other.evaluate(() => Boolean(window.letOpen))));
  await soon.ok(() => button("Choose view", other).isDisabled(), "there is no model yet");
  await openPanels(other);
  await enter(other.locator("#crop"), "0,0.4,1,1");
  await enter(field("Height in mm", other), "2.5");
  await untilTimersRan(other, 300); // by then the page has sent any request that it sends too early
  await other.evaluate(() => window.letOpen());
  await other.getByText(/of 6,000 points.*height 2\.50/).waitFor();
  await untilReady(other);
  await soon.equal(() => other.locator("#crop").inputValue(), "0,0.4,1,1");
  const part = await points(other);
  await enter(other.locator("#crop"), "");
  await eventually(async () => assert.ok((await points(other)) > 1.2 * part, `${await points(other)} after ${part}`));
  assert.deepEqual(answers.filter((status) => status >= 400), []);
  await other.close();
});

test("keeps the view that was asked for last when the one before it arrives later", async () => {
  const other = await page.context().newPage();
  let asked = 0, letGo;
  const held = new Promise((resolve) => (letGo = resolve));
  await other.route("**/api/view", async (route) => {
    if (++asked === 2) await held;
    await route.continue();
  });
  await other.goto(engine.address.replace(/#.*/, ""));
  await untilListening(other);
  await other.locator("#file").setInputFiles(scans[1]);
  await untilReady(other);
  const whole = await points(other), crop = other.locator("#crop");
  await openPanels(other);
  await crop.evaluate(async (field) => {
    for (field.value of ["0,0.4,1,1", "0,0.1,1,1"]) {
      field.dispatchEvent(new Event("change"));
      await new Promise((resolve) => setTimeout(resolve)); // the page sends its request
    }
  });
  await eventually(async () => assert.ok((await points(other)) < whole)); // the points of the first crop have arrived
  const part = await points(other);
  await soon.equal(() => crop.inputValue(), "0,0.1,1,1");
  await soon.ok(() => other.locator('[role="application"][aria-busy="true"]').isVisible());
  letGo();
  await untilReady(other);
  await soon.equal(() => crop.inputValue(), "0,0.1,1,1");
  await soon.ok(async () => (await points(other)) > part);
  await other.close();
});

function anyNormal(random) {
  const z = 2 * random() - 1, angle = 2 * Math.PI * random(), r = Math.sqrt(1 - z * z);
  return [r * Math.cos(angle), r * Math.sin(angle), z];
}

// Writes points with normals; each point is {place, normal}.
function writePoints(file, points) {
  const names = ["x", "y", "z", "nx", "ny", "nz"].map((name) => `property float ${name}`).join("\n");
  const header = `ply\nformat ascii 1.0\nelement vertex ${points.length}\n${names}\nend_header\n`;
  const lines = points.map(({place, normal}) => [...place, ...normal].map((x) => x.toFixed(5)).join(" "));
  writeFileSync(file, `${header}${lines.join("\n")}\n`);
}

// Writes a ball on a tilted table. The table is a square with sides of 4 radii of the ball, and its points are noisy.
function writeBallOnTable(file) {
  const random = randomNumbers(1), n = [0, 0.766, 0.643], points = [];
  for (let i = 0; i < 6000; ++i) {
    const normal = anyNormal(random);
    points.push({place: normal.map((x, k) => x + n[k]), normal});
    const [u, v, off] = [4 * random() - 2, 4 * random() - 2, 0.02 * random() - 0.01];
    points.push({place: [u, -v * n[2] + off * n[1], v * n[1] + off * n[2]], normal: n});
  }
  writePoints(file, points);
}

// Writes a ball, and beside it a small ball with 0.4 % of the first ball's area.
function writeBallWithCrumb(file) {
  const random = randomNumbers(1), ball = (count, radius, x) => Array.from({length: count}, () => {
    const normal = anyNormal(random), [a, b, c] = normal.map((y) => y * radius);
    return {place: [a + x, b, c], normal};
  });
  writePoints(file, [...ball(30000, 1, 0), ...ball(130, 0.065, 1.4)]);
}

test("leaves out a small piece, and keeps it or not at the press of a button", async () => {
  const file = path.join(folder, "crumb.ply"), crumbs = page.locator("#crumbs");
  const untilWide = (least, most) => eventually(async () => { // waits until width / height is in this range
    const wide = (await pieceSize()).reduce((x, y) => x / y);
    assert.ok(wide > least && wide < most, `${wide}`);
  });
  writeBallWithCrumb(file);
  await openScan(file, "30,130");
  await note(/^Left out 1 small piece/).waitFor();
  await untilWide(0.97, 1.03);
  await offered("Keep them").click();
  await note("Small pieces are kept.").waitFor();
  await untilWide(1.15, 1.25); // both balls together are 2.465 by 2 radii of the larger ball, without margins
  await soon.ok(() => crumbs.isChecked());
  await offered("Leave them out").click();
  await note(/^Left out 1 small piece/).waitFor();
  await untilWide(0.97, 1.03);
  await soon.ok(async () => !await crumbs.isChecked());
});

test("tells what is taken out of a depth image as background, and advises nothing that the page lacks", async () => {
  const depth = path.join(folder, "depth.tif"), colours = path.join(folder, "colours.png");
  writeBallBeforeWall(depth);
  run("make", scans[1], "-o", path.join(folder, "relief.stl"), "--preview", colours, "--preview-size", 100);
  await showFile(depth);
  const found = page.locator("#offers li", {hasText: /background/});
  await soon.match(() => found.innerText(), /^Left out as background: 7,9\d\d \(7\d %\)/);
  await button("Hide what was found").click();
  await found.waitFor({state: "hidden"});
  await showFile(colours);
  await page.locator("#depth-values").selectOption("depth"); // a coloured picture has no depths
  const said = toast().getByText(/colours\.png/);
  await said.waitFor();
  await soon.match(() => said.innerText(), /Take their brightness, or save it as a picture in greys/);
  await soon.doesNotMatch(() => said.innerText(), /option|depth-values/);
  await untilReady(page);
});

test("finds a table, and leaves it out at the press of a button", async () => {
  const table = path.join(folder, "table.ply");
  writeBallOnTable(table);
  await openScan(table, "12,000");
  const before = await points();
  const finding = await note(/^Found a table, \d+ % of the visible points\./).innerText();
  const share = Number(finding.match(/\d+/)[0]) / 100;
  await offered("Leave it out").click();
  await note(/^Left out a table/).waitFor();
  await eventually(async () => {
    const left = (await points()) / before;
    assert.ok(Math.abs(left - (1 - share)) < 0.06, `${left} left of a table of ${share}`);
  });
  await untilReady(page);
  await soon.ok(async () => !await page.locator("#plane").isChecked());
  await offered("Keep it").click();
  await note(/^Found a table/).waitFor();
  await eventually(async () => assert.equal(await points(), before));
  await soon.equal(() => note(/fills its whole frame/).count(), 0);
});

// Writes a glTF file with the points of a wavy surface, and its buffer in a second file. Returns both paths.
function writeGltf() {
  const n = 60, places = [];
  for (let i = 0; i < n * n; ++i) {
    const x = i % n, y = Math.floor(i / n);
    places.push(x / n, y / n, 0.1 * Math.sin(x / 6) * Math.cos(y / 7));
  }
  const bytes = Buffer.from(Float32Array.from(places).buffer);
  const gltf = {asset: {version: "2.0"}, scene: 0, scenes: [{nodes: [0]}], nodes: [{mesh: 0}],
    meshes: [{primitives: [{mode: 0, attributes: {POSITION: 0}}]}], // mode 0: points
    buffers: [{uri: "wave.bin", byteLength: bytes.length}], bufferViews: [{buffer: 0, byteLength: bytes.length}],
    accessors: [{bufferView: 0, componentType: 5126, count: n * n, type: "VEC3"}]};
  const files = [path.join(folder, "wave.gltf"), path.join(folder, "wave.bin")];
  writeFileSync(files[0], JSON.stringify(gltf));
  writeFileSync(files[1], bytes);
  return files;
}

test("opens a glTF file together with the buffer that it names", async () => {
  await openScan(writeGltf(), "3,600");
  await page.getByText("wave.zip", {exact: true}).waitFor();
});
