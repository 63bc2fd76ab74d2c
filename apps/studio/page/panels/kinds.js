// Shows a card for each kind of work, with a picture of this scan. A kind of work sets the form, the size and the
// material of the piece.

import {defaultOf} from "../about.js";
import {$, check, make, paint} from "../controls.js";
import {FIRST, shownOptions} from "../document.js";
import {takeArrowKeys} from "../inputs.js";
import {shortLength, shown} from "../lengths.js";

// The outlines whose width and height the user may choose freely.
export const FREE_OUTLINES = ["rectangle", "round", "ellipse"];

// The options of a rectangular plate without extras.
const PLAIN = Object.freeze({outline: "rectangle", diameter: null, plate: "", shift: "", rim: null,
  "rim-height": null, "rim-bevel": null, base: "plane", "base-image": "", wrap: "none", form: "relief", draft: null});

const plaque = {...PLAIN, width: null, height: 5, margin: 5, thickness: 3};
const circle = {...PLAIN, outline: "circle", width: null, margin: defaultOf("margin", "diameter")};
export const RIM = ["rim", "rim-height", "rim-bevel"];
const PLATE = ["plate", "outline", "corner", "margin", "thickness"];

// `part` has the options that the kind sets. `panel` lists the options whose controls are in its panel.
export const KINDS = {
  relief: {label: "Plaque", title: "Plaque", part: plaque, material: "plaster",
    panel: PLATE},
  coin: {label: "Coin", title: "Coin or medal with a rim", material: "silver",
    part: {...circle, diameter: 40, rim: 1.5, height: 1.6, thickness: 2},
    panel: ["diameter", "outline", ...RIM, "margin", "thickness", "form"]},
  wood: {label: "Carving", title: "Carving in wood", material: "walnut",
    part: {...plaque, outline: "round", corner: 12, width: 180, height: 10, margin: 12, thickness: 12},
    panel: PLATE},
  die: {label: "Seal", material: "bronze",
    title: "Seal: a hollow of its own that shapes a piece, with walls that come off. " +
      "The die of a piece on the screen is made in that piece's panel",
    part: {...circle, diameter: 30, rim: 1.2, form: "die", draft: 15, height: 1.2, thickness: 4},
    panel: ["diameter", "draft", ...RIM, "margin", "thickness", "form"],
    note: "The diameter is that of what it shapes: the die is wider, by a rim of its own. Walls that lean by the " +
      "draft angle let it come off."},
  lithophane: {label: "Lithophane", title: "Lithophane: a picture in thickness, lit from behind",
    material: "porcelain",
    part: {...plaque, form: "lithophane", thickness: defaultOf("thickness", "lithophane"),
      height: defaultOf("height", "lithophane")},
    panel: ["thickness", "plate", "margin", "form"],
    note: "The plate is as thick as the brightest places, and height is what the darkest add. Porcelain is lit from " +
      "behind. A tool and a draft angle wait for the other kinds."},
  shell: {label: "Bent", title: "Bent around a body, such as a vase or a ring", material: "plaster",
    part: {...plaque, wrap: "cylinder:turn=180"}, panel: ["wrap", "thickness", "plate", "margin", "form"],
    note: "The plate is the wall.",
    camera: {yaw: -28, pitch: 18}},
};

// Returns the name of the kind of work that a step shows. Ignores the material: any thick plate with round corners
// counts as a carving, even in metal. A die that was made from a piece has the kind of that piece.
export function kindOf({options: {form, wrap, rim, outline, thickness}, isDieOfPiece}) {
  if (form === "lithophane" || (form === "die" && !isDieOfPiece)) return form;
  if (wrap !== "none") return "shell";
  if (outline === "circle" || (rim && !["rectangle", "round"].includes(outline))) return "coin";
  const {part: wood} = KINDS.wood;
  return outline === wood.outline && thickness >= wood.thickness ? "wood" : "relief";
}

// Returns the changes that turn a piece into its die with the same options, or a die back into its piece.
export const dieOf = ({options: {form}}) =>
  ({options: {form: form === "die" ? "relief" : "die"}, isDieOfPiece: form !== "die"});

// Returns the changes that start a kind of work. If `last`, the last step of that kind, is given, the changes restore
// the values of `last`. If the current piece and the new one have a diameter, the current diameter stays. A kind with a
// rectangular plate starts with the size of the current plate, unless that plate is an ellipse.
function partOf(kind, {diameter, plate, outline}, last) {
  const {part, material} = KINDS[kind];
  const begun = plate && outline !== "ellipse" && part.outline !== "circle" ? {...part, plate, width: null} : part;
  const first = {material, isHeightLocked: true, u: null, isDieOfPiece: false, options: begun};
  const {material: own, isHeightLocked, u, isDieOfPiece, options} = last ?? first;
  const same = options.diameter && diameter ? {diameter} : {};
  return {material: own, isHeightLocked, u, isDieOfPiece, options: {...FIRST.options, ...options, ...same}};
}

function measuresOf({diameter, plate, width, height}) {
  const text = (mm) => `${shortLength(mm)} ${shown.unit}`, length = width ?? (plate ? null : defaultOf("width"));
  return [diameter ? `${text(diameter)} across` : length && `${text(length)} long`, `${text(height)} high`]
    .filter(Boolean).join(", ");
}

