// Makes the controls of all options that have no slider.

import {about, optionOf} from "../about.js";
import {BaseImage, withoutImage} from "./base_image.js";
import {$, Pause, clamp, make, pair, sentence} from "../controls.js";
import {FIRST, NOT_PRINTED} from "../document.js";
import {FIELDS} from "./fields.js";
import {showText} from "../inputs.js";
import {FREE_OUTLINES, KINDS} from "./kinds.js";
import {millimetresPerUnit, parseLength, shortLength, shown as lengthUnit, typedNumber} from "../lengths.js";
import {SHAPES, ShapeRow} from "./shapes.js";
import {GESTURE_END_MS, UPWARDS, nextValue} from "./slider.js";

const LABELS = {outline: "Outline", diameter: "Diameter", plate: "Plate size",
  shift: "Moved by", rim: "Rim width",
  "rim-height": "Rim height", "rim-bevel": "Rim bevel", base: "Base", wrap: "Bent around", form: "Form",
  draft: "Draft angle", tolerance: "Simplify", triangles: "Triangles, at most", resolution: "Resolution", tool: "Tool",
  finish: "Finish",
  "depth-values": "Values are", "depth-range": "Depth as a share", background: "Background", blur: "Blur at edges",
  camera: "Camera", channel: "Channel",
  "mm-per-value": "One unit is", ground: "Ground at",
  up: "Upright", points: "Points from meshes", mode: "Precision"};
// Labels of choices whose names on the command line are too short for users.
const CHOICES = {round: "Round corners", subspace: "Nearly exact", auto: "Automatic", keep: "Keep", drop: "Leave out",
  inverse: "Inverse depth", luminance: "Brightness"};
const PLACES = {triangles: "#making", input: "#depth-rows", "mm-per-value": "#depth-rows", ground: "#depth-rows",
  view: "#preparing", model: "#preparing"}; // panels by stage; all other stages: "#piece"
const PLACEHOLDERS = {up: "automatic", points: "as needed", diameter: "as needed", plate: "as needed", shift: "0,0",
  "mm-per-value": "as the height", ground: "automatic",
  "rim-height": "as the relief", "rim-bevel": "automatic"};
// The tips of these options describe their purpose. The engine's help on them explains the format of their texts.
const TIPS = {base: "Surface under the relief", wrap: "Body around which the finished plate is bent",
  tool: "Milling tool; what it leaves standing is coloured on the piece"};
const UNITS = {MM: "mm", DEG: "°"};
const LEAST_STEP = 0.001; // smallest step of the arrow keys

// The options whose text consists of two lengths, with the separator of these lengths.
const PAIRS = {plate: {between: "x", split: /[x×]/}, shift: {between: ",", split: ","}};

// Returns a text such as "200x150" or "5,-3" with typed(length) in place of each length. Returns other texts unchanged;
// the engine refuses them.
function pairText(name, text, typed) {
  const {between, split} = PAIRS[name], lengths = text.toLowerCase().split(split).map(typed);
  return lengths.length === 2 && lengths.every(Number.isFinite) ? lengths.join(between) : text;
}
const inMm = (name, text) =>
  pairText(name, text, (side) => Number(parseLength(side, true, millimetresPerUnit()).toFixed(4)));
const asShown = (name, text) => pairText(name, text, (side) => Number(shortLength(Number(side))));

// Returns whether the user chose this width: whether it differs from the widths of a new document and of all kinds of
// work.
const isChosen = (width) =>
  width !== FIRST.options.width && Object.values(KINDS).every(({part}) => part.width !== width);

// Returns the other options that change with the outline. If the new outline cannot have the size of the plate, that
// size is dropped. If there is no outline, the rim is dropped.
function besidesOutline(value, {diameter, plate}, shownWidth) {
  const rim = value === "none" ? {rim: null, "rim-height": null, "rim-bevel": null} : {};
  const isRound = value === "circle", isFree = FREE_OUTLINES.includes(value);
  const hasSize = (!diameter || isRound) && (!plate || isFree);
  return hasSize ? rim : {...rim, diameter: null, plate: "", shift: "", width: shownWidth};
}

// Returns the other options that change with an option. A given size of the plate also determines the width of the
// relief, unless the user chose a width.
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

// The labels that messages use for options whose controls have a different label or none.
const OTHERS = {tone: "Tone curve", view: "View", text: "Letters", ornaments: "Letters"};
// Descriptions of the values of an option, for messages.
const EXPECTED = {crop: "left, bottom, right and top as shares from 0 to 1, such as 0,0.2,1,0.8"};
// The engine's advice about coloured pictures applies only to the command line. The page shows its own advice instead.
const ADVICE = /; the option channel takes one .*$/;
const OTHER = ". Take their brightness, or save it as a picture in greys, one value per pixel, and open that";

const controlOf = (name) => document.querySelector(`[data-option="${name}"]`);

// Returns whether an option has a label here or a control elsewhere on the page. Any other option gets a control
// labelled with its name.
const isLabelled = (name) => name in LABELS || name in FIELDS || controlOf(name) !== null;

