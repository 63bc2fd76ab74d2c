// Makes the rows of all options of the engine that have no slider.

import {about, optionOf} from "./about.js";
import {BaseImage, withoutImage} from "./base_image.js";
import {$, Pause, clamp, make, pair, sentence} from "./controls.js";
import {FIRST, NOT_PRINTED} from "./document.js";
import {FIELDS} from "./fields.js";
import {isUnfinished} from "./inputs.js";
import {FREE_OUTLINES, KINDS} from "./kinds.js";
import {millimetresPerUnit, parseLength, shortLength, shown as lengthUnit, typedNumber} from "./lengths.js";
import {SHAPES, ShapeRow} from "./shapes.js";
import {REST_MS, UPWARDS, nextValue} from "./slider.js";

const LABELS = {outline: "Outline", diameter: "Diameter", plate: "Plate size",
  shift: "Moved by", rim: "Rim width",
  "rim-height": "Rim height", "rim-bevel": "Rim bevel", base: "Base", wrap: "Bent around", form: "Form",
  draft: "Draft angle", tolerance: "Simplify", triangles: "Triangles, at most", resolution: "Resolution", tool: "Tool",
  finish: "Finish",
  "depth-values": "Values are", background: "Background", blur: "Blur at edges",
  camera: "Camera", channel: "Channel",
  "mm-per-value": "One unit is", ground: "Ground at",
  up: "Upright", points: "Points from meshes", mode: "Precision"};
// Labels of choices whose names on the command line need more words.
const CHOICES = {round: "Round corners", subspace: "Nearly exact", auto: "Automatic", keep: "Keep", drop: "Leave out",
  inverse: "Inverse depth", luminance: "Brightness"};
const PLACES = {triangles: "#making", input: "#depth-rows", "mm-per-value": "#depth-rows", ground: "#depth-rows",
  view: "#preparing", model: "#preparing"}; // other stages: "#piece"
const PLACEHOLDERS = {up: "automatic", points: "as needed", diameter: "as needed", plate: "as needed", shift: "0,0",
  "mm-per-value": "as the height", ground: "automatic",
  "rim-height": "as the relief", "rim-bevel": "automatic"};
// The tips of the options `base`, `wrap` and `tool` say what these are for. The help of these options in the engine
// explains the format of their texts.
const TIPS = {base: "Surface under the relief", wrap: "Body around which the finished plate is bent",
  tool: "Milling tool; what it leaves standing is coloured on the piece"};
const UNITS = {MM: "mm", DEG: "°"};
const LEAST_STEP = 0.001; // least step of arrow keys

// The options that are two lengths, with the text between these lengths.
const PAIRS = {plate: {between: "x", split: /[x×]/}, shift: {between: ",", split: ","}};

// Returns a text such as "200x150" or "5,-3" with each length replaced by typed(length). A text that is no such pair is
// returned unchanged, and the engine refuses it.
function pairText(name, text, typed) {
  const {between, split} = PAIRS[name], lengths = text.toLowerCase().split(split).map(typed);
  return lengths.length === 2 && lengths.every(Number.isFinite) ? lengths.join(between) : text;
}
const inMm = (name, text) =>
  pairText(name, text, (side) => Number(parseLength(side, true, millimetresPerUnit()).toFixed(4)));
const asShown = (name, text) => pairText(name, text, (side) => Number(shortLength(Number(side))));

// Returns whether the user chose this width. Such a width differs from those of a new document and of all kinds of
// work.
const isChosen = (width) =>
  width !== FIRST.options.width && Object.values(KINDS).every(({part}) => part.width !== width);

// Returns the other changes that come with an outline. A size that the outline cannot have is dropped; without an
// outline, the rim is dropped, too.
function besidesOutline(value, {diameter, plate}, shownWidth) {
  const rim = value === "none" ? {rim: null, "rim-height": null, "rim-bevel": null} : {};
  const isRound = value === "circle", isFree = FREE_OUTLINES.includes(value);
  const hasSize = (!diameter || isRound) && (!plate || isFree);
  return hasSize ? rim : {...rim, diameter: null, plate: "", shift: "", width: shownWidth};
}

