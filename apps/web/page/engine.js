// The engine of the page that is one file: WebAssembly in a worker, and work that the browser keeps. The interface is that
// of apps/studio/page/engine.js, whose place this file takes.
import {compile} from "../../../npm/src/compile.js";
import {CANCELLED, EngineError, TAB} from "../../studio/page/engine_base.js";
import {BASE_IMAGE, bytesOf, documentOf, inputOf, mainOf, scanOf} from "./inputs.js";
import {BrowserStore} from "./store.js";

export {EngineError, TAB};

const MOST_UPLOAD = 2 ** 31; // bytes: half of the memory that WebAssembly has
const RUN = TAB; // the engine lives as long as its page
const content = (id) => document.getElementById(id).textContent;
const closed = () => new EngineError("closed", "expected a document that is open");
const cancelled = () => new EngineError("cancelled", "Cancelled.");

const LIMITS = [
  "This page has the engine inside: it needs no program and no network, and nothing leaves this machine.",
  "It computes with one processor, and takes several times as long as the program relievo with all of them.",
  "It has at most 4 GiB of memory, which is enough for about 10 million points; the program has what the machine has.",
  "Depth images in TIFF are read plain or packed by LZW, Deflate or PackBits, not by JPEG, WebP, Zstandard, LERC or LZMA.",
  "Scans and work stay in this browser, for the 24 documents used last; save a project to keep or to move one.",
];

export class Engine {
  document = "";
  takesSeveral = true;
  slowMs = 31; // so that 30 are drawn in a second
  #store = new BrowserStore();
  #module = null;
  #pictures = null; // of the page, by name
  #worker = null;
  #waiting = new Map(); // by number of the message
  #last = 0;
  #isOpen = new Set(); // documents, in this worker
  #statuses = new Map(); // by document, as told last
  #kept = new Map(); // by document, when it was kept last, and by which tab
  #onStatus = () => {};
  #say = () => {};
  #tabs = null;

  // ------------------------------------------------------------------------------------------------- the worker

  async #start() {
    this.#module ??= compile(content("engine"));
    const module = await this.#module;
    if (this.#worker) return;
    const address = URL.createObjectURL(new Blob([content("worker")], {type: "text/javascript"}));
    const worker = this.#worker = new Worker(address);
    worker.onmessage = ({data}) => worker === this.#worker && this.#take(data);
    worker.onerror = (event) => {
      event.preventDefault();
      this.#end(new EngineError("failure", `The engine cannot run here: ${event.message ?? "workers are forbidden"}.`));
    };
    worker.postMessage({module});
  }

