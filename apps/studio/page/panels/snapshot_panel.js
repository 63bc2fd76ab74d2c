// Shows the panel that takes snapshots of the settings, lists them, and applies, compares, renames and removes them.

import {$, make, textField} from "../controls.js";
import {isUnfinished} from "../inputs.js";
import {isSameView, viewOf} from "../opening.js";
import {MOST_SNAPSHOTS, freeName, partOfSnapshot, snapshotOf} from "../snapshots.js";

export class SnapshotPanel {
  constructor({doc, modes}) {
    Object.assign(this, {doc, modes, shown: null, rows: []});
    $("#take-snapshot").onclick = () => this.take();
  }

  get list() {
    return this.doc.now.snapshots;
  }

  set = (snapshots) => this.doc.change({snapshots});

  take() {
    const {now} = this.doc;
    this.set([...this.list, snapshotOf(now, freeName(this.list))]);
    this.rows.at(-1).field.select();
  }

  remove(at) {
    this.set(this.list.filter((_, i) => i !== at));
    (this.rows[Math.min(at, this.rows.length - 1)]?.remove ?? $("#take-snapshot")).focus();
  }

  rename(at, name) {
    const isCompared = this.modes.rival === this.list[at];
    if (name) this.set(this.list.map((each, i) => (i === at ? {...each, name} : each)));
    else this.rows[at].field.value = this.list[at].name;
    if (isCompared) this.modes.setComparing(true, this.list[at]);
  }

  // Starts or ends the comparison of the snapshot with the present settings.
  compare(at) {
    const snapshot = this.list[at], isCompared = this.modes.rival === snapshot;
    this.modes.setComparing(!isCompared, isCompared ? null : snapshot);
  }

  stepOf = (snapshot) => ({...this.doc.now, ...partOfSnapshot(snapshot)});

  show() {
    $("#take-snapshot").disabled = this.list.length >= MOST_SNAPSHOTS;
    if (this.list !== this.shown && !isUnfinished(document.activeElement)) {
      this.shown = this.list;
      this.rows = this.list.map((snapshot, at) => this.row(snapshot, at));
      $("#snapshot-list").replaceChildren(...this.rows.map(({element}) => element));
    }
    this.mark();
  }

  row({name}, at) {
    const field = textField({value: name, "aria-label": `Name of ${name}`, maxlength: 80}, {
      take: (text) => this.rename(at, text), show: () => (field.value = name)});
    const button = (label, title, onclick) =>
      make("button", {type: "button", class: "quiet", "aria-label": `${label} ${name}`, title, onclick}, label);
    const apply = button("Apply", "Change everything to these settings", () =>
      this.doc.change(partOfSnapshot(this.list[at])));
    const compare = button("Compare", "", () => this.compare(at));
    const remove = make("button", {type: "button", class: "quiet", "aria-label": `Remove ${name}`,
      title: `Remove ${name}`, onclick: () => this.remove(at)}, "×");
    return {field, compare, remove, element: make("li", {}, field, remove, apply, compare)};
  }

  // Shows which snapshot is compared. Ends the comparison if that snapshot was removed. Also ends the comparison if the
  // snapshot has another view, since the engine can show only one view at a time.
  mark() {
    const view = viewOf(this.doc.now), {rival} = this.modes;
    const hasView = (snapshot) => isSameView(viewOf(this.stepOf(snapshot)), view);
    if (rival && !(this.list.includes(rival) && hasView(rival))) this.modes.setComparing(false);
    for (const [i, {compare}] of this.rows.entries()) {
      const snapshot = this.list[i], isOther = !snapshot || !hasView(snapshot);
      compare.setAttribute("aria-pressed", snapshot !== undefined && snapshot === this.modes.rival);
      compare.disabled = isOther;
      compare.title = isOther ? "It shows the scan from another side: apply it to see it"
        : "See it beside the present settings";
    }
  }
}
