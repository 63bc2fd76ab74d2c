// Connects the parts of the studio's page.

import {about, engine} from "./about.js";
import {AlphaRow} from "./panels/alpha.js";
import {Brush} from "./stage/brush.js";
import {takeCommands} from "./commands.js";
import {$, Pause, clamp, make} from "./controls.js";
import {CropFrame} from "./stage/crop_frame.js";
import {CurveEditor} from "./panels/curve.js";
import {DepthPanel} from "./panels/depth_panel.js";
import {Document, hasScale} from "./document.js";
import {Entries} from "./entries.js";
import {ExportDialog} from "./export.js";
import {FIELDS} from "./panels/fields.js";
import {Keeper} from "./keeper.js";
import {shown} from "./lengths.js";
import {engineLost, toast} from "./messages.js";
import {Modes} from "./modes.js";
import {KindPanel} from "./panels/kind_panel.js";
import {LettersPanel} from "./panels/letters_panel.js";
import {LightPanel} from "./panels/light_panel.js";
import {KindCards, fileName} from "./panels/kinds.js";
import {Outcome} from "./outcome.js";
import {PieceRows, inWords} from "./panels/pieces.js";
import {Placing} from "./stage/placing.js";
import {OpenDocument, isSameView, optionsOf, viewOf} from "./opening.js";
import {Projects} from "./projects.js";
import {Reach} from "./panels/reach.js";
import {paperWords, showNumbers, showProgress, showSection, showToolReach} from "./readouts.js";
import {ScanPanel} from "./panels/scan_panel.js";
import {ScenePanel} from "./panels/scene_panel.js";
import {ShownView} from "./shown_view.js";
import {Sliders} from "./panels/sliders.js";
import {Stage} from "./stage/stage.js";
import {SnapshotPanel} from "./panels/snapshot_panel.js";
import {StrokePanel} from "./panels/stroke_panel.js";
import {START, Shelf, nameOf, showSamples, thumbnailOf} from "./start.js";
import {Tour} from "./tour.js";
import {ViewDialog} from "./views.js";

const THUMBNAIL_MS = 600; // time from the fine picture until the document's thumbnail is stored
const SHOW_MS = 120; // length of a pause in a drag after which all controls are updated

const doc = new Document((before) => changed(before), () => showing.isRunning && showDocument());
const entries = new Entries({engine, doc, added: () => takeRefusalBack(), changed: showEntries, refused});
const sliders = new Sliders({doc, entries, facts: () => facts, say: refuse});
const shownWidth = () => sliders.shownWidth();
const placing = new Placing({doc, entries, shownWidth, setWidth: (width) => sliders.slide("width", width), say: refuse});
const cropFrame = new CropFrame({engine, doc, failed, done: () => modes.setTool("light")});
const brush = new Brush({engine, doc, modelFacts: () => modelFacts, say: refuse});
const strokePanel = new StrokePanel({doc, brush});
const stage = new Stage(engine, doc,
  {picture: pictured, section: showSection, failed, placing, cropFrame, brush, viewRests: () => shownView.choose()});
const curve = new CurveEditor(changeTone, () => doc.endGesture());
const views = new ViewDialog(engine, (view) => doc.change({options: view}), failed);
const modes = new Modes({stage, doc, cropFrame, sliders: sliders.elements, compared: () => snapshotPanel.mark()});
const snapshotPanel = new SnapshotPanel({doc, modes});
const alphaRow = new AlphaRow({doc, say: refuse});
const scanPanel = new ScanPanel({doc, cropOnPicture: () => modes.setTool("crop")});
const lightPanel = new LightPanel({doc, sliders: sliders.elements, say: refuse});
const letters = new LettersPanel({engine, doc, stage, say: refuse});
const pieces = new PieceRows({engine, doc, entries, say: refuse, shownWidth, redraw: stateCame});
const depthPanel = new DepthPanel({engine, doc, rows: pieces.elements});
const outcome = new Outcome({doc, stage, entries, pieces, facts: () => facts});
const exporting = new ExportDialog({engine, outcome, name: () => fileName(doc.now), heightText, say: toast});
const isAtRest = () => !stage.isAsking && doc.gesture === null && stage.finished === stage.wanted;
const kinds = new KindCards({engine, doc, entries, isAtRest, say: refuse});
const kindPanel = new KindPanel({doc, entries, elements: {...pieces.elements, ...sliders.elements}});
const tour = new Tour(() => {
  if (modelFacts && !$("#start").hidden) showStart(false);
  return modelFacts !== null;
});
const scenePanel = new ScenePanel({say: refuse, open: async (models) => {
  await outcome.entered();
  projects.openScene(models, {steps: doc.steps, at: doc.at}).catch(failed);
}});

