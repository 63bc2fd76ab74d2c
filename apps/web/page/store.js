// Stores documents with their pictures, and the files of scans, in the browser (IndexedDB).
import {EngineError} from "../../studio/page/engine.js";
import {bytesOf, inputOf, scansOf} from "./inputs.js";

const MOST_RECENT = 24; // largest number of documents to store, each with its scan

const done = (request) => new Promise((resolve, reject) => {
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

const ended = (transaction) => new Promise((resolve, reject) => {
  transaction.oncomplete = () => resolve();
  transaction.onabort = () => reject(transaction.error);
});

const hasNoRoom = (error) => error?.name === "QuotaExceededError";

// Returns the reason for an error, in words for users.
function reason(error) {
  if (hasNoRoom(error)) return "the browser has no room left for this page";
  return `the browser does not allow it (${error?.name ?? error})`;
}

export class BrowserStore {
  notice = "";
  #base = null;
  #memory = {documents: new Map(), scans: new Map()}; // data that the browser could not store, until the page closes

  async open() {
    try {
      const request = indexedDB.open("relievo", 1);
      request.onupgradeneeded = () => {
        request.result.createObjectStore("documents", {keyPath: "id"});
        request.result.createObjectStore("scans", {keyPath: "digits"});
      };
      this.#base = await done(request);
      this.#base.onversionchange = () => this.#base.close();
      await this.#removeOld();
    } catch (error) {
      this.#base = null;
      this.notice = `Your work is not kept in this browser: ${reason(error)}. Save projects to keep it.`;
    }
  }

  async #get(name, key) {
    const inMemory = this.#memory[name].get(key);
    return inMemory ?? (this.#base && done(this.#base.transaction(name).objectStore(name).get(key)));
  }

  // Changes an entry. next() takes the current value and returns the new one. Throws an error that next() throws.
  async #change(name, key, next) {
    if (!this.#base) return void this.#memory[name].set(key, next(this.#memory[name].get(key)));
    const transaction = this.#base.transaction(name, "readwrite"), store = transaction.objectStore(name);
    const whole = ended(transaction);
    whole.catch(() => {}); // avoids an unhandled rejection if next() throws, because nobody then awaits `whole`
    const now = await done(store.get(key));
    let changed;
    try {
      changed = next(now);
    } catch (error) {
      transaction.abort();
      throw error;
    }
    store.put(changed);
    try {
      await whole;
      this.#memory[name].delete(key);
    } catch (error) {
      this.#memory[name].set(key, changed);
      throw Object.assign(new EngineError({kind: "output", text: `${reason(error)}.`}), {cause: error});
    }
  }

  // Returns {id, state, picture, touched} of a stored document, where `picture` is its thumbnail; otherwise nothing.
  document = (id) => this.#get("documents", id);

  // Stores the state of a document. Throws an error of kind "older" if a newer state is already stored, and of kind
  // "output" if the browser cannot store this state.
  keepDocument(id, state) {
    return this.#change("documents", id, (kept) => {
      if (kept?.state?.changed > state.changed) throw new EngineError({kind: "older", text: "a newer state is kept"});
      return {...kept, id, state, touched: Date.now()};
    });
  }

  keepThumbnail = (id, picture) => this.#change("documents", id, (kept) => ({...kept, id, picture}));

  touch = (id) => this.#change("documents", id, (kept) => ({...kept, id, touched: Date.now()}));

  // Stores the files of a scan: {digits, main, files: [[path, blob], ...]}. Private windows of WebKit cannot store
  // blobs; there the bytes are stored instead.
  async keepScan(scan) {
    const keep = (kept) => this.#change("scans", scan.digits, () => kept);
    try {
      await keep(scan);
    } catch (error) {
      if (hasNoRoom(error.cause)) throw error;
      await keep({...scan, files: await bytesOf(scan.files)});
    }
  }

  scan = (digits) => (digits ? this.#get("scans", digits) : undefined);

  // Returns the most recently used documents, the newest first.
  async recent() {
    const kept = this.#base ? await done(this.#base.transaction("documents").objectStore("documents").getAll()) : [];
    const all = new Map([...kept.map((each) => [each.id, each]), ...this.#memory.documents]);
    return [...all.values()].filter(({state}) => inputOf(state)).sort((a, b) => b.touched - a.touched).slice(0, MOST_RECENT);
  }

  async #removeOld() {
    const recent = await this.recent();
    const documents = new Set(recent.map(({id}) => id)), scans = new Set(recent.flatMap(({state}) => scansOf(state)));
    const transaction = this.#base.transaction(["documents", "scans"], "readwrite");
    for (const [name, wanted] of [["documents", documents], ["scans", scans]]) {
      const store = transaction.objectStore(name);
      for (const key of await done(store.getAllKeys())) if (!wanted.has(key)) store.delete(key);
    }
    await ended(transaction);
  }
}
