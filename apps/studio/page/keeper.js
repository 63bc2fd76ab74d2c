// Keeps documents: sends each state to the engine, also during drags. A state that no engine has confirmed also stays
// in the browser, so that it outlives the engine and the page. This file does not depend on the page, so that tests can
// run it alone.

// The least time from one state to the next, and from the answer to a state to the next state: the page and the engine
// also need time for pictures.
const PERIOD_MS = 60, PAUSE_MS = 25;

export class Keeper {
  // Calls send(document, state, isMoving), which throws an error of kind "lost" if no engine answers and "older" if a
  // newer state is kept already. Then calls onKept(), onOlder(document) or, after other errors than "lost",
  // onFailed(error). `storage` has the interface of localStorage.
  constructor({send, storage, prefix, onOlder, onFailed, onKept}) {
    Object.assign(this, {send, storage, prefix, onOlder, onFailed, onKept});
    this.waiting = new Map(); // by document, the newest state that is not yet sent
  }

  keep(document, state, isMoving) {
    this.waiting.set(document, {state, isMoving});
    this.pump();
  }

  // Call this when the engine is back: sends the waiting states.
  retry() {
    if (!this.isSending) this.pump();
  }

  // Drops the waiting and the stored state of a document that was removed.
  forget(document) {
    this.waiting.delete(document);
    this.storage.removeItem(this.prefix + document);
  }

  // Stores the waiting states in the browser. The page calls this when it is closed.
  flush() {
    for (const [document, {state}] of this.waiting) this.copy(document, JSON.stringify(state));
  }

  // Returns the state that stayed in the browser; null if there is none.
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
    // The next change, or retry() when the engine is back, sends the state again. Until then it stays in the browser.
    this.flush();
  }

  copy(document, text) {
    try {
      this.storage.setItem(this.prefix + document, text);
    } catch {
      // no room: only the page has the state
    }
  }
}
