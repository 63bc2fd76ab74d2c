// Tests that several tabs of one browser can use one studio.
import assert from "node:assert/strict";
import {readFileSync, renameSync, rmSync, writeFileSync} from "node:fs";
import path from "node:path";
import {browser, button, chooseView, engine, exported, field, folder, found, middleOf, openFile, preset, savedProject,
  scan, slider, soon, startEngine, state, test, toast, undo, untilText, withBrowser} from "./page_suite.mjs";
import {EngineProcess, enter, eventually, openPanels, untilListening, untilReady, writeSample} from "./support.mjs";

const fileOf = (sample) => (sample === "still_life" ? scan : path.join(folder, `${sample}.ply`));
let context;

withBrowser(async () => {
  for (const [sample, points] of [["still_life", 20000], ["shell", 6000], ["green_man", 5000]])
    writeSample(sample, points, fileOf(sample));
  context = await browser.newContext({viewport: {width: 1000, height: 700}, acceptDownloads: true});
  await context.addInitScript(() => { // lets a tab ignore the events of the engine while `isDeaf` is true
    Object.assign(window, {told: [], missed: []});
    new BroadcastChannel(location.pathname).onmessage = ({data}) => window.told.push(data);
    window.EventSource = class extends EventSource {
      set onmessage(take) {
        super.onmessage = (event) => (window.isDeaf ? window.missed.push(JSON.parse(event.data)) : take(event));
      }
    };
  });
  await startEngine(scan);
});

async function newTab() {
  const tab = await context.newPage();
  await tab.goto(engine.address);
  await untilReady(tab);
  return tab;
}

test("works in nine tabs at once, whichever has the stream of events", async () => {
  const tabs = [];
  for (let i = 0; i < 9; ++i) tabs.push(await newTab());
  for (const closed of [0, 4]) await tabs[closed].close(); // the first tab had the stream of events
  const left = tabs.filter((tab) => !tab.isClosed());
  ({document: engine.document} = await engine.json("document", {input: {path: scan}}));
  await engine.prepare({view: "left"});
  const {visible_points: points} = await engine.json("facts");
  for (const tab of left) {
    await tab.getByText(`${points.toLocaleString("en-US")} of 20,000 points`).waitFor();
    await untilReady(tab);
  }
  for (const tab of left) await tab.close();
});

const title = (of) => of.locator("#title");
const snapshots = (of) => of.locator("#snapshot-list input").evaluateAll((all) => all.map(({value}) => value));
const height = (of) => field("Height in mm", of);
const setHeight = (of, text) => enter(height(of), text);
const untilSaid = (of, text) => toast(of).getByText(text, {exact: true}).waitFor();
const untilHeight = (of, text) => untilText(height(of), text);
const untilPoints = async (of, count) => {
  await of.getByText(`of ${count} points`).waitFor();
  await untilReady(of);
};
const openScan = async (of, sample) => {
  await openFile(fileOf(sample), of);
  await untilPoints(of, {shell: "6,000", green_man: "5,000"}[sample]);
};

// Waits until the engine has stored the height that a tab shows, and all tabs show it.
const untilTold = (of, tabs) => eventually(async () => {
  const document = new URL(of.url()).hash.slice(1), {recent} = await engine.json("recent");
  const kept = await engine.kept(recent.find((entry) => entry.document === document).input);
  assert.equal(kept.steps[kept.at].options.height.toFixed(2), await height(of).inputValue());
  for (const tab of tabs)
    assert.ok(await tab.evaluate(([document, changed]) => window.told.some((status) =>
      status?.document === document && status.kept.changed === changed), [document, kept.changed]));
});

test("shows two scans in two tabs, and mixes up nothing", async () => {
  const [tab, other] = [await newTab(), await newTab()];
  let camera;
  other.on("request", (request) => {
    if (!request.url().endsWith("/api/picture")) return;
    const asked = request.postDataJSON();
    if (asked.width > 200) ({camera} = asked); // the pictures of the kinds are smaller
  });
  await setHeight(tab, "3.25");
  await other.mouse.move(...await middleOf(other.locator("#stage")));
  await other.mouse.wheel(0, -300);
  await soon.ok(() => camera?.zoom > 1.1);
  await openScan(other, "shell");
  assert.equal(camera.zoom, 1);
  await setHeight(other, "1.5");
  for (const each of [tab, other]) await untilTold(each, [tab, other]);
  const titles = () => Promise.all([tab, other].map((each) => title(each).innerText()));
  await soon.deepEqual(titles, ["scan.ply", "shell.ply"]);
  for (const [of, mm] of [[tab, "3.25"], [other, "1.50"]]) await soon.equal(() => height(of).inputValue(), mm);
  await tab.getByText("of 20,000 points").waitFor();
  for (const [of, name, mm] of [[tab, /^scan/, 3.25], [other, /^shell/, 1.5]]) {
    const file = await exported(of);
    assert.match(file.name, name);
    assert.ok(Math.abs(file.size[2] - 3 - mm) < 0.01, `${file.size}`);
  }
  for (const each of [tab, other]) await each.reload().then(() => untilReady(each)); // each tab keeps its document
  await soon.deepEqual(titles, ["scan.ply", "shell.ply"]);
  for (const each of [tab, other]) await each.close();
});

