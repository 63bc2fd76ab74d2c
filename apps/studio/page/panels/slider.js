// Makes sliders that have a number field beside them.

import {Pause, clamp, make} from "../controls.js";
import {finish, isUnfinished, showText} from "../inputs.js";
import {lengthText, millimetresPerUnit, shown, shownUnit, typedNumber} from "../lengths.js";

// Mappings from values to positions on a slider, and back.
export const spread = {
  linear: {to: (v, min, max) => (v - min) / (max - min), from: (p, min, max) => min + p * (max - min)},
  root: {to: (v, min, max) => Math.sqrt((v - min) / (max - min)), from: (p, min, max) => min + p * p * (max - min)},
  log: {to: (v, min, max) => Math.log(v / min) / Math.log(max / min), from: (p, min, max) => min * (max / min) ** p},
};

const STEPS = 1000, MOST_DECIMALS = 4;
export const GESTURE_END_MS = 400; // pause after which a movement by keys or the wheel has ended
export const UPWARDS = {ArrowUp: 1, ArrowDown: -1};
const FORWARDS = {...UPWARDS, ArrowRight: 1, ArrowLeft: -1};

// Returns the next multiple of a step in the given direction. The step is a tenth of the largest power of ten that does
// not exceed the value, and at least `least`. With `isFine` it is ten times smaller.
export function nextValue(value, direction, isFine, least) {
  // After 10 comes 11, but before 10 comes 9.9. So 10 counts as slightly less if the direction is towards 0.
  const inner = Math.abs(value) * (Math.sign(value) === direction ? 1 + 1e-9 : 1 - 1e-9);
  const step = Math.max(least, 10 ** (Math.floor(Math.log10(inner || least)) - 1)) / (isFine ? 10 : 1);
  const steps = value / step;
  return (direction > 0 ? Math.floor(steps + 1e-6) + 1 : Math.ceil(steps - 1e-6) - 1) * step;
}

// Returns the number of decimals of a typed value; 0 for a computed value, which has more decimals than a user can
// type.
function decimalsOf(value) {
  return value === Number(value.toFixed(MOST_DECIMALS)) ? `${value}`.split(".")[1]?.length ?? 0 : 0;
}

// A slider with a label and a number field. `field` is {label, unit, unitName, hand, min, max, otherwise, decimals,
// spread, help, extra}. The slider spans the range `hand`, the number field allows `min` to `max`, and a double click
// sets the value `otherwise`. Calls onInput(value, isTyped) while the slider moves, onEnd() when a movement ends, and
// say(text) if a number is refused.
export class Slider {
  constructor(field, onInput, onEnd, say) {
    Object.assign(this, {spread: spread.linear, decimals: 2, ...field, onInput, onEnd, say});
    this.value = this.otherwise;
    this.rest = new Pause(onEnd, GESTURE_END_MS);
    this.range = make("input", {type: "range", min: 0, max: STEPS, step: 1, "aria-label": this.label});
    // The field does not have the type "number", because browsers would then read "1/8in" as 18, and could not read
    // "2,5".
    this.number = make("input", {role: "spinbutton", inputmode: "decimal", autocomplete: "off"});
    this.name = make("span", {class: "name", title: this.help}, this.label);
    this.shownUnit = make("span", {class: "unit", "aria-hidden": "true"});
    this.mark = make("span", {class: "reach", hidden: true});
    const boxed = make("span", {class: "number"}, this.number, this.shownUnit);
    this.row = make("div", {class: "row"}, this.name, ...(this.extra ? [this.extra] : []), boxed);
    this.element = make("div", {class: "slider"}, this.row, make("div", {class: "way"}, this.range, this.mark));
    this.listen();
    this.showUnit();
  }

  get isLength() {
    return this.unit === "mm";
  }

  // Shows the page's unit of lengths, which may have changed.
  showUnit() {
    const unit = shownUnit(this.unit), scale = this.isLength ? millimetresPerUnit() : 1;
    const name = unit === "in" ? "inches" : this.unitName ?? unit;
    this.shownUnit.textContent = unit ?? "";
    this.number.setAttribute("aria-label", `${this.label}${name ? ` in ${name}` : " value"}`);
    this.number.setAttribute("aria-valuemin", Number((this.min / scale).toPrecision(6)));
    this.number.setAttribute("aria-valuemax", Number((this.max / scale).toPrecision(6)));
    this.show(this.value);
  }

