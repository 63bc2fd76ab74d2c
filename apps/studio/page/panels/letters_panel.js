// Shows the panel of ornaments (texts, borders and drawings): their list, buttons that add an ornament, and the fields
// of the chosen one.

import {about} from "../about.js";
import {$, make, oneAtATime, pair, textField} from "../controls.js";
import {hasGround, shownOptions} from "../document.js";
import {FileField, fileInput, fileNameOf, takeDropsOn} from "../file_field.js";
import {showText} from "../inputs.js";
import {LetterMarks, rounded} from "../stage/letter_marks.js";
import {shortLength, shown, typedNumber} from "../lengths.js";
import {fileOf, listOf, withoutEmpty} from "../ornament_list.js";
import {ARCS, FILES, KINDS, hasPlace, isOnArc, keyOfFile, nameOf, partOf} from "./ornaments.js";
import {inWords} from "./pieces.js";

const OFFERED = ["text", "beads", "rope", "line"];
const NEW = {text: {kind: "text", text: "TEXT"}, beads: {kind: "beads"}, rope: {kind: "rope"}, line: {kind: "line"}};
const COIN_ARC = {arc: "top"}; // settings of a new text on a round plate
const SHARE_OF_GROUND = 0.6; // size of a new drawing divided by the height of the ground below the relief

// The numbers of an ornament: their labels, and the values that the engine takes.
const NUMBERS = {
  size: {label: "Size", unit: "mm", min: 0.01, max: 1e4},
  height: {label: "Above ground", unit: "mm", min: -100, max: 100},
  inset: {label: "From the rim", unit: "mm", min: 0, max: 1e4},
  tracking: {label: "Between letters", unit: "mm", min: -100, max: 100},
  angle: {label: "Angle", unit: "°", min: -360, max: 360},
  count: {label: "Number", unit: "", min: 3, max: 2000},
};
const TIPS = {size: "Height of capitals, diameter of beads, width of borders", tracking: "Distance that is added",
  height: "Above the ground; a negative height sinks it", inset: "Distance from the rim",
  angle: "Where the middle is, counter-clockwise from the right", count: "Number of beads or strands"};

function numbersOf(ornament) {
  const {kind = "text"} = ornament, own = ["size", "height", ...(hasPlace(ornament) ? [] : ["inset"])];
  if (kind === "text") own.push("tracking", ...(isOnArc(ornament) ? ["angle"] : []));
  return kind === "beads" || kind === "rope" ? [...own, "count"] : own;
}

export class LettersPanel {
  // `say` shows a line to the user.
  constructor({engine, doc, stage, say}) {
    Object.assign(this, {engine, doc, stage, say, chosen: -1, rows: [], errors: []});
    this.marks = new LetterMarks({stage, doc, panel: this});
    this.refresh = oneAtATime(() => this.place().catch(() => {})); // the picture of this state reports the same error
    $("#ornament-kinds").append(...OFFERED.map((kind) =>
      make("button", {type: "button", class: "quiet", onclick: () => this.add(kind),
        ...(kind === "beads" && {"data-option": "ornaments"})}, `Add ${kind === "text" ? "a text" : kind === "line" ? "a line"
        : kind === "rope" ? "a rope" : kind}`)));
    this.takeFiles();
    stage.element.addEventListener("picture", ({detail}) => this.pictured(detail.facts));
  }

  // Adds the button for drawings, and makes the panel take fonts and drawings that are dropped on it.
  takeFiles() {
    const input = fileInput("File of a drawing", FILES.file.endings, (file) => this.take(file));
    const title = "An SVG of filled paths. Drop it here, too";
    $("#ornament-kinds").append(make("button", {type: "button", class: "quiet", title, onclick: () => input.click()},
      "Add a drawing"));
    $("#letters").append(input);
    takeDropsOn($("#letters"), "Drop to use this font or drawing", (file) => this.take(file));
  }

  // Takes a file. A drawing becomes a new ornament. A font is used for the chosen text or, if no text is chosen, for
  // the list's only text.
  take(file) {
    const {list, chosen} = this, key = keyOfFile(file.name), isText = ({kind = "text"}) => kind === "text";
    const ofSole = list.filter(isText).length === 1 ? list.findIndex(isText) : -1;
    if (key === "file") return this.takeFile(file, key, list.length);
    if (key === undefined) return this.say(`${file.name}: expected a font (TTF, OTF) or a drawing (SVG).`);
    const at = list[chosen] && isText(list[chosen]) ? chosen : ofSole;
    if (at < 0) return this.say(`${file.name}: expected one chosen text, whose font it becomes.`);
    this.takeFile(file, key, at);
  }

