// Tests the page as one file in Debian's browsers, from a scan to an exported solid. The page is opened from disk and
// from a static server.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import {pathToFileURL} from "node:url";
import {before, test} from "node:test";
import {enter, findBrowser, openPanels, savedFiles, temporaryFolder, writeBallBeforeWall}
  from "../../studio/tests/support.mjs";
import {admesh, eventually, fileAddress, pageWithLittleMemory, serve} from "./support.mjs";
import {missingWebKit, WebKitPage} from "./webkit.mjs";

const relievo = await import(pathToFileURL(path.join(process.env.PACKAGE ?? "build/web/npm", "src/index.js")));
const native = process.env.RELIEVO;
const browsers = {chromium: await findBrowser("chromium"), firefox: await findBrowser("firefox")};
const scans = temporaryFolder();

function waves(rows) {
  const head = `ply\nformat binary_little_endian 1.0\nelement vertex ${rows * rows}\n` +
    "property float x\nproperty float y\nproperty float z\nend_header\n";
  const points = new Float32Array(3 * rows * rows);
  for (let i = 0; i < rows * rows; i++)
    points.set([i % rows, Math.floor(i / rows), 30 * Math.sin(i % rows / 40)], 3 * i);
  return Buffer.concat([Buffer.from(head), Buffer.from(points.buffer)]);
}

before(async () => {
  const shell = await relievo.sample("shell", {points: 20000});
  fs.writeFileSync(path.join(scans, "shell.ply"), shell);
  fs.writeFileSync(path.join(scans, "dense.ply"), await relievo.sample("shell", {points: 100000}));
  fs.writeFileSync(path.join(scans, "urn.ply"), await relievo.sample("still_life", {points: 20000}));
  fs.writeFileSync(path.join(scans, "large.ply"), waves(1500));
  fs.writeFileSync(path.join(scans, "broken.ply"), "ply\nformat ascii 1.0\nelement vertex 2\n");
  const relief = await relievo.make(shell, {heightMm: 3});
  fs.writeFileSync(path.join(scans, "map.png"), relief.heightMapFile("png", {size: 16}));
  const models = [{file: "shell.ply"}, {file: "urn.ply", translate: [2.5, 0, 0]}];
  fs.writeFileSync(path.join(scans, "both.json"), JSON.stringify({models}));
});
const scan = (name) => path.join(scans, name);

// The page in a browser, and the actions of its user.
class Studio {
  constructor(found, page, downloads) {
    Object.assign(this, {found, page, downloads, errors: []});
    page.on("pageerror", (error) => this.errors.push(error.message));
  }

  button(name) {
    return this.page.getByRole("button", {name, exact: true});
  }

  get toast() {
    return this.page.getByRole("alert");
  }

  open(...files) {
    return this.page.locator("#file").setInputFiles(files);
  }

  // Opens a file, and waits until its relief is shown.
  async show(file, points = "20,000") {
    await this.open(file);
    await this.untilReady(points);
  }

  async untilReady(points) {
    await this.page.getByText(new RegExp(`${points} points.*height`)).waitFor();
    await this.page.locator('[role="application"][aria-busy="false"]').first().waitFor();
  }

  get height() {
    return this.page.getByRole("spinbutton", {name: "Height in mm"});
  }

  async setHeight(mm) {
    await enter(this.height, String(mm));
    await this.page.getByText(new RegExp(`height ${mm.toFixed(2)} mm`)).waitFor();
  }

  // Waits for a file that the browser downloads, and returns its path.
  async download(trigger, name) {
    const place = path.join(this.downloads, name), [{bytes}] = await savedFiles(this.found, this.page, 1, trigger);
    fs.writeFileSync(place, bytes);
    return place;
  }

  async exported(name) {
    await this.button("Export").click();
    await this.page.getByText(/triangles$/).waitFor();
    return this.download(() => this.page.locator("#export-go").click(), name);
  }

  savedProject(name) {
    return this.download(async () => {
      await this.page.getByRole("button", {name: /^Save/}).first().click();
      await this.page.locator('#save-dialog button[value="save"]').click();
    }, name);
  }
}

