// Shows the panel of the kind of work, with the controls that matter for this kind: those of the rim if there is a rim,
// and the button that turns the piece into its die. The controls of all other options stay in the panels below.

import {$} from "../controls.js";
import {whenFinished} from "../inputs.js";
import {KINDS, RIM, dieOf, kindOf} from "./kinds.js";
import {sizeText} from "../lengths.js";

const HOMES = ["#piece", "#plate-sliders", "#making"];

// Returns a note that explains the die of a piece. States the size of the die if `size` is not null.
function dieNote({options: {draft}}, {label}, size) {
  const walls = draft ? "" : " It has no draft angle: give it one if steep walls hold what it shapes.";
  return `This die shapes the ${label.toLowerCase()} with all its measures.${walls}` +
    (size ? ` The die itself is ${sizeText(size)}.` : "");
}

export class KindPanel {
  // `elements` maps names of options to their controls.
  constructor({doc, entries, elements}) {
    Object.assign(this, {doc, elements});
    this.homes = HOMES.map((selector) => ({home: $(selector), children: [...$(selector).children]}));
    $("#make-die").onclick = () => entries.add({name: "form", label: "Form", part: dieOf, isTried: true, isMade: true});
  }

  show() {
    const {now} = this.doc, {form, rim, wrap, draft} = now.options, kind = kindOf(now), hasRim = Boolean(rim);
    const key = [kind, hasRim, form, wrap, draft].join();
    if (key === this.shown) return; // nothing has changed; this method runs for each event of a drag
    this.shown = key;
    const {label, panel, note = ""} = KINDS[kind], isDie = form === "die" && kind !== "die", lower = label.toLowerCase();
    const names = [...new Set([...panel, ...(isDie ? ["draft"] : []), ...(hasRim ? RIM : [])])];
    whenFinished(() => this.place(names.map((name) => this.elements[name])));
    $("#kind-title").textContent = isDie ? `Die of the ${lower}` : label;
    $("#kind-note").textContent = isDie ? dieNote(now, KINDS[kind]) : note;
    $("#make-die").textContent = isDie ? `Back to the ${lower}` : `Make the die of this ${lower}`;
    $("#make-die").hidden = !isDie && (form !== "relief" || wrap !== "none");
  }

  // Shows the size of the die in the newest picture.
  pictured({size_mm: size, is_size_exact: isExact}) {
    const {now} = this.doc, kind = kindOf(now);
    if (now.options.form === "die" && kind !== "die" && isExact)
      $("#kind-note").textContent = dieNote(now, KINDS[kind], size);
  }

  place(mine) {
    const focused = document.activeElement; // an element that is moved can lose the focus
    $("#kind-rows").append(...mine);
    for (const {home, children} of this.homes) home.append(...children.filter((child) => !mine.includes(child)));
    if (document.activeElement !== focused) focused.focus();
  }
}
