// Sends requests to the WebAssembly engine, which runs in workers, and to the browser's store of documents. Replaces
// apps/studio/page/transport.js; apps/studio/page/engine.js describes transports.
import {compile} from "../../../npm/src/compile.js";
import {EngineError, TAB, cancelled} from "../../studio/page/engine.js";
import {EngineWorkers} from "./engine_workers.js";
import {bytesOf, documentOf, inputOf, mainOf, optionsIn, pathsIn, scanOf} from "./inputs.js";
import {BrowserStore} from "./store.js";

const MOST_UPLOAD = 2 ** 31; // in bytes: half of the largest memory of WebAssembly
const RUN = TAB; // a run of the engine lasts as long as its page
const content = (id) => document.getElementById(id).textContent;
const closed = () => new EngineError({kind: "closed", text: "expected a document that is open"});

const LIMITS = [
  "This page has the engine inside: it needs no program and no network, and nothing leaves this machine.",
  "It computes with one processor, and takes several times as long as the program relievo with all of them.",
  "It has at most 4 GiB of memory. Of binary PLY, PCD and LAS with more than 3 million points it takes those that the view shows, piece by piece, within a minute or two.",
  "Depth images in TIFF are read plain or packed by LZW, Deflate or PackBits, not by JPEG, WebP, Zstandard, LERC or LZMA.",
  "Scans and work stay in this browser, for the 24 documents used last; save a project to keep or to move one.",
  "The licences of the software inside stand at the end of this file.",
];

