// The panel of the kind of work: the controls that matter for it, together and first, with those of a rim if there is
// one. Those of the other options stay in the panels below.

import {$} from "./controls.js";
import {KINDS, RIM, kindOf} from "./kinds.js";

const HOMES = ["#piece", "#plate-sliders", "#making"];

export class KindPanel {
  // `elements` are the controls by the names of their options.
  constructor({doc, elements}) {
    Object.assign(this, {doc, elements});
    this.homes = HOMES.map((selector) => ({home: $(selector), children: [...$(selector).children]}));
  }

  show() {
    const kind = kindOf(this.doc.now), hasRim = Boolean(this.doc.now.options.rim);
    if (kind === this.shown && hasRim === this.hasRim) return; // this runs for each event of a drag
    Object.assign(this, {shown: kind, hasRim});
    const {label, panel, note = ""} = KINDS[kind], names = hasRim ? [...new Set([...panel, ...RIM])] : panel;
    const mine = names.map((name) => this.elements[name]);
    const focused = document.activeElement; // which loses the focus where it is moved
    $("#kind-title").textContent = label;
    $("#kind-note").textContent = note;
    $("#kind-rows").append(...mine);
    for (const {home, children} of this.homes) home.append(...children.filter((child) => !mine.includes(child)));
    if (document.activeElement !== focused) focused.focus();
  }
}