  // Uploads a file and uses it in the ornament at index `at` of the list. If there is no ornament at that index, uses
  // the file in a new drawing. Does not use the file if the engine cannot read it, or if the user has opened another
  // document meanwhile.
  async takeFile(file, key, at) {
    const {document} = this.engine;
    if (!this.isShown || fileOf(this.doc.now.options)) return;
    try {
      const {path} = await this.engine.upload([file]), list = [...this.list];
      list[at] = {...(list[at] ?? {kind: "drawing", ...this.roomForDrawing()}), [key]: path};
      const {options} = partOf(list), part = {...this.doc.now, options: {...this.doc.now.options, ...options}};
      const {error} = (await this.engine.placeOrnaments(shownOptions(part)))[at];
      if (error?.input === "font") throw new Error(error.text);
      if (document !== this.engine.document) return;
      this.chosen = at;
      this.doc.change({options});
    } catch (error) {
      this.say(`${file.name} cannot be used: ${error.message.replaceAll(/[^\s']*\bscans\/\w+\//g, "")}`);
    }
  }

  // Returns the size and the position of a new drawing, which is placed on the ground below the relief.
  roomForDrawing() {
    const {size_mm: size, relief_mm: relief} = this.facts ?? {}, {margin} = this.doc.now.options;
    const low = size ? -size[1] / 2 : 0, high = relief ? relief[0][1] : low + (margin ?? 0);
    return {size: Math.max(1, rounded(SHARE_OF_GROUND * (high - low))), at: [0, rounded((low + high) / 2)]};
  }

  get list() {
    return listOf(this.doc.now.options);
  }

  // Returns whether the piece has ground for ornaments.
  get isShown() {
    return hasGround(this.doc.now);
  }

  clear() {
    Object.assign(this, {chosen: -1, key: "", placedKey: "", told: ""});
    this.marks.take([], []);
  }

  add(kind) {
    const isRound = kind === "text" && this.doc.now.options.outline === "circle";
    this.chosen = this.list.length;
    this.doc.change(partOf([...this.list, {...NEW[kind], ...(isRound && COIN_ARC)}]));
    $("#ornaments li:last-child input")?.select();
  }

  remove(at) {
    this.chosen = -1;
    this.doc.change(partOf(this.list.filter((_, i) => i !== at)));
    $("#ornament-kinds button").focus();
  }

  // Changes an ornament. A key without a value gets the engine's default.
  set(at, part, gesture = null) {
    this.doc.change(partOf(this.list.map((each, i) => (i === at ? withoutEmpty({...each, ...part}) : each))), gesture);
  }

  choose(at) {
    this.chosen = at === this.chosen ? -1 : at;
    this.show();
    this.stage.drawOverlay();
  }

  // Shows the list. Rows stay while only their values change, so that a field keeps the focus.
  show() {
    const {list} = this, {options} = this.doc.now, file = fileOf(options);
    if (this.chosen >= list.length) this.chosen = -1;
    const key = JSON.stringify([list.map(({kind, arc}) => [kind, arc]), this.chosen, shown.unit, file]);
    if (key !== this.key) this.makeRows(list, file);
    this.key = key;
    for (const [i, row] of this.rows.entries()) row.show(list[i]);
    for (const button of $("#ornament-kinds").children) button.disabled = !this.isShown || file !== "";
    this.tell();
  }

  makeRows(list, file) {
    this.rows = list.map((ornament, i) => this.row(ornament, i));
    const drop = () => this.doc.change({options: {ornaments: ""}});
    const ofFile = file && make("li", {class: "pair"}, `Those in ${fileNameOf(file)}`,
      make("button", {class: "quiet", onclick: drop}, "Remove"));
    $("#ornaments").replaceChildren(...this.rows.map(({element}) => element), ...(ofFile ? [ofFile] : []));
  }

  row(ornament, at) {
    const isChosen = at === this.chosen;
    const name = make("button", {type: "button", class: "name quiet", "aria-expanded": String(isChosen),
      onclick: () => this.choose(at)});
    const remove = make("button", {type: "button", class: "quiet", onclick: () => this.remove(at)}, "Remove");
    const fields = isChosen ? this.fields(ornament, at) : [];
    const element = make("li", {}, make("div", {class: "pair"}, name, remove), ...fields.map((field) => field.row));
    return {element, show: (now) => {
      name.textContent = nameOf(now);
      remove.setAttribute("aria-label", `Remove ${nameOf(now)}`);
      for (const {show} of fields) show(now);
    }};
  }