const keeper = new Keeper({
  send: (...state) => engine.keep(...state), storage: localStorage, prefix: `${location.pathname}document:`,
  onOlder: () => opened.adopt().then((isNew) =>
    isNew && toast("Newer work of another page is shown here.")).catch(failed),
  onFailed: notKept, onKept: () => (isKept = true),
});
const opened = new OpenDocument({engine, doc, keeper, on: {
  begun, measured, arrived, failed, refused: (why) => (shownView.restore(), why && refuse(why)),
  changed: stateCame, progress,
  missing: (input, work) => projects.askFor(input, work), closed: () => showStart(true),
}});
const shownView = new ShownView({doc, stage, opened, showDocument, failed});
const reach = new Reach({engine, doc, slider: () => sliders.all.height, chooseView: () => views.show(doc.now.options)});
const projects = new Projects({engine, open: openInput, take, failed, rest: () => opened.id || showStart(true)});
const shelf = new Shelf({engine, opened, keeper, open: openInput, failed});

let modelFacts = null; // facts about the shown model
let facts = null; // facts about the newest picture
let isKept = !about.notice;

// Sets the tone curve of the document. Returns the curve that the document then has, which is the former curve if the
// drag was cancelled.
function changeTone(tone) {
  doc.change({options: {tone}}, "tone");
  return doc.now.options.tone;
}

function chooseUnit(unit) {
  shown.unit = unit;
  localStorage.setItem("unit", unit);
  sliders.showUnit();
  letters.show();
  pieces.show();
  if (facts) stage.invalidate();
}

// Shows why an entry was refused, until the user makes the next entry.
let takeRefusalBack = () => {};
function refuse(text) {
  takeRefusalBack = toast(text);
}
function refused({label}, error) {
  refuse(error.input ? inWords(error) : `${label}: ${error.message}`);
}
// Any entry removes the message about a refusal, even an entry that changes nothing. The end of a slider's movement
// does not count as an entry, since the changes came during the movement.
addEventListener("change", ({target}) => target.type !== "range" && takeRefusalBack(), true);

// ----------------------------------------------------------------------------------------------- the document

function changed(before) {
  const {now} = doc;
  // The message about a refusal stays during later changes of the same drag, because they are no new entries. It also
  // stays when a waiting entry is inserted, because that entry may be older than the refusal.
  if (!entries.isInserting && doc.steps.includes(before)) takeRefusalBack();
  opened.keep(doc.gesture !== null);
  tour.takeBack();
  doc.gesture === null ? showDocument() : showing.begin();
  if (!isSameView(viewOf(before), viewOf(now))) {
    stage.await(true);
    shownView.choose();
  }
  stage.invalidate();
}

// Shows the document after another tab or another engine changed it.
function stateCame() {
  showDocument();
  stage.invalidate();
  shownView.adopt();
}

// A drag updates its own control at once. The other controls are updated when the drag pauses or ends, since updating
// them takes as long as a picture.
const showing = new Pause(showDocument, SHOW_MS);

function showDocument() {
  showing.end();
  const {options, material, input} = doc.now;
  sliders.show();
  const isPaper = options.method === "paper"; // the paper's method has no tone curve
  $("#tone-curve").hidden = isPaper || hasScale(doc.now) || options.form === "lithophane";
  curve.show({tone: isPaper ? "" : options.tone});
  pieces.show();
  kinds.show();
  kindPanel.show();
  scanPanel.show();
  depthPanel.show();
  lightPanel.show();
  letters.show();
  cropFrame.refresh();
  strokePanel.show();
  snapshotPanel.show();
  entries.show();
  views.tell(doc.now, modelFacts !== null);
  modes.showMaterial(material);
  $("#title").textContent = nameOf(input);
  document.title = input ? `${input.name} – Relievo` : "Relievo studio";
}

