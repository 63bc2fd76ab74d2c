// The panel of the kind of work: the controls that matter for it, together and first. Those of the other options stay
// in the panels below.

import {$} from "./controls.js";
import {KINDS, kindOf} from "./kinds.js";

const HOMES = ["#piece", "#plate-sliders", "#making"];

export class KindPanel {
  // `elements` are the controls by the names of their options.
  constructor({doc, elements}) {
    Object.assign(this, {doc, elements});
    this.homes = HOMES.map((selector) => ({home: $(selector), children: [...$(selector).children]}));
  }

  show() {
    const kind = kindOf(this.doc.now);
    if (kind === this.shown) return; // this runs for each event of a drag
    this.shown = kind;
    const {label, panel, note = ""} = KINDS[kind], mine = panel.map((name) => this.elements[name]);
    const focused = document.activeElement; // which loses the focus where it is moved
    $("#kind-title").textContent = label;
    $("#kind-note").textContent = note;
    $("#kind-rows").append(...mine);
    for (const {home, children} of this.homes) home.append(...children.filter((child) => !mine.includes(child)));
    if (document.activeElement !== focused) focused.focus();
  }
}
