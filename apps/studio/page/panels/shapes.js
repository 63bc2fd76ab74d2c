// Makes the controls of options whose value is a shape with parameters, such as "wave:height=3,length=40,hollow" or the
// tool "v:60:0.5": a menu of the shapes, and a field for each parameter of the chosen shape.

import {make, pair, textField} from "../controls.js";
import {showText} from "../inputs.js";
import {parseLength, shortLength, shown, shownUnit, typedNumber} from "../lengths.js";

const mm = {unit: "mm", min: 0, max: 1e6}, degrees = {unit: "°", min: -360, max: 360}, word = {isWord: true};
const height = ["height", {label: "Height", ...mm}], diameter = ["diameter", {label: "Diameter", ...mm}];
const turn = ["turn", {label: "Around by", ...degrees}], angle = ["angle", {label: "Angle", ...degrees}];
const direction = ["direction", {label: "Direction", ...degrees}];
const length = ["length", {label: "Length", ...mm}];
const hollow = ["hollow", {label: "Hollow", ...word}], inside = ["inside", {label: "On the inside", ...word}];
const tip = ["tip", {label: "Tip", ...mm, otherwise: "sharp"}];

const shape = (label, ...parameters) => ({label, parameters: new Map(parameters)});

// The parameters of each shape. They must be those of the engine.
export const SHAPES = {
  base: {
    plane: shape("Plane"), fold: shape("Fold", height, angle, direction, hollow),
    wave: shape("Wave", height, length, direction, hollow),
    cylinder: shape("Cylinder", diameter, height, direction, hollow), dome: shape("Dome", diameter, height, hollow),
    image: shape("Image", height, hollow),
  },
  wrap: {
    none: shape("Nothing"), cylinder: shape("Cylinder", turn, diameter, direction, inside),
    cone: shape("Cone", turn, diameter, angle, direction, inside), sphere: shape("Sphere", turn, diameter, inside),
  },
  tool: {"": shape("None"), ball: shape("Ball end", diameter), flat: shape("Flat end", diameter),
    v: shape("V bit", angle, tip)},
};
// The initial texts of shapes that need a size.
export const FIRST_TEXTS = {ball: "ball:3", flat: "flat:3", v: "v:60"};
const IMAGE = "image"; // chosen by the control of the base's height map
// Maps each parameter to the parameters that are deleted when it is set, since a shape cannot have them together.
const REPLACED = {turn: ["diameter"], diameter: ["turn", "height"], height: ["diameter", "angle"], angle: ["height"]};

// Returns the parameters of a shape; none for a shape that this page does not have.
const parametersOf = (option, name) => SHAPES[option][name]?.parameters ?? new Map();

// Returns the name of the shape in a text, and a map from its parameters to their values as texts. A parameter without
// a value, such as "hollow", has the value "". A comma before a digit is a decimal comma.
export function parseShape(option, text) {
  const [name] = text.split(":", 1), rest = text.slice(name.length + 1), names = [...parametersOf(option, name).keys()];
  const entries = option === "tool" ? rest.split(":").map((value, i) => [names[i], value])
    : rest.split(/,(?!\d)/).map((entry) => [...entry.split("="), ""].slice(0, 2));
  return {name, values: new Map(rest === "" ? [] : entries)};
}

function shapeText(option, {name, values}) {
  const named = [...parametersOf(option, name).keys()].filter((parameter) => values.has(parameter));
  if (option === "tool") return [name, ...named.map((parameter) => values.get(parameter))].join(":");
  const entries = named.map((parameter) => parameter + (values.get(parameter) && `=${values.get(parameter)}`));
  return entries.length ? `${name}:${entries.join()}` : name;
}

export class ShapeRow {
  // Calls take(change) when the user changes the option; `change` turns the current text of the option into the new
  // one. Calls say(text) to show a line to the user.
  constructor({option, label, title, take, say}) {
    Object.assign(this, {option, label, take, say, fields: []});
    this.input = make("select", {id: option, "data-option": option, "aria-label": label},
      ...Object.entries(SHAPES[option]).map(([name, {label}]) => make("option", {value: name}, label)));
    this.input.onchange = ({target: {value}}) => take(() => FIRST_TEXTS[value] ?? value);
    this.element = make("div", {class: "shape", title}, pair(label, this.input));
  }

  show(text) {
    const before = this.shown, {name, values} = parseShape(this.option, text);
    this.shown = {text, unit: shown.unit, name, values};
    if (before?.name !== name || before.unit !== shown.unit) this.showFields();
    this.input.value = name;
    for (const choice of this.input.options) choice.hidden = choice.value === IMAGE && name !== IMAGE;
    for (const field of this.fields) showValue(field, values.get(field.name));
  }

  showFields() {
    for (const {input} of this.fields) input.closest("label").remove();
    this.fields = [...parametersOf(this.option, this.shown.name)].map((entry) => this.field(...entry));
  }

  field(name, parameter) {
    const kind = parameter.isWord ? {type: "checkbox"}
      : {inputmode: "decimal", placeholder: parameter.otherwise ?? "automatic"};
    const input = textField({"aria-label": `${this.label}: ${parameter.label}`, ...kind},
      {take: () => this.changed(name, parameter, input), show: () => this.show(this.shown.text)});
    const label = parameter.isWord ? parameter.label : `${parameter.label} (${shownUnit(parameter.unit)})`;
    this.element.append(pair(label, input, {class: "pair parameter"}));
    return {name, parameter, input};
  }

  // Takes the value of a field, unless it is invalid or the user has chosen another shape meanwhile.
  changed(name, parameter, input) {
    const {name: shape, text: shown} = this.shown, typed = input.value.trim(), {checked} = input;
    const value = parameter.isWord || typed === "" ? "" : typedNumber(typed, parameter, this.say);
    if (value === null) return this.show(shown);
    const isThere = parameter.isWord ? checked : typed !== "";
    this.take((text) => (parseShape(this.option, text).name !== shape ? text
      : withParameter(this.option, text, name, isThere ? String(value) : null)));
  }
}

// Returns the text of the option with a new value of a parameter, or without the parameter if the value is null. If the
// shape needs the parameter, null sets the parameter to its initial value.
function withParameter(option, text, parameter, value) {
  const {name, values} = parseShape(option, text);
  const needed = parseShape(option, FIRST_TEXTS[name] ?? name).values.get(parameter);
  if (value !== null) for (const other of REPLACED[parameter] ?? []) values.delete(other);
  values.delete(parameter);
  if (value !== null || needed) values.set(parameter, value ?? needed);
  return shapeText(option, {name, values});
}

function showValue({parameter, input}, text) {
  if (parameter.isWord) input.checked = text !== undefined;
  else showText(input, text === undefined ? "" : valueText(parameter, text));
}

// Returns the text that a parameter's field shows for its value. Lengths are converted to the page's unit.
const valueText = ({unit}, text) =>
  (unit === "mm" ? shortLength(parseLength(text)) : String(parseLength(text, false)));
