// The dialog that exports files of the finished relief, as downloads of the browser.

import {optionOf} from "./about.js";
import {$, download, fileSize, make} from "./controls.js";

const FORMATS = [
  {id: "stl", name: "STL", ending: ".stl", use: "printing and milling, in millimetres"},
  {id: "3mf", name: "3MF", ending: ".3mf", use: "printing, with units"},
  {id: "ply", name: "PLY", ending: ".ply", use: "the same, with shared corners"},
  {id: "obj", name: "OBJ", ending: ".obj", use: "as text, for 3D programs"},
  {id: "heightmap", name: "Height map", ending: "-heights.png", use: "16-bit PNG for CNC and engraving"},
  {id: "tiff", name: "Heights in mm", ending: "-heights.tif", use: "32-bit TIFF"},
  {id: "preview", name: "Picture", ending: ".png", use: "front and oblique view"},
];

// Estimates the bytes of each file; exact for STL.
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

// Returns the word before the size. How much smaller a simplified mesh is depends on the relief.
const sizeWord = (id, {tolerance, outline = "rectangle"}) => {
  if (tolerance && ["stl", "3mf", "ply", "obj"].includes(id)) return "less than ";
  return id === "stl" && outline === "rectangle" ? "" : "about ";
};

export class ExportDialog {
  // `current` returns {facts, options, name}; `change` takes the options that are chosen here.
  constructor(engine, current, change) {
    Object.assign(this, {engine, current, change});
    this.dialog = $("#export-dialog");
    $("#formats").append(...FORMATS.map(({id, name, use}) => make("label", {},
      make("input", {type: "radio", name: "format", value: id, checked: id === "stl"}),
      make("span", {}, name, make("small", {}, use)), make("span", {class: "muted", id: `size-${id}`}))));
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
    return FORMATS.find(({id}) => id === $("#formats :checked").value);
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
    for (const {id} of FORMATS) $(`#size-${id}`).textContent = `${sizeWord(id, options)}${fileSize(all[id])}`;
    $("#pixels-row").hidden = !["heightmap", "tiff"].includes(this.format.id);
  }

  get pixels() {
    return Math.min(16384, Math.max(16, Number.parseInt($("#pixels").value) || 2048));
  }

  async go() {
    const {options, name} = this.current(), {id, ending} = this.format, button = $("#export-go");
    button.disabled = true;
    $("#export-note").textContent = "Making the file …";
    try {
      download(await this.engine.exportFile({options, format: id, pixels: this.pixels}), name + ending);
      this.dialog.close("export");
    } catch (error) {
      $("#export-note").textContent = error.message;
    }
    button.disabled = false;
  }
}