async function newStudio(t, name, address) {
  const found = browsers[name], downloads = temporaryFolder(), browser = await found.launch();
  t.after(() => browser.close());
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, acceptDownloads: true});
  const openPage = async () => {
    const studio = new Studio(found, await context.newPage(), downloads);
    await studio.page.goto(address);
    await studio.page.locator("#samples button").first().waitFor({state: "attached"}); // shows that the page is ready
    return studio;
  };
  return {studio: await openPage(), openPage, context};
}

for (const [name, {skip}] of Object.entries(browsers))
  for (const place of ["from disk", "from a server"])
    test(`${name}, ${place}: from a scan to a solid`, {skip}, async (t) => {
      const address = place === "from disk" ? fileAddress : await serve(t);
      const {studio} = await newStudio(t, name, address);
      await studio.show(scan("shell.ply"));
      await studio.setHeight(2.5);
      const solid = admesh(await studio.exported("shell.stl"));
      assert.ok(Math.abs(solid.height - 5.5) < 1e-5, `${solid.height} mm`);
      assert.deepEqual([solid.parts, solid.repairs], [1, 0]);
      const project = await studio.savedProject("shell.relievo");
      if (native && fs.existsSync(native)) {
        const again = path.join(studio.downloads, "native.stl");
        execFileSync(native, ["make", project, "-o", again, "--quiet"], {stdio: "pipe"});
        assert.deepEqual(admesh(again), solid);
      }
      await studio.page.reload();
      await studio.untilReady("20,000");
      assert.equal(Number(await studio.height.inputValue()), 2.5);
      assert.deepEqual(studio.errors, []);
    });

for (const place of ["from disk", "from a server"])
  test(`WebKit, ${place}: from a scan to a solid`, {skip: missingWebKit()}, async (t) => {
    const CONTROL_A = "\uE009a\uE000", ENTER = "\uE007"; // key codes of WebDriver
    const folder = temporaryFolder(), address = place === "from disk" ? fileAddress : await serve(t);
    const page = await WebKitPage.open(t, address, folder);
    await page.untilThereIs("#samples button");
    await page.type("#file", scan("shell.ply"));
    await page.untilSaid("20,000 points.*height");
    for (const keys of [CONTROL_A, "2.5", ENTER]) await page.type('[aria-label="Height in mm"]', keys);
    await page.untilSaid("height 2\\.50 mm");
    await page.click("#export");
    await page.untilSaid("triangles");
    await page.click("#export-go");
    const solid = admesh(await page.saved("shell.stl"));
    assert.ok(Math.abs(solid.height - 5.5) < 1e-5, `${solid.height} mm`);
    assert.deepEqual([solid.parts, solid.repairs], [1, 0]);
    await page.reload();
    await page.untilSaid("20,000 points.*height 2\\.50 mm");
  });

const options = {skip: browsers.chromium.skip};

test("a project opens with its scan, and several files as a scene", options, async (t) => {
  const {studio, context} = await newStudio(t, "chromium", fileAddress);
  await studio.show(scan("urn.ply"));
  await studio.setHeight(3.25);
  const project = await studio.savedProject("urn.relievo");
  await context.clearCookies();
  const other = await newStudio(t, "chromium", fileAddress);
  await other.studio.show(project);
  assert.equal(Number(await other.studio.height.inputValue()), 3.25);
  await other.studio.open(scan("shell.ply"), scan("urn.ply"), scan("both.json"));
  await other.studio.page.getByText("both.json", {exact: true}).waitFor();
  await other.studio.untilReady("[\\d,]+");
  await other.studio.open(scan("shell.ply"), scan("urn.ply"));
  await other.studio.page.getByText("scene.json", {exact: true}).waitFor();
  await other.studio.untilReady("[\\d,]+");
  const documentOfScene = () => other.studio.page.evaluate(() => location.hash), scene = await documentOfScene();
  fs.mkdirSync(path.join(scans, "others"), {recursive: true});
  for (const [name, copy] of [["urn.ply", "shell.ply"], ["shell.ply", "urn.ply"]]) // the same names, other scans
    fs.copyFileSync(scan(name), scan(path.join("others", copy)));
  await other.studio.open(...["shell.ply", "urn.ply"].map((name) => scan(path.join("others", name))));
  await other.studio.page.waitForFunction((former) => location.hash !== former, scene);
  await other.studio.untilReady("[\\d,]+");
  assert.deepEqual(other.studio.errors, []);
});

