// The studio's page: puts its parts together.

import {$, Slider, clamp, download, make} from "./controls.js";
import {CurveEditor} from "./curve.js";
import {Document, FIRST, engineOptions, projectText, stepOfProject} from "./document.js";
import {NativeEngine} from "./engine.js";
import {ExportDialog} from "./export.js";
import {FIELDS, MATERIALS, RIMS} from "./fields.js";
import {takeArrowKeys, takeDrops, takeKeys} from "./inputs.js";
import {engineBack, engineLost, showProgress, toast} from "./messages.js";
import {showNumbers, showSection} from "./readouts.js";
import {Stage, TABLE_LIGHTS} from "./stage.js";
import {ViewDialog, viewName} from "./views.js";

const KEEP_MS = 400;

const engine = new NativeEngine();
const doc = new Document((before) => changed(before));
const stage = new Stage(engine, doc, {picture: pictured, section: showSection, failed});
const curve = new CurveEditor((tone) => doc.change({options: {tone}}, "tone"), () => doc.endStroke());
const views = new ViewDialog(engine, (view) => doc.change({options: view}), failed);
const exporting = new ExportDialog(engine, () => ({facts, options: finalOptions(), name: baseName()}),
  (options) => doc.change({options}));

let facts = null;
let status = {busy: false, model: 0};
let last = null; // what came with the newest picture
let shownView = null; // of the model that is shown
let fallback = null; // the document before the scan that is being opened

// ------------------------------------------------------------------------------------------------- sliders

const lock = make("button", {
  class: "lock", "aria-label": "Lock the height", "aria-pressed": "true", title: "Keep this height while other things change",
  onclick: toggleLock,
});
lock.innerHTML = '<svg viewBox="0 0 24 24" aria-hidden="true"><rect x="5" y="11" width="14" height="9" rx="2"/><path class="shackle" d="M8 11V8a4 4 0 0 1 8 0v3"/></svg>';

const sliders = {};
for (const [name, field] of Object.entries(FIELDS)) {
  const slider = new Slider({...field, extra: name === "height" ? lock : null, otherwise: FIRST.options[name]}, (value) => slide(name, value), () => doc.endStroke());
  sliders[name] = slider;
  $(field.place).append(slider.element);
}

function slide(name, value) {
  const part = {options: {[name]: value}};
  if (name === "height") part.u = null; // to be found anew
  doc.change(part, name);
}

// A rim that was not touched becomes the one that the new method starts from.
function changeMethod(method) {
  const {options} = doc.now;
  const boundary = options.boundary === RIMS[options.method] ? RIMS[method] : options.boundary;
  doc.change({options: {method, boundary}});
}

function toggleLock() {
  const {isHeightLocked} = doc.now;
  doc.change({isHeightLocked: !isHeightLocked, u: isHeightLocked ? last?.u ?? null : null});
}

// ----------------------------------------------------------------------------------------------- the document

function changed(before) {
  const {now} = doc;
  showDocument();
  const hasNewView = before && (before.options.view !== now.options.view || before.options.up !== now.options.up);
  if (hasNewView) {
    stage.await(true);
    engine.chooseView(viewOf(now)).catch(failed);
  }
  stage.invalidate();
  keepSoon();
}

const viewOf = ({options: {view, up}}) => ({view, up});

function showDocument() {
  const {options, isHeightLocked, material, input} = doc.now;
  for (const [name, slider] of Object.entries(sliders)) slider.show(options[name]);
  sliders.saturation.disabled = options.tone !== "";
  lock.setAttribute("aria-pressed", isHeightLocked);
  curve.show({tone: options.tone, saturation: options.saturation, method: options.method});
  $("#method").value = options.method;
  $("#outline").value = options.outline;
  $("#outline-note").textContent = options.outline === "rectangle" ? "" : "The files have this outline; the picture here keeps the rectangle.";
  sliders.corner.disabled = options.outline !== "round";
  sliders.margin.disabled = options.outline === "none";
  $("#undo").disabled = !doc.canUndo;
  $("#redo").disabled = !doc.canRedo;
  $("#view-name").textContent = viewName(options.view);
  for (const swatch of $("#materials").children) check(swatch, swatch.dataset.material === material);
  $("#title").textContent = input?.sample ? sampleName(input.sample) : input?.name ?? "";
  document.title = input ? `${input.name} – Relievo` : "Relievo studio";
}

// Exactly one of a radio group can be reached with the Tab key.
function check(radio, isChecked) {
  radio.setAttribute("aria-checked", isChecked);
  radio.tabIndex = isChecked ? 0 : -1;
}

let keeper = 0;
function keepSoon() {
  clearTimeout(keeper);
  keeper = setTimeout(() => engine.keepState(doc.keep()).catch(() => {}), KEEP_MS);
}
addEventListener("pagehide", () => doc.now.input && engine.keepState(doc.keep(), true).catch(() => {}));

// What is made: a height that the view does not reach is not asked for.
function finalOptions() {
  const options = engineOptions(doc.now);
  if (last && !last.is_height_met) options.height = Math.floor(last.height_mm * 1000) / 1000;
  return options;
}

