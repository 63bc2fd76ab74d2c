// Tests numbers, keys and reachable heights on the page, in Chromium or Firefox.
import assert from "node:assert/strict";
import path from "node:path";
import {button, choose, chooseView, drag, engine, exportDialog, field, folder, found, labelled, middleOf, openExport,
  page, preset, press, radio, scan, set, slider, soon, test, text, toast, undo, undoAll, untilTaken, untilText, untilTold,
  withPage} from "./page_suite.mjs";
import {enter, eventually, ignoreTimers, savedFiles, type, untilReady, untilTimersRan,
  writeSample} from "./support.mjs";

withPage("still_life", 8000);

const untilPiece = (size) => untilTold(`piece ${size}`);
const reach = () => page.locator("#reach");

test("steps by round numbers with arrow keys", async () => {
  const next = (...args) => page.evaluate(async (values) =>
    (await import(new URL("panels/slider.js", location))).nextValue(...values), args);
  for (const [value, direction, isFine, least, wanted] of [[4, 1, false, 0.1, 4.1], [4.13, 1, false, 0.1, 4.2],
    [4.13, -1, false, 0.1, 4.1], [12.3, 1, false, 0.1, 13], [10, -1, false, 0.1, 9.9], [10, 1, false, 0.1, 11],
    [0, 1, false, 0.01, 0.01], [0.25, 1, false, 0.01, 0.26], [4, 1, true, 0.1, 4.01], [76, -1, false, 1, 75]])
    assert.equal((await next(value, direction, isFine, least)).toFixed(6), wanted.toFixed(6), `${value} ${direction}`);
  await set("Height in mm", 4);
  await slider("Height").press("ArrowRight");
  await soon.equal(() => text("Height in mm"), "4.10");
  await field("Height in mm").press("Shift+ArrowDown");
  await soon.equal(() => text("Height in mm"), "4.09");
  await slider("Steepest wall").press("ArrowLeft");
  await soon.equal(() => text("Steepest wall in degrees"), "75");
  await slider("Steepest wall").press("ArrowRight");
});

// Drags from the centre of an element and presses Escape. This must restore the value, and the rest of the drag must
// change nothing.
async function takesDragBack(locator, value, [dx, dy]) {
  const before = await value(), [x, y] = await middleOf(locator);
  await press([x, y], [x + dx, y + dy]);
  await soon.notEqual(() => value(), before);
  await page.keyboard.press("Escape");
  await soon.equal(() => value(), before);
  await page.mouse.move(x + 2 * dx, y + 2 * dy, {steps: 4});
  await page.mouse.up();
  await soon.equal(() => value(), before);
}

test("takes back with Escape what is typed or dragged, and undoes in fields", async () => {
  await set("Height in mm", 4);
  await set("Height in mm", 5);
  await type(field("Height in mm"), "17");
  await field("Height in mm").press("Escape");
  await soon.equal(() => text("Height in mm"), "5.00");
  await field("Height in mm").press("Control+z");
  await soon.equal(() => text("Height in mm"), "4.00");
  await field("Height in mm").press("Control+Shift+Z");
  await soon.equal(() => text("Height in mm"), "5.00");

  await takesDragBack(slider("Fine detail"), () => text("Fine detail value"), [-40, 0]);
  await undo();
  await soon.equal(() => text("Height in mm"), "4.00");
});

test("undoes what a field of the plate has taken, but not while something is typed", async () => {
  const plate = labelled("Plate size");
  for (const size of ["150x120", "160x120"]) {
    await enter(plate, size);
    await untilPiece(`${size.slice(0, 3)}.00 × 120.00`);
  }
  await type(plate, "17");
  await plate.press("Control+z");
  await untilPiece("160.00 × 120.00");
  await plate.press("Escape");
  await untilText(plate, "160x120");
  await plate.press("Control+z");
  await untilPiece("150.00 × 120.00");
  await untilText(plate, "150x120");
  await plate.press("Control+z");
  await untilText(plate, "");
});

test("keeps the controls of a rim with it, and takes it off a piece without an outline", async () => {
  const isFirst = async () => (await page.locator("#kind-rows").getByLabel("Rim width").count()) > 0;
  await radio("Coin").click();
  await soon.ok(() => isFirst());
  await labelled("Outline").selectOption("Rectangle");
  await page.getByRole("radio", {name: "Plaque", checked: true}).waitFor();
  await soon.ok(() => isFirst());
  await labelled("Outline").selectOption("None");
  await untilText(labelled("Rim width"), "");
  await soon.equal(() => labelled("Outline").inputValue(), "none");
  await undo(3);
  await soon.ok(async () => !(await isFirst()));
});

