// Collects the values that the user enters for the piece. The document takes them in the order in which they were
// entered, each as its own step. If the engine may be unable to make a piece with a value, the value is tried first.

import {$} from "./controls.js";
import {engineOptions, shownOptions} from "./document.js";

export class Entries {
  // Calls added() when the user makes an entry, changed() when the list of waiting entries has changed, and
  // refused(entry, error) when the engine refuses an entry. `isInserting` is true while the document takes an entry
  // that has waited.
  constructor({engine, doc, added, changed, refused}) {
    Object.assign(this, {engine, doc, added, changed, refused, waiting: [], last: Promise.resolve(), isInserting: false});
  }

  // Returns the entries that wait for the shown document.
  get pending() {
    return this.waiting.filter(({document}) => document === this.engine.document);
  }

  isPending = (name) => this.pending.some((entry) => entry.name === name);

  // Adds {name, label, part, isTried}: the option or control, its name for users, a function that returns the changes
  // to a step, and whether to try the entry. If isTried is false and no other entry waits, the document takes the entry
  // at once.
  add(entry) {
    Object.assign(entry, {document: this.engine.document, position: this.doc.position});
    this.added();
    if (!entry.isTried && this.pending.length === 0) return this.doc.change(entry.part(this.doc.now));
    this.waiting.push(entry);
    this.changed();
    this.last = this.last.then(() => this.take(entry)).finally(() => this.end(entry)).catch(console.error);
    return this.last;
  }

  // Changes the document by an entry, unless the entry was withdrawn, or the engine refuses it.
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

  // Throws the engine's error if the options are invalid or no piece can be made with them. For this test, requests
  // one height of the piece. Ignores two errors: that of a width that does not fit, which is corrected later, and that
  // of a view that is not prepared yet.
  async tryOut(step, {isMade}) {
    await this.engine.check(engineOptions(step));
    if (!isMade) return;
    await this.engine.profile({options: shownOptions(step), from: [0, 0], to: [0, 0]}).catch((error) => {
      if (error.kind === "option" && error.input !== "width") throw error;
    });
  }

  // Inserts the change at the position that the document had when the user made the entry. Later changes and all other
  // entries follow it.
  insert(part, entry) {
    const before = this.doc.position;
    this.isInserting = true;
    this.doc.changeAt(entry.position, part);
    this.isInserting = false;
    for (const other of this.pending) other.position += this.doc.position - before;
  }

  // Removes an entry that was used, refused or withdrawn.
  end(entry) {
    this.waiting = this.waiting.filter((other) => other !== entry);
    this.changed();
  }

  // Withdraws the newest entry if it waits and the document has not changed since. Returns whether it was withdrawn.
  withdraw() {
    const entry = this.pending.at(-1), isNewest = entry?.position === this.doc.position;
    if (isNewest) this.end(entry);
    return isNewest;
  }

  // Undoes the newest change. If that is an entry that still waits, withdraws it.
  undo() {
    if (!this.withdraw()) this.doc.undo();
  }

  // Redoes a step, unless an entry waits.
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

  // Waits until no entry waits any more.
  async settled() {
    while (this.pending.length > 0) await this.last;
  }
}
