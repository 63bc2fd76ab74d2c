// Tests that each state of the page fits each screen, that all its controls can be reached, and that it breaks no rule
// of the accessibility checker axe.
import assert from "node:assert/strict";
import {DESK, PHONE, TABLET, browser, button, folder, found, page, skip, soon, startEngine, test,
  untilLaidOut, withBrowser} from "./page_suite.mjs";
import {STATES, showScene} from "./states.mjs";
import {openPanels, untilReady, writeScans} from "./support.mjs";

const axe = await import("axe-core").then(({default: {source}}) => source, () => null);
const missing = axe ? false : "axe-core is not installed (npm ci --prefix apps/studio/tests)";

const LOW = {width: 640, height: 400}; // a desk screen at a zoom of 200 %
const SCREENS = [DESK, PHONE, LOW, TABLET, {width: 3840, height: 2160}];
let scans;

withBrowser(async (isAnew) => {
  scans = writeScans(folder, 6000);
  const first = await (await browser.newContext({viewport: DESK})).newPage();
  await first.goto((await startEngine()).address);
  await first.locator("#samples button").first().waitFor();
  if (isAnew) await openScan(first);
  return first;
});

// Opens the first scan with all panels open, and closes the offer of the tour.
async function openScan(of) {
  await of.locator("#file").setInputFiles(scans[0]);
  await untilReady(of);
  await openPanels(of);
  await of.locator("#toast").waitFor();
  await button("Dismiss", of).click();
}

// Runs in the page. Returns the parts that scroll although they must not. No part may scroll horizontally. The parts
// around the picture may not scroll vertically. On a desk, dialogs and the start page may not scroll vertically,
// either.
function scrolling() {
  const name = (it) => it.id || it.className || it.localName, all = [...document.querySelectorAll("*")];
  const around = "html, body, main, .studio, .work, #stage, #table, .status";
  const fixed = new Set(document.querySelectorAll(innerWidth < 1280 ? around : `${around}, dialog, .start`));
  const scrolls = (side) => ["auto", "scroll"].includes(side);
  const upwards = all.filter((it) => it.scrollHeight > it.clientHeight + 1 && fixed.has(it));
  const sideways = all.filter((it) => it.scrollWidth > it.clientWidth + 1 &&
    (fixed.has(it) || scrolls(getComputedStyle(it).overflowX)));
  return [...upwards, ...sideways].map(name);
}

// Runs in the page. Returns the elements that extend beyond the left or right edge of the screen.
function beyond() {
  return [...document.querySelectorAll("body *")].filter((it) => it.checkVisibility() && !it.closest("defs"))
    .filter((it) => {
      const {left, right, width} = it.getBoundingClientRect();
      return width > 0 && (left < -1 || right > innerWidth + 1);
    }).map((it) => it.outerHTML.slice(0, 90));
}

// Runs in the page. Returns the controls of a part that a user cannot reach even by scrolling.
function unreached(part) {
  const problem = (it) => {
    it.scrollIntoView({block: "nearest", inline: "nearest"});
    const {left, top, right, bottom, width, height} = it.getBoundingClientRect();
    if (left < -1 || top < -1 || right > innerWidth + 1 || bottom > innerHeight + 1) return "beyond the screen";
    for (let parent = it.parentElement; parent; parent = parent.parentElement)
      if (getComputedStyle(parent).overflowY === "hidden" && (parent.scrollTop || parent.scrollLeft))
        return `only where ${parent.className || parent.localName} is scrolled`;
    const [x, y] = [left + width / 2, top + height / 2], label = it.closest("label");
    const over = [[x, y], [left + 3, y], [right - 3, y], [x, top + 3], [x, bottom - 3]]
      .map((place) => document.elementFromPoint(...place)).find((top) => !it.contains(top) && !label?.contains(top));
    return over === undefined ? "" : `below ${over?.outerHTML.slice(0, 60)}`;
  };
  const controls = document.querySelector(part).querySelectorAll("button, input, select, summary, [role=slider]");
  return [...controls].filter((it) => it.checkVisibility()).map((it) => [problem(it), it.outerHTML.slice(0, 90)])
    .filter(([what]) => what);
}

// Runs in the page. Returns the texts that are cut off. A scan's title may be cut off if it is beside the buttons.
function cut() {
  const title = innerWidth < 800 && innerHeight > 560 ? "#title, " : "";
  return [...document.querySelectorAll(`${title}button, legend, h2, #numbers, .labels span, .pair > span`)]
    .filter((it) => it.checkVisibility() && !it.matches(".hidden") && getComputedStyle(it).display !== "inline")
    .filter((it) => it.scrollWidth > it.clientWidth + 1 && !it.matches(".by-file .quiet"))
    .map((it) => it.outerHTML.slice(0, 90));
}