  fields(ornament, at) {
    const {kind = "text"} = ornament;
    const key = {text: "font", drawing: "file"}[kind];
    return [...(kind === "text" ? [this.textRow(at), this.arcRow(at)] : []),
      ...(key ? [this.fileRow(key, at)] : []),
      ...numbersOf(ornament).map((name) => this.numberRow(name, at)), this.engravedRow(at)];
  }

  // Returns the row with the text field. The document changes with each typed letter; all letters form one undo step.
  textRow(at) {
    const show = ({text}) => showText(input, text);
    const input = textField({"aria-label": "Text", maxlength: 500}, {
      take: (text) => (text ? this.set(at, {text}, "letters") : 0, this.doc.endGesture("letters"), this.show()),
      show: () => (this.doc.cancelGesture(), show(this.list[at]))});
    input.oninput = () => input.value.trim() && this.set(at, {text: input.value.trim()}, "letters");
    return {row: pair("Text", input), show};
  }

  arcRow(at) {
    const input = make("select", {"aria-label": "Line of the text", onchange: ({target: {value}}) =>
      this.set(at, {arc: value, at: null, angle: null})}, ...Object.entries(ARCS).map(([value, label]) =>
      make("option", {value}, label)));
    return {row: pair("Line", input), show: ({arc = "straight"}) => (input.value = arc)};
  }

  fileRow(key, at) {
    const {what, endings} = FILES[key], isFont = key === "font";
    const field = new FileField({label: isFont ? "Font" : "File", what, none: "Noto Serif", accept: endings,
      noneSaid: "Noto Serif: choose another font",
      title: isFont ? "Noto Serif Bold has Latin, Greek and Cyrillic. Other fonts by file; drop it here, too"
        : "An SVG of filled paths",
      take: (file) => this.takeFile(file, key, at), drop: () => this.set(at, {[key]: null})});
    return {row: field.row, show: (ornament) => field.show(ornament[key] ?? "", {isNeeded: !isFont})};
  }

  numberRow(name, at) {
    const number = NUMBERS[name], {label, unit} = number, isLength = unit === "mm";
    const show = (ornament) => {
      const value = ornament[name] ?? "";
      showText(input, isLength && value !== "" ? shortLength(value) : value);
    };
    const input = textField({inputmode: "decimal", "aria-label": label, placeholder: "automatic"}, {
      take: (text) => {
        const value = text === "" ? null : typedNumber(text, number, this.say);
        if (text === "" || value !== null) this.set(at, {[name]: value});
        this.show();
      }, show: () => show(this.list[at])});
    const shownUnit = isLength ? shown.unit : unit;
    return {row: pair(shownUnit ? `${label} (${shownUnit})` : label, input, {title: TIPS[name]}), show};
  }

  engravedRow(at) {
    const input = make("input", {type: "checkbox", "aria-label": "Engraved", onchange: ({target}) =>
      this.set(at, {engraved: target.checked})});
    return {row: pair("Engraved", input), show: ({engraved}) => (input.checked = engraved === true)};
  }

  // Takes the facts about the newest picture, which may say that ornaments have no room.
  pictured(facts) {
    this.facts = facts;
    this.refresh();
    this.tell();
  }

  // Asks the engine for the positions of the ornaments, unless they are known for these options or a drag is running.
  async place() {
    const {list} = this, options = shownOptions(this.doc.now), key = JSON.stringify([options, this.stage.model]);
    if (key === this.placedKey || this.marks.drag || !this.stage.isReady) return;
    const places = list.length && this.isShown ? await this.engine.placeOrnaments(options) : [];
    this.placedKey = key;
    this.errors = places.map(({error}) => error).filter(Boolean);
    this.marks.take(list, places);
    this.tell();
  }

  // Shows the reason if the piece cannot have the listed ornaments.
  tell() {
    const error = this.errors[0] ?? this.facts?.ornament_error, hasList = this.list.length > 0;
    const noGround = "There is no ground around the relief for them.";
    const text = hasList && !this.isShown ? noGround : hasList && error ? inWords({...error, message: error.text}) : "";
    if ($("#ornaments-note").textContent !== text) $("#ornaments-note").textContent = text;
    if (text && text !== this.told && !$("#letters").open) this.say(text);
    this.told = text;
  }
}
