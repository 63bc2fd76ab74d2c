// Tests the page on low screens, with large fonts, with forced colours and with touch: users can see and reach all
// parts, and only the intended gestures move them.
import assert from "node:assert/strict";
import {DESK, PHONE, TABLET, button, drag, field, found, page, preset, radio, slider, soon, test, touchScreen, undo,
  undoAll, withPage} from "./page_suite.mjs";
import {eventually, openPanels, untilReady} from "./support.mjs";

const ZOOMED = {width: 640, height: 400};

withPage("shell", 6000, () => button("Dismiss").click()); // dismisses the offer of the tour

test("moves the divider of the comparison by its line, and nothing else", async () => {
  const compare = button("Compare");
  await compare.click();
  const {x, y, width, height: high} = await page.locator("#stage").boundingBox();
  const line = () => page.evaluate(() => document.querySelector("#overlay .divide").getAttribute("x1") /
    document.querySelector("#overlay").viewBox.baseVal.width);
  for (const [from, at, to] of [[0.5, 0.15, 0.7], [0.7, 0.5, 0.2], [0.2, 0.85, 0.5]]) {
    await page.mouse.move(x + from * width, y + at * high);
    await soon.equal(() => page.locator("#stage").evaluate((stage) => getComputedStyle(stage).cursor), "ew-resize");
    await drag([x + from * width, y + at * high], [x + to * width, y + 0.4 * high]);
    assert.ok(Math.abs(await line() - to) < 0.01, `${await line()} where ${to} was dragged to`);
    await soon.ok(async () => Math.abs(await page.locator("#split").inputValue() / 1000 - to) < 0.01);
  }
  await soon.ok(() => button("Undo").isDisabled(), "the light stays where it is");
  await drag([x + 0.8 * width, y + 0.5 * high]); // a drag that does not start at the line moves the light
  await soon.ok(() => button("Undo").isEnabled());
  await soon.ok(async () => Math.abs(await line() - 0.5) < 0.01);
  await undo();
  await compare.click();
});

// Returns the colour of an element at the fractions `right` and `down` of its width and height.
const colour = async (locator, right, down) => {
  const bytes = await locator.screenshot();
  return page.evaluate(async ([text, right, down]) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const picture = await createImageBitmap(new Blob([bytes], {type: "image/png"}));
    const canvas = new OffscreenCanvas(picture.width, picture.height), context = canvas.getContext("2d");
    context.drawImage(picture, 0, 0);
    return [...context.getImageData(right * (picture.width - 1), down * (picture.height - 1), 1, 1).data.slice(0, 3)];
  }, [bytes.toString("base64"), right, down]);
};
const apart = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

test("tells in forced colours what is pressed, which material is which, and where sliders run", async (context) => {
  if (found.name !== "chromium") return context.skip("only Chromium takes a wish for forced colours");
  try {
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({forcedColors: "active", colorScheme});
      for (const [pressed, other, ...place] of [["Light", "Orbit", 0.04, 0.5], ["Plaque", "Coin", 0.05, 0.9]])
        await soon.ok(async () =>
          apart(await colour(radio(pressed), ...place), await colour(radio(other), ...place)) > 100, pressed);
      const lock = button("Lock the height"), on = await colour(lock, 0.5, 0.1);
      await lock.click();
      await soon.ok(async () => apart(on, await colour(lock, 0.5, 0.1)) > 100, "the lock");
      await undo();
      const materials = await page.locator("#materials button").all(), seen = [];
      for (const material of materials) seen.push(await colour(material, 0.5, 0.5));
      for (const [i, a] of seen.entries())
        for (const b of seen.slice(0, i)) assert.ok(apart(a, b) > 25, `materials ${JSON.stringify(seen)}`);
      const margin = slider("Margin"), ground = await colour(margin, 0.9, 0.1);
      for (const at of [0.05, 0.95])
        await soon.ok(async () => apart(await colour(margin, at, 0.5), ground) > 100, "slider");
      const go = button("Export"), plain = await colour(go, 0.5, 0.12);
      const line = await Promise.all([0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65].map((right) => colour(go, right, 0.5)));
      assert.ok(line.some((it) => apart(it, plain) > 100), "letters of Export");
    }
  } finally {
    await page.emulateMedia({forcedColors: "none", colorScheme: "light"});
  }
});

test("leaves the picture room at a zoom of 200 %", async () => {
  await page.setViewportSize(ZOOMED);
  const {width, height} = await page.locator("#stage").boundingBox();
  assert.ok(width >= 300 && height >= 300, `${width} x ${height}`);
  for (const [tool, part] of [["Section", "#section"], ["Place", "#place-hint"], ["Measure", "#stage"]]) {
    await radio(tool).click();
    const stage = await page.locator("#stage").boundingBox();
    assert.ok(stage.width >= 300 && stage.height >= 180, `${tool}: ${stage.width} x ${stage.height}`);
    await soon.ok(() => page.locator(part).isVisible());
  }
  // When the notes are opened, they have the same buttons as on a higher screen.
  await page.getByRole("button", {name: /notes? on the scan/}).click();
  await page.locator("#notes").getByRole("button", {name: "Keep the noise"}).waitFor();
  await radio("Light").click();
  await page.setViewportSize(DESK);
  await untilReady(page);
});

