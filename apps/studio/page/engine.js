// The engine as the page sees it, in the program `relievo studio`. Everything that knows HTTP is in this file. In the
// page that is one file alone, apps/web/page/engine.js takes its place.
//
// An Engine has
//   about()                     -> version, options, readable, endings, formats, views, materials, stages, curve,
//                                  samples, recent, first (what the program was started with), notice (about the place
//                                  where work is kept), most_upload (bytes), limits (texts: what this engine cannot do)
//   addressOf(file)             -> the address of one of the page's pictures
//   takesSeveral                   whether upload() takes several files together, of which one refers to the others
//   drawsMeanwhile                 whether pictures are drawn while a piece is made
//   slowMs                         of a frame: frames that take longer are drawn with fewer pixels
//   follow(onStatus, onLost, say)  calls back with each new status of each open document, in all tabs, and once with
//                                  {run} alone when an engine is found; onLost when it has gone; say with a text for
//                                  people
//   find(input)                 -> {document, input, is_there, kept}: the document of a scan, and its state
//                                  if it is kept
//   open(input, view)              makes that scan's document the one that all of the following concern
//   upload(files)               -> input for files of the browser; readProject(file) -> {input, is_there,
//                                  options, studio}
//   chooseView(view), cancel()     view is {view, up, crop, crumbs, plane, denoise, mode, points} as make has it
//   facts(), suggestViews()     -> facts about the model; {view, up} of each side, best first
//   frame(request, {signal}), scan(request)-> {image: ImageData, about}; a picture that is aborted is cancelled
//   profile(request)            -> heights in mm
//   reach(options)              -> the largest height in mm
//   check(options)                 throws unless the options can be read
//   piece(options)              -> {triangles, points, size_mm, height_mm} of the finished piece, which is
//                                  then at hand for exportFile(); cancelPiece()
//   exportFile(request)         -> Blob; packProject(project) -> Blob of a project file with its scan
//   recent()                    -> documents that were changed last: {document, input, is_there, picture}
//   kept(), remove(document)    -> {documents, bytes} of all that is kept until it is removed; where the browser keeps work,
//                                  the engine has neither
//   keep(document, state, isMoving), keepPicture(document, picture), leave()
// and throws EngineError with a text for people.

import {CANCELLED, EngineError, TAB} from "./engine_base.js";

export {EngineError, TAB};

async function complain(response) {
  let error = {kind: "request", text: `The engine answered ${response.status}.`};
  try {
    error = (await response.json()).error ?? error;
  } catch {
    // not JSON: the status must do
  }
  throw new EngineError(error.kind, error.text);
}

async function send(path, options) {
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    if (options?.signal?.aborted) throw new EngineError("cancelled", "Cancelled.");
    throw new EngineError("lost", "The engine does not answer. Start relievo studio again.");
  }
  if (!response.ok || response.status === CANCELLED) await complain(response);
  return response;
}

const post = (path, body, options = {}) =>
  send(`api/${path}`, {method: "POST", body: JSON.stringify(body), ...options});

async function picture(path, request, options) {
  const response = await post(path, request, options);
  const about = JSON.parse(response.headers.get("X-Relievo"));
  const pixels = new Uint8ClampedArray(await response.arrayBuffer());
  return {image: new ImageData(pixels, about.width, about.height), about};
}

const ASK = "status?"; // of a new tab to the one that has the stream

export class Engine {
  document = "";
  takesSeveral = false;
  drawsMeanwhile = true;
  slowMs = 55;

  addressOf(file) {
    return file;
  }

  post(path, body = {}, options = {}) {
    return post(path, {document: this.document, ...body}, options);
  }

  async about() {
    return {limits: [], ...(await (await send("api/about")).json())};
  }

  // A browser has six connections to a server for all its tabs, and a stream of events occupies one. So the tab that
  // has the lock opens the stream and passes on what it says; when that tab goes, another has the lock.
  follow(onStatus, onLost) {
    const tabs = new BroadcastChannel(location.pathname);
    const take = (status) => (status ? onStatus(status) : onLost());
    tabs.onmessage = ({data}) => data !== ASK && take(data);
    tabs.postMessage(ASK);
    navigator.locks.request(location.pathname, () => {
      const last = new Map(); // by document; by nothing the run
      const pass = (status) => {
        if (!status || !status.document) last.clear();
        if (status) last.set(status.document, status);
        tabs.postMessage(status);
        take(status);
      };
      tabs.onmessage = ({data}) => data === ASK && [...last.values()].forEach((status) => tabs.postMessage(status));
      this.listen(pass);
      return new Promise(() => {}); // for as long as this page lives
    });
  }

  // A stream that broke off connects again by itself, one that was refused does not.
  listen(pass) {
    const source = new EventSource("api/events");
    source.onmessage = (event) => pass(JSON.parse(event.data));
    source.onerror = () => {
      pass(null);
      if (source.readyState === EventSource.CLOSED) setTimeout(() => this.listen(pass), 1000);
    };
  }

  async find(input) {
    return (await post("document", {input})).json();
  }

  async open(input, view) {
    const {document} = await (await post("open", {input, tab: TAB, ...view})).json();
    this.document = document;
  }

  // Sends the bytes of a file of the browser.
  async upload([file]) {
    const answer = await send(`api/upload?name=${encodeURIComponent(file.name)}`, {method: "POST", body: file});
    return (await answer.json()).input;
  }

  async readProject(file) {
    return (await send(`api/project?name=${encodeURIComponent(file.name)}`, {method: "POST", body: file})).json();
  }

  async chooseView(view) {
    await this.post("view", view);
  }

  async cancel() {
    await this.post("cancel");
  }

  async facts() {
    return (await this.post("facts")).json();
  }

  async suggestViews() {
    return (await (await this.post("views")).json()).views;
  }

  frame(request, options) {
    return picture("frame", {document: this.document, ...request}, options);
  }

  scan(request) {
    return picture("scan", {document: this.document, ...request});
  }

  async profile(request) {
    return (await (await this.post("profile", request)).json()).heights_mm;
  }

  async reach(options) {
    return (await (await this.post("reach", {options})).json()).height_mm;
  }

  async check(options) {
    await this.post("check", {options});
  }

  async piece(options) {
    return (await this.postMaking("piece", {options})).json();
  }

  // Gives up the request for the piece or its file as well: what the engine answers then is of no use.
  async cancelPiece() {
    this.making?.abort();
    await this.post("cancel_piece");
  }

  async exportFile(request) {
    return (await this.postMaking("export", request)).blob();
  }

  postMaking(path, body) {
    this.making = new AbortController();
    return this.post(path, body, {signal: this.making.signal});
  }

  async packProject(project) {
    return (await post("save", {project})).blob();
  }

  async recent() {
    return (await (await post("recent", {})).json()).recent;
  }

  async kept() {
    return (await post("kept", {})).json();
  }

  async remove(document) {
    await post("remove", {document, tab: TAB});
  }

  async keep(document, state, isMoving) {
    await post("state", {document, state, tab: TAB, is_moving: isMoving});
  }

  async keepPicture(document, picture) {
    await post("picture", {document, picture});
  }

  // The page goes: this request outlives it.
  leave() {
    post("leave", {tab: TAB}, {keepalive: true}).catch(() => {});
  }
}
