// Makes the page's sliders, as listed in fields.js, the button that locks the height, and the menu of methods. These
// show and change the values of the document. slider.js has the class of a single slider.

import {defaultOf, namesOf, optionOf} from "../about.js";
import {$, make} from "../controls.js";
import {FIRST, hasScale} from "../document.js";
import {FIELDS} from "./fields.js";
import {withUnit} from "../lengths.js";
import {Slider, lockButton} from "./slider.js";

// The sliders for the relief's shape, except sizes. They have no effect on a lithophane, which is made from brightness.
const SHAPING = namesOf("shape").filter((name) => FIELDS[name] && optionOf(name).unit !== "MM");

// The options that determine the largest width of the relief on its plate.
const PLATE = namesOf("plate");

// Returns the changes of the document for a slider. After a change of the height, u has to be computed again.
const partOf = (name, value) => ({options: {[name]: value}, ...(name === "height" ? {u: null} : {})});

export class Sliders {
  // `facts` returns the facts of the newest picture, or null. `say` shows a line to the user.
  constructor({doc, entries, facts, say}) {
    Object.assign(this, {doc, entries, facts, say});
    this.lock = lockButton(() => this.toggleLock());
    const sliderOf = ([name, field]) => new Slider(
      {...field, extra: name === "height" ? this.lock : null, otherwise: FIRST.options[name]},
      (...moved) => this.slide(name, ...moved), () => doc.endGesture(name), say);
    this.all = Object.fromEntries(Object.entries(FIELDS).map((field) => [field[0], sliderOf(field)]));
    for (const [name, slider] of Object.entries(this.all)) {
      slider.number.dataset.option = name;
      $(FIELDS[name].place).append(slider.element);
    }
    // Maps names of options to the sliders' elements.
    this.elements = Object.fromEntries(Object.entries(this.all).map(([name, {element}]) => [name, element]));
    this.all.height.element.after(make("p", {id: "reach", class: "note", role: "status"}));
    $("#method").onchange = (event) => this.changeMethod(event.target.value);
  }

  shownWidth = () => Number((this.doc.now.options.width ?? this.facts()?.width_mm ?? defaultOf("width")).toFixed(4));

  // Shows the width, and marks the largest width that fits a plate of given size.
  showWidth() {
    const most = this.facts()?.most_width_mm ?? null;
    const {width} = this.all;
    if (!this.entries.isPending("width")) width.show(this.doc.now.options.width ?? width.rounded(this.shownWidth()));
    this.all.width.showMark(most, most && `The plate leaves ${withUnit(most)}`);
  }

  showScaled() {
    if (hasScale(this.doc.now) && this.facts()) this.all.height.show(this.facts().height_mm);
  }

  slide(name, value, isTyped = false) {
    if (isTyped && this.entries.pending.length > 0) return this.enter(name, value);
    const most = this.mostWidth() ?? Infinity, {doc} = this;
    doc.change(partOf(name, name === "width" && value >= most ? null : value), name); // null: the largest that fits
    if (name === "width" && value > most && isTyped)
      this.say(`The plate leaves ${withUnit(most)} for the longer side: the figure is as large as that.`);
    if (name === "width") this.showWidth();
    else if (doc.now.options[name] !== value) this.all[name].show(doc.now.options[name]); // the drag was cancelled
  }

  // Returns the largest width that fits the plate; null if the plate has no given size, or if the plate was changed
  // after the newest picture.
  mostWidth() {
    const {options: shown, most_width_mm: most} = this.facts() ?? {}, {options} = this.doc.now;
    return most && PLATE.every((name) => shown[name] === options[name]) ? most : null;
  }

  // Takes a typed number after the earlier entries.
  enter(name, value) {
    this.all[name].show(value);
    this.entries.add({name, label: FIELDS[name].label, part: () => partOf(name, value)});
  }

  // Changes the method. If the soft outline has the default of the old method, it gets the default of the new method.
  changeMethod(method) {
    const {options} = this.doc.now;
    const isUntouched = options.boundary === defaultOf("boundary", options.method);
    const boundary = isUntouched ? defaultOf("boundary", method) : options.boundary;
    this.doc.change({options: {method, boundary}});
  }

  toggleLock() {
    const {isHeightLocked} = this.doc.now;
    this.doc.change({isHeightLocked: !isHeightLocked, u: isHeightLocked ? this.facts()?.u ?? null : null});
  }

  showUnit() {
    for (const slider of Object.values(this.all)) slider.showUnit();
  }

  show() {
    const {options, isHeightLocked} = this.doc.now, isShaped = options.form !== "lithophane";
    for (const [name, slider] of Object.entries(this.all)) {
      const isWaiting = this.entries.isPending(name);
      slider.element.ariaBusy = isWaiting ? "true" : null;
      if (!isWaiting && name !== "width") slider.show(options[name]); // only the width may be null
    }
    this.showWidth();
    this.showScaled();
    $("#method").value = options.method;
    const isScaled = hasScale(this.doc.now), scale = "One vertical scale gives all heights";
    const noShape = isScaled ? scale : isShaped ? "" : "A lithophane is made from light and colours, not from heights";
    this.all.height.disable(isScaled ? scale : "");
    $("#method").disabled = isScaled;
    for (const name of SHAPING) this.all[name].disable(noShape);
    const isPaper = options.method === "paper";
    if (isShaped && isPaper && !isScaled)
      for (const name of ["steps", "planes"]) this.all[name].disable("The paper's method keeps no steps");
    if (isShaped && !isPaper && !isScaled && options.tone !== "") this.all.saturation.disable("The tone curve takes its place");
    this.all.corner.element.hidden = options.outline !== "round";
    this.all.margin.disable(options.outline === "none" ? "There is no plate around the relief" : "");
    this.lock.setAttribute("aria-pressed", isHeightLocked);
  }
}
