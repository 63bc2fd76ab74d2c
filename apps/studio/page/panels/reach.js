// Marks the largest reachable height on the slider. If the wanted height is out of reach, names the option that limits
// the height, with a button that relaxes this option.

import {$, make, unbroken} from "../controls.js";
import {shownOptions} from "../document.js";
import {withUnit} from "../lengths.js";

// Changes that may allow a higher relief, each with the name of the limit that it removes. The draft angle comes first,
// because without a draft angle the engine knows the largest height at once.
const LOOSER = [
  {limit: "The draft angle", action: "Drop the draft angle", part: {draft: null}},
  {limit: "The steepest wall", action: "Allow steeper walls", part: {steepest: 85}},
  {limit: "The tone curve", action: "Drop the tone curve", part: {tone: ""}},
];
const WORTH = 1.02; // a change is offered if it allows a height larger by this factor

export class Reach {
  constructor({engine, doc, slider, chooseView}) {
    Object.assign(this, {engine, doc, slider, chooseView, key: "", turn: 0});
  }

  clear() {
    this.key = "";
    ++this.turn;
    this.slider().showMark(null);
    this.slider().complain("");
    $("#reach").replaceChildren();
  }

  // Must be called with the facts of each picture of a model. `isFine` is true for the pictures that come when nothing
  // moves. The largest height does not depend on the wanted height, so it is requested again only when something else
  // changes.
  async pictured(facts, isFine, model) {
    const isMissed = this.doc.now.isHeightLocked && !facts.is_height_met;
    this.slider().complain(isMissed ? `Out of reach: the relief is ${withUnit(facts.height_mm)} high` : "");
    if (!isFine) return;
    if (facts.is_height_met) $("#reach").replaceChildren();
    if (this.doc.now.options.form === "lithophane") return this.clear(); // a lithophane can have any height
    const {height, ...rest} = shownOptions(this.doc.now), key = `${model} ${JSON.stringify(rest)}`;
    const turn = ++this.turn; // answers that arrive after the next picture are ignored
    if (key !== this.key) this.answer = this.engine.reach({...rest, height});
    this.key = key;
    try {
      this.reach = await this.answer;
    } catch {
      return turn === this.turn ? this.clear() : undefined; // e.g. another view is being prepared
    }
    if (turn !== this.turn) return;
    // With a draft angle, the relief in the picture may be too high, because the picture does not wait until the
    // largest height is known. The mark then shows that largest height, which steps at depth jumps cannot raise.
    const isTooHigh = rest.draft && facts.height_mm > this.reach, isMet = facts.is_height_met && !isTooHigh;
    const most = isTooHigh ? this.reach : isMet ? Math.max(this.reach, facts.height_mm) : facts.height_mm;
    const name = most === this.reach ? "Reachable without steps at depth jumps" : "Reached with steps at depth jumps";
    this.slider().showMark(most, `${name}: ${withUnit(most)}`);
    if (isMet) return;
    await this.explain(most, turn);
  }

  async explain(most, turn) {
    let best = null;
    for (const looser of LOOSER) {
      const isLoose = ([name, value]) => (this.doc.now.options[name] ?? "") === (value ?? "");
      if (Object.entries(looser.part).every(isLoose)) continue;
      const changed = shownOptions({...this.doc.now, options: {...this.doc.now.options, ...looser.part}});
      const reach = await this.engine.reach(changed).catch(() => null);
      if (reach === null || turn !== this.turn) return; // the page shows another picture, perhaps of another document
      if (reach > this.reach * WORTH) {
        best = looser;
        break;
      }
    }
    const at = unbroken(withUnit(most));
    const text = best ? [`${best.limit} keeps the height at `, at, "."] : ["This view reaches ", at, " at most."];
    const act = best ? () => this.doc.change({options: best.part}) : this.chooseView;
    const button = make("button", {class: "quiet", onclick: act}, best?.action ?? "Choose view");
    $("#reach").replaceChildren(...text, " ", button);
  }
}