export class Transport {
  // If a picture takes longer than slowMs, the page misses its aim of 30 pictures per second.
  traits = {takesSeveral: true, drawsMeanwhile: false, canRemove: false, slowMs: 31};
  #store = new BrowserStore();
  #module = null;
  #pictures = null; // addresses of the page's pictures by name
  #workers = null;
  #opened = {document: "", input: null}; // the document that was opened last
  #isOpen = new Set(); // documents that the workers have open
  #statuses = new Map(); // the last reported status of each document
  #kept = new Map(); // for each document, the time when it was stored last, and the tab that stored it
  #onStatus = () => {};
  #say = () => {};
  #tabs = null;
  // Answers to requests that need no engine. The program `relievo studio` answers them with its files and threads.
  #own = {
    about: () => this.#about(), document: ({input}) => this.#find(input), open: (request) => this.#open(request),
    upload: (_, files) => this.#upload(files), project: ({name}, [file]) => this.#readProject(name, file),
    view: (request) => this.#chooseView(request), cancel: () => this.#cancel(), cancel_piece: () => this.#cancelPiece(),
    save: ({project}) => this.#packProject(project), recent: async () => ({recent: await this.#recent()}),
    state: ({document, state}) => this.#keep(document, state), leave: () => {},
    thumbnail: ({document, thumbnail}) => this.#store.keepThumbnail(document, thumbnail),
  };

  async call(name, request = {}, {files = [], onSolved} = {}) {
    const own = this.#own[name];
    return own ? {body: await own(request, files)} : this.#ask(name, request, onSolved);
  }

  // ------------------------------------------------------------------------------------------------ the workers

  // Starts the workers, unless they are already running.
  async #start() {
    const module = await (this.#module ??= compile(content("engine")));
    if (this.#workers) return;
    const address = URL.createObjectURL(new Blob([content("worker")], {type: "text/javascript"}));
    this.#workers = new EngineWorkers(address, module, {
      statuses: (statuses) => statuses.forEach((each) => this.#tell(each)), over: (error) => this.#failed(error)});
  }

  // Ends the workers. Rejects unanswered requests: those for pieces and files with `error`, all others with `others`.
  // The next request starts new workers.
  #end(error, others = error) {
    this.#isOpen.clear();
    this.#workers?.end(error, others);
    this.#workers = null;
  }

  // Ends the workers if they are still preparing the document that was opened last.
  #endPreparation() {
    if (this.#workers && this.#status().busy) this.#end(cancelled(), closed());
  }

  // In WebKit the worker of a page that was opened from disk cannot read files. Then the page reads each file as a
  // whole.
  async #work(call, request, files = [], onSolved) {
    try {
      return await this.#send(call, request, files, onSolved);
    } catch (error) {
      if (error.kind !== "unreadable") throw error;
      return this.#send(call, request, await bytesOf(files), onSolved);
    }
  }

  async #send(...call) {
    await this.#start();
    return this.#workers.send(...call);
  }

  // Sends a call for a document. Throws if the workers do not have that document open.
  async #ask(call, request, onSolved) {
    if (!this.#isOpen.has(request.document)) throw closed();
    return this.#work(call, request, await this.#filesIn(request.options), onSolved);
  }

  async #filesIn(options) {
    return (await Promise.all(pathsIn(options).map((path) => this.#filesOf({path})))).flat();
  }

  async #filesOf(input) {
    return (await this.#store.scan(scanOf(input)))?.files ?? [];
  }

  // Ends the workers after the engine ran out of memory or failed, and reports the error as the document's status.
  #failed(error) {
    this.#end(new EngineError(error), closed());
    this.#tell({...this.#status(), busy: false, model: 0, error});
  }

  // Cancels work by ending the workers, because they handle no messages while they compute.
  #cancel() {
    this.#end(cancelled(), closed());
    this.#tell({...this.#status(), busy: false, error: {kind: "cancelled", text: "Cancelled."}});
  }

  #cancelPiece() {
    if (this.#workers?.isMaking) this.#end(cancelled(), closed());
  }

  #status() {
    const {document} = this.#opened;
    return this.#statuses.get(document) ?? {document, model: 0, input: null, requested: {}, making: {}};
  }

  #tell(status) {
    if (!status.document) return;
    this.#statuses.set(status.document, status);
    const kept = this.#kept.get(status.document) ?? {changed: 0, tab: ""};
    this.#onStatus({...status, run: RUN, kept});
  }

  // ---------------------------------------------------------------------------------------------------- the page

  addressOf(file) {
    this.#pictures ??= JSON.parse(content("pictures"));
    return this.#pictures[file];
  }

  async #about() {
    await this.#store.open();
    const {body} = await this.#work("about");
    return {...body, recent: await this.#recent(), notice: this.#store.notice, limits: LIMITS, most_upload: MOST_UPLOAD};
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
      // other tabs see the newer state when they are reloaded
    }
    onStatus({run: RUN});
  }

  // ----------------------------------------------------------------------------------------- scans and documents

  async #find(input) {
    const scan = input.sample ? null : await this.#store.scan(scanOf(input));
    const found = scan ? {path: scan.main, name: input.name, hash: input.hash || `fnv1a64:${scan.digits}`} : input;
    const document = documentOf(found), kept = (await this.#store.document(document))?.state ?? null;
    if (kept) this.#kept.set(document, {changed: kept.changed, tab: ""});
    return {document, input: found, is_there: Boolean(input.sample || scan), kept};
  }

  // Opens a document, and ends the preparation of any other.
  async #open({document: _, input, ...view}) {
    const document = documentOf(input);
    if (!this.#isOpen.has(document)) this.#endPreparation();
    this.#opened = {document, input};
    this.#statuses.delete(document);
    await this.#work("open", {input, ...view}, await this.#filesOf(input));
    this.#isOpen.add(document);
    await this.#store.touch(document).catch(() => {}); // later failures to store the document are reported
    return {document};
  }

  #chooseView(request) {
    if (!this.#isOpen.has(request.document)) return this.#open({input: this.#opened.input, tab: TAB, ...request});
    return this.#ask("view", request);
  }

  async #upload(files) {
    const main = mainOf(files), all = files.includes(main) ? files : [main, ...files];
    this.#endPreparation();
    const hash = await this.#hashOf(main);
    // Scenes whose files have the same names have the same main file. So the hash of all files names the folder.
    const folder = all.length > 1 ? await this.#hashOf(new Blob(all)) : hash;
    return {input: await this.#keepScan(hash, main.name, all.map((file) => [file.name, file]), folder)};
  }

  #hashOf = async (file) => (await this.#work("hash", {path: "scan"}, [["scan", file]])).body.hash;

  // Stores a scan whose main file has the hash `hash`. The folder of the scan is named after `folderHash`.
  async #keepScan(hash, name, files, folderHash = hash) {
    const digits = scanOf({hash: folderHash}), folder = `scans/${digits}`;
    const scan = {digits, main: `${folder}/${name}`, files: files.map(([file, blob]) => [`${folder}/${file}`, blob])};
    try {
      await this.#store.keepScan(scan);
    } catch (error) {
      this.#say(`${name} can be used now, but is not kept: ${error.message}`, true);
    }
    return {path: scan.main, name, hash};
  }

  async #readProject(name, file) {
    this.#endPreparation();
    const {body: project} = await this.#work("project", {path: "project", name}, [["project", file]]);
    const {input} = project;
    for (const path of [input.path, ...optionsIn(project).flatMap(pathsIn)]) await this.#keepUnpacked(path);
    return {...project, ...(await this.#find(input))};
  }

  // Stores a file that was packed in the project that was read last.
  async #keepUnpacked(path) {
    if (!path) return;
    const {body: file} = await this.#work("unpacked", {path}), name = path.slice(path.lastIndexOf("/") + 1);
    if (file instanceof Blob) await this.#keepScan(`fnv1a64:${scanOf({path})}`, name, [[name, file]]);
  }

  async #packProject(project) {
    const named = await Promise.all(optionsIn(project).map((options) => this.#filesIn(options)));
    return (await this.#work("save", {project}, [...(await this.#filesOf(project.input)), ...named.flat()])).body;
  }

  async #recent() {
    const documents = await this.#store.recent();
    return Promise.all(documents.map(async ({id, state, picture: thumbnail = ""}) => {
      const input = inputOf(state), isThere = Boolean(input.sample || (await this.#store.scan(scanOf(input))));
      return {document: id, input, is_there: isThere, thumbnail};
    }));
  }

  async #keep(document, state) {
    await this.#store.keepDocument(document, state);
    const kept = {changed: state.changed, tab: TAB};
    this.#kept.set(document, kept);
    this.#tabs?.postMessage({document, kept});
  }
}