// OF_KINDS has all options that kinds of work set. kept() returns the other options; they determine the view and the
// relief's shape.
const OF_KINDS = new Set(Object.values(KINDS).flatMap(({part}) => Object.keys(part)));
const kept = (options) => Object.fromEntries(Object.entries(options).filter(([name]) => !OF_KINDS.has(name)));

const WIDTH = 176, HEIGHT = 132; // size of a card's picture in pixels
const PAUSE_MS = 60;

const pause = () => new Promise((resolve) => setTimeout(resolve, PAUSE_MS));

// The outline of the piece that a card shows until its picture is drawn, in a box of 48 x 36.
const ROUND = "M12 18a12 12 0 1 0 24 0a12 12 0 1 0-24 0";
const OUTLINES = {
  relief: "M9 8h30v20H9z", coin: `${ROUND}M15 18a9 9 0 1 0 18 0a9 9 0 1 0-18 0`,
  wood: "M12 8h24a4 4 0 0 1 4 4v12a4 4 0 0 1-4 4H12a4 4 0 0 1-4-4V12a4 4 0 0 1 4-4zM12 15h24M12 21h24",
  die: `${ROUND}M19 18a5 5 0 1 0 10 0a5 5 0 1 0-10 0`, lithophane: "M14 11h20v16H14zM24 3v4M7 19h4M37 19h4M24 31v3",
  shell: "M12 9q12 6 24 0v18q-12 6-24 0z",
};

// Returns the name of a scan's file without its ending.
export const plainName = (input) => (input?.name ?? "relief").replace(/\.[a-z0-9]+$/i, "");

// Returns the name of a step's files: the name of the scan, followed by the kind and the form. The kind is
// left out for plaques, dies and lithophanes. The form is left out if it is `relief`.
export function fileName(step) {
  const kind = kindOf(step), {form} = step.options;
  const words = [kind === "relief" ? "" : KINDS[kind].label.toLowerCase(), form === "relief" ? "" : form];
  const isForm = ["die", "lithophane"].includes(form); // the name of the kind would repeat that of the form
  return [plainName(step.input), ...words.slice(isForm ? 1 : 0)].filter(Boolean).join("-");
}

export class KindCards {
  // `isAtRest` returns whether the engine has time for pictures. `say` shows a line to the user.
  constructor({engine, doc, entries, isAtRest, say}) {
    Object.assign(this, {engine, doc, entries, isAtRest, say, model: 0});
    const outline = (kind) => make("svg", {viewBox: "0 0 48 36", "aria-hidden": "true"},
      make("path", {d: OUTLINES[kind]}));
    const card = ([kind, {label}]) => make("button", {role: "radio", "data-kind": kind,
      onclick: () => this.choose(kind)}, outline(kind),
      make("canvas", {width: WIDTH, height: HEIGHT, "aria-hidden": "true"}), label);
    $("#kinds").append(...Object.entries(KINDS).map(card));
    takeArrowKeys($("#kinds"));
  }

  // Chooses a kind of work, as soon as the waiting entries are taken. Tells the user if the plate of this kind cannot
  // keep the current size.
  async choose(kind) {
    let lost = "";
    await this.entries.add({name: "kind", label: KINDS[kind].label, part: (step) => {
      const was = kindOf(step), next = kind === was ? step : this.stepOf(kind, step);
      const isLost = step.options.plate && !next.options.plate;
      lost = isLost ? `The size of the plate stays with ${KINDS[was].label}, and comes back with it.` : "";
      return next;
    }});
    if (lost) this.say(lost);
  }

  // Returns the step to which the document changes if the user chooses a kind of work. It continues from the last step
  // of that kind in this document, or starts the kind if there is none.
  stepOf(kind, step = this.doc.now) {
    const {steps} = this.doc, isThis = (former) => kindOf(former) === kind;
    const part = partOf(kind, step.options, steps.slice(0, steps.indexOf(step) + 1).findLast(isThis));
    return {...step, ...part, options: {...part.options, ...kept(step.options)}};
  }

  show() {
    const kind = kindOf(this.doc.now), isPending = this.entries.isPending("kind");
    for (const card of $("#kinds").children) card.ariaBusy = isPending ? "true" : null;
    if (this.doc.gesture === null) this.showTitles();
    if (kind === this.shown) return; // nothing has changed; this method runs for each event of a drag
    this.shown = kind;
    for (const card of $("#kinds").children) check(card, card.dataset.kind === kind);
  }

  showTitles() {
    for (const card of $("#kinds").children) {
      const {kind} = card.dataset, step = kind === this.shown ? this.doc.now : this.stepOf(kind);
      card.title = `${KINDS[kind].title}: ${measuresOf(step.options)}`;
    }
  }

  // Draws the pictures of the cards one after the other, each only while nothing else is drawn. They show the relief of
  // `model`. If `model` is 0, they show the turned relief of the view `turned`; without a view, no pictures are drawn.
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
      const made = await this.engine.picture(request).catch(() => null); // the kind may be impossible in this view
      if (!made || key !== this.model) continue;
      const card = $(`#kinds [data-kind="${kind}"]`);
      paint($("canvas", card), made.image);
      card.dataset.drawn = drawn;
    }
  }

  // Removes the pictures after another scan was opened.
  clear() {
    this.model = 0;
    for (const card of $("#kinds").children) delete card.dataset.drawn;
    for (const canvas of document.querySelectorAll("#kinds canvas"))
      canvas.getContext("2d").clearRect(0, 0, canvas.width, canvas.height);
  }
}