test("keeps the figure's size on another plate, as long as it fits", async () => {
  const plate = labelled("Plate size"), shift = page.locator("#shift");
  const longer = async () => Number(await text("Longer side in mm"));
  await enter(plate, "20cm x 150");
  await untilPiece("200.00 × 150.00");
  await soon.ok(async () => (await longer()) > 120, "as large as fits");
  await set("Longer side in mm", 64);
  await enter(plate, "200x151");
  await untilPiece("200.00 × 151.00");
  await soon.equal(() => longer(), 64);
  await enter(plate, "60x50");
  await page.getByText("The figure was too large for its plate: now it is as large as fits.").waitFor();
  await untilPiece("60.00 × 50.00");
  await soon.ok(async () => (await longer()) < 50);
  await enter(shift, "45,0"); // beyond the plate's edge
  await page.getByText("The plate has no room for the figure there: it stays where it is.").waitFor();
  await soon.equal(() => shift.inputValue(), "");
  await undo(2);
  await untilPiece("200.00 × 151.00");
  await enter(shift, "60,0");
  await enter(plate, "100x80"); // the shift of 60 mm is more than half of 100 mm
  await page.getByText("The plate has no room for the figure there: it is in the middle again.").waitFor();
  await soon.deepEqual(async () => [await shift.inputValue(), await longer()], ["", 64]);
  await undoAll(page, async () => (await plate.inputValue()) === "");
});

test("takes letters as keys again after Enter, and goes on with Tab from the field", async () => {
  const focused = () => page.evaluate(() => document.activeElement.dataset.option);
  await type(field("Height in mm"), "4");
  await page.keyboard.press("Enter");
  await page.keyboard.press("m");
  await soon.ok(() => radio("Measure").isChecked());
  await page.keyboard.press("l");
  await page.keyboard.press("Shift+Tab");
  await page.keyboard.press("Tab");
  await soon.equal(() => focused(), "height");
});

test("takes back what no piece can be made of", async () => {
  await labelled("Bent around").selectOption("Cylinder");
  const diameter = page.getByLabel("Bent around: Diameter");
  await enter(diameter, "1");
  await page.getByText(/^Bent around: expected a diameter of at least/).waitFor();
  await soon.equal(() => diameter.inputValue(), "");
  await soon.ok(() => toast().isVisible());
  await enter(diameter, "200");
  await toast().waitFor({state: "hidden"});
  await undo(2);
  await soon.ok(() => radio("Plaque").isChecked());
});

test("says why an entry is refused until the next one is taken, even one that changes nothing", async () => {
  const option = labelled, refused = (text) => toast().getByText(text).waitFor();
  const untilGone = () => toast().waitFor({state: "hidden"});
  await page.evaluate(ignoreTimers, 8000); // messages would disappear after 8 s
  await set("Height in mm", 5);
  await set("Height in mm", "high");
  await refused("Height: expected a number");
  await set("Height in mm", "5.0");
  await untilGone();
  await enter(page.locator("#crop"), "abc");
  await refused("Crop: expected left, bottom, right and top as shares from 0 to 1, such as 0,0.2,1,0.8, found 'abc'");
  await untilReady(page);
  await soon.ok(() => toast().isVisible());
  await enter(option("Margin in mm"), "6");
  await untilGone();
  await enter(page.locator("#crop"), "0,0,0.001,0.001"); // this crop keeps no points
  await refused("expected");
  await untilText(page.locator("#crop"), "");
  await soon.ok(() => toast().isVisible());
  await enter(option("Margin in mm"), "5");
  await untilGone();
  await option("Outline").selectOption("hexagon");
  await untilTaken(); // before that, the figure cannot be moved
  await radio("Place").click();
  await page.locator("#stage").click();
  await refused("Give the plate a size first: then the figure can be moved on it.");
  await option("Outline").selectOption("ellipse");
  await untilGone();
  await enter(option("Plate size"), "200x150");
  await enter(option("Moved by"), "120,0");
  await refused("The plate has no room for the figure there: it stays where it is.");
  await enter(option("Moved by"), "1,0");
  await untilGone();
  await choose("Light");
  await undoAll(page, async () => (await option("Outline").inputValue()) === "rectangle");
  await page.evaluate(ignoreTimers, Infinity);
});

