// Several tabs of one browser on one studio.
import assert from "node:assert/strict";
import {readFileSync, renameSync, rmSync, writeFileSync} from "node:fs";
import path from "node:path";
import {after, before, test} from "node:test";
import {EngineProcess, enter, eventually, findBrowser, readStl, removeFolder, savedFiles, temporaryFolder,
  untilListening, untilReady, writeSample} from "./support.mjs";

const found = await findBrowser(), {skip} = found;

const folder = temporaryFolder(), state = path.join(folder, "state"), scan = path.join(folder, "scan.ply");
const fileOf = (sample) => (sample === "still_life" ? scan : path.join(folder, `${sample}.ply`));
let browser, context, engine;

before(async () => {
  if (skip) return;
  for (const [sample, points] of [["still_life", 20000], ["shell", 6000], ["green_man", 5000]])
    writeSample(sample, points, fileOf(sample));
  browser = await found.launch();
  context = await browser.newContext({viewport: {width: 1000, height: 700}, acceptDownloads: true});
  await context.addInitScript(() => { // a tab that is deaf hears nothing of what the engine tells by itself
    Object.assign(window, {told: [], missed: []});
    new BroadcastChannel(location.pathname).onmessage = ({data}) => window.told.push(data);
    window.EventSource = class extends EventSource {
      set onmessage(take) {
        super.onmessage = (event) => (window.isDeaf ? window.missed.push(JSON.parse(event.data)) : take(event));
      }
    };
  });
  engine = await new EngineProcess(state, scan).ready();
});

after(async () => {
  await browser?.close();
  await engine?.stop();
  removeFolder(folder);
});

async function newTab() {
  const tab = await context.newPage();
  await tab.goto(engine.address);
  await untilReady(tab);
  return tab;
}

test("works in nine tabs at once, whichever has the stream of events", {skip}, async () => {
  const tabs = [];
  for (let i = 0; i < 9; ++i) tabs.push(await newTab());
  for (const closed of [0, 4]) await tabs[closed].close(); // the first has the stream
  const left = tabs.filter((tab) => !tab.isClosed());
  ({document: engine.document} = await engine.json("document", {input: {path: scan}}));
  await engine.post("view", {view: "left"});
  await engine.untilIdle();
  const {visible_points: points} = await engine.json("facts");
  for (const tab of left) {
    await tab.getByText(`${points.toLocaleString("en-US")} of 20,000 points`).waitFor();
    await untilReady(tab);
  }
  for (const tab of left) await tab.close();
});

const title = (of) => of.locator("#title");
const height = (of) => of.getByRole("spinbutton", {name: "Height in mm"});
const setHeight = (of, text) => enter(height(of), text);
const untilSaid = (of, text) => of.getByRole("alert").getByText(text, {exact: true}).waitFor();
const untilHeight = (of, text) => eventually(async () => assert.equal(await height(of).inputValue(), text));
const openScan = async (of, sample) => {
  const chooser = of.waitForEvent("filechooser");
  await of.getByRole("button", {name: "Open", exact: true}).click();
  await (await chooser).setFiles(fileOf(sample));
  await of.getByText(/of [56],000 points/).waitFor();
  await untilReady(of);
};

// Waits until the height that a tab shows is kept, and all tabs know.
const untilTold = (of, tabs) => eventually(async () => {
  const document = new URL(of.url()).hash.slice(1), {recent} = await engine.json("recent");
  const {kept} = await engine.json("document", {input: recent.find((entry) => entry.document === document).input});
  assert.equal(kept.steps[kept.at].options.height.toFixed(2), await height(of).inputValue());
  for (const tab of tabs)
    assert.ok(await tab.evaluate(([document, changed]) => window.told.some((status) =>
      status?.document === document && status.kept.changed === changed), [document, kept.changed]));
});

async function exported(tab) {
  await tab.getByRole("button", {name: "Export", exact: true}).click();
  const [{name, bytes}] = await savedFiles(found, tab, 1, () =>
    tab.getByRole("dialog", {name: "Export"}).getByRole("button", {name: "Export"}).click());
  return {name, height: readStl(bytes).size[2]};
}