// Runs in the page. Returns the texts that are too small. The limit is 12.5 pixels if the page's font has 14.5 pixels,
// and grows with that font. A text in a drawing has its stated size only after the drawing was redrawn at its new size.
function small() {
  const least = 12.5 / 14.5 * parseFloat(getComputedStyle(document.documentElement).fontSize);
  const hasText = (it) => it.matches("input, select") || [...it.childNodes].some((node) =>
    node.nodeType === Node.TEXT_NODE && node.data.trim() !== "");
  const size = (it) => parseFloat(getComputedStyle(it).fontSize);
  return [...document.querySelectorAll("body *")].filter((it) => it.checkVisibility() && hasText(it))
    .filter((it) => !it.matches(".mark") && size(it) < least).map((it) => [size(it), it.outerHTML.slice(0, 90)]);
}

// Runs in the page. Returns the rows of tool buttons if there is more than one row on a desk, or more than two on a
// phone. Low screens show the tools in a column, which is always accepted.
function wrapped() {
  if (innerHeight <= 560) return [];
  const boxes = [...document.querySelectorAll(".tools button")].map((it) => it.getBoundingClientRect());
  const middles = new Set(boxes.map(({top, height}) => Math.round(top + height / 2)));
  return innerWidth === 820 || middles.size <= (innerWidth < 800 ? 2 : 1) ? [] : [...middles];
}

// Returns the faults of the page on a screen, by kind. The page must already have the screen's size.
async function misfits(screen, part) {
  await untilLaidOut();
  const all = [];
  for (const check of [scrolling, beyond, wrapped, small, cut, unreached])
    all.push({width: screen.width, kind: check.name, found: await page.evaluate(check, part)});
  return all.filter(({found}) => found.length > 0);
}

// Axe checks the page in these media. In Firefox the last one is enough, since axe reads styles and not pixels.
const ALL_MEDIA = [{screen: PHONE}, {screen: PHONE, colorScheme: "dark"}, {colorScheme: "dark"},
  {forcedColors: "active"}, {}];
const MEDIA = found.name === "firefox" ? ALL_MEDIA.slice(-1) : ALL_MEDIA;

async function assertFits(part = "body") {
  for (const screen of SCREENS) {
    await page.setViewportSize(screen);
    await soon.deepEqual(() => misfits(screen, part), []);
  }
}

// Returns the rules of axe that elements of the page break, each with the element.
async function findings() {
  if (!await page.evaluate(() => "axe" in window)) await page.evaluate(axe);
  return page.evaluate(async () => (await window.axe.run(document, {resultTypes: ["violations"]})).violations
    .flatMap(({id, nodes}) => nodes.map(({target}) => `${id}: ${target}`)));
}

// Runs as a subtest of the state's test. If axe is missing, the subtest is skipped; in CI it fails.
const hasNoFindings = (state) => state.test("has no findings of axe", {skip: !process.env.CI && missing}, async () => {
  assert.ok(!missing, missing);
  for (const {screen = DESK, colorScheme = "light", forcedColors = "none"} of MEDIA) {
    await page.setViewportSize(screen);
    await page.emulateMedia({colorScheme, forcedColors});
    await soon.deepEqual(() => findings(), [], JSON.stringify({screen, colorScheme, forcedColors}));
  }
});

test("fits every screen before the first scan", async (state) => {
  await assertFits();
  await hasNoFindings(state);
  await openScan(page);
});

test("leaves the picture room on a phone", async () => {
  await page.setViewportSize(PHONE);
  const {width, height} = await page.locator("#stage").boundingBox();
  assert.ok(width === PHONE.width && height > 330, `${width} x ${height}`);
  await page.setViewportSize(DESK);
});

for (const [name, {enter, leave, part}] of Object.entries(STATES))
  test(`fits every screen: ${name}`, async (state) => {
    try {
      await enter(page);
      await assertFits(part);
      await hasNoFindings(state);
    } finally {
      await page.emulateMedia({colorScheme: "light", forcedColors: "none"});
      await page.setViewportSize(DESK);
      await leave(page);
    }
  });

test("fits every screen: a scene", async (state) => {
  await showScene(page, scans);
  // Closes the message that documents are stored, which would stay for eight seconds.
  await page.locator("#toast").evaluate((toast) => toast.hidden || toast.querySelector(".close").click());
  await assertFits();
  await hasNoFindings(state);
});