  // Ends the worker: what waits for it gets the error, and what is asked for next starts another one.
  #end(error, others = error) {
    this.#worker?.terminate();
    this.#worker = null;
    this.#isOpen.clear();
    const waiting = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const {call, reject} of waiting) reject(["piece", "export"].includes(call) ? error : others);
  }

  // WebKit lets the worker of a page that was opened from disk read no files: the page reads them as a whole then.
  async #call(call, request, files = []) {
    try {
      return await this.#send(call, request, files);
    } catch (error) {
      if (error.kind !== "unreadable") throw error;
      return this.#send(call, request, await bytesOf(files));
    }
  }

  async #send(call, request = {}, files = []) {
    await this.#start();
    const id = ++this.#last;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, {call, resolve, reject});
      this.#worker.postMessage({id, call, request, files});
    });
  }

  // A call about the document that is shown.
  async #ask(call, request = {}) {
    const {document} = this;
    if (!this.#isOpen.has(document)) throw closed();
    return (await this.#call(call, {document, ...request}, await this.#imageOf(request.options))).body;
  }

  // Returns the files that options name: the height map of a base.
  async #imageOf(options) {
    const path = options?.[BASE_IMAGE];
    return path ? (await this.#store.scan(scanOf({path})))?.files ?? [] : [];
  }

  #take({id, statuses, error, isOver, status, about, type, body}) {
    if (statuses) return statuses.forEach((each) => this.#tell(each));
    const waiting = this.#waiting.get(id);
    this.#waiting.delete(id);
    if (isOver) this.#failed(new EngineError(error.kind, error.text));
    if (error ?? (status >= 400 || status === CANCELLED)) {
      const {kind, text} = error ?? body.error;
      return waiting?.reject(new EngineError(kind, text));
    }
    waiting?.resolve({about, type, body});
  }

  // The memory was not enough, or the engine has a fault: the document cannot be shown, and the page says why.
  #failed(error) {
    this.#end(error, closed());
    this.#tell({...this.#status(), busy: false, model: 0, error: {kind: error.kind, text: error.message}});
  }

  #status() {
    return this.#statuses.get(this.document) ?? {document: this.document, model: 0, input: null, shown: {}, making: {}};
  }

  get #isBusy() {
    return Boolean(this.#worker && this.#status().busy);
  }

  #tell(status) {
    if (!status.document) return;
    this.#statuses.set(status.document, status);
    const kept = this.#kept.get(status.document) ?? {changed: 0, tab: ""};
    this.#onStatus({...status, run: RUN, kept});
  }

  // ------------------------------------------------------------------------------------------------ the interface

  addressOf(file) {
    this.#pictures ??= JSON.parse(content("pictures"));
    return this.#pictures[file];
  }

  async about() {
    await this.#store.open();
    const {body} = await this.#call("about");
    return {...body, recent: await this.recent(), notice: this.#store.notice, limits: LIMITS, most_upload: MOST_UPLOAD};
  }

  follow(onStatus, _onLost, say) {
    this.#onStatus = onStatus;
    this.#say = say;
    try {
      this.#tabs = new BroadcastChannel("relievo");
      this.#tabs.onmessage = ({data: {document, kept}}) => {
        this.#kept.set(document, kept);
        if (this.#statuses.has(document)) this.#tell(this.#statuses.get(document));
      };
    } catch {
      // other tabs see newer work when they are reloaded
    }
    onStatus({run: RUN});
  }

  async find(input) {
    const scan = input.sample ? null : await this.#store.scan(scanOf(input));
    const found = scan ? {path: scan.main, name: input.name, hash: input.hash || `fnv1a64:${scan.digits}`} : input;
    const document = documentOf(found), kept = (await this.#store.document(document))?.state ?? null;
    if (kept) this.#kept.set(document, {changed: kept.changed, tab: ""});
    return {document, input: found, is_there: Boolean(input.sample || scan), kept};
  }

  // The preparation of another document is of no use any more.
  async open(input, view) {
    const document = documentOf(input);
    if (this.#isBusy && !this.#isOpen.has(document)) this.#end(cancelled(), closed());
    this.document = document;
    this.#statuses.delete(document);
    const {files = []} = (await this.#store.scan(scanOf(input))) ?? {};
    this.input = input;
    await this.#call("open", {input, tab: TAB, ...view}, files);
    this.#isOpen.add(document);
    await this.#store.touch(document).catch(() => {}); // the page says what is not kept
  }

  async upload(files) {
    const main = mainOf(files), all = files.includes(main) ? files : [main, ...files];
    if (this.#isBusy) this.#end(cancelled(), closed());
    const {hash} = (await this.#call("hash", {path: "scan"}, [["scan", main]])).body;
    return this.#keepScan(hash, main.name, all.map((file) => [file.name, file]));
  }

  async #keepScan(hash, name, files) {
    const digits = scanOf({hash}), folder = `scans/${digits}`;
    const scan = {digits, main: `${folder}/${name}`, files: files.map(([file, blob]) => [`${folder}/${file}`, blob])};
    try {
      await this.#store.keepScan(scan);
    } catch (error) {
      this.#say(`${name} can be used now, but is not kept: ${error.message}`, true);
    }
    return {path: scan.main, name, hash};
  }

  async readProject(file) {
    if (this.#isBusy) this.#end(cancelled(), closed());
    const {body: project} = await this.#call("project", {path: "project", name: file.name}, [["project", file]]);
    const {input, options} = project;
    await this.#keepUnpacked(input.path);
    await this.#keepUnpacked(options[BASE_IMAGE]);
    return {...project, ...(await this.find(input))};
  }

  // Keeps a file that was part of the project that was read last.
  async #keepUnpacked(path) {
    if (!path) return;
    const {body: bytes} = await this.#call("unpacked", {path}), name = path.slice(path.lastIndexOf("/") + 1);
    if (bytes.buffer) await this.#keepScan(`fnv1a64:${scanOf({path})}`, name, [[name, new Blob([bytes])]]);
  }

  async chooseView(view) {
    if (!this.#isOpen.has(this.document)) return this.open(this.input, view);
    await this.#ask("view", view);
  }

  // Nothing reaches a worker that computes, so it is ended.
  async cancel() {
    this.#end(cancelled(), closed());
    this.#tell({...this.#status(), busy: false, error: {kind: "cancelled", text: "Cancelled."}});
  }

  facts() {
    return this.#ask("facts");
  }

  async suggestViews() {
    return (await this.#ask("views")).views;
  }

  async #picture(call, request) {
    const {document} = this;
    if (!this.#isOpen.has(document)) throw closed();
    const {about, body} = await this.#call(call, {document, ...request}, await this.#imageOf(request.options));
    const pixels = new Uint8ClampedArray(body.buffer, body.byteOffset, body.length);
    return {image: new ImageData(pixels, about.width, about.height), about};
  }

  frame(request) {
    return this.#picture("frame", request);
  }

  scan(request) {
    return this.#picture("scan", request);
  }

  async profile(request) {
    return (await this.#ask("profile", request)).heights_mm;
  }

  async reach(options) {
    return (await this.#ask("reach", {options})).height_mm;
  }

  check(options) {
    return this.#ask("check", {options});
  }

  piece(options) {
    return this.#ask("piece", {options});
  }

  async cancelPiece() {
    if ([...this.#waiting.values()].some(({call}) => call === "piece" || call === "export")) this.#end(cancelled(), closed());
  }

  async exportFile(request) {
    const {document} = this;
    if (!this.#isOpen.has(document)) throw closed();
    const {type, body} = await this.#call("export", {document, ...request}, await this.#imageOf(request.options));
    return new Blob([body], {type});
  }

  async packProject(project) {
    const {files = []} = (await this.#store.scan(scanOf(project.input))) ?? {};
    const all = [...files, ...(await this.#imageOf(project.options))];
    return new Blob([(await this.#call("save", {project}, all)).body], {type: "application/zip"});
  }

  async recent() {
    const documents = await this.#store.recent();
    return Promise.all(documents.map(async ({id, state, picture = ""}) => {
      const input = inputOf(state);
      return {document: id, input, is_there: Boolean(input.sample || (await this.#store.scan(scanOf(input)))), picture};
    }));
  }

  async keep(document, state) {
    await this.#store.keepDocument(document, state);
    const kept = {changed: state.changed, tab: TAB};
    this.#kept.set(document, kept);
    this.#tabs?.postMessage({document, kept});
  }

  keepPicture(document, picture) {
    return this.#store.keepPicture(document, picture);
  }

  leave() {}
}