test("says without a break that a figure is dragged beyond its plate", async () => {
  const shift = page.locator("#shift"), longer = "Longer side in mm", before = await text(longer);
  await enter(labelled("Plate size"), "200x150");
  await set(longer, 100);
  await choose("Place");
  const middle = await middleOf(page.locator("#stage")), {width} = await page.locator("#stage").boundingBox();
  await press(middle, [middle[0] + 0.4 * width, middle[1]]);
  await toast().getByText("The plate has no room for the figure there").waitFor();
  await page.evaluate(() => {
    window.hidden = 0;
    new MutationObserver(() => (window.hidden += document.querySelector("#toast").hidden))
      .observe(document.querySelector("#toast"), {attributeFilter: ["hidden"]});
  });
  for (let i = 0; i < 10; ++i) {
    await page.mouse.move(middle[0] + 0.4 * width + i, middle[1]);
    await untilTimersRan(page, 50);
  }
  await soon.ok(() => toast().isVisible());
  await soon.equal(() => page.evaluate(() => window.hidden), 0);
  await page.mouse.up();
  await choose("Light");
  await undoAll(page, async () => !await shift.inputValue() && (await text(longer)) === before);
});

test("knows what a draft angle allows, and exports no piece that cannot be made", async () => {
  const dialog = exportDialog(), option = labelled;
  await enter(option("Draft angle"), "60");
  await set("Height in mm", 15);
  await reach().getByText(/^The draft angle keeps the height at [\d.]+ mm\./).waitFor();
  const reached = (await reach().innerText()).match(/[\d.]+ mm/)[0];
  await page.getByTitle(`Out of reach: the relief is ${reached} high`).waitFor();
  await page.keyboard.press("Control+e");
  await dialog.getByText(/^A height of [\d.]+ mm is out of reach here\.$/).waitFor();
  const shown = async () => Number((await dialog.innerText()).match(/relief ([\d.]+) mm high,/)?.[1]);
  await soon.ok(async () => Math.abs(await shown() - parseFloat(reached)) < 0.006); // the dialog shows more digits
  await soon.ok(() => button("Export", dialog).isEnabled());
  await button("Cancel", dialog).click();
  const bevel = 1.1 * parseFloat(reached) * Math.tan(Math.PI / 3); // more than the draft angle of 60 degrees needs
  await enter(option("Rim width"), (bevel + 1).toFixed(2));
  await enter(option("Rim bevel"), bevel.toFixed(2));
  await untilReady(page);
  await soon.equal(async () => Number(await option("Rim bevel").inputValue()), Number(bevel.toFixed(2)));
  await undo();
  await enter(option("Rim bevel"), "0.3");
  await page.getByText(/^Rim bevel: expected at least [\d.]+ mm, so that the rim of/).waitFor();
  await soon.equal(() => option("Rim bevel").inputValue(), "");
  await button("Drop the draft angle").click();
  await reach().getByText("draft angle").waitFor({state: "hidden"});
  await soon.equal(() => option("Draft angle").inputValue(), "");
  await undo(4);
});

test("steps numbers of the plate by arrow keys", async () => {
  const rim = labelled("Rim width");
  await enter(rim, "3");
  const kept = async () => {
    const {steps, at} = await engine.kept({path: scan});
    return [steps[at - 1].options.rim, steps[at].options.rim];
  };
  await eventually(async () => assert.equal((await kept())[1], 3));
  await rim.press("ArrowUp");
  await soon.equal(() => rim.inputValue(), "3.1");
  await rim.press("Shift+ArrowDown");
  await soon.equal(() => rim.inputValue(), "3.09");
  await eventually(async () => assert.deepEqual(await kept(), [3, 3.09])); // all keys make one step, after a pause
  await undo();
  await soon.equal(() => rim.inputValue(), "3");
  await undo();
});

test("takes back with Escape what a point of the curve is dragged to, and draws no refused curve", async () => {
  await preset().selectOption("Bold edges first");
  const point = page.getByRole("slider", {name: "Curve point 2 of 4", exact: true});
  await point.evaluate((element) => element.scrollIntoView({block: "center"}));
  const value = () => point.getAttribute("aria-valuenow"), before = await value();
  const [x, y] = await middleOf(point);
  await takesDragBack(point, value, [0, -25]);
  await drag([x, y], [x, y - 20]);
  await soon.notEqual(() => value(), before, "the next drag counts again");
  await preset().selectOption("As Edge emphasis says");
});