const baseName = () => (doc.now.input?.name ?? "relief").replace(/\.[a-z0-9]+$/i, "");

// --------------------------------------------------------------------------------------------------- pictures

function pictured(about, ms, isFine) {
  last = about;
  if (!doc.now.isHeightLocked && !status.busy) {
    const height = Math.round(about.height_mm * 1e4) / 1e4;
    doc.note({u: about.u, options: {height: clamp(height, 1e-3, 1e5)}});
    sliders.height.show(doc.now.options.height);
    keepSoon();
  }
  curve.show({u: about.u ?? 1, delta: facts?.delta ?? 0.25, histogram: facts?.histogram ?? []});
  $("#reach").textContent = about.is_height_met ? "" : `This view reaches ${about.height_mm.toFixed(2)} mm at most.`;
  const paper = `alpha ${number(about.alpha)}, beta ${number(about.beta)}, gamma ${number(doc.now.options.detail)}, u ${number(about.u)}`;
  sliders.height.name.title = `${FIELDS.height.help}. In the paper's words: ${paper}`;
  showNumbers({about, ms, isFine, facts, height: shownHeight(about)});
  stage.element.dispatchEvent(new CustomEvent("picture", {detail: {about, ms, isFine}}));
}

const number = (x) => (x === null ? "–" : Number(x.toPrecision(4)).toString());

// A frame meets a locked height to a part in a thousand, the finished relief exactly.
const shownHeight = ({height_mm, is_height_met}) => (doc.now.isHeightLocked && is_height_met ? doc.now.options.height : height_mm);

// ----------------------------------------------------------------------------------------------------- status

function followed(next) {
  const before = status;
  status = next;
  engineBack();
  showProgress(status, status.model === 0);
  if (next.error && JSON.stringify(next.error) !== JSON.stringify(before.error)) complain(next);
  if (next.model !== before.model && next.model > 0) arrived();
}

async function arrived() {
  try {
    facts = await engine.facts();
  } catch (error) {
    return failed(error);
  }
  shownView = {view: status.view, up: status.up};
  fallback = null;
  if (isSame(doc.now.input, status.input)) doc.note({input: status.input}); // now with its hash
  stage.isReady = true;
  stage.model = status.model;
  stage.await(false);
  stage.share = 1;
  $("#remarks").textContent = facts.remarks.join("  ");
  $("#save").hidden = $("#export").hidden = false;
  stage.invalidate();
}

function complain({error, model}) {
  stage.await(false);
  if (error.kind !== "cancelled") toast(error.text);
  if (model === 0) return showStart(true);
  if (fallback && doc.restore(fallback)) {
    fallback = null; // the old relief is still there: go on with it
    showDocument();
    keepSoon();
    return;
  }
  const {view, up} = doc.now.options;
  if (shownView && (view !== shownView.view || up !== shownView.up)) doc.change({options: shownView});
}

function failed(error) {
  if (error.kind === "geometry" && status.busy) return; // not ready yet: the next status tells
  toast(error.message);
}

// ------------------------------------------------------------------------------------------------ open and save

async function openInput(input, step = {...FIRST, input}) {
  showStart(false);
  fallback = status.model > 0 ? doc.keep() : null;
  doc.begin({...step, input});
  stage.await(true);
  try {
    await engine.open(input, viewOf(step));
  } catch (error) {
    failed(error);
  }
}

async function openFile(file) {
  if (!file) return;
  try {
    if (!file.name.endsWith(".relievo")) return await openInput(await takeIn(file));
    const text = await file.text(), checked = await engine.readProject(file.name, text);
    const step = stepOfProject(text, checked);
    await openInput(step.input, step);
  } catch (error) {
    failed(error);
  }
}

// The engine gets the file's bytes; for large scans that takes a moment.
async function takeIn(file) {
  showStart(false);
  showProgress({busy: true, stage: "take in"}, status.model === 0);
  try {
    return await engine.upload(file);
  } catch (error) {
    showProgress(status, status.model === 0);
    showStart(status.model === 0);
    throw error;
  }
}

function saveProject() {
  const step = {...doc.now, options: {...doc.now.options, height: finalOptions().height}};
  download(new Blob([projectText(step)], {type: "application/json"}), `${baseName()}.relievo`);
}

// ------------------------------------------------------------------------------------------------------- modes

function showStart(isShown) {
  $("#start").hidden = !isShown;
  $("#studio").hidden = isShown;
  $("#back").hidden = !(doc.now.input && status.model > 0);
  if (!isShown) stage.invalidate();
}

function setTool(tool) {
  for (const button of $("#tools").children) check(button, button.dataset.tool === tool);
  $("#section").hidden = tool !== "section";
  if (tool !== "light") setTable(false);
  stage.setTool(tool);
}

function setTable(isShown) {
  $("#light-table").setAttribute("aria-pressed", isShown);
  $("#table").hidden = !isShown;
  stage.setTable(isShown);
}

