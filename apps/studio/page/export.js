// The dialog that exports files of the finished relief, as downloads of the browser.

import {about, optionOf} from "./about.js";
import {$, download, fileSize, make} from "./controls.js";
import {fillChoices} from "./fields.js";

// Estimates the bytes of the files whose size is known beforehand; exact for STL.
function sizes(facts, options, pixels) {
  const sides = options.outline === "none" ? 2 : 1; // its bottom is as fine as its front
  const triangles = sides * (facts.triangles + facts.hull + 14), points = sides * (facts.points + 8);
  const [longer, shorter] = [Math.max(...facts.size), Math.min(...facts.size)];
  const share = (shorter / longer * options.width + 2 * options.margin) / (options.width + 2 * options.margin);
  return {
    stl: 84 + 50 * triangles, "3mf": 13 * triangles,
    ply: 230 + 12 * points + 13 * triangles, obj: 31 * points + 23 * triangles,
    heightmap: pixels * pixels * share * 0.9, tiff: pixels * pixels * share * 4, preview: 600000,
  };
}

// Returns the size in words, if it is known. How much smaller a simplified mesh is depends on the relief.
const sizeText = ({name, type}, bytes, {tolerance, outline = "rectangle"}) => {
  if (bytes === undefined) return "";
  if (tolerance && !type.startsWith("image/")) return `less than ${fileSize(bytes)}`;
  return (name === "stl" && outline === "rectangle" ? "" : "about ") + fileSize(bytes);
};

export class ExportDialog {
  // `current` returns {facts, options, name}; `change` takes the options that are chosen here.
  constructor(engine, current, change) {
    Object.assign(this, {engine, current, change});
    this.dialog = $("#export-dialog");
    $("#formats").append(...about.formats.map(({name, label, use}, i) => make("label", {},
      make("input", {type: "radio", name: "format", value: name, checked: i === 0}),
      make("span", {}, label, make("small", {}, use)), make("span", {class: "muted", id: `size-${name}`}))));
    fillChoices("form");
    this.dialog.oninput = () => this.show();
    $("#form").onchange = () => this.choose();
    for (const name of ["tolerance", "draft"]) {
      const {min, max} = optionOf(name);
      Object.assign($(`#${name}`), {min, max, onchange: () => this.choose()});
    }
    $("#export-go").onclick = (event) => {
      event.preventDefault();
      this.go();
    };
  }

  get format() {
    return about.formats.find(({name}) => name === $("#formats :checked").value);
  }

  choose() {
    const tolerance = Number.parseFloat($("#tolerance").value), draft = Number.parseFloat($("#draft").value);
    this.change({form: $("#form").value, tolerance: tolerance > 0 ? tolerance : null, draft: draft > 0 ? draft : null});
    this.show();
  }

  open() {
    const {form = "relief", tolerance = "", draft = ""} = this.current().options;
    $("#form").value = form;
    $("#tolerance").value = tolerance;
    $("#draft").value = draft;
    $("#export-note").textContent = "";
    this.show();
    this.dialog.showModal();
  }

  show() {
    const {facts, options} = this.current();
    const {width, margin, thickness, height, outline = "rectangle"} = options;
    const scale = width / Math.max(...facts.size), ground = outline === "rectangle" ? 2 * margin : 0;
    const [x, y] = facts.size.map((side) => (side * scale + ground).toFixed(1));
    const depth = (thickness + height).toFixed(2);
    $("#export-size").textContent = ground || outline === "none"
      ? `${x} × ${y} × ${depth} mm, relief ${height.toFixed(2)} mm high`
      : `Relief ${x} × ${y} mm and ${height.toFixed(2)} mm high, plate ${depth} mm in all`;
    const all = sizes(facts, options, this.pixels);
    for (const format of about.formats)
      $(`#size-${format.name}`).textContent = sizeText(format, all[format.name], options);
    $("#pixels-row").hidden = !["heightmap", "tiff"].includes(this.format.name);
  }

  get pixels() {
    return Math.min(16384, Math.max(16, Number.parseInt($("#pixels").value) || 2048));
  }

  async go() {
    const {options, name} = this.current(), {name: format, ending} = this.format, button = $("#export-go");
    button.disabled = true;
    $("#export-note").textContent = "Making the file …";
    try {
      download(await this.engine.exportFile({options, format, pixels: this.pixels}), name + ending);
      this.dialog.close("export");
    } catch (error) {
      $("#export-note").textContent = error.message;
    }
    button.disabled = false;
  }
}
