// Stores documents: sends each state to the engine, even during drags. A state that the engine has not confirmed also
// stays in the browser, where it survives the end of the engine and of the page. This file does not use other files of
// the page, so that tests can run it alone.

// PERIOD_MS is the shortest time between the sending of two states. PAUSE_MS is the shortest time from the answer to
// one state to the sending of the next. In between, the page and the engine have time for pictures.
const PERIOD_MS = 60, PAUSE_MS = 25;

export class Keeper {
  // Calls send(document, state, isMoving), which throws an error of kind "lost" if no engine answers, and of kind
  // "older" if a newer state is already stored. Calls onKept() after success, onOlder(document) after an error of kind
  // "older", and onFailed(error) after any other error except "lost". `storage` has the interface of localStorage.
  constructor({send, storage, prefix, onOlder, onFailed, onKept}) {
    Object.assign(this, {send, storage, prefix, onOlder, onFailed, onKept});
    this.waiting = new Map(); // the newest unsent state of each document
  }

  keep(document, state, isMoving) {
    this.waiting.set(document, {state, isMoving});
    this.pump();
  }

  // Sends the waiting states. Must be called when the engine is back.
  retry() {
    if (!this.isSending) this.pump();
  }

  // Drops all states of a document that was removed.
  forget(document) {
    this.waiting.delete(document);
    this.storage.removeItem(this.prefix + document);
  }

  // Stores the waiting states in the browser. The page calls this when it closes.
  flush() {
    for (const [document, {state}] of this.waiting) this.copy(document, JSON.stringify(state));
  }

  // Returns the state that was stored in the browser; null if there is none.
  copyOf(document) {
    try {
      return JSON.parse(this.storage.getItem(this.prefix + document));
    } catch {
      return null;
    }
  }

  async pump() {
    if (this.isSending || this.waiting.size === 0) return;
    this.isSending = true;
    const next = performance.now() + PERIOD_MS;
    const [document, {state, isMoving}] = this.waiting.entries().next().value, text = JSON.stringify(state);
    this.waiting.delete(document);
    this.copy(document, text);
    let mustWait = false;
    try {
      await this.send(document, state, isMoving);
      if (this.storage.getItem(this.prefix + document) === text) this.storage.removeItem(this.prefix + document);
      this.onKept();
    } catch (error) {
      mustWait = error.kind === "lost";
      if (mustWait && !this.waiting.has(document)) this.waiting.set(document, {state, isMoving});
      if (error.kind === "older") {
        this.storage.removeItem(this.prefix + document);
        this.onOlder(document);
      } else if (!mustWait) this.onFailed(error);
    }
    const pause = mustWait ? PAUSE_MS : Math.max(PAUSE_MS, next - performance.now());
    await new Promise((resolve) => setTimeout(resolve, pause));
    this.isSending = false;
    if (!mustWait) return this.pump();
    // The engine is lost. The next change, or retry(), sends the state again; until then it stays in the browser.
    this.flush();
  }

  copy(document, text) {
    try {
      this.storage.setItem(this.prefix + document, text);
    } catch {
      // the browser has no space, so only the page has the state
    }
  }
}
