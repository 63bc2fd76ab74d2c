// Lists the states of the studio's page, for tests and pictures. Each state starts and ends at the plain relief: one
// scan from a file, with all panels open.
import {button, choose, field, takeBack, undo} from "./page_suite.mjs";
import {enter, untilReady} from "./support.mjs";

const press = (name) => (page) => button(name, page).click();
const escape = (page) => page.keyboard.press("Escape");
const nothing = () => {};

const tool = (name) => ({enter: (page) => choose(name, page), leave: (page) => choose("Light", page)});

// Returns a function that leaves a state: it undoes `times` steps, and waits until the page is ready.
const undone = (times) => (page) => takeBack(times, page);
const kind = (name) => ({enter: (page) => choose(name, page), leave: undone(1)});

// Paints a dab by the keyboard, in the middle of the picture.
const painting = async (page) => {
  await choose("Brush", page);
  await page.locator("#stage").press(" ");
  await page.locator("#stage").press(" ");
  await page.locator("#strokes").waitFor();
  await untilReady(page);
};
const painted = async (page) => {
  await undo(1, page);
  await choose("Light", page);
};

// Requests a height that is out of reach even with steps at depth jumps.
const highest = async (page) => {
  await enter(field("Steepest wall in degrees", page), "30");
  await enter(field("Height in mm", page), "900");
  await page.locator("#reach button").waitFor();
};

const exporting = async (page) => {
  await button("Export", page).click();
  const dialog = page.getByRole("dialog", {name: "Export"});
  await dialog.getByText(/triangles/).waitFor();
  await dialog.getByRole("checkbox", {name: /^Height map/}).check();
};

// Each step of the tour is reached from the plain relief, not from the step before it.
const tourStep = (step) => ({
  part: ".tour", leave: escape, enter: async (page) => {
    await button("Help", page).click();
    await button("Take the tour", page).click();
    for (let i = 1; i < step; ++i) await button("Next", page).click();
  },
});

const message = (page) => page.evaluate(async () => {
  const {offer} = await import(new URL("messages.js", location));
  offer("A scan of a long name.ply is not found at /home/somebody/models/a scan of a long name.ply.", "Locate it");
});

export const STATES = {
  "the relief": {enter: nothing, leave: nothing},
  ...Object.fromEntries(["Turn", "Orbit", "Pan", "Place", "Brush", "Crop", "Section", "Measure"].map((name) =>
    [`tool ${name}`, tool(name)])),
  ...Object.fromEntries(["Coin", "Carving", "Seal", "Lithophane", "Bent"].map((name) => [`kind ${name}`, kind(name)])),
  "a stroke": {enter: painting, leave: painted},
  "light for which the relief is made": {
    enter: (page) => page.getByLabel("Made for one light").check(), leave: undone(1),
  },
  "letters and a line": {enter: async (page) => {
    for (const name of ["Add a line", "Add a text"]) await press(name)(page);
    await untilReady(page);
  }, leave: undone(2)},
  "a height out of reach": {enter: highest, leave: undone(2)},
  "a snapshot that is compared": {enter: async (page) => {
    for (const name of ["Take a snapshot", "Compare Snapshot 1"]) await press(name)(page);
    await untilReady(page);
  }, leave: undone(1)},
  comparison: {enter: press("Compare"), leave: press("Compare")},
  "light table": {enter: press("Light table"), leave: press("Light table")},
  "choosing the view": {part: "#view-dialog", enter: press("Choose view"), leave: escape},
  export: {part: "#export-dialog", enter: exporting, leave: escape},
  saving: {part: "#save-dialog", enter: press("Save project"), leave: escape},
  help: {part: "#help-dialog", enter: press("Help"), leave: escape},
  ...Object.fromEntries([1, 2, 3, 4, 5].map((step) => [`tour, step ${step}`, tourStep(step)])),
  "a message": {part: "#toast", enter: message, leave: press("Dismiss")},
  "the start page": {enter: press("Relievo, start page"), leave: press("Back to the relief")},
};

// Opens several scans as a scene, which has its own document.
export async function showScene(page, scans) {
  await page.locator("#file").setInputFiles(scans);
  await page.locator("#scene").waitFor();
  await untilReady(page);
}
