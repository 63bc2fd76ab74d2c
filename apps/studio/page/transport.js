// Sends requests to the program `relievo studio`. No other file of the page uses HTTP.

import {CANCELLED, EngineError, cancelled} from "./engine.js";

const ASK = "status?"; // message of a new tab to the tab that has the stream of events

async function errorIn(response) {
  try {
    const {error} = await response.json();
    if (error) return new EngineError(error);
  } catch {
    // the body is not JSON, so the message only states the status
  }
  return new EngineError({kind: "request", text: `The engine answered ${response.status}.`});
}

async function send(path, options) {
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    if (options.signal?.aborted) throw cancelled();
    throw new EngineError({kind: "lost", text: "The engine does not answer. Start relievo studio again."});
  }
  if (!response.ok || response.status === CANCELLED) throw await errorIn(response);
  return response;
}

// Throws the reason why an upload failed: a folder, or a file that has changed or may not be read, cannot be sent.
async function explain(error, file) {
  const isReadable = error.kind !== "lost" || await file.slice(0, 1).arrayBuffer().then(() => true, () => false);
  throw isReadable ? error
    : new EngineError({kind: "input", input: file.name, text: `${file.name}: expected a file that can be read`});
}

export class Transport {
  traits = {takesSeveral: false, drawsMeanwhile: true, canRemove: true, slowMs: 55};

  // The body of an upload is the file itself; its name is in the address. The request "leave" is sent even if the page
  // closes.
  async call(name, request, {files: [file] = [], signal} = {}) {
    const path = file ? `api/${name}?name=${encodeURIComponent(file.name)}` : `api/${name}`;
    const body = file ?? JSON.stringify(request), keepalive = name === "leave";
    const sent = send(path, request ? {method: "POST", body, signal, keepalive} : {});
    const response = await (file ? sent.catch((error) => explain(error, file)) : sent);
    if (response.headers.get("Content-Type") === "application/json") return {body: await response.json()};
    const facts = response.headers.get("X-Relievo");
    if (!facts) return {body: await response.blob()};
    return {facts: JSON.parse(facts), body: new Uint8Array(await response.arrayBuffer())};
  }

  addressOf = (file) => file;

  // A browser opens at most six connections to a server for all its tabs together, and a stream of events uses one of
  // them. So only the tab that has the lock opens the stream, and passes the events on to the other tabs. When that tab
  // is closed, another one gets the lock.
  follow(onStatus, onLost) {
    const tabs = new BroadcastChannel(location.pathname);
    const take = (status) => (status ? onStatus(status) : onLost());
    tabs.onmessage = ({data}) => data !== ASK && take(data);
    tabs.postMessage(ASK);
    navigator.locks.request(location.pathname, () => {
      const last = new Map(); // the last status of each document; the key `undefined` has the name of the run
      const pass = (status) => {
        if (!status || !status.document) last.clear();
        if (status) last.set(status.document, status);
        tabs.postMessage(status);
        take(status);
      };
      tabs.onmessage = ({data}) => data === ASK && [...last.values()].forEach((status) => tabs.postMessage(status));
      this.listen(pass);
      return new Promise(() => {}); // keeps the lock until this page is closed
    });
  }

  // Opens the stream of events. The browser itself reconnects a stream that breaks, but it does not reconnect a stream
  // that was refused. So a refused stream is opened again here.
  listen(pass) {
    const source = new EventSource("api/events");
    source.onmessage = (event) => pass(JSON.parse(event.data));
    source.onerror = () => {
      pass(null);
      if (source.readyState === EventSource.CLOSED) setTimeout(() => this.listen(pass), 1000);
    };
  }
}
