// Connects the parts of the studio's page.

import {about, defaultOf, engine} from "./about.js";
import {$, Slider, clamp, download, fileSize, make} from "./controls.js";
import {CurveEditor} from "./curve.js";
import {Document, FIRST, engineOptions, projectText, stepOfProject} from "./document.js";
import {ExportDialog} from "./export.js";
import {FIELDS, fillChoices} from "./fields.js";
import {takeArrowKeys, takeDrops, takeKeys} from "./inputs.js";
import {engineBack, engineLost, offer, toast} from "./messages.js";
import {showProgress} from "./progress.js";
import {showNumbers, showSection} from "./readouts.js";
import {Stage, TABLE_LIGHTS} from "./stage.js";
import {ViewDialog, viewName} from "./views.js";

const KEEP_MS = 400;

const doc = new Document((before) => changed(before));
const stage = new Stage(engine, doc, {picture: pictured, section: showSection, failed});
const curve = new CurveEditor((tone) => doc.change({options: {tone}}, "tone"), () => doc.endStroke());
const views = new ViewDialog(engine, (view) => doc.change({options: view}), failed);
const exporting = new ExportDialog(
  engine, () => ({facts, options: finalOptions(), name: baseName(), input: doc.now.input}),
  (options) => doc.change({options}));

let facts = null;
let status = {busy: false, model: 0};
let last = null; // numbers of the newest picture
let shownView = null; // the view of the model that is shown
let fallback = null; // the document before the scan that is being opened
let asking = 0; // requests for a scan or a view that the engine has not answered yet

// ------------------------------------------------------------------------------------------------- sliders

const lock = make("button", {
  class: "lock", "aria-label": "Lock the height", "aria-pressed": "true", onclick: toggleLock,
  title: "Keep this height while other things change",
});
lock.innerHTML = '<svg viewBox="0 0 24 24" aria-hidden="true"><rect x="5" y="11" width="14" height="9" rx="2"/>' +
  '<path class="shackle" d="M8 11V8a4 4 0 0 1 8 0v3"/></svg>';

const sliders = {};
for (const [name, field] of Object.entries(FIELDS)) {
  const slider = new Slider({...field, extra: name === "height" ? lock : null, otherwise: FIRST.options[name]},
    (value) => slide(name, value), () => doc.endStroke(), toast);
  sliders[name] = slider;
  $(field.place).append(slider.element);
}

function slide(name, value) {
  const part = {options: {[name]: value}};
  if (name === "height") part.u = null; // to be found anew
  doc.change(part, name);
}

// Changes the method. A soft rim that was not touched becomes the one that the new method starts from.
function changeMethod(method) {
  const {options} = doc.now;
  const isUntouched = options.boundary === defaultOf("boundary", options.method);
  const boundary = isUntouched ? defaultOf("boundary", method) : options.boundary;
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
  const hasNewView = before && !isSameView(viewOf(before), viewOf(now));
  if (hasNewView) {
    stage.await(true);
    ask(engine.chooseView(viewOf(now))).catch(failed);
  }
  stage.invalidate();
  keepSoon();
}

const viewOf = ({options: {view, up, crop, crumbs, denoise}}) => ({view, up, crop, crumbs, denoise});

const isSameView = (a, b) => Object.keys(a).every((name) => a[name] === b[name]);

function showDocument() {
  const {options, isHeightLocked, material, input} = doc.now;
  for (const [name, slider] of Object.entries(sliders)) slider.show(options[name]);
  sliders.saturation.disabled = options.tone !== "";
  lock.setAttribute("aria-pressed", isHeightLocked);
  curve.show({tone: options.tone});
  $("#method").value = options.method;
  $("#outline").value = options.outline;
  $("#crop").value = options.crop;
  $("#crumbs").checked = options.crumbs === "keep";
  showDenoise(options.denoise);
  $("#outline-note").textContent =
    options.outline === "rectangle" ? "" : "The files have this outline; the picture here keeps the rectangle.";
  sliders.corner.disabled = options.outline !== "round";
  sliders.margin.disabled = options.outline === "none";
  $("#undo").disabled = !doc.canUndo;
  $("#redo").disabled = !doc.canRedo;
  $("#view-name").textContent = viewName(options.view);
  for (const swatch of $("#materials").children) check(swatch, swatch.dataset.material === material);
  $("#title").textContent = input?.sample ? sampleName(input.sample) : input?.name ?? "";
  document.title = input ? `${input.name} – Relievo` : "Relievo studio";
}

