// The kinds of work, as pictures of this scan: each sets the piece, its size and its material.

import {$, check, make} from "./controls.js";
import {FIRST, LITHOPHANE, MARGIN_IN_DIAMETER, shownOptions} from "./document.js";
import {takeArrowKeys} from "./inputs.js";
import {paint} from "./stage.js";

// A rectangular plate with nothing besides.
const PLAIN = Object.freeze({outline: "rectangle", diameter: null, plate: "", shift: "", rim: null,
  "rim-height": null, "rim-bevel": null, base: "plane", "base-image": "", wrap: "none", form: "relief", draft: null});

const plaque = {...PLAIN, width: null, height: 5, margin: 5, thickness: 3};
const circle = {...PLAIN, outline: "circle", width: null, margin: MARGIN_IN_DIAMETER};
export const RIM = ["rim", "rim-height", "rim-bevel"];
const PLATE = ["plate", "outline", "corner", "margin", "thickness"];

// `part` are the options that a kind sets when it is chosen, `panel` those whose controls stand first then.
export const KINDS = {
  relief: {label: "Plaque", title: "Plaque: 100 mm long, 5 mm high", part: plaque, material: "plaster",
    panel: PLATE},
  coin: {label: "Coin", title: "Coin or medal: 40 mm across, 1.6 mm high, with a rim", material: "silver",
    part: {...circle, diameter: 40, rim: 1.5, height: 1.6, thickness: 2},
    panel: ["diameter", "outline", ...RIM, "margin", "thickness", "form"]},
  wood: {label: "Carving", title: "Carving in wood: 180 mm long, 10 mm high", material: "walnut",
    part: {...plaque, outline: "round", corner: 12, width: 180, height: 10, margin: 12, thickness: 12},
    panel: PLATE},
  die: {label: "Seal", material: "bronze",
    title: "Seal or die: the negative of a piece 30 mm across, 1.2 mm deep, with walls that come off",
    part: {...circle, diameter: 30, rim: 1.2, form: "die", draft: 15, height: 1.2, thickness: 4},
    panel: ["diameter", "draft", ...RIM, "margin", "thickness", "form"],
    note: "The diameter is that of what it shapes: the die is wider, by a rim of its own. Walls that lean by the " +
      "draft angle let it come off."},
  lithophane: {label: "Lithophane", title: "Lithophane: a picture in thickness, lit from behind, 100 mm long",
    material: "porcelain", part: {...plaque, ...LITHOPHANE},
    panel: ["thickness", "plate", "margin", "form"],
    note: "The plate is as thick as the brightest places, and height is what the darkest add. Porcelain is lit from " +
      "behind."},
  shell: {label: "Bent", title: "Bent around a body, such as a vase or a ring", material: "plaster",
    part: {...plaque, wrap: "cylinder:turn=180"}, panel: ["wrap", "thickness", "plate", "margin", "form"],
    note: "The plate is the wall.",
    camera: {yaw: -28, pitch: 18}},
};

// Returns the kind of work that a document's step is, whatever its material: a thick plate with round corners is a
// carving.
export function kindOf({options: {form, wrap, rim, outline, thickness}}) {
  if (form === "lithophane" || form === "die") return form;
  if (wrap !== "none") return "shell";
  if (outline === "circle" || (rim && !["rectangle", "round"].includes(outline))) return "coin";
  const {part: wood} = KINDS.wood;
  return outline === wood.outline && thickness >= wood.thickness ? "wood" : "relief";
}

// Returns the document's changes that begin a kind of work, or go on from its last step. A coin and its die have the
// same diameter.
function partOf(kind, {diameter}, last) {
  const {part, material} = KINDS[kind], first = {material, isHeightLocked: true, u: null, options: part};
  const {material: own, isHeightLocked, u, options} = last ?? first;
  const same = options.diameter && diameter ? {diameter} : {};
  return {material: own, isHeightLocked, u, options: {...FIRST.options, ...options, ...same}};
}

// The options that a kind leaves as they are: how the scan is seen and shaped.
const KEPT = ["view", "up", "crop", "crumbs", "plane", "denoise", "mode", "points", "method", "saturation", "detail",
  "steepest", "boundary", "steps", "tone", "tool", "finish", "resolution", "tolerance", "triangles"];