test("adds a point to the tone curve by a double click, which Delete removes", async () => {
  const curve = page.locator("#curve svg"), count = () => curve.locator("circle").count(), before = await count();
  await curve.scrollIntoViewIfNeeded();
  const {x, y, width, height} = await curve.boundingBox(), at = {x: 0.4 * width, y: 0.3 * height};
  await curve.dblclick({position: at});
  if (found.name === "firefox") // see doubleClick()
    await curve.dispatchEvent("dblclick", {clientX: x + at.x, clientY: y + at.y});
  await soon.equal(() => count(), before + 1);
  await soon.equal(() => page.evaluate(() => getSelection().toString()), "");
  await page.keyboard.press("Delete");
  await soon.equal(() => count(), before);
  await undo(2);
});

test("shows and takes inches, and keeps millimetres", async () => {
  await set("Longer side in mm", 101.6);
  await page.getByRole("combobox", {name: "Unit of lengths"}).selectOption("inch");
  await soon.equal(() => text("Longer side in inches"), "4.000");
  await set("Longer side in inches", "2 1/2".replace(" ", "+"));
  await set("Height in inches", "1/8");
  await soon.equal(() => text("Height in inches"), "0.125");
  await page.getByText(/points.*height 0\.125 in/).waitFor();
  await field("Height in inches").press("ArrowUp");
  await soon.equal(() => text("Height in inches"), "0.130");
  await set("Height in inches", "4mm");
  await soon.equal(() => text("Height in inches"), "0.157");
  await page.reload();
  await page.getByText(/points.*height/).waitFor();
  await page.getByRole("combobox", {name: "Unit of lengths"}).selectOption("mm");
  await soon.equal(() => text("Longer side in mm"), "63.5");
  await soon.equal(() => text("Height in mm"), "4.00");
});

test("exports when Enter is pressed", async () => {
  await openExport();
  const [file] = await savedFiles(found, page, 1, () => enter(labelled("File name"), "medal"));
  assert.equal(file.name, "medal.stl");
  await exportDialog().waitFor({state: "hidden"});
});

test("says what was saved of an export that is cancelled", async () => {
  const dialog = exportDialog();
  let asked = 0;
  await page.route("**/api/export", (route) => asked++ === 0 && route.continue()); // lets only the first file pass
  for (const [written, saved] of [["2 of 2", "Saved: scan.stl."], ["1 of 2", "Nothing was saved."]]) {
    await openExport();
    await dialog.getByRole("checkbox", {name: /^3MF/}).check();
    await dialog.getByRole("button", {name: "Export"}).click();
    await dialog.getByText(`Writing file ${written}`).waitFor();
    await dialog.getByRole("button", {name: "Cancel"}).click();
    await toast().getByText(`Cancelled. ${saved}`).waitFor();
  }
  await page.unroute("**/api/export");
});

// Returns the height that the slider marks as reachable or reached.
const marked = async () => (await page.getByTitle(/^Reach(able|ed) with(out)? steps at depth jumps: [\d.]+ mm$/)
  .getAttribute("title")).match(/[\d.]+ mm/)[0];

// Returns the height and the thickness in the status line and in the export dialog.
async function toldSizes() {
  await untilReady(page);
  const shown = (await page.locator("#numbers").innerText()).match(/height ([\d.]+).*× ([\d.]+) mm/).slice(1);
  await openExport();
  const [, thick, high] = (await page.locator("#export-size").innerText()).match(/× ([\d.]+) mm, relief ([\d.]+)/);
  await button("Cancel", exportDialog()).click();
  return {shown, exported: [high, thick]};
}

test("tells the same height and thickness everywhere", async () => {
  await set("Height in mm", 3.175);
  await soon.equal(() => text("Height in mm"), "3.175");
  await untilTold(/height 3\.175 mm/);
  await soon.equal(() => text("Plate thickness in mm"), "3.0"); // the thickness of the plate below the relief
  await soon.deepEqual(() => toldSizes(), {shown: ["3.175", "6.18"], exported: ["3.175", "6.18"]});
  await radio("Measure").click();
  await page.locator("#overlay").getByText("6.18 mm thick").waitFor();
  await radio("Light").click();
  await labelled("Outline").selectOption("round");
  await set("Height in mm", 300);
  await reach().getByText(/at most|keeps the height at/).waitFor();
  const {shown, exported} = await toldSizes();
  assert.deepEqual(shown, exported);
  assert.ok(Math.abs(shown[1] - shown[0] - 3) < 0.006, `${shown}`);
  await undo(3);
});

