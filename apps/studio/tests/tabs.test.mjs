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