function showEntries() {
  for (const part of [entries, pieces, sliders, kinds]) part.show();
}

// Tells the user once that changes are not stored. Not called if the engine is lost, because engineLost() reports that.
function notKept({message}) {
  if (isKept) toast(`Your work is not kept: ${message}`);
  isKept = false;
}
addEventListener("pagehide", () => keeper.flush());
addEventListener("pagehide", () => engine.leave());

// --------------------------------------------------------------------------------------------------- pictures

const pictureRests = new Pause(keepThumbnail, THUMBNAIL_MS);
async function keepThumbnail() {
  const {id} = opened, thumbnail = opened.isReady ? thumbnailOf($("#picture")) : "";
  if (thumbnail) await engine.keepThumbnail(id, thumbnail).catch(() => {}); // documents need no thumbnail
}

function pictured(newest, ms, isFine) {
  facts = newest;
  const isOfView = !facts.isTurned && !opened.asked && !opened.status.busy; // heights differ in other views
  if (isOfView && facts.options["height-of-diagonal"]) {
    doc.note({options: {height: facts.height_mm, "height-of-diagonal": null}});
    sliders.all.height.show(facts.height_mm);
  }
  const {u, options} = doc.now; // u or the height may have changed since the picture was requested
  const isNewest = u === null ? facts.options.height === options.height : facts.u === u;
  if (!doc.now.isHeightLocked && isOfView && isNewest && !hasScale(doc.now)) {
    const slider = sliders.all.height, rounded = slider.rounded(facts.height_mm);
    // A computed height is rounded to the slider's decimals, but not if it is below 0.1 mm, since rounding would then
    // change it much.
    const height = rounded < 0.1 ? facts.height_mm : rounded;
    doc.note({u: facts.u, options: {height: clamp(height, 1e-3, 1e5)}});
    slider.show(doc.now.options.height);
  }
  sliders.showWidth();
  sliders.showScaled();
  if (opened.status.busy) showProgress(opened.status, false);
  alphaRow.show(facts);
  isFine ? pictureRests.begin() : pictureRests.end();
  curve.show({samples: facts.curve, histogram: modelFacts?.histogram ?? []});
  if (opened.isReady) reach.pictured(facts, isFine, stage.model);
  if (isFine) kinds.pictured(opened.isReady ? stage.model : 0, stage.turning.shown);
  if (isFine) showToolReach(facts.tool);
  if (isFine) kindPanel.pictured(facts);
  sliders.all.height.name.title = `${FIELDS.height.help}. ${paperWords(facts, doc.now.options.detail)}`;
  showNumbers({facts, ms, isFine, modelFacts, height: heightText(facts.relief_height_mm)});
  stage.element.dispatchEvent(new CustomEvent("picture", {detail: {facts, ms, isFine}}));
}

// Returns a height as its field shows it.
function heightText(mm) {
  return sliders.all.height.text(mm);
}

// --------------------------------------------------------------------------------------------------- documents

function progress(status) {
  showProgress(status, facts === null);
  exporting.progress(status);
  if (stage.isReady && stage.model === status.model) shownView.settle(status);
}

// Called when another document was opened and its model is not ready yet. Removes the former document's pictures.
function begun(former) {
  if (former) toast(`Your work on ${former.name} is kept: the start page lists it.`);
  $(".inspector").scrollTop = 0;
  modelFacts = facts = null;
  shownView.clear();
  $("#picture").width = $("#before").width = 1;
  scanPanel.tell(null);
  depthPanel.tell(null);
  lightPanel.tell(null);
  letters.clear();
  scenePanel.show([]);
  for (const part of [kinds, reach]) part.clear();
  $("#numbers").textContent = "";
  stage.clear();
  stage.await(true);
  $("#save").hidden = $("#export").hidden = $("#choose-view").disabled = true;
  showStart(false);
  showDocument();
  showProgress({busy: true, stage: "waiting"}, true);
}