// Returns the other changes that come with a new value of an option. A given size of the plate also determines the
// width of the relief, unless the user chose a width.
function besides(name, value, {outline, diameter, plate, width}, shownWidth) {
  if (name === "base") return withoutImage(value);
  if ((name === "diameter" || name === "plate") && value) {
    const circle = name === "diameter" ? {outline: "circle", plate: ""} : {diameter: null};
    const straight = name === "plate" && outline === "circle" ? {outline: "rectangle"} : {};
    return {width: isChosen(width) ? width : null, ...circle, ...straight};
  }
  if (name === "outline") return besidesOutline(value, {diameter, plate}, shownWidth);
  return (name === "diameter" && diameter) || (name === "plate" && plate) ? {width: shownWidth, shift: ""} : {};
}

// The names of options whose controls have other labels.
const OTHERS = {tone: "Tone curve", view: "View"};
// The page's texts for the expected values of an option.
const EXPECTED = {crop: "left, bottom, right and top as shares from 0 to 1, such as 0,0.2,1,0.8"};
// The engine's advice about coloured pictures applies only to the command line, so the page replaces it.
const ADVICE = /; the option channel takes one .*$/;
const OTHER = ". Take their brightness, or save it as a picture in greys, one value per pixel, and open that";

const controlOf = (name) => document.querySelector(`[data-option="${name}"]`);

// Returns whether an option has a label, or a control somewhere else on the page. Any other option gets a row labelled
// with its name.
const isLabelled = (name) => name in LABELS || name in FIELDS || controlOf(name) !== null;

// Returns the name of an option on the page: from the tables, otherwise from its control.
function labelOf(name) {
  const control = controlOf(name);
  return LABELS[name] ?? FIELDS[name]?.label ?? OTHERS[name] ?? control?.getAttribute("aria-label") ??
    control?.closest("label")?.firstElementChild.textContent ?? name;
}