  listen() {
    this.range.oninput = () => this.moved(this.valueAt(this.range.value));
    this.range.onchange = () => this.onEnd();
    this.number.onchange = () => this.typed();
    this.number.onkeydown = (event) => (event.key === "Escape" ? this.takeBack() : this.step(event, UPWARDS));
    const reset = (event) => {
      event.preventDefault();
      this.moved(this.otherwise);
      this.onEnd();
    };
    this.range.ondblclick = reset;
    this.name.ondblclick = reset;
    this.element.addEventListener("wheel", (event) => this.wheel(event), {passive: false});
    this.range.onkeydown = (event) => this.step(event, FORWARDS);
  }

  // Takes the typed number with all its decimals, even if the slider shows fewer.
  typed() {
    const value = typedNumber(this.number.value, this, this.say);
    if (value === null) this.show(this.value);
    else this.moved(Number(value.toFixed(MOST_DECIMALS)), true);
    this.onEnd();
  }

  // Restores the number that the field had before the user typed, after Escape.
  takeBack() {
    this.show(this.value);
    this.number.select();
  }

  // The wheel moves the slider only if the slider has the focus. Otherwise it scrolls the panel.
  wheel(event) {
    if (this.range.disabled || event.ctrlKey || !this.element.contains(document.activeElement)) return;
    event.preventDefault();
    const step = -Math.sign(event.deltaY) * (event.shiftKey ? 1 : 8);
    this.moved(this.valueAt(clamp(this.position() + step, 0, STEPS)));
    this.rest.begin();
  }

  // Changes the number by arrow keys to the next round number, or by smaller steps with Shift.
  step(event, directions) {
    const direction = directions[event.key];
    if (!direction) return;
    event.preventDefault();
    if (isUnfinished(this.number)) finish(), this.typed();
    const scale = this.isLength ? millimetresPerUnit() : 1;
    const decimals = this.isLength && shown.unit === "in" ? 3 : this.decimals;
    const least = Math.max(10 ** -decimals, 10 ** Math.ceil(Math.log10(this.hand[1] / scale / 1000)));
    const isFine = event.shiftKey && least > 10 ** -decimals;
    this.moved(clamp(nextValue(this.value / scale, direction, isFine, least) * scale, this.min, this.max));
    this.rest.begin();
  }

  valueAt = (position) => this.spread.from(position / STEPS, ...this.hand);

  position = (value = this.value) => Math.round(this.spread.to(clamp(value, ...this.hand), ...this.hand) * STEPS);

  moved(value, isTyped = false) {
    const now = isTyped ? value : this.rounded(value);
    this.show(now);
    this.onInput(now, isTyped);
  }

  // Returns a value rounded to the slider's decimals. A length is rounded in the page's unit, and returned in mm.
  rounded(value) {
    const number = Number(this.text(value, this.decimals));
    return this.isLength ? Number((number * millimetresPerUnit()).toFixed(MOST_DECIMALS)) : number;
  }

  // Returns the number as text, with the slider's decimals, or with more if the user typed more.
  text(value, decimals = Math.max(this.decimals, decimalsOf(value))) {
    return this.isLength ? lengthText(value, decimals) : value.toFixed(decimals);
  }

  show(value) {
    this.value = value;
    const text = this.text(value);
    this.range.value = this.position();
    this.range.style.setProperty("--filled", `${this.position() / STEPS * 100}%`);
    this.range.setAttribute("aria-valuetext", `${text} ${shownUnit(this.unitName ?? this.unit) ?? ""}`.trim());
    this.number.setAttribute("aria-valuenow", text);
    showText(this.number, text);
  }

  // Marks a value on the slider, such as the largest reachable one, with a tip. Removes the mark if the value is null.
  showMark(value, title = "") {
    this.mark.hidden = value === null || value > this.hand[1];
    this.range.title = value === null ? "" : title; // the mark itself is too thin for a pointer
    if (value !== null) this.mark.style.setProperty("--at", this.position(value) / STEPS);
  }

  // Marks the number as invalid, with the reason as a tip; "" removes the mark.
  complain(text) {
    this.number.title = text;
    this.number.setAttribute("aria-invalid", text !== "");
  }

  // Disables the slider, with the reason as a tip; "" enables it.
  disable(why) {
    this.range.disabled = this.number.disabled = Boolean(why);
    this.element.classList.toggle("disabled", Boolean(why));
    this.element.title = why;
  }
}

// Returns a button that locks the height: a locked height stays the same while other options change.
export function lockButton(onclick) {
  const lock = make("button", {
    class: "lock", "aria-label": "Lock the height", "aria-pressed": "true", onclick,
    title: "Keep this height while other things change",
  });
  lock.innerHTML = '<svg viewBox="0 0 24 24" aria-hidden="true"><rect x="5" y="11" width="14" height="9" rx="2"/>' +
    '<path class="shackle" d="M8 11V8a4 4 0 0 1 8 0v3"/></svg>';
  return lock;
}
