// Sliders with a number beside them, and small helpers for the page's elements.

import {typedNumber} from "./lengths.js";

export const $ = (selector, root = document) => root.querySelector(selector);

// Creates an element: make("button", {class: "quiet", "aria-label": "Undo", onclick: f}, ...children)
export function make(tag, attributes = {}, ...children) {
  const svg = ["svg", "path", "g", "circle", "line", "text", "rect"].includes(tag);
  const element = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element[name] = value;
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

export const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

// Ways to spread values over a slider.
export const spread = {
  linear: {to: (v, min, max) => (v - min) / (max - min), from: (p, min, max) => min + p * (max - min)},
  root: {to: (v, min, max) => Math.sqrt((v - min) / (max - min)), from: (p, min, max) => min + p * p * (max - min)},
  log: {to: (v, min, max) => Math.log(v / min) / Math.log(max / min), from: (p, min, max) => min * (max / min) ** p},
};

const STEPS = 1000;

// A labelled slider with a number field. `field` is {label, unit, unitName, hand, min, max, otherwise, decimals,
// spread, help}: the slider spans `hand`, the number is from `min` to `max`, a double click sets `otherwise`. Calls
// onInput(value) while the slider moves, onEnd() when a movement is over, and say(text) if a number is refused.
export class Slider {
  constructor(field, onInput, onEnd, say) {
    Object.assign(this, {spread: spread.linear, decimals: 2, ...field, onInput, onEnd, say});
    this.value = this.otherwise;
    const unit = this.unit ? ` in ${this.unitName ?? this.unit}` : " value";
    this.range = make("input", {type: "range", min: 0, max: STEPS, step: 1, "aria-label": this.label});
    // No input of type number: browsers make 18 of "1/8in" there, and nothing of "2,5".
    this.number = make("input", {
      role: "spinbutton", inputmode: "decimal", autocomplete: "off", "aria-label": this.label + unit,
      "aria-valuemin": this.min, "aria-valuemax": this.max,
    });
    this.name = make("span", {class: "name", title: this.help}, this.label);
    const shownUnit = make("span", {class: "unit", "aria-hidden": "true"}, this.unit ?? "");
    const boxed = make("span", {class: "number"}, this.number, shownUnit);
    this.row = make("div", {class: "row"}, this.name, ...(this.extra ? [this.extra] : []), boxed);
    this.element = make("div", {class: "slider"}, this.row, this.range);
    this.listen();
    this.show(this.value);
  }

  listen() {
    this.range.oninput = () => this.moved(this.valueAt(this.range.value));
    this.range.onchange = () => this.onEnd();
    this.number.oninput = () => (this.isTyping = true);
    this.number.onblur = () => (this.isTyping = false);
    this.number.onchange = () => this.typed();
    this.number.onkeydown = (event) => this.step(event, {ArrowUp: 1, ArrowDown: -1});
    const reset = (event) => {
      event.preventDefault();
      this.moved(this.otherwise);
      this.onEnd();
    };
    this.range.ondblclick = reset;
    this.name.ondblclick = reset;
    this.element.addEventListener("wheel", (event) => this.wheel(event), {passive: false});
    this.range.onkeydown = (event) => this.step(event, {ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1});
  }

  // Takes the number that was typed, with more decimals than the slider has if they were typed.
  typed() {
    this.isTyping = false;
    const value = typedNumber(this.number.value, this, this.say);
    this.exact = value === null ? this.exact : Number(value.toFixed(4));
    if (value === null) this.show(this.value);
    else this.moved(this.exact);
    this.onEnd();
  }

  wheel(event) {
    if (this.range.disabled || event.ctrlKey) return;
    event.preventDefault();
    const step = -Math.sign(event.deltaY) * (event.shiftKey ? 1 : 8);
    this.moved(this.valueAt(clamp(this.position() + step, 0, STEPS)));
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.onEnd(), 400);
  }

  // Arrow keys move the slider by a hundredth of the way, with shift by a thousandth.
  step(event, directions) {
    const direction = directions[event.key];
    if (!direction) return;
    event.preventDefault();
    this.isTyping = false;
    const step = direction * (event.shiftKey ? 1 : 10);
    this.moved(this.valueAt(clamp(this.position() + step, 0, STEPS)));
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.onEnd(), 400);
  }

  valueAt(position) {
    return this.spread.from(position / STEPS, ...this.hand);
  }

  position() {
    return Math.round(this.spread.to(clamp(this.value, ...this.hand), ...this.hand) * STEPS);
  }

  moved(value) {
    this.show(value);
    this.onInput(Number(this.text(value)));
  }

  // Returns the number as it is shown.
  text(value) {
    return value === this.exact ? value.toFixed(Math.max(this.decimals, `${value}`.split(".")[1]?.length ?? 0))
      : value.toFixed(this.decimals);
  }

  show(value) {
    this.value = value;
    const text = this.text(value);
    this.range.value = this.position();
    this.range.style.setProperty("--filled", `${this.position() / STEPS * 100}%`);
    this.range.setAttribute("aria-valuetext", `${text} ${this.unitName ?? this.unit ?? ""}`.trim());
    this.number.setAttribute("aria-valuenow", text);
    if (!this.isTyping) this.number.value = text;
  }

  set disabled(is) {
    this.range.disabled = this.number.disabled = is;
    this.element.classList.toggle("disabled", is);
  }
}

// Returns the number as "1,234,567".
export const count = (n) => Math.round(n).toLocaleString("en-US");

export function fileSize(bytes) {
  const units = ["bytes", "kB", "MB", "GB"];
  let unit = 0;
  for (; bytes >= 1000 && unit < 3; ++unit) bytes /= 1000;
  return `${bytes >= 100 || unit === 0 ? bytes.toFixed(0) : bytes.toFixed(1)} ${units[unit]}`;
}

// Lets a file be saved through the browser.
export function download(blob, name) {
  const link = make("a", {href: URL.createObjectURL(blob), download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