const kept = (options) => Object.fromEntries(KEPT.map((name) => [name, options[name]]));

const WIDTH = 176, HEIGHT = 132; // pixels of a picture
const PAUSE_MS = 60;

const pause = () => new Promise((resolve) => setTimeout(resolve, PAUSE_MS));

// What stands on a card until its picture is drawn: the outline of the piece, in a box of 48 x 36.
const ROUND = "M12 18a12 12 0 1 0 24 0a12 12 0 1 0-24 0";
const OUTLINES = {
  relief: "M9 8h30v20H9z", coin: `${ROUND}M15 18a9 9 0 1 0 18 0a9 9 0 1 0-18 0`,
  wood: "M12 8h24a4 4 0 0 1 4 4v12a4 4 0 0 1-4 4H12a4 4 0 0 1-4-4V12a4 4 0 0 1 4-4zM12 15h24M12 21h24",
  die: `${ROUND}M19 18a5 5 0 1 0 10 0a5 5 0 1 0-10 0`, lithophane: "M14 11h20v16H14zM24 3v4M7 19h4M37 19h4M24 31v3",
  shell: "M12 9q12 6 24 0v18q-12 6-24 0z",
};

export class KindCards {
  // `isAtRest` returns whether the engine has time for pictures.
  constructor({engine, doc, isAtRest}) {
    Object.assign(this, {engine, doc, isAtRest, model: 0});
    const outline = (kind) => make("svg", {viewBox: "0 0 48 36", "aria-hidden": "true"},
      make("path", {d: OUTLINES[kind]}));
    const card = ([kind, {label, title}]) => make("button", {role: "radio", "data-kind": kind, title,
      onclick: () => this.choose(kind)}, outline(kind),
      make("canvas", {width: WIDTH, height: HEIGHT, "aria-hidden": "true"}), label);
    $("#kinds").append(...Object.entries(KINDS).map(card));
    takeArrowKeys($("#kinds"));
  }

  choose(kind) {
    if (kind !== kindOf(this.doc.now)) this.doc.change(this.stepOf(kind));
  }

  // Returns the step with which a kind of work goes on: as it was left in this document, or as it begins.
  stepOf(kind) {
    const {now: {options}, steps, at} = this.doc, isThis = (step) => kindOf(step) === kind;
    const part = partOf(kind, options, steps.slice(0, at + 1).findLast(isThis));
    return {...this.doc.now, ...part, options: {...part.options, ...kept(options)}};
  }

  show() {
    const kind = kindOf(this.doc.now);
    if (kind === this.shown) return; // this runs for each event of a drag
    this.shown = kind;
    for (const card of $("#kinds").children) check(card, card.dataset.kind === kind);
  }

  // Draws the pictures when a model is there, one after the other, while nothing else is drawn. Before the first model
  // they show the coarse relief of the view that is `turned`, if there is one.
  async pictured(model, turned) {
    const drawn = model ? "exact" : turned ? "coarse" : "", key = model || drawn;
    if (!drawn || key === this.model) return;
    this.model = key;
    for (const [kind, {camera}] of Object.entries(KINDS)) {
      do await pause(); while (!this.isAtRest() && key === this.model);
      if (key !== this.model) return;
      const {options, ...step} = this.stepOf(kind), {material, light} = step;
      const request = {options: shownOptions({options}), material, light, width: WIDTH, height: HEIGHT,
        camera: {yaw: 0, pitch: 0, zoom: 1.06, ...camera}, ...(!model && {turned})};
      const made = await this.engine.frame(request).catch(() => null); // a view that does not suit the kind
      if (!made || key !== this.model) continue;
      const card = $(`#kinds [data-kind="${kind}"]`);
      paint($("canvas", card), made.image);
      card.dataset.drawn = drawn;
    }
  }

  // Another scan is shown: its pictures are still to come.
  clear() {
    this.model = 0;
    for (const card of $("#kinds").children) delete card.dataset.drawn;
    for (const canvas of document.querySelectorAll("#kinds canvas"))
      canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
  }
}