test("marks the height that can be reached, and loosens what limits it", async () => {
  await set("Longer side in mm", 60);
  await untilReady(page);
  const reachable = async () => parseFloat(await marked()), most = await reachable();
  await set("Steepest wall in degrees", 30);
  let limited;
  await eventually(async () => assert.ok((limited = await reachable()) < most, `${limited} of ${most}`));
  await set("Height in mm", 300); // out of reach even with steps at depth jumps
  await reach().getByText(/The steepest wall keeps the height at [\d.]+ mm/).waitFor();
  await soon.equal(() => field("Height in mm").getAttribute("aria-invalid"), "true");
  const reached = (await reach().innerText()).match(/[\d.]+ mm/)[0];
  await page.getByTitle(`Out of reach: the relief is ${reached} high`).waitFor();
  await page.keyboard.press("Control+e"); // the file will not have the requested height
  await exportDialog().getByText(/^A height of [\d.]+ mm is out of reach here\.$/).waitFor();
  await button("Cancel", exportDialog()).click();
  await button("Allow steeper walls").click();
  await soon.equal(() => text("Steepest wall in degrees"), "85");
  await untilReady(page);
  await eventually(async () => assert.ok((await reachable()) > most, `${await reachable()} of ${most}`));
});

test("marks the height that the view reaches which is shown", async () => {
  await set("Height in mm", 3); // easily reached
  await untilReady(page);
  const front = await marked();
  for (const view of ["Left", "Front"]) {
    await chooseView(view);
    await eventually(async () => {
      await untilReady(page);
      assert.equal((await marked()) === front, view === "Front");
    });
  }
});

test("says what a plate leaves to who types a longer side than that", async () => {
  const plate = labelled("Plate size");
  await enter(plate, "60x50");
  await untilPiece("60.00 × 50.00");
  await set("Longer side in mm", 30);
  await set("Longer side in mm", 90);
  await page.getByText(/^The plate leaves [\d.]+ mm for the longer side: the figure is as large as that\.$/).waitFor();
  await soon.ok(async () => Number(await text("Longer side in mm")) < 50);
  await undoAll(page, async () => (await plate.inputValue()) === "");
});

test("names the tone curve, the walls and the view where they limit the height, and loosens them", async () => {
  await preset().selectOption("Fine detail first");
  await set("Height in mm", 2000);
  await reach().getByText(/^The tone curve keeps the height at [\d.]+ mm\./).waitFor();
  await button("Drop the tone curve").click();
  await soon.equal(() => preset().inputValue(), "");
  await reach().getByText(/^The steepest wall keeps the height at [\d.]+ mm\./).waitFor();
  await button("Allow steeper walls").click();
  await reach().getByText(/^This view reaches [\d.]+ mm at most\./).waitFor();
  await button("Choose view", reach()).click();
  await page.getByRole("dialog", {name: "Choose the view"}).waitFor();
  await page.keyboard.press("Escape");
  await undo(4);
});

test("can redo after a drag that was taken back, and ends none after another slider's pause", async () => {
  const [heights, counts] = await page.evaluate(async () => {
    const {Document, FIRST} = await import(new URL("document.js", location));
    const [doc, other] = [1, 2].map(() => new Document(() => {})), counts = [];
    const seen = [], see = () => seen.push(doc.now.options.height);
    for (const each of [doc, other]) each.begin(FIRST);
    for (const height of [6, 7]) doc.change({options: {height}});
    doc.undo();
    for (const height of [8, 9]) doc.change({options: {height}}, "height");
    see();
    doc.cancelGesture();
    see();
    doc.redo();
    see();
    for (const [height, ended] of [[6, "width"], [7, "height"], [8, null]]) {
      other.change({options: {height}}, "height");
      counts.push(other.steps.length);
      other.endGesture(ended);
    }
    return [seen, counts];
  });
  assert.deepEqual([heights, counts], [[9, 6, 7], [2, 2, 3]]);
});

test("shows no mark of the piece before while another scan opens", async () => {
  const marks = () => page.locator("#overlay > *").count(), other = path.join(folder, "other.ply"), complaints = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  writeSample("shell", 5000, other);
  await radio("Place").click();
  await eventually(async () => assert.ok(await marks() > 8));
  let open;
  await page.route("**/api/open", (route) => (open = () => route.continue()));
  await page.locator("#file").setInputFiles(other);
  await page.getByText("other.ply", {exact: true}).waitFor();
  await soon.equal(() => marks(), 0);
  await page.locator("#stage").click({position: {x: 30, y: 30}}); // there is no figure to move yet
  await page.mouse.wheel(0, 100);
  await page.locator("#stage").press("ArrowLeft");
  await eventually(() => open());
  await page.getByText(/of 5,000 points/).waitFor();
  await eventually(async () => assert.ok(await marks() > 8));
  assert.deepEqual(complaints, []);
});
