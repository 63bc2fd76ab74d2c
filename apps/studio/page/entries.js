// Collects the entries that the user types or chooses for the piece. The document takes them in the order in which they
// were made, each as a step of its own. If the engine may be unable to make a piece with an entry, the entry is tried
// first.

import {$} from "./controls.js";
import {engineOptions, shownOptions} from "./document.js";

export class Entries {
  // Calls changed() when an entry was added or removed, and refused(entry, error) when the engine refuses one.
  constructor({engine, doc, changed, refused}) {
    Object.assign(this, {engine, doc, changed, refused, waiting: [], last: Promise.resolve()});
  }

  // Returns the entries that this document has not taken yet.
  get pending() {
    return this.waiting.filter(({document}) => document === this.engine.document);
  }

  isPending = (name) => this.pending.some((entry) => entry.name === name);

  // Takes {name, label, part, isTried}: the option or control, its name for users, a function that returns the changes
  // to a step, and whether to try the entry. An entry that is not tried is taken at once if none is waiting.
  add(entry) {
    Object.assign(entry, {document: this.engine.document, position: this.doc.position});
    if (!entry.isTried && this.pending.length === 0) return this.doc.change(entry.part(this.doc.now));
    this.waiting.push(entry);
    this.changed();
    this.last = this.last.then(() => this.take(entry)).finally(() => this.end(entry)).catch(console.error);
    return this.last;
  }

  // Takes an entry, unless it was withdrawn, or the engine cannot read it or make a piece with it.
  async take(entry) {
    const isMeant = () => this.pending.includes(entry);
    if (!isMeant()) return;
    try {
      const step = this.doc.stepAt(entry.position), part = entry.part(step);
      if (entry.isTried) await this.tryOut({...step, options: {...step.options, ...part.options}}, entry);
      if (isMeant()) this.insert(part, entry);
    } catch (error) {
      if (isMeant()) this.refused(entry, error);
    }
  }

  // Throws the engine's error if it cannot read the options or make a piece with them. To find out, requests one height
  // of the piece. Two errors do not count: a width that does not fit, as it is corrected later, and a view that is not
  // prepared yet.
  async tryOut(step, {isMade}) {
    await this.engine.check(engineOptions(step));
    if (!isMade) return;
    await this.engine.profile({options: shownOptions(step), from: [0, 0], to: [0, 0]}).catch((error) => {
      if (error.kind === "option" && error.input !== "width") throw error;
    });
  }

  // Inserts the change at the position of its entry: changes made since the entry, and all other entries, follow it.
  insert(part, entry) {
    const before = this.doc.position;
    this.doc.changeAt(entry.position, part);
    for (const other of this.pending) other.position += this.doc.position - before;
  }

  // Removes an entry that was taken, refused or withdrawn.
  end(entry) {
    this.waiting = this.waiting.filter((other) => other !== entry);
    this.changed();
  }

  // Withdraws the newest entry if it is still waiting and nothing was changed since. Returns whether there was one.
  withdraw() {
    const entry = this.pending.at(-1), isNewest = entry?.position === this.doc.position;
    if (isNewest) this.end(entry);
    return isNewest;
  }

  // Takes back the newest change, which may be an entry that is still waiting.
  undo() {
    if (!this.withdraw()) this.doc.undo();
  }

  // Redoes a step, unless an entry is waiting.
  redo() {
    if (this.pending.length === 0) this.doc.redo();
  }

  // Shows the waiting entries, and whether anything can be undone.
  show() {
    const names = [...new Set(this.pending.map(({label}) => label))], isWaiting = names.length > 0;
    $("#trying").textContent = isWaiting ? `Trying ${names.join(", ")} …` : "";
    $("#undo").disabled = !this.doc.can(-1) && !isWaiting;
    $("#redo").disabled = !this.doc.can(1) || isWaiting;
  }

  // Waits until all entries are taken or refused.
  async settled() {
    while (this.pending.length > 0) await this.last;
  }
}
