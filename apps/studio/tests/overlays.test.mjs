// Tests texts and lines over and beside the piece, on a desk and a phone: messages, labels of measurements, and
// numbers.
import assert from "node:assert/strict";
import {DESK, PHONE, TABLET, browser, button, choose, drag, engine, found, middleOf, option, page, pieceSize,
  plateLength, press, radio, scan, soon, takeBack, test, toast, touchScreen, undo, undoAll, withPage} from
  "./page_suite.mjs";
import {enter, eventually, untilReady} from "./support.mjs";

const SCREENS = [DESK, TABLET, PHONE];

withPage("shell", 8000);

const overlap = (a, b) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

test("closes by the keyboard a line that offers something, and does what it offers", async () => {
  const offer = () => page.evaluate(async () => {
    const {offer, toast} = await import(new URL("messages.js", location));
    window.takeBack = offer("A scan is not found.", "Locate it", () => toast("Located."));
  });
  await offer();
  await button("Locate it").focus();
  await page.keyboard.press("Tab");
  await soon.equal(() => page.evaluate(() => document.activeElement.ariaLabel), "Dismiss");
  await page.keyboard.press("Enter");
  await toast().waitFor({state: "hidden"});
  await offer();
  await button("Locate it").click();
  await toast().getByText("Located.").waitFor();
  await page.evaluate(() => window.takeBack()); // the offer has gone already, so the message stays
  await soon.ok(() => toast().isVisible());
  await button("Dismiss").click();
});

// Each measured line ends near the label of the relief's height or width, so that the line's own label could cover that
// label.
test("keeps the labels of measures apart", async () => {
  for (const screen of SCREENS) {
    await page.setViewportSize(screen);
    await choose("Measure");
    const labels = () => page.locator("#overlay rect.ground").evaluateAll((all) =>
      all.map((rect) => rect.getBoundingClientRect().toJSON()));
    await eventually(async () => assert.equal((await labels()).length, 5));
    const stage = await page.locator("#stage").boundingBox(), figure = await page.locator("#overlay .bounds").boundingBox();
    if (screen === SCREENS[0]) // other screens have no space beside the plate, so their labels are in the corners
      for (const label of await labels()) assert.ok(!overlap(label, figure), `${JSON.stringify(label)} on the figure`);
    for (const {x, y, width, height} of (await labels()).slice(0, 2)) {
      const [left, top] = [Math.max(stage.x + 5, x + width / 2 - 20), y + height / 2 + 8];
      await drag([left, top], [left + 40, top]);
      await page.mouse.move(left + 40, top + 1);
      await eventually(async () => assert.ok((await labels()).length >= 7));
      const all = await labels();
      for (const [i, a] of all.entries())
        for (const b of all.slice(0, i)) assert.ok(!overlap(a, b), `${JSON.stringify([a, b])} at ${screen.width}`);
    }
    await page.mouse.move(0, 0);
    await page.reload();
    await untilReady(page);
  }
});

// Returns {length, mm} of the scale bar: its length in pixels, and in mm of the piece.
const scaleBar = () => page.evaluate(() => {
  const {width} = document.querySelector("#overlay path.scale").getBoundingClientRect();
  const [, number, unit] = document.querySelector("#overlay text.scale").textContent.match(/^([\d.]+) (mm|in)$/);
  return {length: width, mm: number * (unit === "in" ? 25.4 : 1)};
});

