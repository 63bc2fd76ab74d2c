// Keeps the document: the steps of the user's work, each with the options of the relief, for undo and redo. It is plain
// data, so that it can be stored and saved.

import {about, defaultOf, namesOf, optionOf} from "./about.js";

// Returns the value of an option in a new document: the studio's own default, or else the engine's.
const firstOf = ({name, in_studio: own}) => own ?? defaultOf(name, optionOf("method").in_studio);

export const FIRST = Object.freeze({
  input: null,
  // A document has u instead of alpha, which depends on the height.
  options: Object.freeze({...Object.fromEntries(about.options.filter(({name}) => name !== "alpha")
    .map((option) => [option.name, firstOf(option)])), "base-image": ""}),
  isHeightLocked: true,
  u: null, // parameter of the compression, while the height is not locked
  isDieOfPiece: false, // whether the die was made of another piece; it then keeps the kind of that piece
  material: "plaster",
  light: [-1, 1, 1],
});

const MOST_STEPS = 200, MOST_U = 1e12; // the engine's limit of u

// Returns the parameter u of the compression for the paper's alpha and beta.
export const uOfAlpha = (alpha, beta) => (alpha === 0 ? MOST_U : Math.min(alpha ** -beta, MOST_U));

const isSame = (a, b) => JSON.stringify(a) === JSON.stringify(b);

// Returns a step in which the values of `part` replace the former ones.
const withPart = (step, part) => ({...step, ...part, options: {...step.options, ...part.options}});

// Returns `part` without the values that were changed between the steps `base` and `later`.
function unlessChanged({options = {}, ...part}, base, later) {
  const kept = (values, was, is) =>
    Object.fromEntries(Object.entries(values).filter(([name]) => isSame(was[name], is[name])));
  return {...kept(part, base, later), options: kept(options, base.options, later.options)};
}

export class Document {
  constructor(onChange, onStrokeEnd = () => {}) {
    Object.assign(this, {onChange, onStrokeEnd});
    this.steps = [FIRST];
    this.at = 0;
    this.forgotten = 0; // number of steps that were dropped before the first one in `steps`
    this.changedAt = 0; // in milliseconds since 1970; decides which of two states is newer
  }

  stamp() {
    this.changedAt = Math.max(Date.now(), this.changedAt + 1);
  }

  get now() {
    return this.steps[this.at];
  }

  // Begins a document, without a call of onChange().
  begin(step) {
    this.steps = [step];
    this.at = 0;
    this.changedAt = 0; // any kept state is newer
    this.stroke = null;
  }

  // Changes the document. Changes of one stroke, such as a drag, are undone together.
  change(part, stroke = null) {
    const before = this.now;
    if (this.append(part, stroke)) this.onChange(before);
  }

  // Returns the number of steps before the present one, forgotten ones included.
  get position() {
    return this.forgotten + this.at;
  }

  // Returns the step at a position. If that step is forgotten, returns the first one that is kept; if the position is
  // after the present step, returns the present step.
  stepAt = (position) => this.steps[Math.min(this.at, Math.max(0, position - this.forgotten))];

  // Inserts a change after the step at a position. Later changes follow it and keep their values.
  changeAt(position, part) {
    const at = Math.max(0, position - this.forgotten);
    if (at >= this.at) return this.change(part);
    const before = this.now, base = this.steps[at];
    if (isSame(withPart(base, part), base)) return;
    this.steps = [...this.steps.slice(0, at + 1), ...this.steps.slice(at, this.at + 1).map((step) =>
      withPart(step, unlessChanged(part, base, step)))];
    this.at = this.steps.length - 1;
    if (this.stroke !== null)
      this.beforeStroke = {steps: this.steps.slice(0, -1), at: this.at - 1, forgotten: this.forgotten};
    this.stamp();
    this.onChange(before);
  }

  // Does the same as change() without a call of onChange(). Returns whether anything has changed.
  append(part, stroke = null) {
    if (stroke !== null && stroke === this.cancelled) return false;
    const next = withPart(this.now, part);
    if (isSame(next, this.now)) return false;
    if (stroke !== null && stroke === this.stroke) {
      this.steps[this.at] = next;
    } else {
      const {steps, at, forgotten} = this, excess = Math.max(0, at + 2 - MOST_STEPS);
      this.beforeStroke = {steps, at, forgotten};
      this.forgotten += excess;
      this.steps = [...steps.slice(excess, at + 1), next];
      this.at = this.steps.length - 1;
    }
    this.stroke = stroke;
    this.stamp();
    return true;
  }

  // Puts values that were found by the engine into the present step, without adding a step.
  note(part) {
    this.steps[this.at] = withPart(this.now, part);
  }

  // Ends the running stroke. If `stroke` is given, ends only that one: a slider's pause may end after another drag
  // began.
  endStroke(stroke = null) {
    if (stroke !== null && stroke !== (this.stroke ?? this.cancelled)) return;
    this.stroke = this.cancelled = null;
    this.onStrokeEnd();
  }

  // Takes back the changes of the running stroke, and ignores the rest of it. Returns whether a stroke was running.
  cancelStroke() {
    if (this.stroke === null) return false;
    const before = this.now;
    this.cancelled = this.stroke;
    this.stroke = null;
    Object.assign(this, this.beforeStroke); // restores the steps for redo, too
    this.stamp();
    this.onChange(before);
    return true;
  }