test("comes back to each scan as it was left, with curve, view and steps, and shows recent ones", async () => {
  const tab = await newTab(), {document} = await engine.json("document", {input: {path: scan}});
  await tab.goto(`${engine.address}#${document}`);
  await tab.reload();
  await untilReady(tab);
  await openPanels(tab);
  const tone = preset(tab), view = tab.locator("#view-name");
  const curve = () => tab.locator("#curve .drawn").getAttribute("d");
  await tone.selectOption("Bold edges first");
  await chooseView("Left", tab);
  await setHeight(tab, "2.75");
  await untilReady(tab);
  const [shaped, told] = [await curve(), await tab.locator("#numbers").innerText()];
  await openScan(tab, "green_man");
  await soon.equal(() => tone.inputValue(), "");
  await soon.notEqual(() => view.innerText(), "Left");
  await soon.notEqual(() => curve(), shaped);
  await setHeight(tab, "6");
  await untilReady(tab);
  await startPage(tab);
  const recent = shelf(tab);
  await recent.getByRole("button", {name: "green_man.ply"}).waitFor();
  const picture = recent.getByRole("button", {name: "green_man.ply"}).locator("img");
  await eventually(async () => assert.match(await picture.getAttribute("src"), /^data:image\/jpeg/));
  await recent.getByRole("button", {name: /^scan\.ply/}).click();
  await untilReady(tab);
  await soon.equal(() => title(tab).innerText(), "scan.ply");
  await soon.equal(() => height(tab).inputValue(), "2.75");
  await soon.equal(() => view.innerText(), "Left");
  await soon.equal(() => tone.locator("option:checked").innerText(), "Bold edges first");
  await soon.deepEqual(async () => [await curve(), await tab.locator("#numbers").innerText()], [shaped, told]);
  await undo(1, tab);
  await soon.equal(() => height(tab).inputValue(), "3.25");
  await undo(2, tab);
  await soon.notEqual(() => view.innerText(), "Left");
  await untilReady(tab);
  await tab.close();
});

test("is one document in two tabs", async () => {
  const [tab, other] = [await newTab(), await newTab()], before = await height(tab).inputValue();
  await setHeight(tab, "4.5");
  await untilHeight(other, "4.50");
  await undo(1, other);
  await untilHeight(tab, before);
  await button("Redo", tab).click();
  await untilHeight(other, "4.50");
  const crop = (of) => of.locator("#crop"), crops = async () => [await crop(tab).inputValue(),
    await crop(other).inputValue()];
  await tab.locator("#scan").evaluate((panel) => (panel.open = true));
  for (const [typed, taken] of [["0,0.3,1,1", "0,0.3,1,1"], ["abc", "0,0.3,1,1"], ["", ""]]) { // "abc" is refused
    await enter(crop(tab), typed);
    if (typed !== taken) await tab.getByText(/expected left, bottom, right and top as shares/).waitFor();
    await eventually(async () => {
      for (const of of [tab, other]) await untilReady(of);
      assert.deepEqual(await crops(), [taken, taken]);
    });
  }
  for (const each of [tab, other]) await each.close();
});

test("loses nothing when the engine is killed in a drag, and finds the next one by itself", async () => {
  const tab = await newTab(), [x, y] = await middleOf(slider("Height", tab));
  await tab.mouse.move(x, y);
  await tab.mouse.down();
  for (let i = 0; i < 20; ++i) {
    await tab.mouse.move(x - 2 * i, y);
    if (i === 12) await engine.stop("SIGKILL");
  }
  await tab.mouse.up();
  await toast(tab).getByText(/engine has stopped/).waitFor();
  const dragged = await height(tab).inputValue(), {address} = engine;
  await enter(field("Longer side in mm", tab), "80");
  assert.equal((await startEngine()).address, address);
  await untilSaid(tab, "The engine is back, and goes on with what this page shows.");
  await untilReady(tab);
  await soon.equal(() => height(tab).inputValue(), dragged);
  await eventually(async () => {
    const {options} = await engine.newestStep(scan);
    assert.deepEqual([options.height.toFixed(2), options.width], [dragged, 80]);
  });
  await tab.close();
});