test("a base takes an image, which the browser and a project keep", options, async (t) => {
  const {studio} = await newStudio(t, "chromium", fileAddress);
  await studio.show(scan("urn.ply"));
  await openPanels(studio.page);
  const image = (page) => page.locator("[data-option='base-image']");
  await studio.page.locator(".base-image input").setInputFiles(scan("map.png"));
  await image(studio.page).filter({hasText: "map.png"}).waitFor();
  await studio.untilReady("20,000");
  const project = await studio.savedProject("urn.relievo");
  await studio.page.reload();
  await studio.untilReady("20,000");
  assert.equal(await image(studio.page).textContent(), "map.png");
  const {studio: other} = await newStudio(t, "chromium", fileAddress);
  await other.show(project);
  const solids = [await studio.exported("kept.stl"), await other.exported("opened.stl")].map(admesh);
  assert.ok(solids[0].height > 12, `${solids[0].height} mm`); // without the image the height would be 8 mm
  assert.deepEqual(solids[1], solids[0]);
  if (native && fs.existsSync(native)) {
    const made = path.join(studio.downloads, "native.stl");
    execFileSync(native, ["make", project, "-o", made, "--quiet"], {stdio: "pipe"});
    assert.deepEqual(admesh(made), solids[0]);
  }
  assert.deepEqual([...studio.errors, ...other.errors], []);
});

// The file of the font that is built into the program. A text has the same outlines with this file and with the
// built-in font.
const FONT = new URL("../../../src/lettering/fonts/NotoSerif-Bold.subset.ttf", import.meta.url);

test("a legend has the bytes of the native program, and a font by file stays in browser and project", options, async (t) => {
  const {studio} = await newStudio(t, "chromium", fileAddress), {page} = studio;
  const labelled = (label) => page.getByLabel(label, {exact: true});
  const ownFont = (of) => of.getByRole("button", {name: "Font own.ttf: choose another"});
  await studio.show(scan("urn.ply"));
  await openPanels(page);
  await enter(labelled("Resolution"), "0.6"); // such a coarse piece is made quickly
  await enter(labelled("Margin in mm"), "9");
  await studio.button("Add a text").click();
  await enter(labelled("Text"), "ΔΗΜΟΣ");
  await labelled("Line of the text").selectOption("bottom");
  await studio.untilReady("20,000");
  const inside = fs.readFileSync(await studio.exported("inside.stl"));
  fs.copyFileSync(FONT, scan("own.ttf"));
  await labelled("File of the font").setInputFiles(scan("own.ttf"));
  await ownFont(page).waitFor();
  const project = await studio.savedProject("urn.relievo");
  await page.reload();
  await studio.untilReady("20,000");
  const {studio: other} = await newStudio(t, "chromium", fileAddress);
  await other.show(project);
  for (const each of [studio, other]) {
    await openPanels(each.page);
    await each.button("“ΔΗΜΟΣ”").click();
    await ownFont(each.page).waitFor();
    assert.ok(fs.readFileSync(await each.exported("own.stl")).equals(inside), "the same font by file gives other bytes");
    assert.deepEqual(each.errors, []);
  }
  if (!native || !fs.existsSync(native)) return;
  const made = path.join(studio.downloads, "native.stl");
  execFileSync(native, ["make", project, "-o", made, "--quiet"], {stdio: "pipe"});
  assert.ok(fs.readFileSync(made).equals(inside), "the native program gives other bytes");
});