  // Returns whether so many steps can be redone or, if the number is negative, undone.
  can = (by) => this.steps[this.at + by] !== undefined;

  undo = () => this.move(-1);
  redo = () => this.move(1);
  move(by) {
    if (!this.can(by)) return;
    const before = this.now;
    this.at += by;
    this.stroke = null;
    this.stamp();
    this.onChange(before);
  }

  // Returns the document as plain data.
  keep = () => ({version: 1, changed: this.changedAt, steps: this.steps, at: this.at});

  // Takes over a kept state. Returns whether the state is valid.
  restore(kept) {
    if (kept?.version !== 1 || !Array.isArray(kept.steps) || !kept.steps[kept.at]?.input) return false;
    this.steps = kept.steps.map((step) => ({...FIRST, ...step, options: {...FIRST.options, ...step.options}}));
    this.at = kept.at;
    this.changedAt = kept.changed ?? 0;
    this.stroke = null;
    return true;
  }
}

// A lithophane, which is printed, has none of these options. A document keeps them for its other kinds of work.
export const NOT_PRINTED = ["draft", "tool", "finish"];

// The options of the shape of heights, which one vertical scale does not have.
const SHAPE = namesOf("shape").filter((name) => !/^(width|mm-per-value|ground)$/.test(name));

// The options of the shape that the paper's method does not have.
const NOT_OF_PAPER = SHAPE.filter((name) => /^(tone|steps|planes|light|colour)$/.test(name));

// The options of texts and ornaments, which need ground around the relief. A document keeps them while it has none.
export const ON_GROUND = namesOf("plate").filter((name) => /^(text|font|ornaments)/.test(name));
export const hasGround = ({options}) => options.outline !== "none" && options.form !== "lithophane";

// Returns whether one vertical scale gives the height.
export const hasScale = ({options}) => (options["mm-per-value"] ?? null) !== null && options.form !== "lithophane";

// Returns the options for the engine and `relievo make`. Leaves out those with the value of a new document, unless the
// engine wants them stated.
export function engineOptions(step) {
  const {outline, form} = step.options, options = {};
  for (const [name, value] of Object.entries(step.options)) {
    const isThere = value !== null && value !== "" && value !== undefined;
    if (isThere && (optionOf(name)?.is_stated || value !== FIRST.options[name])) options[name] = value;
  }
  options.height = Math.round(options.height * 1e4) / 1e4;
  if ("height-of-diagonal" in options) delete options.height; // until the first picture has it in mm
  if (outline === "round") options.corner = step.options.corner;
  else delete options.corner;
  if (form === "lithophane") for (const name of NOT_PRINTED) delete options[name];
  if (!hasGround(step)) for (const name of ON_GROUND) delete options[name];
  if (hasScale(step)) {
    for (const name of SHAPE) delete options[name];
    return {...options, method: "linear"};
  }
  delete options["mm-per-value"], delete options.ground; // kept for forms that have a scale
  if (options.method === "paper") for (const name of NOT_OF_PAPER) delete options[name]; // kept for the other method
  return options;
}

// The paths of base images that the engine failed to read for a picture.
const goneImages = new Set();
export const isGone = (path) => goneImages.has(path);
export const markGone = (path, isGone = true) => (isGone ? goneImages.add(path) : goneImages.delete(path));

// Returns the options of pictures: if the base image is missing, the relief is shown on a plane.
export function shownOptions(step) {
  const options = engineOptions(step);
  if (isGone(options["base-image"])) delete options.base, delete options["base-image"];
  return options;
}

// Returns a project file's content.
export function projectOf(step) {
  const {input, isHeightLocked, u, isDieOfPiece, material, light} = step;
  const studio = {isHeightLocked, u, material, light, ...(isDieOfPiece && {isDieOfPiece})};
  return {relievo: 1, input, options: engineOptions(step), studio};
}

// Returns whether a light is valid. A project file may have an invalid one, and the engine would then refuse each
// picture.
const isDirection = (light) =>
  Array.isArray(light) && light.length === 3 && light.every(Number.isFinite) && light.some((x) => x !== 0);

// Returns the step that a project file describes, as the engine has read it. `usual` has the defaults of numbers that
// the file does not state. Without a stated width, the plate may determine it.
export function stepOfProject({input, options: {alpha, ...own} = {}, usual = {}, studio = {}}) {
  const options = hasScale({options: own}) ? {...own, method: FIRST.options.method} : own;
  const method = options.method ?? (alpha === undefined ? FIRST.options.method : "paper");
  const step = {...FIRST, input, options: {...FIRST.options, ...usual, method, width: null, ...options}};
  if (options.height === undefined && method === "paper") {
    step.isHeightLocked = false;
    step.u = uOfAlpha(alpha ?? defaultOf("alpha"), step.options.saturation);
  }
  if (typeof studio.isHeightLocked === "boolean") step.isHeightLocked = studio.isHeightLocked;
  if (studio.isDieOfPiece === true) step.isDieOfPiece = true;
  if (Number.isFinite(studio.u) && studio.u >= 0 && studio.u <= MOST_U) step.u = studio.u;
  if (about.materials.some(({id}) => id === studio.material)) step.material = studio.material;
  if (isDirection(studio.light)) step.light = studio.light;
  return step;
}
