// Shows the start page: the samples, and the documents that were changed last, with their thumbnails.

import {about, engine} from "./about.js";
import {$, fileSize, make, sentence} from "./controls.js";
import {offer} from "./messages.js";

const sampleName = (name) => sentence(name).replaceAll("_", " ");

export const nameOf = (input) => (input?.sample ? sampleName(input.sample) : input?.name ?? "");

// Fills the shelf of samples. `open` opens an input.
export function showSamples(open) {
  const card = ({name, description}) => make("button", {onclick: () => open({sample: name, name})},
    make("img", {src: engine.addressOf(`sample-${name}.jpg`), alt: "", width: 320, height: 200}),
    make("span", {}, make("b", {}, sampleName(name)), make("small", {}, description)));
  $("#samples").append(...about.samples.map((sample) => make("li", {}, card(sample))));
}

export const START = "#start"; // if its address ends in this text, the page first shows the start page

// Shows the thumbnail of a document, or an icon if it has none. Returns the image element.
function showThumbnail(image, thumbnail) {
  const source = thumbnail || engine.addressOf("icon.svg");
  if (image.getAttribute("src") !== source) Object.assign(image, {src: source, className: thumbnail ? "" : "none"});
  return image;
}

// The shelf of stored documents: opens and removes them, and shows how much space they take.
export class Shelf {
  constructor({engine, opened, keeper, open, failed}) {
    Object.assign(this, {engine, opened, keeper, open, failed});
  }

  async show() {
    const {engine} = this, [recent, kept] = await Promise.all([engine.recent(), engine.canRemove && engine.kept()]);
    $("#recent-shelf").hidden = recent.length === 0;
    const names = recent.map(({document, is_there: isThere}) => `${document} ${isThere}`).join();
    // If the list is unchanged, the cards stay, because a card that is replaced while the mouse button is down gets no
    // click.
    if (names === this.names)
      recent.forEach(({thumbnail}, i) => showThumbnail($("#recent").children[i].querySelector("img"), thumbnail));
    else
      $("#recent").replaceChildren();
    this.add(names === this.names ? [] : recent, kept);
    this.names = names;
  }

  add(entries, kept) {
    $("#recent").append(...entries.map((entry) => this.card(entry)));
    const {length: shown} = $("#recent").children, isMore = kept && shown > 0 && kept.documents > shown;
    $("#kept").textContent = kept ? inTotal(kept, shown) : "";
    $("#older").hidden = !isMore;
    const last = entries.at(-1)?.document;
    if (last) $("#older").onclick = async () => this.add(await this.engine.recent(last), kept);
  }

  card({document, input, thumbnail, is_there: isThere}) {
    const open = make("button", {title: input.path ?? `Sample ${input.name}`, onclick: () => this.open(input)},
      showThumbnail(make("img", {alt: "", width: 320, height: 200}), thumbnail),
      make("span", {}, nameOf(input), make("small", {}, isThere ? "" : "Scan not found")));
    const ask = () => offer(`Remove your work on ${nameOf(input)} for good, with the scan if it was dropped here?`, "Remove",
      () => this.remove(document).catch(this.failed));
    const remove = {class: "remove", "aria-label": "Remove", title: "Remove this work and its dropped scan", onclick: ask};
    return make("li", {}, open, ...(this.engine.canRemove ? [make("button", remove, "×")] : []));
  }

  // Removes a document. If the page shows that document, loads the page again without it.
  async remove(document) {
    const {engine, opened, keeper} = this, isShown = document === opened.id;
    if (isShown) opened.id = ""; // so that the document is not stored again
    try {
      await engine.remove(document);
    } catch (error) {
      if (isShown) opened.id = document;
      throw error;
    }
    keeper.forget(document);
    this.names = null; // forces new cards, since the list may now have an older document
    if (!isShown) return this.show();
    location.hash = START;
    location.reload();
  }
}

// Returns a text for users about the amount of stored documents, and about how long they are stored.
function inTotal({documents, bytes}, shown) {
  if (documents === 0) return "";
  const scans = documents === 1 ? "1 scan" : `${documents} scans`;
  const newest = documents > shown ? ` The newest ${shown} are shown.` : "";
  return `The work on ${scans} is kept on this machine until you remove it, with what was dropped here: ${fileSize(bytes)}.` +
    newest;
}

const WIDTH = 320, HEIGHT = 200;

// Returns a small copy of a canvas as a data URL; "" if the canvas is empty.
export function thumbnailOf(canvas) {
  if (canvas.width < 2) return "";
  const small = make("canvas"), context = small.getContext("2d");
  [small.width, small.height] = [WIDTH, HEIGHT];
  context.fillStyle = "#e7e4df";
  context.fillRect(0, 0, WIDTH, HEIGHT);
  const scale = Math.max(WIDTH / canvas.width, HEIGHT / canvas.height) * 0.95;
  const width = canvas.width * scale, height = canvas.height * scale;
  context.drawImage(canvas, (WIDTH - width) / 2, (HEIGHT - height) / 2, width, height);
  return small.toDataURL("image/jpeg", 0.8);
}