test("tells the scale by a bar of a round length, and by rulers that begin at the piece's corner", async () => {
  await page.setViewportSize(SCREENS[0]);
  await choose("Measure");
  const [mm] = await pieceSize(), scale = (await plateLength()) / mm;
  const numbers = await page.locator('#overlay text.scale[text-anchor="middle"]').evaluateAll((all) =>
    all.map((text) => ({at: Number(text.getAttribute("x")), mm: Number(text.textContent)})));
  assert.ok(numbers.length > 4);
  const zero = numbers.find((number) => number.mm === 0).at, left = await page.locator("#overlay line.dimension")
    .evaluateAll((lines) => Math.min(...lines.map((line) => line.getAttribute("x1"))));
  assert.ok(Math.abs(zero - left) < 6, `0 at ${zero}, the piece at ${left}`);
  for (const {at, mm} of numbers) assert.ok(Math.abs(at - zero - mm * scale) < 0.5, `${mm} at ${at}`);
  await radio("Light").click();
  await eventually(async () => assert.equal(await page.locator("#overlay path.scale").count(), 1));
  for (const unit of ["mm", "in"]) {
    await page.getByLabel("Unit of lengths").selectOption(unit);
    const bar = await eventually(scaleBar);
    assert.ok(Math.abs(bar.length - bar.mm * scale) < 3, JSON.stringify(bar));
  }
  await page.getByLabel("Unit of lengths").selectOption("mm");
  const before = await scaleBar();
  await page.locator("#stage").focus();
  for (let step = 0; step < 8; ++step) await page.keyboard.press("+"); // zooms to 4.3 times the size
  await untilReady(page);
  await eventually(async () => {
    const bar = await scaleBar();
    assert.ok(bar.mm < before.mm && Math.abs(bar.length - bar.mm * scale * 1.2 ** 8) < 5, JSON.stringify(bar));
  });
  await button("Fit").click();
  await untilReady(page);
});

// The engine refuses pictures of more than eight million pixels.
test("draws no more pixels on a large screen than the engine makes", async () => {
  const large = await browser.newContext({viewport: {width: 2560, height: 1440}, deviceScaleFactor: 2});
  const screen = await large.newPage();
  await screen.goto(engine.address);
  await untilReady(screen);
  const {width, height} = await screen.locator("#picture").evaluate(({width, height}) => ({width, height}));
  assert.ok(width * height > 6e6 && width * height <= 8e6, `${width} x ${height}`);
  await radio("Crop", screen).click();
  await screen.locator("#crop-frame .frame").waitFor();
  await soon.equal(() => screen.getByRole("alert").filter({hasText: /million/}).count(), 0);
  await large.close();
});

// Returns the offset in pixels between the edge of the model and that of the relief, for each quarter of the figure.
const edgesOff = () => page.evaluate(async () => {
  const {width, height} = document.querySelector("#picture");
  const edges = (id) => {
    const {data} = document.querySelector(id).getContext("2d").getImageData(0, 0, width, height);
    return Float32Array.from({length: width * height}, (_, i) => {
      const at = (j) => data[4 * j + 3] / 255 * data[4 * j + 1];
      return Math.min(60, Math.hypot(at(i + 1) - at(i), at(i + width) - at(i)) || 0);
    });
  };
  const [model, relief] = [edges("#before"), edges("#picture")], [low, high] = window.figure;
  const alike = ([left, top, right, bottom], dx, dy) => {
    let sum = 0;
    for (let y = top; y < bottom; ++y)
      for (let x = left; x < right; ++x) sum += relief[y * width + x] * model[(y + dy) * width + x + dx];
    return sum;
  };
  const [middleX, middleY] = [0, 1].map((k) => Math.round((low[k] + high[k]) / 2));
  const quarters = [[low[0], low[1], middleX, middleY], [middleX, low[1], high[0], middleY],
    [low[0], middleY, middleX, high[1]], [middleX, middleY, high[0], high[1]]];
  return quarters.map((quarter) => {
    let best = [0, 0, 0];
    for (let dy = -12; dy <= 12; ++dy)
      for (let dx = -12; dx <= 12; ++dx) {
        const sum = alike(quarter, dx, dy);
        if (sum > best[0]) best = [sum, dx, dy];
      }
    return Math.max(Math.abs(best[1]), Math.abs(best[2]));
  });
});

// Returns the opacity of the model's picture just inside the left, right, upper and lower edge of the piece, and at the
// corners of the piece's box. A round piece does not cover the corners.
const plateOpacity = () => page.evaluate(() => {
  const canvas = document.querySelector("#before"), [wide, high] = window.piece, context = canvas.getContext("2d");
  const near = [[-0.48, 0], [0.48, 0], [0, -0.48], [0, 0.48]], corners = [-0.45, 0.45].flatMap((x) => [[x, -0.45], [x, 0.45]]);
  return [...near, ...corners].map(([x, y]) => context.getImageData(Math.round(canvas.width / 2 + x * wide),
    Math.round(canvas.height / 2 + y * high), 1, 1).data[3]);
});

