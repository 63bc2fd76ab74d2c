// Shows the dialog that exports files of the finished piece as downloads.

import {about} from "./about.js";
import {$, download, fileSize, make, unbroken} from "./controls.js";
import {showText} from "./inputs.js";
import {shown, sizeText, typedNumber, withUnit} from "./lengths.js";
import {inWords} from "./panels/pieces.js";

const PIXELS = {label: "Longer side of height maps, in pixels", min: 16, max: 16384};
const PIXEL = {label: "Exact size of a pixel", unit: "mm", min: 0.001, max: 100};

// Converts a resolution such as "254 dpi" to the size of a pixel in mm, as text. Returns other texts unchanged.
function withoutDpi(text) {
  const [, dots] = text.trim().match(/^([\d.,]+) *dpi$/i) ?? [];
  return dots ? `${254 / (10 * Number(dots.replace(",", ".")))} mm` : text;
}

// Returns the options of a height map under the names of the flags of `relievo make`. The TIFF contains millimetres, so
// it takes no number of bits.
function mapOptions(format, pixelMm) {
  const black = $("#map-black").value, bits = format === "heightmap" ? $("#map-bits").value : "";
  return {pixel: pixelMm ? `${pixelMm}mm` : "", "heightmap-bits": bits, "heightmap-area": $("#map-area").value,
    "heightmap-zero": black === "ground" ? "ground" : "lowest", "heightmap-high": black === "highest" ? "black" : "white"};
}

// Returns the sizes of a piece's files as texts. The texts are exact if the numbers of triangles and points determine
// the sizes. They begin with "about" for compressed files and text files, and with "at most" for a compressed height
// map.
function sizes({triangles, points, size_mm: [x, y]}, {pixels, pixelMm}) {
  const longer = Math.max(x, y), side = pixelMm ? longer / pixelMm : pixels, area = side * side * Math.min(x, y) / longer;
  const around = (bytes) => `about ${fileSize(bytes)}`, atMost = (bytes) => `at most ${fileSize(bytes)}`;
  return {
    stl: fileSize(84 + 50 * triangles), ply: fileSize(230 + 12 * points + 13 * triangles),
    "3mf": around(13 * triangles), obj: around(33 * points + 23 * triangles),
    heightmap: atMost(2 * area), tiff: atMost(4 * area), preview: around(1e6),
  };
}

export class ExportDialog {
  // `outcome` is an Outcome. `name` returns the default name of the files, and `heightText` returns a height as the
  // page shows it. `say` shows a line to the user.
  constructor({engine, outcome, name, heightText, say}) {
    Object.assign(this, {engine, outcome, name, heightText, say, pixels: 2048, pixelMm: null, piece: null, runs: 0});
    this.dialog = $("#export-dialog");
    $("#formats").append(...about.formats.map(({name, label, use}, i) => make("label", {},
      make("input", {type: "checkbox", name: "format", value: name, checked: i === 0}),
      make("span", {}, label, make("small", {}, use)), make("span", {class: "muted", id: `size-${name}`}))));
    this.dialog.oninput = () => this.show();
    for (const id of ["#pixels", "#pixel"]) $(id).onchange = () => this.choosePixels();
    // When the close event arrives, the user may have opened the dialog again.
    this.dialog.onclose = () => this.isBusy && !this.dialog.open && this.engine.cancelPiece().catch(() => {});
    $("#export-cancel").onclick = () => this.dialog.close();
    $("#export-go").onclick = (event) => {
      event.preventDefault();
      this.go();
    };
  }

  get formats() {
    return about.formats.filter(({name}) => $(`#formats [value="${name}"]`).checked);
  }

  // Reads the numbers that the user typed. If one is invalid, shows a message and returns false.
  choosePixels() {
    let complaint = "";
    const say = (text) => (complaint ||= text), size = withoutDpi($("#pixel").value);
    const pixels = typedNumber($("#pixels").value, PIXELS, say);
    const pixelMm = size.trim() ? typedNumber(size, PIXEL, say) : null;
    $("#export-note").textContent = complaint;
    if (!complaint) Object.assign(this, {pixels: Math.round(pixels), pixelMm});
    this.show();
    return !complaint;
  }