function showDenoise(denoise) {
  const isMeasured = denoise === "auto", noise = isMeasured ? facts?.noise ?? 0 : Number(denoise);
  const slider = $("#denoise");
  slider.value = noise;
  slider.style.setProperty("--filled", `${100 * noise}%`);
  $("#denoise-value").textContent = noise.toFixed(2);
  $("#denoise-auto").checked = isMeasured;
}

// Checks a radio button, and lets only the checked one of its group be reached with the Tab key.
function check(radio, isChecked) {
  radio.setAttribute("aria-checked", isChecked);
  radio.tabIndex = isChecked ? 0 : -1;
}

let keeper = 0, isKept = !about.notice;
function keepSoon() {
  clearTimeout(keeper);
  keeper = setTimeout(() => engine.keepState(doc.keep()).then(() => (isKept = true), notKept), KEEP_MS);
}

// Says once that work is not kept, unless the engine is gone, which is said elsewhere.
function notKept({kind, message}) {
  if (isKept && kind !== "lost") toast(`Your work is not kept: ${message}`);
  if (kind !== "lost") isKept = false;
}
addEventListener("pagehide", () => doc.now.input && engine.keepState(doc.keep(), true).catch(() => {}));

// Returns the options of the files: a height that the view does not reach is replaced by the one that it does.
function finalOptions() {
  const options = engineOptions(doc.now);
  if (last && !last.is_height_met) options.height = Math.floor(last.height_mm * 1000) / 1000;
  return options;
}

const baseName = () => (doc.now.input?.name ?? "relief").replace(/\.[a-z0-9]+$/i, "");

// --------------------------------------------------------------------------------------------------- pictures

function pictured(frame, ms, isFine) {
  last = frame;
  if (!doc.now.isHeightLocked && !status.busy) {
    const height = Math.round(frame.height_mm * 1e4) / 1e4;
    doc.note({u: frame.u, options: {height: clamp(height, 1e-3, 1e5)}});
    sliders.height.show(doc.now.options.height);
    keepSoon();
  }
  curve.show({samples: frame.curve, histogram: facts?.histogram ?? []});
  $("#reach").textContent = frame.is_height_met ? "" : `This view reaches ${frame.height_mm.toFixed(2)} mm at most.`;
  const {detail} = doc.now.options;
  const words = Object.entries({alpha: frame.alpha, beta: frame.beta, gamma: detail, u: frame.u})
    .map(([name, value]) => `${name} ${number(value)}`);
  sliders.height.name.title = `${FIELDS.height.help}. In the paper's words: ${words.join(", ")}`;
  showNumbers({about: frame, ms, isFine, facts, height: shownHeight(frame)});
  stage.element.dispatchEvent(new CustomEvent("picture", {detail: {about: frame, ms, isFine}}));
}

const number = (x) => (x === null ? "–" : Number(x.toPrecision(4)).toString());

// Returns the height to show. A frame meets a locked height to a part in a thousand, the finished relief exactly.
const shownHeight = ({height_mm, is_height_met}) =>
  (doc.now.isHeightLocked && is_height_met ? doc.now.options.height : height_mm);

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
  showDenoise(doc.now.options.denoise);
  shownView = status.shown;
  fallback = null;
  if (doc.now.input && asking === 0) await followOtherTab().catch(failed);
  if (isSame(doc.now.input, status.input)) doc.note({input: status.input}); // now with its hash
  stage.isReady = true;
  stage.model = status.model;
  stage.await(false);
  stage.share = 1;
  $("#remarks").textContent = facts.remarks.join("  ");
  $("#save").hidden = $("#export").hidden = false;
  stage.invalidate();
}

async function ask(request) {
  ++asking;
  return request.finally(() => --asking);
}

// Takes over the scan or the view that another tab has asked for, with the document of that tab as far as it is kept.
async function followOtherTab() {
  const {input, wanted, shown} = status, mine = doc.keep();
  if (isSame(doc.now.input, input) || isSame(doc.now.input, wanted)) {
    if (isSame(doc.now.input, input) && isSame(input, wanted)) doc.note({options: shown});
    return showDocument();
  }
  const {state} = await engine.about();
  if (!doc.restore(state) || !isSame(doc.now.input, input))
    doc.begin({...FIRST, input, options: {...FIRST.options, ...shown}});
  showDocument();
  const step = mine.steps[mine.at];
  offer(`Another tab opened ${input.name}, which is shown here, too.`, `Go back to ${step.input.name}`, async () => {
    await openInput(step.input, step);
    if (isSame(doc.now.input, step.input) && doc.restore(mine)) showDocument();
  });
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
  if (shownView && !isSameView(shownView, viewOf(doc.now))) doc.change({options: shownView});
}

function failed(error) {
  if (error.kind === "geometry" && status.busy) return; // not ready yet: the next status will show it
  toast(error.message);
}

