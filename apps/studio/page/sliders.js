// The sliders on the page, with the lock of the height and the method: shows the document's values, and changes them.

import {defaultOf} from "./about.js";
import {$, Slider, lockButton, make} from "./controls.js";
import {FIRST} from "./document.js";
import {FIELDS} from "./fields.js";
import {withUnit} from "./lengths.js";

// What shapes heights: a lithophane, which is made from light and colours, has none of it.
const SHAPING = ["detail", "boundary", "steepest", "steps"];

export class Sliders {
  // `frame` returns the numbers of the newest picture, or null; `say` takes a line for people.
  constructor({doc, frame, say}) {
    Object.assign(this, {doc, frame, say});
    this.lock = lockButton(() => this.toggleLock());
    const sliderOf = ([name, field]) => new Slider(
      {...field, extra: name === "height" ? this.lock : null, otherwise: FIRST.options[name]},
      (...moved) => this.slide(name, ...moved), () => doc.endStroke(name), say);
    this.all = Object.fromEntries(Object.entries(FIELDS).map((field) => [field[0], sliderOf(field)]));
    for (const [name, slider] of Object.entries(this.all)) {
      slider.number.dataset.option = name;
      $(FIELDS[name].place).append(slider.element);
    }
    this.all.height.element.after(make("p", {id: "reach", class: "note", role: "status"}));
    $("#method").onchange = (event) => this.changeMethod(event.target.value);
  }

  // The elements by the names of their options.
  get elements() {
    return Object.fromEntries(Object.entries(this.all).map(([name, {element}]) => [name, element]));
  }

  shownWidth() {
    return Number((this.doc.now.options.width ?? this.frame()?.width_mm ?? defaultOf("width")).toFixed(4));
  }

  // Marks the width that a plate of a given size leaves.
  showWidth() {
    const most = this.frame()?.most_width_mm ?? null;
    this.all.width.show(this.shownWidth());
    this.all.width.showMark(most, most && `The plate leaves ${withUnit(most)}`);
  }

  slide(name, value, isTyped = false) {
    const part = {options: {[name]: value}}, most = this.frame()?.most_width_mm ?? Infinity, {doc} = this;
    if (name === "width" && value >= most) part.options.width = null; // as wide as the plate leaves
    if (name === "height") part.u = null; // to be found anew
    doc.change(part, name);
    if (name === "width" && value > most && isTyped)
      this.say(`The plate leaves ${withUnit(most)} for the longer side: the figure is as large as that.`);
    if (name === "width") this.showWidth();
    else if (doc.now.options[name] !== value) this.all[name].show(doc.now.options[name]); // the drag was taken back
  }

  // Changes the method. A soft rim that was not touched becomes the one that the new method starts from.
  changeMethod(method) {
    const {options} = this.doc.now;
    const isUntouched = options.boundary === defaultOf("boundary", options.method);
    const boundary = isUntouched ? defaultOf("boundary", method) : options.boundary;
    this.doc.change({options: {method, boundary}});
  }

  toggleLock() {
    const {isHeightLocked} = this.doc.now;
    this.doc.change({isHeightLocked: !isHeightLocked, u: isHeightLocked ? this.frame()?.u ?? null : null});
  }

  showUnit() {
    for (const slider of Object.values(this.all)) slider.showUnit();
  }

  // Shows the document's values.
  show() {
    const {options, isHeightLocked} = this.doc.now, isShaped = options.form !== "lithophane";
    for (const [name, slider] of Object.entries(this.all)) slider.show(options[name] ?? this.shownWidth());
    this.showWidth();
    $("#method").value = options.method;
    const noShape = isShaped ? "" : "A lithophane is made from light and colours, not from heights";
    for (const name of SHAPING) this.all[name].disable(noShape);
    this.all.saturation.disable(noShape || (options.tone !== "" ? "The tone curve takes its place" : ""));
    this.all.corner.element.hidden = options.outline !== "round";
    this.all.margin.disable(options.outline === "none" ? "There is no plate around the relief" : "");
    this.lock.setAttribute("aria-pressed", isHeightLocked);
  }
}
