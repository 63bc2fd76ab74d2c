// Tests that exports show their progress, and that a cancelled export leaves no running work and no file.
import assert from "node:assert/strict";
import {button, engine, exportDialog as dialog, page, set, soon, test, withPage} from "./page_suite.mjs";
import {enter, eventually, untilReady} from "./support.mjs";

withPage("still_life", 8000, async () => {
  await button("Light table").click(); // the light table shows no finished piece, so only an export makes one
  await enter(page.locator("#resolution"), "0.07"); // making such a fine piece takes seconds
  await untilReady(page);
  await page.evaluate(() => {
    window.seen = [];
    window.saved = [];
    const {createObjectURL} = URL;
    URL.createObjectURL = (file) => window.saved.push(file.size) && createObjectURL(file);
    const bar = document.querySelector("#export-progress");
    new MutationObserver(() => bar.hasAttribute("value") && window.seen.push(bar.value))
      .observe(bar, {attributeFilter: ["value"]});
  });
});

const making = async () => (await engine.json("status")).making.stage;
const open = () => page.locator("#export").click();

async function cancel() {
  await dialog().getByRole("button", {name: "Cancel"}).click();
  await dialog().waitFor({state: "hidden"});
  await eventually(async () => assert.equal(await making(), ""));
}

test("shows how far a piece has come", async () => {
  let seen = [];
  for (let i = 0; i < 3 && seen.length === 0; ++i) { // repeated, since a busy browser may miss all values
    await enter(page.locator("#resolution"), String(0.07 - 0.005 * i));
    await untilReady(page);
    await open();
    await dialog().getByText(/triangles/).waitFor();
    seen = await page.evaluate(() => window.seen.splice(0));
    await page.keyboard.press("Escape");
  }
  assert.ok(seen.at(-1) > 0 && seen.every((value, i) => value >= (seen[i - 1] ?? 0) && value <= 1), `${seen}`);
});

test("ends the engine's work when it is cancelled, and saves no file of it", async () => {
  await set("Height in mm", 4); // no piece of this height has been made yet
  await untilReady(page);
  await open();
  await eventually(async () => assert.notEqual(await making(), ""));
  await cancel();
  await open();
  await dialog().getByText(/triangles/).waitFor();
  await dialog().getByRole("button", {name: "Export"}).click(); // starts to write the file
  await cancel();
  await enter(page.locator("#resolution"), "2"); // the export after the cancelled one makes another file
  await untilReady(page);
  await open();
  await dialog().getByText(/triangles/).waitFor();
  await dialog().getByRole("button", {name: "Export"}).click();
  await page.getByRole("alert").getByText(/^Saved/).waitFor();
  const saved = await page.evaluate(() => window.saved);
  assert.equal(saved.length, 1, `${saved}`);
  assert.ok(saved[0] < 2e6, `${saved} bytes, and the other has many times as many`);
});

test("says of each format how large its file becomes", async () => {
  await open();
  await dialog().getByText(/triangles/).waitFor();
  const {formats} = await engine.about();
  assert.ok(formats.length > 5, `${formats.length} formats`);
  for (const {name} of formats) assert.match(await page.locator(`#size-${name}`).textContent(), /\d.* [kM]?(B|bytes)$/, name);
  await cancel();
});

test("lowers a height that a draft angle does not allow, also while the light table is shown", async () => {
  await enter(page.locator("#resolution"), "0.5");
  await enter(page.locator("#draft"), "40");
  await set("Height in mm", 60);
  await untilReady(page);
  await open();
  await dialog().getByText(/A height of 60.* is out of reach here/).waitFor();
  await dialog().getByText(/triangles/).waitFor();
  await cancel();
});

test("exports nothing whose piece cannot be made, and says why", async () => {
  const error = {kind: "option", input: "rim-bevel", text: "rim-bevel: expected 1 mm"};
  const refuse = (route) => route.fulfill({status: 400, json: {error}});
  await page.route("**/api/piece", refuse);
  await open();
  await dialog().getByText("Rim bevel: expected 1 mm").waitFor();
  await soon.ok(() => dialog().getByRole("button", {name: "Export", exact: true}).isDisabled());
  await cancel();
  await page.unroute("**/api/piece", refuse);
});