// ------------------------------------------------------------------------------------------------ open and save

async function openInput(input, step = {...FIRST, input}) {
  showStart(false);
  fallback = status.model > 0 ? doc.keep() : null;
  doc.begin({...step, input});
  stage.await(true);
  try {
    await ask(engine.open(input, viewOf(step)));
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

// Sends the file's bytes to the engine, which takes a moment for large scans.
async function takeIn(file) {
  const most = about.most_upload;
  if (file.size > most) throw new Error(`${file.name} has ${fileSize(file.size)}: expected at most ${fileSize(most)}.`);
  showStart(false);
  showProgress({busy: true, stage: "upload"}, status.model === 0);
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
  fillChoices("outline");
  $("#materials").append(...about.materials.map(({id, name}) => make("button", {
    role: "radio", "data-material": id, "aria-label": name, title: name, onclick: () => doc.change({material: id}),
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
  $("#crop").onchange = (event) => doc.change({options: {crop: event.target.value.replaceAll(" ", "")}});
  $("#crumbs").onchange = (event) => doc.change({options: {crumbs: event.target.checked ? "keep" : "drop"}});
  $("#denoise").oninput = (event) => showDenoise(event.target.value);
  $("#denoise").onchange = (event) => doc.change({options: {denoise: event.target.value}});
  $("#denoise-auto").onchange = (event) =>
    doc.change({options: {denoise: event.target.checked ? "auto" : $("#denoise").value}});
  $("#outline").onchange = (event) => doc.change({options: {outline: event.target.value}});
  $("#split").oninput = (event) => stage.setSplit(event.target.value / 1000);
  takeDrops($("#veil"), openFile);
  takeKeys({
    commands: COMMANDS, always: {"?": () => $("#help-dialog").showModal()}, keys: KEYS,
    isReady: () => facts && !$("#studio").hidden, hold: (isHeld) => stage.hold(isHeld),
  });
}

const COMMANDS = {
  z: () => doc.undo(), Z: () => doc.redo(), y: () => doc.redo(), o: () => $("#file").click(),
  s: () => facts && saveProject(), e: () => facts && exporting.open(),
};
const KEYS = {
  l: () => setTool("light"), o: () => setTool("turn"), h: () => setTool("pan"), s: () => setTool("section"),
  f: () => stage.fit(), t: () => setTable(!isPressed("#light-table")), Escape: () => setTable(false),
  c: () => setComparing(!isPressed("#compare")), v: () => views.show(doc.now.options),
  ...Object.fromEntries(about.materials.map(({id}, i) => [i + 1, () => doc.change({material: id})])),
};

// ------------------------------------------------------------------------------------------------------- start

function fillStart() {
  const card = ({name, description}) => make("button", {onclick: () => openInput({sample: name, name})},
    make("img", {src: `sample-${name}.jpg`, alt: "", width: 320, height: 200}),
    make("span", {}, make("b", {}, sampleName(name)), make("small", {}, description)));
  $("#samples").append(...about.samples.map((sample) => make("li", {}, card(sample))));
  const recent = about.recent.filter(({sample}) => !sample);
  $("#recent-shelf").hidden = recent.length === 0;
  const entry = (input) => make("button", {title: input.path, onclick: () => openInput(input)}, input.name);
  $("#recent").append(...recent.map((input) => make("li", {}, entry(input))));
}

const sampleName = (name) => (name[0].toUpperCase() + name.slice(1)).replaceAll("_", " ");

const isSame = (a, b) => a && b && (a.sample ?? "") === (b.sample ?? "") && (a.path ?? "") === (b.path ?? "");

// Goes on where the last page or the last run ended, unless the program was started with another scan.
async function resume({state, status: {wanted, model, shown}}) {
  const hasState = doc.restore(state);
  if (wanted && !(hasState && isSame(doc.now.input, wanted))) doc.begin({...FIRST, input: wanted});
  showDocument();
  if (!doc.now.input) return showStart(true);
  showStart(false);
  if (!wanted) return engine.open(doc.now.input, viewOf(doc.now));
  if (!isSameView(shown, viewOf(doc.now))) {
    if (model > 0) await engine.chooseView(viewOf(doc.now));
    else await engine.open(doc.now.input, viewOf(doc.now));
  }
}

async function start() {
  buildTools();
  wire();
  setTool("light");
  try {
    $("#readable").textContent = about.readable;
    $("#file").accept = [...about.endings, ".relievo"].join();
    fillStart();
    await resume(about);
  } catch (error) {
    failed(error);
    showStart(true);
  }
  if (about.notice) toast(about.notice, true);
  engine.follow(followed, engineLost);
}

start();
