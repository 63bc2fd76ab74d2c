// The document: the options of the relief that is being made, and all its former states. It is plain data, so that
// it can be stored, undone and saved.

import {about, defaultOf} from "./about.js";

// The options whose first value in the page differs from the engine's default.
const START = {height: 4, method: "layered", mode: "auto", tone: "", up: "", crop: "", crumbs: "drop", denoise: "auto"};

// The options that the page changes besides.
const CHANGED = ["width", "saturation", "detail", "steepest", "boundary", "steps", "view", "outline", "corner",
  "margin", "thickness", "form", "resolution", "tolerance", "draft"];

export const FIRST = Object.freeze({
  input: null,
  options: Object.freeze({
    ...Object.fromEntries(CHANGED.map((name) => [name, defaultOf(name, START.method)])), ...START,
  }),
  isHeightLocked: true,
  u: null, // of the compression, while the height is not locked
  material: "plaster",
  light: [-1, 1, 1],
});

const MOST_STEPS = 200, MOST_U = 1e12; // as the engine takes it

// Documents of older versions call the method `layered` by its former name.
const renamed = (options) => (options?.method === "ours" ? {...options, method: "layered"} : options);

export class Document {
  constructor(onChange) {
    this.onChange = onChange;
    this.steps = [FIRST];
    this.at = 0;
  }

  get now() {
    return this.steps[this.at];
  }

  // A new document begins; nothing of the old one can be undone any more.
  begin(step) {
    this.steps = [step];
    this.at = 0;
    this.stroke = null;
    this.onChange(null);
  }

  // Changes the document. Changes of one stroke, such as a drag, are undone together.
  change(part, stroke = null) {
    const next = {...this.now, ...part, options: {...this.now.options, ...part.options}};
    if (JSON.stringify(next) === JSON.stringify(this.now)) return;
    const before = this.now;
    if (stroke !== null && stroke === this.stroke) {
      this.steps[this.at] = next;
    } else {
      this.steps = [...this.steps.slice(Math.max(0, this.at + 2 - MOST_STEPS), this.at + 1), next];
      this.at = this.steps.length - 1;
    }
    this.stroke = stroke;
    this.onChange(before);
  }

  // Enters what the engine found out, which is no step of its own.
  note(part) {
    this.steps[this.at] = {...this.now, ...part, options: {...this.now.options, ...part.options}};
  }

  endStroke() {
    this.stroke = null;
  }

  get canUndo() {
    return this.at > 0;
  }
  get canRedo() {
    return this.at + 1 < this.steps.length;
  }

  undo() {
    if (this.canUndo) this.move(-1);
  }
  redo() {
    if (this.canRedo) this.move(1);
  }
  move(by) {
    const before = this.now;
    this.at += by;
    this.stroke = null;
    this.onChange(before);
  }

  keep() {
    return {version: 1, steps: this.steps, at: this.at};
  }

  // Returns whether the kept state could be used.
  restore(kept) {
    if (kept?.version !== 1 || !Array.isArray(kept.steps) || !kept.steps[kept.at]?.input) return false;
    this.steps = kept.steps.map((step) => ({...FIRST, ...step, options: {...FIRST.options, ...renamed(step.options)}}));
    this.at = kept.at;
    return true;
  }
}

// Returns the options as the engine and `relievo make` take them.
export function engineOptions(step) {
  const {
    steepest, tone, up, crop, crumbs, denoise, form, outline, corner, resolution, tolerance, draft, ...rest
  } = step.options;
  const options = {...rest, height: Math.round(rest.height * 1e4) / 1e4};
  if (steepest !== FIRST.options.steepest) options.steepest = steepest; // without it the paper's bound rules
  if (tone) options.tone = tone;
  if (form !== FIRST.options.form) options.form = form;
  if (outline !== FIRST.options.outline) options.outline = outline;
  if (outline === "round") options.corner = corner;
  if (resolution) options.resolution = resolution;
  if (tolerance) options.tolerance = tolerance;
  if (draft && form !== "lithophane") options.draft = draft;
  if (up) options.up = up;
  if (crop) options.crop = crop;
  if (crumbs !== START.crumbs) options.crumbs = crumbs;
  if (denoise !== START.denoise) options.denoise = denoise;
  return options;
}

// Returns the text of a project file.
export function projectText(step) {
  const {input, isHeightLocked, u, material, light} = step;
  const project = {relievo: 1, input, options: engineOptions(step), studio: {isHeightLocked, u, material, light}};
  return JSON.stringify(project, null, 1) + "\n";
}

// A project file may come from anywhere: what the engine would refuse in each picture is left out.
const isDirection = (light) =>
  Array.isArray(light) && light.length === 3 && light.every(Number.isFinite) && light.some((x) => x !== 0);

// Returns the step that a project file describes; `checked` is what the engine read in it.
export function stepOfProject(text, checked) {
  const {studio = {}} = JSON.parse(text);
  const step = {...FIRST, input: checked.input, options: {...FIRST.options, ...checked.options}};
  if (typeof studio.isHeightLocked === "boolean") step.isHeightLocked = studio.isHeightLocked;
  if (Number.isFinite(studio.u) && studio.u >= 0 && studio.u <= MOST_U) step.u = studio.u;
  if (about.materials.some(({id}) => id === studio.material)) step.material = studio.material;
  if (isDirection(studio.light)) step.light = studio.light;
  return step;
}
