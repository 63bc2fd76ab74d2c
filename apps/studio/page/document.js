// Keeps the document: a list of steps for undo and redo, each with all options of the relief. The document is plain
// data, so it can be stored and saved as JSON.

import {about, defaultOf, namesOf, optionOf} from "./about.js";
import {knownOptions, packedSteps, snapshotsIn, unpackedSteps} from "./snapshots.js";

// Returns the value of an option in a new document: the studio's own default, or the engine's if there is none.
const firstOf = ({name, in_studio: own}) => own ?? defaultOf(name, optionOf("method").in_studio);

export const FIRST = Object.freeze({
  input: null,
  // A document stores u instead of alpha, see uOfAlpha().
  options: Object.freeze({...Object.fromEntries(about.options.filter(({name}) => name !== "alpha")
    .map((option) => [option.name, firstOf(option)])), "base-image": ""}),
  isHeightLocked: true,
  u: null, // parameter of the compression; null while the height decides it
  isDieOfPiece: false, // whether the die was made from a piece of another kind, see kindOf()
  material: "plaster",
  light: [-1, 1, 1],
  snapshots: Object.freeze([]),
});

const MOST_STEPS = 200, MOST_U = 1e12; // MOST_U: the engine's limit of u

// Returns the parameter u of the compression for the paper's alpha and beta.
export const uOfAlpha = (alpha, beta) => (alpha === 0 ? MOST_U : Math.min(alpha ** -beta, MOST_U));

const isSame = (a, b) => a === b || JSON.stringify(a) === JSON.stringify(b);
const isSameStep = (a, b) => Object.keys(a).every((key) => isSame(a[key], b[key]));

// Returns a step that has the values of `part` in place of the former ones.
const withPart = (step, part) => ({...step, ...part, options: {...step.options, ...part.options}});

// Returns `part` without the names whose values differ between the steps `base` and `later`.
function unlessChanged({options = {}, ...part}, base, later) {
  const kept = (values, was, is) =>
    Object.fromEntries(Object.entries(values).filter(([name]) => isSame(was[name], is[name])));
  return {...kept(part, base, later), options: kept(options, base.options, later.options)};
}

export class Document {
  constructor(onChange, onGestureEnd = () => {}) {
    Object.assign(this, {onChange, onGestureEnd});
    this.steps = [FIRST];
    this.at = 0;
    this.forgotten = 0; // number of old steps that were dropped from the beginning of `steps`
    this.changedAt = 0; // time of the last change in ms since 1970; a stored state with a later time replaces this one
  }

  stamp() {
    this.changedAt = Math.max(Date.now(), this.changedAt + 1);
  }

  get now() {
    return this.steps[this.at];
  }

  // Begins a new document. Does not call onChange().
  begin(step) {
    this.steps = [step];
    this.at = 0;
    this.changedAt = 0; // any stored state is newer than this
    this.gesture = null;
  }

  // Changes the document. Changes with the same `gesture`, such as those of one drag, are undone together.
  change(part, gesture = null) {
    const before = this.now;
    if (this.append(part, gesture)) this.onChange(before);
  }

  // Returns the number of steps before the current one, dropped steps included.
  get position() {
    return this.forgotten + this.at;
  }

  // Returns the step at a position. If that step was dropped, returns the first remaining one; if the position is after
  // the current step, returns the current step.
  stepAt = (position) => this.steps[Math.min(this.at, Math.max(0, position - this.forgotten))];

  // Inserts a change after the step at a position. Values that later steps have changed stay as they are.
  changeAt(position, part) {
    const at = Math.max(0, position - this.forgotten);
    if (at >= this.at) return this.change(part);
    const before = this.now, base = this.steps[at];
    if (isSameStep(withPart(base, part), base)) return;
    this.steps = [...this.steps.slice(0, at + 1), ...this.steps.slice(at, this.at + 1).map((step) =>
      withPart(step, unlessChanged(part, base, step)))];
    this.at = this.steps.length - 1;
    if (this.gesture !== null)
      this.beforeGesture = {steps: this.steps.slice(0, -1), at: this.at - 1, forgotten: this.forgotten};
    this.stamp();
    this.onChange(before);
  }