// Returns the message of an error in the words of the page, which name an option by its label.
export function inWords({input, message}) {
  const label = optionOf(input) && labelOf(input);
  const text = message.replace(ADVICE, OTHER), [found] = (EXPECTED[input] && text.match(/, found '.*$/)) ?? [];
  if (found) return `${label}: expected ${EXPECTED[input]}${found}`;
  return label ? label + text.slice(input.length) : text;
}

export class PieceRows {
  // `say` shows a line to the user; `shownWidth` returns the width in mm of the relief that is shown.
  constructor({engine, doc, entries, say, shownWidth, redraw}) {
    Object.assign(this, {engine, doc, entries, say, shownWidth, rows: {}});
    for (const {name, is_hidden: isHidden} of about.options)
      if (!isHidden && !isLabelled(name)) LABELS[name] = sentence(name.replaceAll("-", " "));
    for (const name of Object.keys(LABELS)) {
      this.rows[name] = SHAPES[name] ? this.shapeRow(name) : this.row(name);
      $(PLACES[name] ?? PLACES[optionOf(name).stage] ?? "#piece").append(this.rows[name].element);
    }
    this.baseImage = new BaseImage({engine, doc, say, redraw});
    this.rows.base.element.after(this.baseImage.element);
  }

  // Returns the rows' elements by the names of their options.
  get elements() {
    return Object.fromEntries(Object.entries(this.rows).map(([name, {element}]) => [name, element]));
  }

  shapeRow(option) {
    return new ShapeRow({option, label: LABELS[option], title: TIPS[option], say: this.say,
      take: (change) => this.set(option, change)});
  }

  // Makes the row of an option. Returns {element, input, rest, isNumber, unit, min, max}.
  row(name) {
    const {choices, help, min, max, unit, default: otherwise} = optionOf(name);
    const attributes = {id: name, "data-option": name, autocomplete: "off", "aria-label": LABELS[name]};
    const input = choices
      ? make("select", attributes, ...choices.map((choice) =>
        make("option", {value: choice}, CHOICES[choice] ?? sentence(choice))))
      : make("input", {
        ...attributes, inputmode: min === undefined ? "text" : "decimal",
        placeholder: PLACEHOLDERS[name] ?? String(otherwise || "none"),
      });
    const label = UNITS[unit] === "°" ? `${LABELS[name]} (°)` : LABELS[name];
    const element = pair(label, input, {title: sentence(help)});
    const rest = new Pause(() => input.dispatchEvent(new Event("change")), REST_MS);
    input.onchange = () => this.take(name);
    input.oninput = ({isTrusted}) => isTrusted && rest.end(); // the user types after using the arrow keys
    input.onkeydown = (event) => {
      if (event.key === "Escape") rest.end(), this.show();
      if (event.key in UPWARDS) this.step(event, name);
    };
    return {element, input, rest, isNumber: min !== undefined, unit: UNITS[unit], min, max};
  }

  // Changes a number by the up and down keys to the next round one, with Shift in smaller steps. The document takes the
  // number when no such key was pressed for REST_MS, or earlier by takeSteps().
  step(event, name) {
    const row = this.rows[name], {input, isNumber, unit, min, max} = row, isLength = unit === "mm";
    const scale = isLength ? millimetresPerUnit() : 1, value = parseLength(input.value, isLength, scale) / scale;
    if (!isNumber || !Number.isFinite(value)) return;
    event.preventDefault();
    const next = clamp(nextValue(value, UPWARDS[event.key], event.shiftKey, LEAST_STEP) * scale, min, max);
    input.value = isLength ? shortLength(next) : String(Number(next.toPrecision(12)));
    input.dispatchEvent(new Event("input")); // like typing
    row.rest.begin();
  }

  // Takes the entered choice or text. A row for numbers refuses a text that is no number.
  take(name) {
    const {input, rest, isNumber, unit, min, max} = this.rows[name], text = input.value.trim();
    rest.end();
    let value = text === "" ? FIRST.options[name] : text;
    if (isNumber && text !== "") value = typedNumber(text, {label: LABELS[name], unit, min, max}, this.say);
    if (isNumber && text !== "" && value === null) return this.show();
    return this.set(name, () => (PAIRS[name] ? inMm(name, value ?? "") : value));
  }

  // Changes an option after all earlier entries. `change` gets the option's value at that time, and returns the new
  // one.
  set(name, change) {
    const part = ({options}) => {
      const value = change(options[name]);
      const isDieOfPiece = name === "form" && value === "die" ? {isDieOfPiece: true} : {};
      return {...isDieOfPiece, options: {...besides(name, value, options, options.width ?? this.shownWidth()),
        [name]: value}};
    };
    const isMade = Boolean(SHAPES[name]) || !this.rows[name].input.matches("select");
    return this.entries.add({name, label: LABELS[name], part, isTried: true, isMade});
  }

  // Takes the numbers set by arrow keys at once, without waiting for the pause.
  takeSteps() {
    for (const [name, {rest}] of Object.entries(this.rows)) if (rest?.isRunning) this.take(name);
  }

  // Shows the document's values, except in fields in which the user types or whose entry is being tried.
  show() {
    const {options} = this.doc.now, tried = new Set(this.entries.pending.map(({name}) => name));
    for (const [name, {element}] of Object.entries(this.rows)) element.ariaBusy = tried.has(name) ? "true" : null;
    for (const name of Object.keys(SHAPES)) if (!tried.has(name)) this.rows[name].show(options[name]);
    for (const [name, {element, input, unit}] of Object.entries(this.rows).filter(([name]) => !SHAPES[name])) {
      const value = options[name] ?? "", isNumber = typeof value === "number";
      const text = PAIRS[name] ? asShown(name, value) : value;
      const shown = isNumber && unit === "mm" ? shortLength(value) : text;
      if (!isUnfinished(input) && !tried.has(name)) input.value = shown;
      if (this.shownUnit !== lengthUnit.unit && (unit === "mm" || PAIRS[name]))
        element.firstChild.textContent = `${LABELS[name]} (${lengthUnit.unit})`;
    }
    this.baseImage.show();
    for (const name of ["rim-height", "rim-bevel"]) this.rows[name].element.hidden = !options.rim;
    this.shownUnit = lengthUnit.unit;
    for (const name of NOT_PRINTED) this.rows[name].element.hidden = options.form === "lithophane";
    if (!options.tool) this.rows.finish.element.hidden = true;
  }
}
