// The engine as the page sees it. Everything that knows HTTP is in this file, so that an engine in WebAssembly
// can take its place.
//
// An Engine has
//   about()                     -> version, options, readable, endings, formats, views, materials, stages, curve,
//                                  samples, recent, status, state (as keepState() stored it), notice (about the place
//                                  where work is kept), most_upload (bytes)
//   follow(onStatus, onLost)       calls back with each new status, in all tabs; onLost when the engine has gone
//   open(input, view)              starts to read and prepare; upload(file) -> input for a file of the browser
//   chooseView(view), cancel()     view is {view, up, crop, crumbs, denoise}, as the command line has them
//   facts(), suggestViews()     -> facts about the model; names of sides, the best first
//   frame(request), scan(request)-> {image: ImageData, about}
//   profile(request)            -> heights in mm
//   exportFile(request)         -> Blob
//   readProject(name, text)     -> {input, options}
//   keepState(state)
// and throws EngineError with a text for people.

export class EngineError extends Error {
  constructor(kind, text) {
    super(text);
    this.kind = kind;
  }
}

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
    throw new EngineError("lost", "The engine does not answer. Start relievo studio again.");
  }
  if (!response.ok) await complain(response);
  return response;
}

const post = (path, body, options = {}) =>
  send(`api/${path}`, {method: "POST", body: JSON.stringify(body), ...options});

async function picture(path, request) {
  const response = await post(path, request);
  const about = JSON.parse(response.headers.get("X-Relievo"));
  const pixels = new Uint8ClampedArray(await response.arrayBuffer());
  return {image: new ImageData(pixels, about.width, about.height), about};
}

const ASK = "status?"; // of a new tab to the one that has the stream

export class NativeEngine {
  async about() {
    return (await send("api/about")).json();
  }

  // A browser has six connections to a server for all its tabs, and a stream of events occupies one. So the tab that
  // has the lock opens the stream and passes on what it says; when that tab goes, another has the lock.
  follow(onStatus, onLost) {
    const tabs = new BroadcastChannel(location.pathname);
    const take = (status) => (status ? onStatus(status) : onLost());
    const pass = (status) => {
      tabs.postMessage(status);
      take(status);
    };
    tabs.onmessage = ({data}) => data !== ASK && take(data);
    tabs.postMessage(ASK);
    navigator.locks.request(location.pathname, () => {
      let last = null;
      const source = new EventSource("api/events");
      source.onmessage = (event) => pass(last = JSON.parse(event.data));
      source.onerror = () => pass(null);
      tabs.onmessage = ({data}) => data === ASK && last && tabs.postMessage(last);
      return new Promise(() => {}); // for as long as this page lives
    });
  }

  async upload(file) {
    const answer = await send(`api/upload?name=${encodeURIComponent(file.name)}`, {method: "POST", body: file});
    return (await answer.json()).input;
  }

  async open(input, view) {
    await post("open", {input, ...view});
  }

  async chooseView(view) {
    await post("view", view);
  }

  async cancel() {
    await post("cancel", {});
  }

  async facts() {
    return (await send("api/facts")).json();
  }

  async suggestViews() {
    return (await (await send("api/views")).json()).views;
  }

  frame(request) {
    return picture("frame", request);
  }

  scan(request) {
    return picture("scan", request);
  }

  async profile(request) {
    return (await (await post("profile", request)).json()).heights_mm;
  }

  async exportFile(request) {
    return (await post("export", request)).blob();
  }

  async readProject(name, text) {
    return (await post("project", {name, text})).json();
  }

  // `isLast` when the page goes: then the request outlives it.
  async keepState(state, isLast = false) {
    await post("state", state, {keepalive: isLast});
  }
}