test("shows what another page kept later, and says so where a change of its own is lost", async () => {
  const tab = await newTab(), {document, kept} = await engine.json("document", {input: {path: scan}});
  const keep = async (mm, later) => {
    kept.steps[kept.at].options.height = mm;
    kept.changed = Date.now() + later;
    await engine.post("state", {document, state: kept, tab: "another"});
  };
  await keep(5.5, 1000);
  await untilHeight(tab, "5.50");
  await soon.ok(async () => !await toast(tab).isVisible());
  await tab.evaluate(() => (window.isDeaf = true));
  await keep(4.75, 600000); // dated later than the next change on this page, however busy the machine is
  await tab.waitForFunction((changed) => window.missed.some((status) => status.kept?.changed === changed),
    kept.changed);
  await soon.equal(() => height(tab).inputValue(), "5.50");
  await setHeight(tab, "3.5");
  await untilSaid(tab, "Newer work of another page is shown here.");
  await untilHeight(tab, "4.75");
  await tab.close();
});

test("shows the newer work that it finds with the next engine, and says so", async () => {
  const tab = await newTab(), {document, kept} = await engine.json("document", {input: {path: scan}});
  await engine.stop("SIGKILL");
  await toast(tab).getByText(/engine has stopped/).waitFor();
  const file = path.join(state, "documents", `${document}.json`), newer = JSON.parse(readFileSync(file));
  assert.equal(newer.changed, kept.changed);
  newer.steps[newer.at].options.height = 6.5;
  writeFileSync(file, JSON.stringify({...newer, changed: Date.now() + 1200000})); // as if another tab had stored it
  await startEngine();
  await untilSaid(tab, "The engine is back. It had newer work on this scan, which is shown here.");
  await untilHeight(tab, "6.50");
  await tab.close();
});

test("opens a project saved with its scan in another studio, where the scan is not", async () => {
  const tab = await newTab(), moved = path.join(folder, "moved.ply"), project = path.join(folder, "work.relievo");
  writeFileSync(project, await savedProject("With the scan", tab));
  renameSync(scan, moved);
  const elsewhere = await new EngineProcess(path.join(folder, "elsewhere")).ready();
  await tab.goto(elsewhere.address);
  await untilListening(tab);
  await tab.locator("#samples button").first().waitFor();
  await choose(tab, project);
  await untilPoints(tab, "20,000");
  await soon.equal(() => title(tab).innerText(), "scan.ply");
  await soon.equal(() => height(tab).inputValue(), "6.50");
  assert.ok(Math.abs((await exported(tab)).size[2] - 9.5) < 0.01);
  await tab.close();
  await elsewhere.stop();
  renameSync(moved, scan);
});

test("asks for a scan that has moved, takes no other for it unasked, and goes on with it", async () => {
  await engine.stop(); // the engine may have ended already, since no page was open for a while
  await startEngine(scan);
  const tab = await newTab(), moved = path.join(folder, "elsewhere.ply");
  await openPanels(tab);
  await button("Take a snapshot", tab).click();
  await soon.deepEqual(() => snapshots(tab), ["Snapshot 1"]);
  await openScan(tab, "shell");
  renameSync(scan, moved);
  const answerWith = async (offered, file) => { // see openFile()
    await button(offered, toast(tab)).waitFor();
    if (found.name === "firefox") return tab.locator("#locate").setInputFiles(file);
    const chooser = tab.waitForEvent("filechooser");
    await button(offered, toast(tab)).click();
    await (await chooser).setFiles(file);
  };
  const locate = async (file) => {
    await startPage(tab);
    await shelf(tab).getByRole("button", {name: /^scan\.ply/}).click();
    await answerWith("Locate it", file);
  };
  const broken = path.join(folder, "broken.ply"), kept = () => engine.kept({path: scan});
  writeFileSync(broken, "ply\nformat ascii 1.0\nelement vertex 3\n");
  const before = await kept();
  for (const file of [fileOf("green_man"), broken]) {
    await locate(file);
    const name = path.basename(file);
    await toast(tab).getByText(`${name} is not scan.ply as it was when this work was kept.`).waitFor();
    await soon.equal(() => title(tab).innerText(), "shell.ply");
  }
  await button("Use it all the same", tab).click();
  await toast(tab).getByText(/^broken\.ply.*expected/).waitFor();
  await eventually(async () => assert.equal(await title(tab).innerText(), "shell.ply"));
  await untilReady(tab);
  await soon.deepEqual(() => kept(), before);
  await locate(fileOf("green_man")); // chooses a wrong file by mistake
  await answerWith("Locate another file", moved);
  await untilPoints(tab, "20,000");
  await soon.equal(() => height(tab).inputValue(), "6.50");
  await soon.deepEqual(() => snapshots(tab), ["Snapshot 1"]);
  const {input} = before.steps[before.at], copy = await engine.json("document", {input});
  assert.ok(copy.is_there && copy.input.path !== scan);
  assert.deepEqual(copy.moved, before);
  await tab.close();
});