test("scrolls the panel by a swipe that begins on a slider, which only a sideways drag or a tap moves", async (context) => {
    if (found.name !== "chromium") return context.skip("only Chromium takes made-up touches");
    const {touched: phone, send, close} = await touchScreen(PHONE, true), inspector = phone.locator(".inspector");
    const undone = button("Undo", phone), height = () => field("Height in mm", phone).inputValue();
    await openPanels(phone);
    await undoAll(phone);
    const swipe = async (range, across, down) => {
      const {x, y, width, height} = await range.boundingBox(), from = {x: x + 0.4 * width, y: y + height / 2};
      await send("touchStart", [from]);
      for (let i = 1; i <= 10; ++i) await send("touchMove", [{x: from.x + across * i, y: from.y + down * i}]);
      await send("touchEnd", []);
      return 0.4 + 10 * across / width;
    };
    const middle = async (range) => {
      await range.evaluate((it) => it.scrollIntoView({block: "center"}));
      return inspector.evaluate(({scrollTop}) => scrollTop);
    };
    for (const range of await phone.locator(".inspector input[type=range]:enabled").all()) {
      if (!await range.isVisible()) continue;
      for (const [across, down] of [[0, -9], [0, 9], [2, -9]]) {
        const before = await range.inputValue(), top = await middle(range), label = await range.getAttribute("aria-label");
        await swipe(range, across, down);
        await eventually(async () => assert.ok(Math.abs(await inspector.evaluate((it) => it.scrollTop) - top) > 20, label));
        await soon.equal(() => range.inputValue(), before, label);
        await soon.ok(() => undone.isDisabled(), label);
      }
    }
    const range = slider("Height", phone), before = await height();
    await middle(range);
    const to = await swipe(range, 6, 0);
    await eventually(async () => assert.ok(Math.abs(await range.inputValue() / 1000 - to) < 0.06, `${to}`));
    await soon.notEqual(() => height(), before);
    await undone.click();
    await soon.equal(() => height(), before);
    await eventually(async () => assert.ok(await undone.isDisabled()));
    const {x, y, width, height: high} = await range.boundingBox();
    await phone.touchscreen.tap(x + 0.8 * width, y + high / 2);
    await eventually(async () => assert.ok(Math.abs(await range.inputValue() / 1000 - 0.8) < 0.06));
    await undone.click();
    await soon.equal(() => height(), before);
    await close();
  });

test("puts names, numbers and sliders in one order, curves within their box, and no dot before the first number", async () => {
    const [name, value, range] = await Promise.all([page.getByText("Denoise", {exact: true}),
      page.locator("#denoise-value"), page.locator("#denoise")].map((it) => it.boundingBox()));
    assert.ok(name.x + name.width < value.x && range.y >= name.y + name.height - 3 && range.width > 200);
    await preset().selectOption("Even"); // this curve runs along the top of its diagram
    const box = await page.locator("#curve svg").boundingBox();
    for (const part of ["path.drawn", "circle"])
      for (const it of await page.locator(`#curve ${part}`).all()) {
        const {x, y, width, height} = await it.boundingBox();
        assert.ok(x > box.x && y > box.y && x + width < box.x + box.width && y + height < box.y + box.height, part);
      }
    await undo();
    for (const screen of [DESK, TABLET, PHONE]) {
      await page.setViewportSize(screen);
      await untilReady(page);
      const before = await page.locator("#numbers span").evaluateAll((all) =>
        getComputedStyle(all.find((it) => it.checkVisibility()), "::before").content);
      assert.equal(before, "none", `${screen.width}`);
    }
    await page.setViewportSize(DESK);
  });

// Runs in the page. Returns the controls and other parts that a message covers.
function covered() {
  const toast = document.querySelector("#toast").getBoundingClientRect();
  const visible = (it) => { // returns the part of an element that is visible in all its scrolling parents
    const box = it.getBoundingClientRect();
    let [left, top, right, bottom] = [box.left, box.top, box.right, box.bottom];
    for (let parent = it.parentElement; parent; parent = parent.parentElement) {
      if (getComputedStyle(parent).overflowY === "visible") continue;
      const cut = parent.getBoundingClientRect();
      [left, top] = [Math.max(left, cut.left), Math.max(top, cut.top)];
      [right, bottom] = [Math.min(right, cut.right), Math.min(bottom, cut.bottom)];
    }
    return {left, top, right, bottom};
  };
  return [...document.querySelectorAll("button, input, select, summary, [role=slider], #stage, .bar, #numbers")]
    .filter((it) => it.checkVisibility() && !it.closest("#toast")).filter((it) => {
      const {left, top, right, bottom} = visible(it);
      return left < right && top < bottom && left < toast.right && right > toast.left && top < toast.bottom &&
        bottom > toast.top;
    }).map((it) => it.outerHTML.slice(0, 80));
}

test("lays a line for people on no control and not on the picture, wherever one has worked", async () => {
  const say = () => page.evaluate(async () => (await import(new URL("messages.js", location)))
    .toast("A scan of a long name.ply is not found at /home/somebody/models/a scan of a long name.ply.", true));
  const dismiss = button("Dismiss");
  for (const screen of [DESK, PHONE, ZOOMED, TABLET]) {
    await page.setViewportSize(screen);
    for (const name of ["Height in mm", "Steepest wall in degrees", "Margin in mm"]) {
      const it = field(name);
      await it.evaluate((input) => (input.scrollIntoView({block: "end"}), input.focus()));
      await say();
      await eventually(async () => assert.deepEqual(await page.evaluate(covered), [], `${name} at ${screen.width}`));
      const box = await it.boundingBox(), {x, y, width, height} = await page.locator("#toast").boundingBox();
      assert.ok(box.y + box.height <= y, `${name} stays in sight at ${screen.width}`);
      assert.ok(x >= 0 && x + width <= screen.width && y + height <= screen.height, `${screen.width}`);
      await dismiss.click();
    }
    await button("Relievo, start page").click();
    await say();
    await eventually(async () => assert.deepEqual(await page.evaluate(covered), [], `start page at ${screen.width}`));
    await dismiss.click();
    await button("Back to the relief").click();
  }
  await page.setViewportSize(DESK);
});