function setComparing(isComparing) {
  $("#compare").setAttribute("aria-pressed", isComparing);
  $("#split").hidden = $("#labels").hidden = !isComparing;
  stage.setComparing(isComparing);
}

const isPressed = (selector) => $(selector).getAttribute("aria-pressed") === "true";

// ------------------------------------------------------------------------------------------------------- wiring

function buildTools() {
  $("#materials").append(...Object.entries(MATERIALS).map(([material, name]) => make("button", {
    role: "radio", "data-material": material, "aria-label": name, title: name, onclick: () => doc.change({material}),
  })));
  $("#table").append(...TABLE_LIGHTS.map(({name, light}, i) => make("button", {
    "data-cell": i, "aria-label": `Light from: ${name}`, onclick: () => {
      doc.change({light});
      setTable(false);
    },
  }, make("canvas", {"aria-hidden": "true"}), make("span", {"aria-hidden": "true"}, name))));
  for (const button of $("#tools").children) button.onclick = () => setTool(button.dataset.tool);
  takeArrowKeys($("#tools"));
  takeArrowKeys($("#materials"));
}

function wire() {
  const click = (selector, action) => ($(selector).onclick = action);
  click("#undo", () => doc.undo());
  click("#redo", () => doc.redo());
  click("#open", () => $("#file").click());
  click("#drop", () => $("#file").click());
  click("#save", saveProject);
  click("#export", () => exporting.open());
  click("#help", () => $("#help-dialog").showModal());
  click("#home", () => showStart(true));
  click("#back", () => showStart(false));
  click("#cancel", () => engine.cancel().catch(failed));
  click("#choose-view", () => views.show(doc.now.options));
  click("#light-table", () => setTable(!isPressed("#light-table")));
  click("#compare", () => setComparing(!isPressed("#compare")));
  click("#fit", () => stage.fit());
  $("#file").onchange = (event) => {
    openFile(event.target.files[0]);
    event.target.value = "";
  };
  $("#method").onchange = (event) => changeMethod(event.target.value);
  $("#outline").onchange = (event) => doc.change({options: {outline: event.target.value}});
  $("#split").oninput = (event) => stage.setSplit(event.target.value / 1000);
  takeDrops($("#veil"), openFile);
  takeKeys({
    commands: COMMANDS, always: {"?": () => $("#help-dialog").showModal()}, keys: KEYS,
    isReady: () => facts && !$("#studio").hidden, hold: (isHeld) => stage.hold(isHeld),
  });
}

const COMMANDS = {
  z: () => doc.undo(), Z: () => doc.redo(), y: () => doc.redo(), o: () => $("#file").click(), s: () => facts && saveProject(), e: () => facts && exporting.open(),
};
const KEYS = {
  l: () => setTool("light"), o: () => setTool("turn"), h: () => setTool("pan"), s: () => setTool("section"), f: () => stage.fit(),
  t: () => setTable(!isPressed("#light-table")), c: () => setComparing(!isPressed("#compare")), v: () => views.show(doc.now.options),
  Escape: () => setTable(false),
  ...Object.fromEntries(Object.keys(MATERIALS).map((material, i) => [i + 1, () => doc.change({material})])),
};

// ------------------------------------------------------------------------------------------------------- start

function fillStart(about) {
  $("#samples").append(...about.samples.map(({name, description}) => make("li", {}, make("button", {onclick: () => openInput({sample: name, name})},
    make("img", {src: `sample-${name}.jpg`, alt: "", width: 320, height: 200}),
    make("span", {}, make("b", {}, sampleName(name)), make("small", {}, description))))));
  const recent = about.recent.filter(({sample}) => !sample);
  $("#recent-shelf").hidden = recent.length === 0;
  $("#recent").append(...recent.map((input) => make("li", {}, make("button", {title: input.path, onclick: () => openInput(input)}, input.name))));
}

const sampleName = (name) => (name[0].toUpperCase() + name.slice(1)).replaceAll("_", " ");

const isSame = (a, b) => a && b && (a.sample ?? "") === (b.sample ?? "") && (a.path ?? "") === (b.path ?? "");

// Goes on where the last page or the last run ended, unless the program was started with another scan.
async function resume({state, status: {wanted, model, view, up}}) {
  const hasState = doc.restore(state);
  if (wanted && !(hasState && isSame(doc.now.input, wanted))) doc.begin({...FIRST, input: wanted});
  showDocument();
  if (!doc.now.input) return showStart(true);
  showStart(false);
  if (!wanted) return engine.open(doc.now.input, viewOf(doc.now));
  const {options} = doc.now;
  if (options.view !== view || options.up !== up) {
    if (model > 0) await engine.chooseView(viewOf(doc.now));
    else await engine.open(doc.now.input, viewOf(doc.now));
  }
}

async function start() {
  buildTools();
  wire();
  setTool("light");
  try {
    const about = await engine.about();
    fillStart(about);
    await resume(about);
  } catch (error) {
    failed(error);
    showStart(true);
  }
  engine.follow(followed, engineLost);
}

start();
