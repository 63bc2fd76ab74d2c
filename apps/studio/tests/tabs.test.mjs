// Several tabs of one browser on one studio.
import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import path from "node:path";
import {after, before, test} from "node:test";
import {EngineProcess, PROGRAM, findBrowser, removeFolder, temporaryFolder} from "./support.mjs";

const found = await findBrowser();
const skip = found.missing ? `${found.missing}: the page is not tested` : false;
if (skip) console.log(`SKIPPED: ${skip}`);

const folder = temporaryFolder(), scan = path.join(folder, "scan.ply");
let browser, context, engine;

before(async () => {
  if (skip) return;
  const made = spawnSync(PROGRAM, ["sample", "still_life", "-o", scan, "--points", "20000"]);
  assert.equal(made.status, 0, String(made.stderr));
  browser = await found.launch();
  context = await browser.newContext({viewport: {width: 1000, height: 700}, acceptDownloads: true});
  engine = await new EngineProcess(path.join(folder, "state"), scan).ready();
});

after(async () => {
  await browser?.close();
  await engine?.stop();
  removeFolder(folder);
});

async function newTab() {
  const tab = await context.newPage();
  tab.setDefaultTimeout(20000);
  await tab.goto(engine.address);
  await untilReady(tab);
  return tab;
}

async function untilReady(tab) {
  await tab.getByText(/points.*height/).waitFor();
  await tab.locator('[role="application"][aria-busy="false"]').first().waitFor();
}

test("works in nine tabs at once, whichever has the stream of events", {skip}, async () => {
  const tabs = [];
  for (let i = 0; i < 9; ++i) tabs.push(await newTab());
  for (const closed of [0, 4]) await tabs[closed].close(); // the first has the stream
  const left = tabs.filter((tab) => !tab.isClosed());
  await engine.post("view", {view: "left"});
  await engine.untilIdle();
  const {visible_points: points} = JSON.parse((await engine.get("api/facts")).body);
  for (const tab of left) await tab.getByText(`${points.toLocaleString("en-US")} of 20,000 points`).waitFor();
  for (const tab of left) await tab.close();
});

test("follows another tab to its scan, says so, and goes back", {skip}, async () => {
  const [tab, other] = [await newTab(), await newTab()], title = tab.locator("#title");
  const height = (of) => of.getByRole("spinbutton", {name: "Height in mm"});
  await height(tab).fill("3.25");
  await height(tab).press("Enter");
  await other.getByRole("button", {name: "Start page"}).click();
  await other.getByRole("list", {name: "Try a sample"}).getByRole("button", {name: /shell/i}).click();
  await height(other).fill("1.5");
  await height(other).press("Enter");
  await tab.getByRole("alert").getByText("Another tab opened shell, which is shown here, too.").waitFor();
  assert.equal(await title.innerText(), "Shell");
  assert.equal(await height(tab).inputValue(), "1.50");
  await untilReady(tab);
  await tab.getByRole("button", {name: "Export", exact: true}).click();
  const download = tab.waitForEvent("download");
  await tab.getByRole("dialog", {name: "Export"}).getByRole("button", {name: "Export"}).click();
  assert.match((await download).suggestedFilename(), /^shell/);
  await tab.getByRole("button", {name: "Go back to scan.ply"}).click();
  await tab.getByText("of 20,000 points").waitFor();
  assert.equal(await title.innerText(), "scan.ply");
  assert.equal(await height(tab).inputValue(), "3.25");
  await other.getByText("Another tab opened scan.ply, which is shown here, too.").waitFor();
  for (const each of [tab, other]) await each.close();
});

test("follows another tab to its view", {skip}, async () => {
  const tab = await newTab(), name = tab.locator("#view-name");
  await engine.post("view", {view: "right"});
  await name.getByText("Right").waitFor();
  await tab.close();
});
