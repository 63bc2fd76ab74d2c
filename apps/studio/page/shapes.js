// Options whose texts are shapes with parameters, such as "wave:height=3,length=40,hollow" or the tool "v:60:0.5": a
// menu of the shapes, and a field for each parameter of the chosen one.

import {make} from "./controls.js";
import {isUnfinished} from "./inputs.js";
import {lengthText, parseLength, shown, shownUnit, typedNumber} from "./lengths.js";

const mm = {unit: "mm", min: 0, max: 1e6}, degrees = {unit: "°", min: -360, max: 360}, word = {isWord: true};
const height = ["height", {label: "Height", ...mm}], diameter = ["diameter", {label: "Diameter", ...mm}];
const turn = ["turn", {label: "Around by", ...degrees}], angle = ["angle", {label: "Angle", ...degrees}];
const direction = ["direction", {label: "Direction", ...degrees}];
const wavelength = ["length", {label: "Wavelength", ...mm}];
const hollow = ["hollow", {label: "Hollow", ...word}], inside = ["inside", {label: "On the inside", ...word}];
const tip = ["tip", {label: "Tip", ...mm}];

const shape = (label, ...parameters) => ({label, parameters: new Map(parameters)});

// The parameters of each shape, which the engine takes as well.
export const SHAPES = {
  base: {
    plane: shape("Plane"), fold: shape("Fold", height, angle, direction, hollow),
    wave: shape("Wave", height, wavelength, direction, hollow),
    cylinder: shape("Cylinder", diameter, height, direction, hollow), dome: shape("Dome", diameter, height, hollow),
    image: shape("Image", height, hollow),
  },
  wrap: {
    none: shape("Nothing"), cylinder: shape("Cylinder", turn, diameter, direction, inside),
    cone: shape("Cone", turn, diameter, angle, direction, inside), sphere: shape("Sphere", turn, diameter, inside),
  },
  tool: {none: shape("None"), ball: shape("Ball end", diameter), flat: shape("Flat end", diameter),
    v: shape("V bit", angle, tip)},
};
const CHOSEN = {ball: "ball:3", flat: "flat:3", v: "v:60"}; // shapes that are none without their sizes
const OF_IMAGES = "image"; // which another row chooses
const EXCLUDED = {turn: "diameter", diameter: "turn"}; // of which a shape has one, where it has both

// Returns the text's shape and its values as texts, by parameter. A word that is there is "". A comma before a digit is
// a decimal comma.
export function parseShape(option, text) {
  const [name] = (text || Object.keys(SHAPES[option])[0]).split(":", 1), rest = text.slice(name.length + 1);
  const {parameters} = SHAPES[option][name];
  const entries = option === "tool" ? rest.split(":").map((value, i) => [[...parameters.keys()][i], value])
    : rest.split(/,(?!\d)/).map((entry) => [...entry.split("="), ""].slice(0, 2));
  return {name, values: new Map(rest === "" ? [] : entries)};
}

function shapeText(option, {name, values}) {
  const named = [...SHAPES[option][name].parameters.keys()].filter((parameter) => values.has(parameter));
  if (option === "tool") return [name, ...named.map((parameter) => values.get(parameter))].join(":");
  const entries = named.map((parameter) => parameter + (values.get(parameter) && `=${values.get(parameter)}`));
  return entries.length ? `${name}:${entries.join()}` : name;
}

export class ShapeRow {
  // Calls take(text) with the text of what was chosen, and say(text) with a line for people. `input` is the menu.
  constructor({option, label, title, take, say}) {
    Object.assign(this, {option, label, take, say, fields: []});
    this.input = make("select", {id: option, "data-option": option, "aria-label": label},
      ...Object.entries(SHAPES[option]).map(([name, {label}]) => make("option", {value: name}, label)));
    this.input.onchange = ({target: {value}}) => take(CHOSEN[value] ?? value);
    this.element = make("div", {class: "shape", title}, make("label", {class: "pair"}, make("span", {}, label),
      this.input));
  }

  // Shows the text of the option.
  show(text) {
    const before = this.shown, {name, values} = parseShape(this.option, text);
    this.shown = {text, unit: shown.unit, name, values};
    if (before?.name !== name || before.unit !== shown.unit) this.showFields();
    this.input.value = name;
    for (const choice of this.input.options) choice.hidden = choice.value === OF_IMAGES && name !== OF_IMAGES;
    for (const field of this.fields) showValue(field, values.get(field.name));
  }

  showFields() {
    for (const {input} of this.fields) input.closest("label").remove();
    this.fields = [...SHAPES[this.option][this.shown.name].parameters].map(([name, about]) => this.field(name, about));
  }

  field(name, about) {
    const attributes = {"aria-label": `${this.label}: ${about.label}`, autocomplete: "off"};
    const input = make("input", about.isWord ? {...attributes, type: "checkbox"}
      : {...attributes, inputmode: "decimal", placeholder: "by itself"});
    input.onchange = () => this.changed(name, about, input);
    input.onkeydown = ({key}) => {
      if (key === "Escape") this.show(this.shown.text);
    };
    const label = about.isWord ? about.label : `${about.label} (${shownUnit(about.unit)})`;
    this.element.append(make("label", {class: "pair parameter"}, make("span", {}, label), input));
    return {name, about, input};
  }

  // Takes what was chosen or typed, unless it is no value. One that the shape needs comes back if it is removed.
  changed(name, about, input) {
    const {name: shape, values: before, text: shownText} = this.shown, values = new Map(before);
    const needed = parseShape(this.option, CHOSEN[shape] ?? shape).values.get(name), text = input.value.trim();
    const value = about.isWord || text === "" ? "" : typedNumber(text, about, this.say);
    if (value === null) return this.show(shownText);
    if (about.isWord ? input.checked : text !== "") values.set(name, String(value)).delete(EXCLUDED[name]);
    else if (needed) values.set(name, needed);
    else values.delete(name);
    this.take(shapeText(this.option, {name: shape, values}));
  }
}

function showValue({about, input}, text) {
  if (about.isWord) input.checked = text !== undefined;
  else if (!isUnfinished(input)) input.value = text === undefined ? "" : valueText(about, text);
}

// Returns a value of an option's text as its field shows it: a length in the page's unit.
const valueText = ({unit}, text) =>
  String(Number(unit === "mm" ? lengthText(parseLength(text), 4) : parseLength(text, false)));