// Returns the label of an option: from the tables, or else from its control.
function labelOf(name) {
  const control = controlOf(name);
  return LABELS[name] ?? FIELDS[name]?.label ?? OTHERS[name] ?? control?.getAttribute("aria-label") ??
    control?.closest("label")?.firstElementChild.textContent ?? name;
}

// Returns the message of an error in the words of the page, which calls an option by its label.
export function inWords({input, message}) {
  const label = optionOf(input) && labelOf(input);
  const text = message.replace(ADVICE, OTHER), [found] = (EXPECTED[input] && text.match(/, found '.*$/)) ?? [];
  if (found) return `${label}: expected ${EXPECTED[input]}${found}`;
  return label ? label + text.slice(input.length) : text;
}

export class PieceRows {
  // `say` shows a line to the user. `shownWidth` returns the width of the shown relief in mm.
  constructor({engine, doc, entries, say, shownWidth, redraw}) {
    Object.assign(this, {engine, doc, entries, say, shownWidth, rows: {}});
    for (const {name, is_hidden: isHidden} of about.options)
      if (!isHidden && !isLabelled(name)) LABELS[name] = sentence(name.replaceAll("-", " "));
    for (const name of Object.keys(LABELS)) {
      this.rows[name] = SHAPES[name] ? this.shapeRow(name) : this.row(name);
      $(PLACES[name] ?? PLACES[optionOf(name).stage] ?? "#piece").append(this.rows[name].element);
    }
    // Maps names of options to the elements of their controls.
    this.elements = Object.fromEntries(Object.entries(this.rows).map(([name, {element}]) => [name, element]));
    this.baseImage = new BaseImage({engine, doc, say, redraw});
    this.rows.base.element.after(this.baseImage.element);
  }

  shapeRow(option) {
    return new ShapeRow({option, label: LABELS[option], title: TIPS[option], say: this.say,
      take: (change) => this.set(option, change)});
  }

  // Makes the control of an option. Returns {element, input, rest, isNumber, unit, min, max}.
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
    const rest = new Pause(() => input.dispatchEvent(new Event("change")), GESTURE_END_MS);
    input.onchange = () => this.take(name);
    input.oninput = ({isTrusted}) => isTrusted && rest.end(); // typing ends the movement by arrow keys
    input.onkeydown = (event) => {
      if (event.key === "Escape") rest.end(), this.show();
      if (event.key in UPWARDS) this.step(event, name);
    };
    return {element, input, rest, isNumber: min !== undefined, unit: UNITS[unit], min, max};
  }

  // Changes a number by the up and down keys to the next round number, or by smaller steps with Shift. The document
  // takes the number when no such key was pressed for GESTURE_END_MS, or when takeSteps() is called.
  step(event, name) {
    const row = this.rows[name], {input, isNumber, unit, min, max} = row, isLength = unit === "mm";
    const scale = isLength ? millimetresPerUnit() : 1, value = parseLength(input.value, isLength, scale) / scale;
    if (!isNumber || !Number.isFinite(value)) return;
    event.preventDefault();
    const next = clamp(nextValue(value, UPWARDS[event.key], event.shiftKey, LEAST_STEP) * scale, min, max);
    input.value = isLength ? shortLength(next) : String(Number(next.toPrecision(12)));
    input.dispatchEvent(new Event("input")); // has the same effect as typing
    row.rest.begin();
  }

  // Takes the choice or the text that the user entered. If the option is a number, refuses a text that is not one.
  take(name) {
    const {input, rest, isNumber, unit, min, max} = this.rows[name], text = input.value.trim();
    rest.end();
    let value = text === "" ? FIRST.options[name] : text;
    if (isNumber && text !== "") value = typedNumber(text, {label: LABELS[name], unit, min, max}, this.say);
    if (isNumber && text !== "" && value === null) return this.show();
    return this.set(name, () => (PAIRS[name] ? inMm(name, value ?? "") : value));
  }

  // Changes an option after all earlier entries. `change` gets the value that the option has at that time, and returns
  // the new value.
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

  // Takes at once the numbers that arrow keys have changed, without waiting for the pause.
  takeSteps() {
    for (const [name, {rest}] of Object.entries(this.rows)) if (rest?.isRunning) this.take(name);
  }

  // Shows the document's values, except in a field in which the user is typing or whose entry is being tried.
  show() {
    const {options} = this.doc.now, tried = new Set(this.entries.pending.map(({name}) => name));
    for (const [name, {element}] of Object.entries(this.rows)) element.ariaBusy = tried.has(name) ? "true" : null;
    for (const name of Object.keys(SHAPES)) if (!tried.has(name)) this.rows[name].show(options[name]);
    for (const [name, {element, input, unit}] of Object.entries(this.rows).filter(([name]) => !SHAPES[name])) {
      const value = options[name] ?? "", isNumber = typeof value === "number";
      const text = PAIRS[name] ? asShown(name, value) : value;
      const shown = isNumber && unit === "mm" ? shortLength(value) : text;
      if (!tried.has(name)) showText(input, shown);
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
