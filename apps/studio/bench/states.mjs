// Takes a picture of each state of the studio's page, for people to inspect, on a desk and a phone, light and dark:
// node apps/studio/bench/states.mjs FOLDER
import path from "node:path";
import {STATES, showScene} from "../tests/states.mjs";
import {EngineProcess, findBrowser, openPanels, temporaryFolder, untilReady,
  writeScans} from "../tests/support.mjs";

const SCREENS = [{width: 1280, height: 800}, {width: 390, height: 844}];
const [into] = process.argv.slice(2), found = await findBrowser();
if (!into || found.skip) throw new Error(found.skip || "expected a folder for the pictures");
const browser = await found.launch(), folder = temporaryFolder();
const scans = writeScans(folder, 30000);
const engine = await new EngineProcess(path.join(folder, "state"), scans[0]).ready();
const page = await (await browser.newContext({viewport: SCREENS[0]})).newPage();

async function take(name) {
  for (const screen of SCREENS)
    for (const colorScheme of ["light", "dark"]) {
      await page.setViewportSize(screen);
      await page.emulateMedia({colorScheme});
      await page.waitForTimeout(900); // until the drawings fit their new size
      await page.screenshot({path: path.join(into, `${name.replace(/\W+/g, "-")}-${screen.width}-${colorScheme}.png`)});
    }
  await page.setViewportSize(SCREENS[0]);
}

await page.addInitScript(() => localStorage.setItem("toured", "yes"));
await page.goto(engine.address);
await untilReady(page);
await openPanels(page);
for (const [name, {enter, leave}] of Object.entries(STATES)) {
  await enter(page);
  await take(name);
  await leave(page);
}
await showScene(page, scans);
await take("a scene");
await browser.close();
await engine.stop();
