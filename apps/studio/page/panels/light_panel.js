// Shows the panel of light and colour: the light for which a relief is made, and the depth of a coloured scan's lines.

import {$, ARROWS, Pause, clamp, make, pair, textField} from "../controls.js";
import {hasScale} from "../document.js";
import {showText} from "../inputs.js";
import {typedNumber} from "../lengths.js";
import {angles, degrees, direction, whole} from "../lights.js";
import {GESTURE_END_MS} from "./slider.js";

const LOWEST = 5, HIGHEST = 85; // range of elevations that the engine accepts, in degrees
const RADIUS = 46; // radius of the dial in units of its SVG

// Parses the option's text "AZIMUTH,ELEVATION", both in degrees.
function parse(text) {
  const [azimuth, elevation] = text.split(",").map(Number);
  return {azimuth, elevation};
}
const textOf = ({azimuth, elevation}) => `${whole(azimuth)},${clamp(Math.round(elevation), LOWEST, HIGHEST)}`;

// Converts a direction of light to a position on the dial: light from the viewer is in the middle, and low light is
// near the edge.
const placeOf = ({azimuth, elevation}) => {
  const [x, y] = direction(azimuth, 0), far = RADIUS * (90 - elevation) / 90;
  return [far * x, -far * y];
};
const lightAt = (x, y) => ({azimuth: degrees(Math.atan2(-y, x)), elevation: 90 * (1 - Math.hypot(x, y) / RADIUS)});

export class LightPanel {
  // `sliders` has the elements of the sliders by the names of their options; `say` shows a line to the user.
  constructor({doc, sliders, say}) {
    Object.assign(this, {doc, sliders, say, facts: null, rest: new Pause(() => doc.endGesture("aim"), GESTURE_END_MS)});
    this.input = make("input", {type: "checkbox", id: "light", "data-option": "light", "aria-label": "Made for one light",
      onchange: ({target}) => doc.change({options: {light: target.checked ? textOf(angles(doc.now.light)) : ""}})});
    this.choice = pair("Made for one light", this.input);
    this.fields = [["azimuth", "From (°)", [-360, 360]], ["elevation", "Elevation (°)", [LOWEST, HIGHEST]]]
      .map((field) => this.field(...field));
    const take = make("button", {class: "quiet", onclick: () => this.aim(angles(doc.now.light))}, "As on the picture");
    this.rows = make("div", {class: "aim"}, this.dial(), make("div", {}, ...this.fields.map(({row}) => row), take));
    $("#light-rows").prepend(this.choice, this.rows);
  }

  field(name, label, [min, max]) {
    const input = textField({inputmode: "decimal", "aria-label": `${label} of the light`}, {
      take: (text) => {
        const value = typedNumber(text, {label, unit: "°", min, max}, this.say);
        if (value === null) return this.show();
        this.aim({...parse(this.doc.now.options.light), [name]: value});
      },
      show: () => this.show()});
    return {name, input, row: pair(label, input)};
  }

  // Returns the dial, on which a dot is dragged or moved by arrow keys.
  dial() {
    const cross = [[RADIUS, 0], [0, RADIUS]].map(([x, y]) => make("line", {x1: -x, y1: -y, x2: x, y2: y}));
    this.ray = make("line", {class: "ray", x2: 0, y2: 0});
    this.sun = make("circle", {class: "sun", r: 6});
    const svg = make("svg", {viewBox: "-50 -50 100 100", "aria-hidden": "true"}, make("circle", {r: RADIUS}), ...cross,
      this.ray, this.sun);
    this.knob = make("div", {class: "dial", role: "slider", tabindex: 0, "aria-label": "Direction of the light",
      "aria-valuemin": 0, "aria-valuemax": 359, title: "Drag the light; arrow keys turn, raise and lower it"}, svg);
    const move = ({clientX, clientY}) => {
      const {left, top, width} = svg.getBoundingClientRect(), scale = 100 / width;
      this.aim(lightAt((clientX - left) * scale - 50, (clientY - top) * scale - 50), "aim");
    };
    this.knob.onpointerdown = (event) => {
      this.knob.setPointerCapture(event.pointerId);
      this.doc.endGesture();
      move(event);
    };
    this.knob.onpointermove = (event) => this.knob.hasPointerCapture(event.pointerId) && move(event);
    this.knob.onlostpointercapture = () => this.doc.endGesture("aim");
    this.knob.onkeydown = (event) => this.step(event);
    return this.knob;
  }

  step(event) {
    const step = ARROWS[event.key];
    if (!step) return;
    event.preventDefault();
    const {azimuth, elevation} = parse(this.doc.now.options.light), size = event.shiftKey ? 1 : 5;
    this.aim({azimuth: azimuth - step[0] * size, elevation: elevation + step[1] * size}, "aim");
    this.rest.begin();
  }

  // Makes the relief for a light, and shows it under that light.
  aim(light, gesture = null) {
    const text = textOf(light), {azimuth, elevation} = parse(text);
    const lamp = direction(azimuth, elevation).map((x) => Math.round(x * 1e4) / 1e4);
    this.doc.change({light: lamp, options: {light: text}}, gesture);
    if (gesture) this.show(); // the other controls are updated when the drag pauses
  }

  tell(facts) {
    this.facts = facts;
    this.show();
  }

  // Returns the reason why no light can be chosen; "" if a light can be chosen.
  get refusal() {
    const {options} = this.doc.now;
    if (hasScale(this.doc.now)) return "One vertical scale gives all heights";
    if (options.form === "lithophane") return "A lithophane is lit from behind";
    if (options.method === "paper") return "The paper's method chooses no slopes for a light";
    return this.facts && !this.facts.can_be_lit ? "Precision has to be exact for this" : "";
  }

  show() {
    const {light, form} = this.doc.now.options, {refusal} = this, isLit = light !== "" && !refusal;
    this.input.checked = light !== "";
    this.input.disabled = refusal !== "";
    this.choice.title = refusal || "Slopes are chosen for the light under which the piece will hang";
    this.rows.hidden = this.sliders["light-contrast"].hidden = !isLit;
    const isFlat = form === "lithophane" || hasScale(this.doc.now) || this.doc.now.options.method === "paper";
    this.sliders.attention.hidden = isFlat || this.facts?.can_be_lit === false;
    this.sliders.colour.hidden = !this.facts?.has_colours || isFlat;
    if (!isLit) return;
    const {azimuth, elevation} = parse(light), [x, y] = placeOf({azimuth, elevation});
    for (const [part, names] of [[this.sun, ["cx", "cy"]], [this.ray, ["x1", "y1"]]])
      names.forEach((name, i) => part.setAttribute(name, [x, y][i]));
    this.knob.setAttribute("aria-valuenow", whole(azimuth));
    this.knob.setAttribute("aria-valuetext", `from ${whole(azimuth)} degrees, ${elevation} degrees high`);
    for (const {name, input} of this.fields) showText(input, {azimuth: whole(azimuth), elevation}[name]);
  }
}