  // Opens the dialog. Makes the piece as soon as all entries are settled. After that, the sizes of the piece's files
  // are known, and each file is written quickly.
  async open() {
    const outcome = this.outcome.known(), usual = this.name();
    this.piece = null;
    $("#export-name").value = usual;
    this.show();
    this.dialog.showModal();
    const isMade = await this.run("Waiting for what was entered …", async (isWanted) => {
      this.order = await outcome;
      if (!isWanted()) return;
      if ($("#export-name").value === usual) showText($("#export-name"), this.order.name);
      $("#export-note").textContent = "Making the piece …";
      this.piece = await this.engine.piece(this.order.options);
    });
    if (isMade) $("#export-note").textContent = this.order.note;
    this.show();
  }

  show() {
    const pixelsWanted = this.formats.some(({name}) => ["heightmap", "tiff"].includes(name));
    $("#map-rows").hidden = !pixelsWanted;
    $("#export-go").disabled = this.isBusy || this.formats.length === 0 || !this.piece;
    const texts = this.piece ? sizes(this.piece, this) : {};
    for (const {name} of about.formats) $(`#size-${name}`).textContent = texts[name] ?? "";
    const {size_mm: size, height_mm: height, front_mm: front, triangles} = this.piece ?? {};
    const isCoarse = pixelsWanted && $("#map-bits").value === "8";
    const facts = this.piece ? [`${sizeText(size)},`, `relief ${this.heightText(height)} ${shown.unit} high,`,
      `${triangles.toLocaleString("en-US")} triangles`,
      ...(isCoarse ? [`a grey level of 8 bits is ${withUnit(front / 255, 4)} or less`] : [])] : [];
    $("#export-size").replaceChildren(...facts.flatMap((text) => [" ", unbroken(text)]).slice(1));
  }

  progress({making}) {
    if (!this.isBusy || !making?.stage) return;
    $("#export-progress").value = making.fraction;
  }

  // Calls `work` and shows its progress. If it fails, shows the error. Returns whether it succeeded and the dialog is
  // still open.
  async run(text, work) {
    const number = ++this.runs, isWanted = () => this.dialog.open && number === this.runs;
    this.isBusy = true;
    $("#export-progress").hidden = false;
    $("#export-progress").removeAttribute("value");
    $("#export-note").textContent = text;
    $("#export-note").classList.add("muted");
    this.show();
    let complaint = "";
    try {
      await work(isWanted);
    } catch (error) {
      complaint = error.kind === "cancelled" ? "Cancelled." : inWords(error);
    }
    if (number !== this.runs) return false; // the user has opened the dialog again meanwhile
    this.isBusy = false;
    $("#export-progress").hidden = true;
    $("#export-note").textContent = complaint;
    $("#export-note").classList.remove("muted");
    return complaint === "";
  }

  async go() {
    if (this.isBusy || !this.choosePixels()) return;
    const {options, name, material} = this.order, {formats} = this;
    const typed = $("#export-name").value.replace(/[/\\]/g, " ").trim();
    const saved = [];
    const isDone = await this.run("Writing the files …", async () => {
      for (const [i, {name: format, ending}] of formats.entries()) {
        $("#export-note").textContent = `Writing file ${i + 1} of ${formats.length} …`;
        const file = await this.engine.exportFile({options, format, pixels: this.pixels, material,
          ...mapOptions(format, this.pixelMm)});
        if (!this.dialog.open) return;
        saved.push((typed || name) + ending);
        download(file, saved.at(-1));
      }
    });
    this.show();
    const told = saved.length > 0 ? `Saved: ${saved.join(", ")}.` : "Nothing was saved.";
    if (!this.dialog.open) return this.say(`Cancelled. ${told}`);
    if (!isDone) return;
    this.say(`${told} ${$("#export-size").textContent}.`);
    this.dialog.close("export");
  }
}