  // Makes the same change as change(), but does not call onChange(). Returns whether anything has changed.
  append(part, gesture = null) {
    if (gesture !== null && gesture === this.cancelled) return false;
    const next = withPart(this.now, part);
    if (isSameStep(next, this.now)) return false;
    if (gesture !== null && gesture === this.gesture) {
      this.steps[this.at] = next;
    } else {
      const {steps, at, forgotten} = this, excess = Math.max(0, at + 2 - MOST_STEPS);
      this.beforeGesture = {steps, at, forgotten};
      this.forgotten += excess;
      this.steps = [...steps.slice(excess, at + 1), next];
      this.at = this.steps.length - 1;
    }
    this.gesture = gesture;
    this.stamp();
    return true;
  }

  // Returns whether one of the steps has the settings of the step `settings`. The scan may have another path.
  has = (settings) => this.steps.some((step) => isSameStep(withPart(step, {...settings, input: step.input}), step));

  // Changes the current step to values that the engine has found. Adds no step.
  note(part) {
    this.steps[this.at] = withPart(this.now, part);
  }

  // Ends the running gesture. If `gesture` is given, ends only that gesture, because the pause after a slider's
  // movement may end when the next drag has already begun.
  endGesture(gesture = null) {
    if (gesture !== null && gesture !== (this.gesture ?? this.cancelled)) return;
    this.gesture = this.cancelled = null;
    this.onGestureEnd();
  }

  // Undoes the changes of the running gesture, and ignores its further changes. Returns whether a gesture was running.
  cancelGesture() {
    if (this.gesture === null) return false;
    const before = this.now;
    this.cancelled = this.gesture;
    this.gesture = null;
    Object.assign(this, this.beforeGesture); // also restores the steps that redo needs
    this.stamp();
    this.onChange(before);
    return true;
  }

  // Returns whether that many steps can be redone or, if the number is negative, undone.
  can = (by) => this.steps[this.at + by] !== undefined;

  undo = () => this.move(-1);
  redo = () => this.move(1);
  move(by) {
    if (!this.can(by)) return;
    const before = this.now;
    this.at += by;
    this.gesture = null;
    this.stamp();
    this.onChange(before);
  }

  keep = () => ({version: 1, changed: this.changedAt, at: this.at, ...packedSteps(this.steps)});

  // Takes over a stored state. Returns whether the state is valid.
  restore(kept) {
    if (kept?.version !== 1 || !Array.isArray(kept.steps) || !kept.steps[kept.at]?.input) return false;
    this.steps = unpackedSteps(kept).map((step) =>
      ({...FIRST, ...step, options: {...FIRST.options, ...step.options}}));
    this.at = kept.at;
    this.changedAt = kept.changed ?? 0;
    this.gesture = null;
    return true;
  }
}

// These options are for milling, casting and striking. A lithophane is printed, so they do not apply to it. The
// document keeps their values for other kinds of work.
export const NOT_PRINTED = ["draft", "tool", "finish"];

// The options of the relief's shape that have no effect if mm-per-value is set.
const SHAPE = namesOf("shape").filter((name) => !/^(width|mm-per-value|ground)$/.test(name));

// The options of the shape that the method `paper` does not have.
const NOT_OF_PAPER = SHAPE.filter((name) => /^(tone|steps|planes|light|attention|colour|strokes)$/.test(name));

// The options of texts and ornaments, which need ground around the relief. A document without ground keeps these
// options.
export const ON_GROUND = namesOf("plate").filter((name) => /^(text|font|ornaments)/.test(name));
export const hasGround = ({options}) => options.outline !== "none" && options.form !== "lithophane";

// Returns whether a piece shows the figure mirrored.
export const isMirrored = ({options: {form}}) => form === "mirror" || form === "die";

export const hasScale = ({options}) => (options["mm-per-value"] ?? null) !== null && options.form !== "lithophane";