test("shows two scans in two tabs, and mixes up nothing", {skip}, async () => {
  const [tab, other] = [await newTab(), await newTab()];
  await setHeight(tab, "3.25");
  await openScan(other, "shell");
  await setHeight(other, "1.5");
  for (const each of [tab, other]) await untilTold(each, [tab, other]);
  assert.deepEqual([await title(tab).innerText(), await title(other).innerText()], ["scan.ply", "shell.ply"]);
  assert.deepEqual([await height(tab).inputValue(), await height(other).inputValue()], ["3.25", "1.50"]);
  await tab.getByText("of 20,000 points").waitFor();
  for (const [of, name, mm] of [[tab, /^scan/, 3.25], [other, /^shell/, 1.5]]) {
    const file = await exported(of);
    assert.match(file.name, name);
    assert.ok(Math.abs(file.height - 3 - mm) < 0.01, `${file.height}`);
  }
  for (const each of [tab, other]) await each.reload().then(() => untilReady(each)); // each stays with its document
  assert.deepEqual([await title(tab).innerText(), await title(other).innerText()], ["scan.ply", "shell.ply"]);
  for (const each of [tab, other]) await each.close();
});

test("comes back to each scan as it was left, with curve, view and steps, and shows recent ones", {skip}, async () => {
  const tab = await newTab(), {document} = await engine.json("document", {input: {path: scan}});
  await tab.goto(`${engine.address}#${document}`);
  await tab.reload();
  await untilReady(tab);
  await tab.locator(".inspector details").evaluateAll((all) => all.forEach((panel) => (panel.open = true)));
  const preset = tab.getByRole("combobox", {name: "Tone curve preset"}), view = tab.locator("#view-name");
  const curve = () => tab.locator("#curve .drawn").getAttribute("d");
  await preset.selectOption("Bold edges first");
  await tab.getByRole("button", {name: "Choose view"}).click();
  await tab.getByRole("group", {name: "Sides"}).getByRole("button", {name: "Left", exact: true}).click();
  await tab.getByRole("button", {name: "Use this view"}).click();
  await setHeight(tab, "2.75");
  await untilReady(tab);
  const [shaped, told] = [await curve(), await tab.locator("#numbers").innerText()];
  await openScan(tab, "green_man");
  assert.equal(await preset.inputValue(), "");
  assert.notEqual(await view.innerText(), "Left");
  assert.notEqual(await curve(), shaped);
  await setHeight(tab, "6");
  await untilReady(tab);
  await tab.getByRole("button", {name: "Start page"}).click();
  const recent = tab.getByRole("list", {name: "Go on with"});
  await recent.getByRole("button", {name: "green_man.ply"}).waitFor();
  const picture = recent.getByRole("button", {name: "green_man.ply"}).locator("img");
  await eventually(async () => assert.match(await picture.getAttribute("src"), /^data:image\/jpeg/));
  await recent.getByRole("button", {name: /^scan\.ply/}).click();
  await untilReady(tab);
  assert.equal(await title(tab).innerText(), "scan.ply");
  assert.equal(await height(tab).inputValue(), "2.75");
  assert.equal(await view.innerText(), "Left");
  assert.equal(await preset.locator("option:checked").innerText(), "Bold edges first");
  assert.deepEqual([await curve(), await tab.locator("#numbers").innerText()], [shaped, told]);
  await tab.getByRole("button", {name: "Undo"}).click();
  assert.equal(await height(tab).inputValue(), "3.25");
  for (let step = 0; step < 2; ++step) await tab.getByRole("button", {name: "Undo"}).click();
  assert.notEqual(await view.innerText(), "Left");
  await untilReady(tab);
  await tab.close();
});

test("is one document in two tabs", {skip}, async () => {
  const [tab, other] = [await newTab(), await newTab()], before = await height(tab).inputValue();
  await setHeight(tab, "4.5");
  await untilHeight(other, "4.50");
  await other.getByRole("button", {name: "Undo"}).click();
  await untilHeight(tab, before);
  await tab.getByRole("button", {name: "Redo"}).click();
  await untilHeight(other, "4.50");
  const crop = (of) => of.locator("#crop"), crops = async () => [await crop(tab).inputValue(),
    await crop(other).inputValue()];
  await tab.locator("#scan").evaluate((panel) => (panel.open = true));
  for (const [typed, taken] of [["0,0.3,1,1", "0,0.3,1,1"], ["abc", "0,0.3,1,1"], ["", ""]]) { // one is refused
    await enter(crop(tab), typed);
    if (typed !== taken) await tab.getByText(/expected left, bottom, right and top as shares/).waitFor();
    await eventually(async () => {
      for (const of of [tab, other]) await untilReady(of);
      assert.deepEqual(await crops(), [taken, taken]);
    });
  }
  for (const each of [tab, other]) await each.close();
});

