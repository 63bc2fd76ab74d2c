// The dialog that exports files of the finished relief, as downloads of the browser.

import {about, optionOf} from "./about.js";
import {$, download, fileSize, make} from "./controls.js";
import {fillChoices} from "./fields.js";
import {typedNumber} from "./lengths.js";

const fields = {resolution: "Resolution", tolerance: "Simplify", draft: "Draft angle"}; // empty for none
const units = {MM: "mm", DEG: "°"};
const PIXELS = {label: "Longer side in pixels", min: 16, max: 16384};

// Estimates the triangles of the solid: of its samples, or with a draft angle or as a lithophane of the scan's points.
function solidTriangles(facts, {width, resolution, form, draft, outline}) {
  const sides = outline === "none" ? 2 : 1; // its bottom is as fine as its front
  if (draft || form === "lithophane") return sides * (facts.triangles + facts.hull + 14);
  const scale = width / Math.max(...facts.size), step = resolution ?? Math.min(width / 700, facts.rho * scale);
  return sides * 2 * facts.area * (scale / step) ** 2;
}

// Estimates the bytes of the files whose size is known beforehand.
function sizes(facts, options, pixels) {
  const triangles = solidTriangles(facts, options), points = triangles / 2;
  const [longer, shorter] = [Math.max(...facts.size), Math.min(...facts.size)];
  const share = (shorter / longer * options.width + 2 * options.margin) / (options.width + 2 * options.margin);
  return {
    stl: 84 + 50 * triangles, "3mf": 13 * triangles,
    ply: 230 + 12 * points + 13 * triangles, obj: 31 * points + 23 * triangles,
    heightmap: pixels * pixels * share * 0.9, tiff: pixels * pixels * share * 4, preview: 600000,
  };
}

// Returns the size in words, if it is known. How much smaller a simplified mesh is depends on the relief.
const sizeText = ({type}, bytes, {tolerance}) => {
  if (bytes === undefined) return "";
  if (tolerance && !type.startsWith("image/")) return `less than ${fileSize(bytes)}`;
  return `about ${fileSize(bytes)}`;
};

export class ExportDialog {
  // `current` returns {facts, options, name, input}; `change` takes the options that are chosen here.
  constructor(engine, current, change) {
    Object.assign(this, {engine, current, change, pixels: 2048});
    this.dialog = $("#export-dialog");
    $("#formats").append(...about.formats.map(({name, label, use}, i) => make("label", {},
      make("input", {type: "radio", name: "format", value: name, checked: i === 0}),
      make("span", {}, label, make("small", {}, use)), make("span", {class: "muted", id: `size-${name}`}))));
    fillChoices("form");
    this.dialog.oninput = () => this.show();
    $("#form").onchange = () => this.choose();
    for (const name of [...Object.keys(fields), "pixels"]) $(`#${name}`).onchange = () => this.choose();
    $("#export-go").onclick = (event) => {
      event.preventDefault();
      this.go();
    };
  }

  get format() {
    return about.formats.find(({name}) => name === $("#formats :checked").value);
  }

  // Takes what was typed; returns false after saying which number was not understood.
  choose() {
    let complaint = "";
    const say = (text) => (complaint ||= text), chosen = {form: $("#form").value};
    for (const [name, label] of Object.entries(fields)) {
      const {unit, min, max} = optionOf(name), {value} = $(`#${name}`);
      chosen[name] = value.trim() === "" ? null : typedNumber(value, {label, unit: units[unit], min, max}, say);
    }
    this.pixels = Math.round(typedNumber($("#pixels").value, PIXELS, say) ?? this.pixels);
    $("#export-note").textContent = complaint;
    if (!complaint) this.change(chosen);
    this.show();
    return !complaint;
  }

  open() {
    const {options} = this.current();
    $("#form").value = options.form ?? "relief";
    for (const name of Object.keys(fields)) $(`#${name}`).value = options[name] ?? "";
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

  async go() {
    if (!this.choose()) return;
    const {options, name, input} = this.current(), {name: format, ending} = this.format, button = $("#export-go");
    button.disabled = true;
    $("#export-note").textContent = "Making the file …";
    try {
      download(await this.engine.exportFile({input, options, format, pixels: this.pixels}), name + ending);
      this.dialog.close("export");
    } catch (error) {
      $("#export-note").textContent = error.message;
    }
    button.disabled = false;
  }
}
