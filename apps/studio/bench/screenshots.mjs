// Takes the pictures of the studio for the README. Usage: node apps/studio/bench/screenshots.mjs
import {EngineProcess, areKindsDrawn, findBrowser, temporaryFolder} from "../tests/support.mjs";

const found = await findBrowser();
if (found.skip) throw new Error(found.skip);
const browser = await found.launch(), state = temporaryFolder();
const engine = await new EngineProcess(state, "--linger", "600").ready();

async function open(colorScheme) {
  const page = await (await browser.newContext({viewport: {width: 1280, height: 800}, colorScheme})).newPage();
  await page.addInitScript(() => localStorage.setItem("toured", "yes"));
  await page.goto(engine.address);
  return page;
}

const take = async (page, name) => {
  await page.waitForTimeout(3000);
  await page.screenshot({path: `docs/pictures/studio-${name}.jpg`, type: "jpeg", quality: 90});
};

const untilKindsAreDrawn = (page) => page.waitForFunction(areKindsDrawn, null, {timeout: 120000});

const page = await open("light");
await take(page, "start");
await page.getByRole("button", {name: /green man/i}).click();
await page.getByText(/points.*height/).waitFor({timeout: 60000});
await page.getByRole("radio", {name: "Coin"}).click();
await page.getByRole("radio", {name: "Bronze"}).click();
await untilKindsAreDrawn(page);
await take(page, "main");
await page.close();

const dark = await open("dark");
await dark.getByText(/points.*height/).waitFor({timeout: 60000});
await dark.getByRole("radio", {name: "Plaque"}).click();
await untilKindsAreDrawn(dark);
await dark.getByRole("button", {name: "Light table"}).click();
await take(dark, "light-table");
await browser.close();
await engine.stop();