test("loses nothing when the engine is killed in a drag, and finds the next one by itself", {skip}, async () => {
  const tab = await newTab(), slider = tab.getByRole("slider", {name: "Height", exact: true});
  const box = await slider.boundingBox(), y = box.y + box.height / 2;
  await tab.mouse.move(box.x + box.width / 2, y);
  await tab.mouse.down();
  for (let i = 0; i < 20; ++i) {
    await tab.mouse.move(box.x + box.width / 2 - 2 * i, y);
    if (i === 12) await engine.stop("SIGKILL");
  }
  await tab.mouse.up();
  await tab.getByRole("alert").getByText(/engine has stopped/).waitFor();
  const dragged = await height(tab).inputValue();
  await enter(tab.getByRole("spinbutton", {name: "Longer side in mm"}), "80");
  const address = engine.address;
  engine = await new EngineProcess(state).ready();
  assert.equal(engine.address, address);
  await untilSaid(tab, "The engine is back, and goes on with what this page shows.");
  await untilReady(tab);
  assert.equal(await height(tab).inputValue(), dragged);
  await eventually(async () => {
    const {kept} = await engine.json("document", {input: {path: scan}}), {options} = kept.steps[kept.at];
    assert.deepEqual([options.height.toFixed(2), options.width], [dragged, 80]);
  });
  await tab.close();
});

test("shows what another page kept later, and says so where a change of its own is lost", {skip}, async () => {
  const tab = await newTab(), {document, kept} = await engine.json("document", {input: {path: scan}});
  const keep = async (mm, later) => {
    kept.steps[kept.at].options.height = mm;
    kept.changed = Date.now() + later;
    await engine.post("state", {document, state: kept, tab: "another"});
  };
  await keep(5.5, 1000);
  await untilHeight(tab, "5.50");
  assert.ok(!await tab.getByRole("alert").isVisible());
  await tab.evaluate(() => (window.isDeaf = true));
  await keep(4.75, 600000); // later than what this page changes now, however busy the machine is
  await tab.waitForFunction((changed) => window.missed.some((status) => status.kept?.changed === changed),
    kept.changed);
  assert.equal(await height(tab).inputValue(), "5.50");
  await setHeight(tab, "3.5");
  await untilSaid(tab, "Newer work of another page is shown here.");
  await untilHeight(tab, "4.75");
  await tab.close();
});

test("shows the newer work that it finds with the next engine, and says so", {skip}, async () => {
  const tab = await newTab(), {document, kept} = await engine.json("document", {input: {path: scan}});
  await engine.stop("SIGKILL");
  await tab.getByRole("alert").getByText(/engine has stopped/).waitFor();
  const file = path.join(state, "documents", `${document}.json`), newer = JSON.parse(readFileSync(file));
  assert.equal(newer.changed, kept.changed);
  newer.steps[newer.at].options.height = 6.5;
  writeFileSync(file, JSON.stringify({...newer, changed: Date.now() + 1200000})); // as another page has it kept
  engine = await new EngineProcess(state).ready();
  await untilSaid(tab, "The engine is back. It had newer work on this scan, which is shown here.");
  await untilHeight(tab, "6.50");
  await tab.close();
});

test("opens a project saved with its scan in another studio, where the scan is not", {skip}, async () => {
  const tab = await newTab(), moved = path.join(folder, "moved.ply"), project = path.join(folder, "work.relievo");
  await tab.getByRole("button", {name: "Save project"}).click();
  await tab.getByRole("radio", {name: /^With the scan/}).check();
  const [{bytes}] = await savedFiles(found, tab, 1, () => tab.getByRole("button", {name: "Save", exact: true}).click());
  writeFileSync(project, bytes);
  renameSync(scan, moved);
  const elsewhere = await new EngineProcess(path.join(folder, "elsewhere")).ready();
  await tab.goto(elsewhere.address);
  await untilListening(tab);
  await tab.locator("#samples button").first().waitFor();
  await tab.locator("#file").setInputFiles(project);
  await tab.getByText("of 20,000 points").waitFor();
  await untilReady(tab);
  assert.deepEqual([await title(tab).innerText(), await height(tab).inputValue()], ["scan.ply", "6.50"]);
  assert.ok(Math.abs((await exported(tab)).height - 9.5) < 0.01);
  await tab.close();
  await elsewhere.stop();
  renameSync(moved, scan);
});

