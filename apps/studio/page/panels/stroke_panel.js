// Lists the strokes of the brush. Each stroke can be named, muted and removed. A stroke whose row is under the pointer
// or has the focus is highlighted on the picture.

import {$, make, textField} from "../controls.js";
import {isUnfinished} from "../inputs.js";
import {strokesOf, textOf} from "../strokes.js";

export class StrokePanel {
  constructor({doc, brush}) {
    Object.assign(this, {doc, brush, shown: null, list: $("#stroke-list")});
  }

  show() {
    const text = this.doc.now.options.strokes, {activeElement} = document;
    if (text === this.shown || isUnfinished(activeElement)) return;
    this.shown = text;
    const focused = this.list.contains(activeElement) ? activeElement.dataset.control : null;
    const strokes = strokesOf(this.doc.now);
    $("#strokes").hidden = strokes.length === 0;
    this.brush.highlight(null);
    this.list.replaceChildren(...strokes.map((stroke, at) => this.row(stroke, at)));
    if (focused) this.focus(focused);
  }

  // Moves the focus to a control, and selects its text, if it has one, as the Tab key does. If that control no longer
  // exists, focuses the control of its kind in the last row.
  focus(control) {
    const [kind] = control.split(" "), alike = [...this.list.querySelectorAll(`[data-control^="${kind}"]`)];
    const found = $(`[data-control="${control}"]`, this.list) ?? alike.at(-1) ?? $("#stage");
    found.focus();
    found.select?.();
  }

  row(stroke, at) {
    const {name = "", brush, muted = false} = stroke, mark = () => this.brush.highlight(stroke);
    const called = name || brush, show = () => (field.value = name);
    const isUsed = make("input", {type: "checkbox", "aria-label": `Use ${called}`, "data-control": `use ${at}`});
    isUsed.checked = !muted;
    isUsed.onchange = () => this.change(at, {muted: isUsed.checked ? undefined : true});
    const attributes = {value: name, "aria-label": `Name of ${called}`, "data-control": `name ${at}`, maxlength: 80};
    const field = textField(attributes, {take: (text) => this.change(at, {name: text}), show});
    const remove = make("button", {class: "quiet", "aria-label": `Remove ${called}`, "data-control": `remove ${at}`,
      title: `Remove ${called}`}, "×");
    remove.onclick = () => this.set(strokesOf(this.doc.now).filter((_, i) => i !== at));
    const unmark = () => this.brush.highlight(null);
    const row = make("li", {onpointerenter: mark, onpointerleave: unmark}, isUsed, field, remove);
    row.addEventListener("focusin", mark);
    row.addEventListener("focusout", unmark);
    return row;
  }

  set = (strokes) => this.doc.change({options: {strokes: textOf(strokes)}});

  change(at, part) {
    this.set(strokesOf(this.doc.now).map((stroke, i) => (i === at ? {...stroke, ...part} : stroke)));
  }
}