const choose = (tab, file) => tab.locator("#file").setInputFiles(file);
const startPage = (tab) => button("Relievo, start page", tab).click();
const shelf = (tab) => tab.getByRole("list", {name: "Go on with"});

test("goes on opening a scan after a reload, and with one that cannot be kept", async () => {
  const place = path.join(folder, "reloads"), large = path.join(folder, "large.ply");
  writeSample("green_man", 150000, large);
  const other = await new EngineProcess(place).ready(), tab = await context.newPage();
  await tab.goto(other.address);
  await untilListening(tab);
  await choose(tab, fileOf("shell"));
  await untilPoints(tab, "6,000");
  await choose(tab, large);
  await tab.locator("#title").getByText("large.ply").waitFor();
  await tab.reload();
  await tab.locator("#title").getByText("large.ply").waitFor();
  await startPage(tab);
  await shelf(tab).getByRole("button", {name: "large.ply"}).waitFor();
  await button("Back to the relief", tab).click();
  await untilPoints(tab, "150,000");
  rmSync(path.join(place, "documents"), {recursive: true});
  writeFileSync(path.join(place, "documents"), ""); // a file in place of the folder, so that nothing can be stored
  await choose(tab, fileOf("green_man"));
  const said = toast(tab).getByText(/^Your work is not kept/);
  await said.waitFor();
  assert.ok(!(await said.innerText()).includes(place), await said.innerText());
  await tab.getByText("of 5,000 points").waitFor();
  await tab.reload();
  await tab.getByText("of 5,000 points").waitFor();
  await soon.equal(() => title(tab).innerText(), "green_man.ply");
  await tab.close();
  await other.stop();
});

test("shows older work, too, than the newest with which the start page begins", async () => {
  const other = await new EngineProcess(path.join(folder, "older")).ready(), tab = await context.newPage();
  for (let i = 0; i < 30; ++i) {
    const input = {path: path.join(folder, `${i}.ply`)}, {document} = await other.json("document", {input});
    await other.post("state", {document, state: {at: 0, steps: [{input}], changed: 1}, tab: "test"});
  }
  await tab.goto(other.address);
  await tab.getByText(/^The work on 30 scans is kept .* The newest 24 are shown\.$/).waitFor();
  await button("Show older work", tab).click();
  await soon.equal(() => shelf(tab).getByRole("listitem").count(), 30);
  const names = await shelf(tab).locator("span").evaluateAll((all) => all.map(({textContent}) => parseInt(textContent)));
  assert.deepEqual(names.sort((a, b) => a - b), [...Array(30).keys()]);
  await soon.ok(() => button("Show older work", tab).isHidden());
  await shelf(tab).getByRole("listitem").last().getByRole("button", {name: "Remove"}).click();
  await button("Remove", toast(tab)).click();
  await tab.getByText(/^The work on 29 scans is kept .* The newest 24 are shown\.$/).waitFor();
  await soon.equal(() => shelf(tab).getByRole("listitem").count(), 24);
  await tab.close();
  await other.stop();
});

test("removes what is kept, also what it shows", async () => {
  const other = await new EngineProcess(path.join(folder, "removes")).ready(), tab = await context.newPage();
  await tab.goto(other.address);
  await untilListening(tab);
  for (const [sample, points] of [["shell", "6,000"], ["green_man", "5,000"]]) {
    await choose(tab, fileOf(sample));
    await untilPoints(tab, points);
  }
  await startPage(tab);
  await tab.getByText(/^The work on 2 scans is kept on this machine until you remove it, .* [\d.]+ kB\.$/).waitFor();
  const remove = async (name) => {
    await shelf(tab).getByRole("listitem").filter({hasText: name}).getByRole("button", {name: "Remove"}).click();
    await button("Remove", toast(tab)).click();
  };
  await remove("shell.ply");
  await tab.getByText(/^The work on 1 scan is kept/).waitFor();
  await remove("green_man.ply");
  await tab.getByText("Go on with").waitFor({state: "hidden"});
  await eventually(async () => assert.deepEqual(await other.json("kept"), {documents: 0, bytes: 0}));
  await tab.reload();
  await tab.locator("#samples button").first().waitFor();
  await soon.ok(() => tab.locator("#recent-shelf").isHidden());
  await tab.close();
  await other.stop();
});
