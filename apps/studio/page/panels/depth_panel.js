// Shows the panel of a depth image: which of its pixels were left out and why, and the options for reading it.

import {$, count, make, paint} from "../controls.js";
import {hasScale} from "../document.js";

const LEAST_OFFERED = 0.02; // if more than this share of the pixels is blur, keeping them is offered beside the picture

const WORDS = {missing: "No value", background: "Background", blur: "Blur at edges"};
const VALUES = {depth: "depths", height: "heights", inverse: "inverse depths", luminance: "brightness"};

const percent = (share) => `${share > 0 && share < 0.1 ? "less than 0.1" : Number(share.toPrecision(2))} %`;

const share = (pixels, all) => `${count(pixels)} (${percent(100 * pixels / all)})`;

// Returns a remark without the flags of the command line. If the remark is on pixels that were taken out, and they are
// background or much blur, adds the option that keeps them, and a shorter text to show beside the picture.
export function noteOn(note, {pixels: all, uses}) {
  const text = note.text.replace(/ \(--[^)]*\)/g, "");
  if (!/ taken out/.test(text)) return {...note, text};
  const [{use, pixels}] = uses.filter(({use: name}) => name !== "missing").sort((a, b) => b.pixels - a.pixels);
  const isMuch = use === "background" || pixels > LEAST_OFFERED * all;
  const offer = {option: use, value: "keep", label: `Keep the ${use}`, short: `Left out as ${use}: ${share(pixels, all)}`};
  return isMuch ? {text, ...offer} : {...note, text};
}

export class DepthPanel {
  // `rows` maps names of options to the elements of their controls.
  constructor({engine, doc, rows}) {
    Object.assign(this, {engine, doc, rows, told: 0});
  }

  // Shows how the pixels were used. `depth` is null if the scan is not a single depth image.
  async tell(depth) {
    const told = ++this.told;
    this.depth = depth;
    $("#depth").hidden = !depth;
    if (!depth) return;
    const {pixels, values, uses} = depth, isPhoto = !depth.is_surface;
    this.show();
    const lost = uses.filter(({pixels: n}) => n > 0);
    const read = `Its values are read as ${VALUES[values]}.`;
    $("#depth-text").textContent = isPhoto ? "Its brightness becomes thickness, pixel by pixel."
      : `${read} ${lost.length ? "These pixels are left out:" : "All pixels are used."}`;
    $("#depth-uses").replaceChildren(...lost.map((use) => this.entry(use, pixels)));
    const canvas = $("#depth-picture");
    canvas.hidden = !lost.length;
    canvas.style.aspectRatio = depth.aspect;
    canvas.setAttribute("aria-label", "The picture, with what is left out in colours");
    if (canvas.hidden) return;
    const {image} = await this.engine.pixels();
    if (told === this.told) paint(canvas, image);
  }

  // Shows only the options that have an effect.
  show() {
    for (const name of ["background", "blur"]) this.rows[name].hidden = !this.depth?.is_surface;
    this.showScale();
  }

  // Shows the options of pictures whose heights are proportional to their values: the depth of the figure, and the
  // height in mm of one unit of the values.
  showScale() {
    const isScaled = this.depth?.is_scaled, {options} = this.doc.now;
    this.rows["depth-range"].hidden = !isScaled || hasScale(this.doc.now);
    this.rows["mm-per-value"].hidden = !isScaled || options.form === "lithophane";
    this.rows.ground.hidden = !isScaled || !hasScale(this.doc.now);
  }

  entry({use, colour, pixels}, all) {
    const dot = make("span", {class: "dot", "aria-hidden": "true"});
    dot.style.background = colour;
    const keep = use === "missing" ? [] : [make("button", {class: "quiet", "aria-label": `Keep the ${use}`,
      onclick: () => this.doc.change({options: {[use]: "keep"}})}, "Keep")];
    return make("li", {}, make("span", {}, dot, `${WORDS[use]}: ${share(pixels, all)}`), ...keep);
  }
}
