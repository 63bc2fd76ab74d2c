// The start page: samples, and the documents that were changed last, with their pictures.

import {about, engine} from "./about.js";
import {$, make} from "./controls.js";

const sampleName = (name) => (name[0].toUpperCase() + name.slice(1)).replaceAll("_", " ");

export const nameOf = (input) => (input?.sample ? sampleName(input.sample) : input?.name ?? "");

// Fills the shelf of samples; `open` takes an input.
export function showSamples(open) {
  const card = ({name, description}) => make("button", {onclick: () => open({sample: name, name})},
    make("img", {src: engine.addressOf(`sample-${name}.jpg`), alt: "", width: 320, height: 200}),
    make("span", {}, make("b", {}, sampleName(name)), make("small", {}, description)));
  $("#samples").append(...about.samples.map((sample) => make("li", {}, card(sample))));
}

// Shows the documents; `open` takes an input.
export function showRecent(recent, open) {
  const card = ({input, picture, is_there: isThere}) => make("button", {
    title: input.path ?? `Sample ${input.name}`, onclick: () => open(input),
  }, make("img", {
    src: picture || engine.addressOf("icon.svg"), alt: "", width: 320, height: 200, class: picture ? "" : "none",
  }),
  make("span", {}, nameOf(input), make("small", {}, isThere ? "" : "Scan not found")));
  $("#recent-shelf").hidden = recent.length === 0;
  $("#recent").replaceChildren(...recent.map((entry) => make("li", {}, card(entry))));
}

const WIDTH = 320, HEIGHT = 200;

// Returns a small picture of a canvas as a data address; "" if there is nothing on it.
export function smallPicture(canvas) {
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