// Shows a turned relief while the first view is being prepared.
function measured({requested}) {
  if (stage.isReady || !engine.drawsMeanwhile) return;
  doc.note({options: optionsOf(opened.wantedView(requested), doc.now)});
  showDocument();
  $("#choose-view").disabled = false;
  stage.isReady = true;
  stage.await(true);
  stage.invalidate();
}

async function arrived(status) {
  const {id} = opened;
  try {
    const found = await engine.facts();
    if (id !== opened.id || status.model !== opened.model) return; // another model has arrived meanwhile
    modelFacts = found;
  } catch (error) {
    return failed(error);
  }
  stage.isReady = true;
  stage.model = status.model;
  shownView.arrived(status);
  showDocument();
  stage.share = 1;
  scanPanel.tell(modelFacts);
  depthPanel.tell(modelFacts.depth_image).catch(failed);
  lightPanel.tell(modelFacts);
  cropFrame.refresh();
  // With takesSeveral there is no panel, because a new scene file could not refer to the models' files.
  scenePanel.show(engine.takesSeveral ? [] : modelFacts.models);
  tour.offer();
  $("#save").hidden = $("#export").hidden = $("#choose-view").disabled = false;
  stage.invalidate();
}

const reopening = new Pause(() => opened.closed().catch(failed), 200);
function failed(error) {
  const isReady = opened.isReady && !opened.status.busy;
  if (error.kind === "geometry" && !isReady) return; // the next status will report this error
  if (placing.fit(error, facts)) return opened.keep(), stateCame();
  if (pieces.baseImage.isMissing(error)) return pieces.show(), stage.invalidate();
  if (error.kind !== "closed") return (error.kind === "lost" ? toast : refuse)(inWords(error));
  reopening.begin();
}

// Opens an input. First enters the texts that the user has typed, since they belong to the document that is shown now.
async function openInput(input, work) {
  await outcome.entered();
  return opened.open(input, work).catch(failed);
}

const openFiles = (files) => projects.openFiles(files).catch(failed);

// Until the promise `bytes` settles, shows that an upload or a download is running. Large scans take long.
async function take(bytes) {
  const isStart = !$("#start").hidden;
  showStart(false);
  showProgress({busy: true, stage: "upload"}, !opened.isReady);
  try {
    return await bytes;
  } catch (error) {
    showStart(isStart);
    throw error;
  } finally {
    showProgress(opened.status, !opened.isReady);
  }
}

const saveProject = () => projects.save(doc.now.input, outcome.step());

// ------------------------------------------------------------------------------------------------------- modes

function showStart(isShown) {
  $("#start").hidden = !isShown;
  $("#studio").hidden = isShown;
  $("#back").hidden = !opened.id;
  if (isShown) showRecentNow().catch(failed);
  else stage.invalidate();
}

const showRecentNow = () => keepThumbnail().then(() => shelf.show());

// ------------------------------------------------------------------------------------------------------- start

// Shows the document that the page's address names. If it names none, shows the input with which the program was
// started. If there is no such input either, shows the document that was changed last.
async function resume({first, recent}) {
  const mine = recent.find(({document}) => `#${document}` === location.hash);
  if (mine) return opened.open(mine.input);
  if (first?.options) return projects.openProject(first);
  const input = first?.input ?? recent[0]?.input;
  return input ? opened.open(input) : showStart(true);
}

async function start() {
  takeCommands({doc, stage, entries, exporting, views, modes, cropFrame, brush, opened, tour, save: saveProject, openFiles,
    isThere: () => modelFacts !== null, showStart, chooseUnit, failed});
  document.body.inert = false; // clicks before this would be lost
  $("#unit").value = localStorage.getItem("unit") === "in" ? "in" : "mm";
  chooseUnit($("#unit").value);
  try {
    $("#readable").textContent = about.readable;
    $("#limits").replaceChildren(...(about.limits ?? []).map((text) => make("li", {}, text)));
    $("#file").accept = [...about.endings, ".jpg", ".jpeg", ".webp", ".zip", ".npz", ".relievo"].join();
    showSamples(openInput);
    engine.follow((status) => opened.followed(status), engineLost, toast);
    await (location.hash === START ? showStart(true) : resume(about));
  } catch (error) {
    failed(error);
    showStart(true);
  }
  if (about.notice) toast(about.notice, true);
}

start();