test("asks for a scan that has moved, takes no other for it unasked, and goes on with it", {skip}, async () => {
  await engine.stop(); // it may have ended by itself, as no page was there for a while
  engine = await new EngineProcess(state, scan).ready();
  const tab = await newTab(), moved = path.join(folder, "elsewhere.ply");
  await openScan(tab, "shell");
  renameSync(scan, moved);
  const locate = async (file) => {
    await tab.getByRole("button", {name: "Start page"}).click();
    await tab.getByRole("list", {name: "Go on with"}).getByRole("button", {name: /^scan\.ply/}).click();
    if (found.name === "firefox") return tab.locator("#locate").setInputFiles(file); // see openFile() of page.test.mjs
    const chooser = tab.waitForEvent("filechooser");
    await tab.getByRole("alert").getByRole("button", {name: "Locate it"}).click();
    await (await chooser).setFiles(file);
  };
  const broken = path.join(folder, "broken.ply"), kept = async () =>
    (await engine.json("document", {input: {path: scan}})).kept;
  writeFileSync(broken, "ply\nformat ascii 1.0\nelement vertex 3\n");
  const before = await kept();
  for (const file of [fileOf("green_man"), broken]) {
    await locate(file);
    const name = path.basename(file);
    await tab.getByRole("alert").getByText(`${name} is not scan.ply as it was when this work was kept.`).waitFor();
    assert.equal(await title(tab).innerText(), "shell.ply");
  }
  await tab.getByRole("button", {name: "Use it all the same"}).click();
  await tab.getByRole("alert").getByText(/^broken\.ply.*expected/).waitFor();
  await eventually(async () => assert.equal(await title(tab).innerText(), "shell.ply"));
  await untilReady(tab);
  assert.deepEqual(await kept(), before);
  await locate(fileOf("green_man")); // by mistake
  const another = tab.getByRole("alert").getByRole("button", {name: "Locate another file"});
  await another.waitFor();
  if (found.name === "firefox") await tab.locator("#locate").setInputFiles(moved);
  else {
    const chooser = tab.waitForEvent("filechooser");
    await another.click();
    await (await chooser).setFiles(moved);
  }
  await tab.getByText("of 20,000 points").waitFor();
  await untilReady(tab);
  assert.equal(await height(tab).inputValue(), "6.50");
  await tab.close();
});

const choose = (tab, file) => tab.locator("#file").setInputFiles(file);
const startPage = (tab) => tab.getByRole("button", {name: "Start page"}).click();
const shelf = (tab) => tab.getByRole("list", {name: "Go on with"});

test("goes on opening a scan after a reload, and with one that cannot be kept", {skip}, async () => {
  const place = path.join(folder, "reloads"), large = path.join(folder, "large.ply");
  writeSample("green_man", 150000, large);
  const other = await new EngineProcess(place).ready(), tab = await context.newPage();
  tab.setDefaultTimeout(120000);
  await tab.goto(other.address);
  await untilListening(tab);
  await choose(tab, fileOf("shell"));
  await tab.getByText("of 6,000 points").waitFor();
  await untilReady(tab);
  await choose(tab, large);
  await tab.locator("#title").getByText("large.ply").waitFor();
  await tab.reload();
  await tab.locator("#title").getByText("large.ply").waitFor();
  await startPage(tab);
  await shelf(tab).getByRole("button", {name: "large.ply"}).waitFor();
  await tab.getByRole("button", {name: "Back to the relief"}).click();
  await tab.getByText("of 150,000 points").waitFor();
  await untilReady(tab);
  rmSync(path.join(place, "documents"), {recursive: true});
  writeFileSync(path.join(place, "documents"), ""); // so that nothing can be kept there
  await choose(tab, fileOf("green_man"));
  const said = tab.getByRole("alert").getByText(/^Your work is not kept/);
  await said.waitFor();
  assert.ok(!(await said.innerText()).includes(place), await said.innerText());
  await tab.getByText("of 5,000 points").waitFor();
  await tab.reload();
  await tab.getByText("of 5,000 points").waitFor();
  assert.equal(await title(tab).innerText(), "green_man.ply");
  await tab.close();
  await other.stop();
});

test("removes what is kept, also what it shows", {skip}, async () => {
  const other = await new EngineProcess(path.join(folder, "removes")).ready(), tab = await context.newPage();
  await tab.goto(other.address);
  await untilListening(tab);
  for (const [sample, points] of [["shell", "6,000"], ["green_man", "5,000"]]) {
    await choose(tab, fileOf(sample));
    await tab.getByText(`of ${points} points`).waitFor();
    await untilReady(tab);
  }
  await startPage(tab);
  await tab.getByText(/^The work on 2 scans is kept on this machine until you remove it, .* [\d.]+ kB\.$/).waitFor();
  const remove = async (name) => {
    await shelf(tab).getByRole("listitem").filter({hasText: name}).getByRole("button", {name: "Remove"}).click();
    await tab.getByRole("alert").getByRole("button", {name: "Remove"}).click();
  };
  await remove("shell.ply");
  await tab.getByText(/^The work on 1 scan is kept/).waitFor();
  await remove("green_man.ply");
  await tab.getByText("Go on with").waitFor({state: "hidden"});
  await eventually(async () => assert.deepEqual(await other.json("kept"), {documents: 0, bytes: 0}));
  await tab.reload();
  await tab.locator("#samples button").first().waitFor();
  assert.ok(await tab.locator("#recent-shelf").isHidden());
  await tab.close();
  await other.stop();
});