test("a depth picture is read anew as the page asks, and stays so", options, async (t) => {
  const {studio} = await newStudio(t, "chromium", fileAddress), {page} = studio;
  writeBallBeforeWall(scan("depth.tif"));
  await studio.open(scan("depth.tif"));
  await page.locator("#depth").getByRole("button", {name: "Keep the background"}).click();
  await studio.untilReady("10,800");
  await page.reload();
  await studio.untilReady("10,800");
  await page.locator("#depth").getByText("All pixels are used").waitFor({state: "attached"});
  assert.deepEqual(studio.errors, []);
});

test("broken and huge files are refused, and the relief stays", options, async (t) => {
  const {studio} = await newStudio(t, "chromium", fileAddress);
  await studio.show(scan("shell.ply"));
  await studio.open(scan("broken.ply"));
  await studio.toast.getByText(/broken\.ply.*expected/).waitFor();
  await studio.untilReady("20,000");
  const huge = path.join(studio.downloads, "huge.obj");
  fs.closeSync(fs.openSync(huge, "w"));
  fs.truncateSync(huge, 3e9);
  await studio.open(huge);
  await studio.toast.getByText(/huge\.obj has .*: expected at most/).waitFor();
  await studio.untilReady("20,000");
  assert.deepEqual(studio.errors, []);
});

test("a preparation is cancelled, and a tab closed in the middle of one loses nothing", options, async (t) => {
  const {studio, openPage} = await newStudio(t, "chromium", fileAddress);
  await studio.page.getByRole("button", {name: /green man/i}).click();
  await studio.button("Cancel").first().click();
  await studio.page.getByRole("list", {name: "Try a sample"}).waitFor();
  await studio.show(scan("dense.ply"), "100,000");
  await studio.setHeight(1.75);
  await studio.button("Choose view").click();
  await studio.page.getByRole("group", {name: "Sides"}).getByRole("button", {name: "Back", exact: true}).click();
  await studio.button("Use this view").click();
  await studio.page.getByRole("progressbar", {name: "Preparing"}).waitFor();
  await studio.page.close({runBeforeUnload: true});
  const again = await openPage();
  await again.untilReady("100,000");
  assert.equal(Number(await again.height.inputValue()), 1.75);
  assert.equal(await again.page.locator("#view-name").textContent(), "Back");
});

test("a second tab shows what the first one changes", options, async (t) => {
  const {studio, openPage} = await newStudio(t, "chromium", fileAddress);
  await studio.show(scan("shell.ply"));
  const second = await openPage();
  await second.untilReady("20,000");
  await studio.setHeight(2.2);
  await second.page.getByText(/height 2\.20 mm/).waitFor();
  await second.setHeight(3.1);
  await studio.page.getByText(/height 3\.10 mm/).waitFor();
});

test("where the memory is not enough the page says so, and goes on", options, async (t) => {
  const {studio} = await newStudio(t, "chromium", pageWithLittleMemory());
  await studio.open(scan("large.ply"));
  await studio.page.getByText(/expected more memory/).first().waitFor();
  await studio.show(scan("shell.ply"));
  await studio.setHeight(2.5);
  assert.deepEqual(studio.errors, []);
});

test("where the browser has no room the page says so, and goes on", options, async (t) => {
  const address = await serve(t), {studio, context} = await newStudio(t, "chromium", address);
  const devtools = await context.newCDPSession(studio.page);
  await devtools.send("Storage.overrideQuotaForOrigin", {origin: new URL(address).origin, quotaSize: 1});
  await studio.open(scan("shell.ply"));
  await studio.toast.getByText(/not kept.*no room left/).waitFor();
  await studio.untilReady("20,000");
  await studio.setHeight(2);
  assert.equal(admesh(await studio.exported("shell.stl")).parts, 1);
});

test("a page that was served opens without a network", options, async (t) => {
  const {studio, context} = await newStudio(t, "chromium", await serve(t));
  await studio.page.evaluate(() => navigator.serviceWorker.ready.then(() => {}));
  await studio.page.reload();
  await eventually(() => studio.page.evaluate(async () => (await (await caches.open("relievo")).keys()).length > 0));
  await context.setOffline(true);
  await studio.page.reload();
  await studio.page.getByRole("list", {name: "Try a sample"}).waitFor();
});