test("lays the model over the relief, wherever that stands on its plate, and mirrored", async () => {
  await page.setViewportSize(SCREENS[0]);
  await page.evaluate(() => document.querySelector("#stage").addEventListener("picture", ({detail: {facts}}) => {
    const {width, height, pixels_per_mm: scale, relief_mm: [[left, bottom], [right, top]]} = facts;
    window.piece = facts.size_mm.map((mm) => mm * scale);
    window.figure = [[left, -top], [right, -bottom]]
      .map(([x, y]) => [Math.round(width / 2 + x * scale), Math.round(height / 2 + y * scale)]);
  }));
  await button("Compare").click();
  const kinds = {relief: {"#plate": "200x150", "#shift": "30,10"}, coin: {"#diameter": "60"}, die: {}};
  for (const [kind, fields] of Object.entries(kinds)) {
    await page.locator(`[data-kind="${kind}"]`).click();
    await page.locator("[data-material=plaster]").click(); // like the model; edges of metal look different
    for (const [field, value] of Object.entries(fields)) await enter(page.locator(field), value);
    await eventually(async () => {
      await untilReady(page);
      const off = (await edgesOff()).sort((a, b) => a - b); // sloping walls or the rim may shift one quarter's edges
      assert.ok(off[2] <= 2, `${kind}: ${off}`);
      if (kind === "coin") assert.deepEqual(await plateOpacity(), [255, 255, 255, 255, 0, 0, 0, 0]);
    });
  }
  await page.locator("#stage").press("Escape");
  await page.getByRole("button", {name: "Compare", pressed: false}).waitFor();
  await page.locator('[data-kind="relief"]').click();
});

test("takes a pen as it takes a mouse, whatever else touches the screen", async (context) => {
  if (found.name !== "chromium") return context.skip("only Chromium takes made-up pens");
  const {touched: tablet, cdp, send: palm, close} = await touchScreen(TABLET);
  await undoAll(tablet);
  await tablet.evaluate(() => ["pointerdown", "pointermove"].forEach((type) =>
    document.querySelector("#stage").addEventListener(type, (event) => (window.pointer = event.pointerType), true)));
  const pen = (type, x, y, rest = {}) => cdp.send("Input.dispatchMouseEvent",
    {type, x, y, pointerType: "pen", button: "left", buttons: 1, force: 0.5, clickCount: 1, ...rest});
  const {x, y, width, height} = await tablet.locator("#stage").boundingBox(), middle = [x + width / 2, y + height / 2];
  const sun = () => tablet.locator("#overlay .sun").evaluate((circle) =>
    ["cx", "cy"].map((name) => Number(circle.getAttribute(name))));
  await pen("mousePressed", ...middle);
  await pen("mouseMoved", middle[0] + 60, middle[1] - 40);
  await palm("touchStart", [{x: x + 30, y: y + 30, id: 5}]);
  await palm("touchEnd", []);
  await pen("mouseMoved", middle[0] + 80, middle[1] - 50);
  await soon.equal(() => tablet.evaluate(() => window.pointer), "pen");
  const [sunX, sunY] = await sun();
  assert.ok(Math.hypot(sunX - width / 2 - 80, sunY - height / 2 + 50) < 2, `${sunX} ${sunY}`);
  await pen("mouseReleased", middle[0] + 80, middle[1] - 50, {buttons: 0});
  await soon.equal(() => tablet.locator("#overlay .sun").count(), 0);
  await undo(1, tablet);
  await soon.ok(() => button("Undo", tablet).isDisabled(), "one gesture is one step");
  await radio("Crop", tablet).click();
  const frame = tablet.locator("#crop-frame .frame"), whole = await frame.boundingBox();
  await pen("mousePressed", whole.x + whole.width, whole.y + whole.height / 2);
  await pen("mouseMoved", whole.x + whole.width / 2, whole.y + whole.height / 2);
  await pen("mouseReleased", whole.x + whole.width / 2, whole.y + whole.height / 2, {buttons: 0});
  await eventually(async () => assert.match(await tablet.locator("#crop").inputValue(), /^0,0,0\.(49|5)\d*,1$/));
  await takeBack(1, tablet);
  await close();
});