// Returns the options for the engine and for `relievo make`. Leaves out options that have the value of a new document,
// except those that must always be stated (`is_stated`).
export function engineOptions(step) {
  const {outline, form} = step.options, options = {};
  for (const [name, value] of Object.entries(step.options)) {
    const isThere = value !== null && value !== "" && value !== undefined;
    if (isThere && (optionOf(name)?.is_stated || value !== FIRST.options[name])) options[name] = value;
  }
  options.height = Math.round(options.height * 1e4) / 1e4;
  if ("height-of-diagonal" in options) delete options.height; // the first picture reports the height in mm
  if (outline === "round") options.corner = step.options.corner;
  else delete options.corner;
  if (form === "lithophane") for (const name of NOT_PRINTED) delete options[name];
  if (!hasGround(step)) for (const name of ON_GROUND) delete options[name];
  if (hasScale(step)) {
    for (const name of SHAPE) delete options[name];
    return {...options, method: "linear"};
  }
  delete options["mm-per-value"], delete options.ground; // the document keeps them for forms with a scale
  if (options.method === "paper") for (const name of NOT_OF_PAPER) delete options[name]; // the document keeps them
  return options;
}

// The paths of the base images that the engine could not read when it drew a picture.
const goneImages = new Set();
export const isGone = (path) => goneImages.has(path);
export const markGone = (path, isGone = true) => (isGone ? goneImages.add(path) : goneImages.delete(path));

// Returns the options for pictures. If the base's height map is missing, the relief is shown on a plane.
export function shownOptions(step) {
  const options = engineOptions(step);
  if (isGone(options["base-image"])) delete options.base, delete options["base-image"];
  return options;
}

// Returns the content of a project file. `studio.kept` has the options that do not apply to this kind of piece, such as
// the letters of a lithophane. The document keeps them for other kinds.
export function projectOf(step) {
  const {input, isHeightLocked, u, isDieOfPiece, material, light, snapshots} = step, options = engineOptions(step);
  const kept = Object.fromEntries(Object.entries(step.options).filter(([name, value]) => !(name in options) &&
    (value ?? "") !== "" && value !== FIRST.options[name]));
  const studio = {isHeightLocked, u, material, light, ...(isDieOfPiece && {isDieOfPiece}),
    ...(Object.keys(kept).length > 0 && {kept}), ...(snapshots.length > 0 && {snapshots})};
  return {relievo: 1, input, options, studio};
}

// Returns whether a direction of light is valid. With an invalid one from a project file, the engine would refuse every
// picture.
const isDirection = (light) =>
  Array.isArray(light) && light.length === 3 && light.every(Number.isFinite) && light.some((x) => x !== 0);

// Returns those settings of a project file that only the studio has, without invalid ones.
export function studioPart({isHeightLocked, isDieOfPiece, u, material, light}) {
  return {...(typeof isHeightLocked === "boolean" && {isHeightLocked}), ...(isDieOfPiece === true && {isDieOfPiece}),
    ...(Number.isFinite(u) && u >= 0 && u <= MOST_U && {u}),
    ...(about.materials.some(({id}) => id === material) && {material}), ...(isDirection(light) && {light})};
}

// Returns the document's step for the content of a project file that the engine has read. `usual` has the defaults of
// numbers that the file does not state. If the file states no width, the size of the plate determines the width.
export function stepOfProject({input, options: {alpha, ...own} = {}, usual = {}, studio = {}}) {
  const options = hasScale({options: own}) ? {...own, method: FIRST.options.method} : own;
  const method = options.method ?? (alpha === undefined ? FIRST.options.method : "paper");
  // The engine states defaults for all options, so the options in `studio.kept` come last.
  const step = {...FIRST, input,
    options: {...FIRST.options, ...usual, method, width: null, ...options, ...knownOptions(studio.kept)}};
  if (options.height === undefined && method === "paper") {
    step.isHeightLocked = false;
    step.u = uOfAlpha(alpha ?? defaultOf("alpha"), step.options.saturation);
  }
  return {...step, ...studioPart(studio), snapshots: snapshotsIn(studio.snapshots)};
}