test("scales and turns the figure by two fingers in one step, and tells how it is placed", async (context) => {
  await page.setViewportSize(SCREENS[0]);
  const mouseHint = page.getByText("Drag the figure to move it, with Shift to turn it; the wheel scales it");
  await radio("Place").click();
  await mouseHint.waitFor();
  await radio("Light").click();
  await mouseHint.waitFor({state: "hidden"});
  if (found.name !== "chromium") return context.skip("only Chromium takes made-up touches");
  const {touched: phone, send, fingers, close} = await touchScreen(PHONE, true), longer = option("width", phone);
  await undoAll(phone);
  await radio("Place", phone).click();
  await phone.getByText("One finger moves the figure, two scale and turn it").waitFor();
  await soon.ok(async () => !await phone.getByText("Drag the figure").isVisible());
  await untilReady(phone);
  const plate = () => plateLength(phone), step = async () => {
    const {steps, at} = await engine.kept({path: scan});
    return {at, ...steps[at].options};
  };
  const [whole, wide, before] = [Number(await longer.inputValue()), await plate(), await step()];
  const pinch = async (degrees) => { // fingers move from 100 pixels apart to 60, and turn counterclockwise
    await send("touchStart", fingers(100).slice(0, 1));
    await send("touchStart", fingers(100));
    for (let i = 1; i <= 8; ++i) await send("touchMove", fingers(100 - 5 * i, i * degrees / 8));
  };
  await pinch(4); // fingers that only scale turn a little, too
  await send("touchEnd", []);
  const untilScaled = () => eventually(async () => {
    const {width} = await step();
    assert.ok(Math.abs(width / whole - 0.6) < 0.01, `${width} of ${whole}`);
  });
  await untilScaled();
  await untilReady(phone);
  const scaled = await step();
  assert.deepEqual([scaled.view, scaled.up, scaled.at], ["front", "", before.at + 1]);
  await soon.ok(async () => Math.abs(await plate() - wide) < 2, "the plate and the picture stay as they are");
  await undo(1, phone);
  await eventually(async () => assert.equal((await step()).at, before.at));
  await untilReady(phone);
  await soon.equal(async () => Number(await longer.inputValue()), whole);
  await pinch(40);
  await phone.locator("#overlay").getByText("40° to the left", {exact: true}).waitFor();
  await send("touchEnd", []);
  await eventually(async () => assert.notEqual((await step()).up, ""));
  const turned = await step(), [upX, upY] = turned.up.split(",").map(Number);
  // The model turns counterclockwise, so the direction `up` in the model's coordinates turns clockwise.
  assert.ok(Math.abs(Math.atan2(upX, upY) * 180 / Math.PI - 40) < 0.6, turned.up);
  assert.equal(turned.at, before.at + 1);
  await untilScaled();
  await takeBack(1, phone);
  await close();
});

test("tells frames in a second while things move, and not at rest", async () => {
  await page.setViewportSize(SCREENS[2]);
  await untilReady(page);
  const numbers = page.locator("#numbers"), [x, y] = await middleOf(page.locator("#stage"));
  await page.evaluate(() => {
    window.told = [];
    new MutationObserver(() => window.told.push(document.querySelector("#numbers").textContent))
      .observe(document.querySelector("#numbers"), {childList: true});
  });
  await radio("Light").click();
  await press([x, y]);
  await eventually(async () => {
    for (let i = 0; i < 40; ++i) await page.mouse.move(x + 2 * i, y - 50 + i);
    assert.ok(await page.evaluate(() => window.told.some((text) => /\d frames\/s/.test(text))));
  });
  await page.mouse.up();
  await untilReady(page);
  await soon.doesNotMatch(() => numbers.textContent(), /frames\/s/);
});
