// Shows the panel of a scan: notes about it, each with a button that changes the cause, and the controls for cropping
// and denoising.

import {$, make, pair} from "../controls.js";
import {noteOn} from "./depth_panel.js";
import {showText} from "../inputs.js";

export const WHOLE = [0, 0, 1, 1, 0, 1];
// The sides that the user can cut away, each with its index in the crop X0,Y0,X1,Y1,NEAR,FAR. The numbers of a crop are
// fractions of the model's box, counted from its left side, from its bottom, and from its nearest point. A cut of 0
// removes nothing.
const SIDES = [["Left", 0], ["Right", 2], ["Top", 3], ["Bottom", 1], ["Front", 4], ["Back", 5]];
const MOST_CUT = 95; // percent

export const numbersOf = (crop) => WHOLE.map((otherwise, i) => {
  const number = crop.split(",")[i]?.trim();
  return number ? Number(number) : otherwise;
});

// Returns the numbers of a crop as the text of the option `crop`; "" for the whole scan.
export function cropText(numbers) {
  const short = numbers.map((x) => Number(x.toFixed(3))), isDeep = short[4] !== 0 || short[5] !== 1;
  return short.every((x, i) => x === WHOLE[i]) ? "" : short.slice(0, isDeep ? 6 : 4).join();
}

// Labels of the buttons of notes, by the option and the value that the button sets.
const REMEDIES = {"crumbs keep": "Keep them", "plane keep": "Keep it", "plane drop": "Leave it out",
  "denoise 0": "Keep the noise", "doubtful keep": "Keep them"};

const DOUBTFUL = "; --doubtful keep keeps them"; // end of a remark: advice for users of the command line

// In a remark on points that the file marks as doubtful, replaces the advice by the option that keeps them.
const withOption = (note) => (!note.text.includes(DOUBTFUL) ? note
  : {...note, text: note.text.replace(DOUBTFUL, ""), option: "doubtful", value: "keep"});

// Returns whether a note also appears beside the picture. It does if something was removed from the picture, or if
// something other than the figure fills the picture.
const isOffered = ({option, short}) => Boolean(short) || ["crumbs", "plane"].includes(option);

// The parts of a scan that the preparation can leave out: their options, labels and tips.
const PARTS = [
  ["crumbs", "Keep small pieces", "Pieces of less than 0.5 % of what is seen"],
  ["plane", "Keep table, background", "A table or background that is found: a plane that the figure stands on or before"],
  ["doubtful", "Keep doubtful points",
    "Points that the file marks as noise or withheld, splats less than half opaque, and blurred outlines"],
];

// Returns the controls for these parts, and for the noise.
const viewRows = () => [
  ...PARTS.map(([name, label, title]) =>
    pair(label, make("input", {id: name, "data-option": name, type: "checkbox"}), {title})),
  make("div", {class: "slider", title: "Standard deviation of the scan's noise, in distances between its points, " +
    "that is smoothed away while creases stay"},
  make("div", {class: "row"}, make("span", {class: "name"}, "Denoise"), make("output", {id: "denoise-value"})),
  make("input", {id: "denoise", "data-option": "denoise", type: "range", min: 0, max: 1, step: 0.01,
    "aria-label": "Denoise"})),
  pair("As measured", make("input", {id: "denoise-auto", type: "checkbox"}),
    {title: "As much noise is removed as the scan shows"}),
];

export class ScanPanel {
  // Calls cropOnPicture() to show the crop frame on the picture.
  constructor({doc, cropOnPicture}) {
    this.doc = doc;
    this.cuts = SIDES.map(([label, at]) => {
      const input = make("input", {type: "range", min: 0, max: MOST_CUT, step: 1, "aria-label": `Cut away: ${label}`});
      const output = make("output");
      input.oninput = () => this.showCut({input, output}, input.value);
      input.onchange = () => this.cut(at, Number(input.value) / 100);
      $("#cuts").append(pair(label, input, {class: "pair cut"}));
      input.after(output);
      return {input, output, at};
    });
    $("#preparing").before(...viewRows());
    $("#cuts").prepend(make("p", {class: "muted"}, "Cut away a table, a background, or what is not wanted:"));
    $("#remarks").onclick = () => this.open();
    $("#offers .close").onclick = () => {
      this.hidden = this.offeredKey; // hides the offer until the notes change
      $("#offers").hidden = true;
    };
    $("#crop-picture").onclick = cropOnPicture;
    $("#crop").onkeydown = ({key, target}) => {
      if (key === "Escape") target.value = doc.now.options.crop;
    };
    $("#crop").onchange = (event) => this.set({crop: event.target.value.replaceAll(" ", "")});
    for (const [name] of PARTS)
      $(`#${name}`).onchange = ({target}) => this.set({[name]: target.checked ? "keep" : "drop"});
    $("#denoise").oninput = (event) => this.showNoise(Number(event.target.value));
    $("#denoise").onchange = (event) => this.set({denoise: event.target.value});
    $("#denoise-auto").onchange = (event) => this.set({denoise: event.target.checked ? "auto" : $("#denoise").value});
  }

  showCut({input, output}, percent) {
    input.value = percent;
    input.style.setProperty("--filled", `${percent / MOST_CUT * 100}%`);
    input.setAttribute("aria-valuetext", `${Math.round(percent)} percent`);
    output.textContent = `${Math.round(percent)} %`;
  }

  cut(at, share) {
    const numbers = numbersOf(this.doc.now.options.crop), other = at < 4 ? (at + 2) % 4 : 9 - at;
    const isFar = WHOLE[at] === 1;
    numbers[at] = isFar ? Math.max(1 - share, numbers[other] + 0.05) : Math.min(share, numbers[other] - 0.05);
    this.doc.change({options: {crop: cropText(numbers)}});
    this.shown = null; // lets show() also reset a control whose cut was refused because it would remove everything
    this.show();
  }

  open() {
    $("#scan").open = true;
    $("#scan").scrollIntoView({block: "start"});
    $("#scan summary").focus();
  }

  showNoise(noise) {
    $("#denoise").value = noise;
    $("#denoise").style.setProperty("--filled", `${100 * noise}%`);
    $("#denoise-value").textContent = noise.toFixed(2);
  }

  show() {
    const {options} = this.doc.now, {crop, denoise} = options;
    const key = [crop, ...PARTS.map(([name]) => options[name]), denoise, this.facts?.noise].join();
    if (key === this.shown) return; // nothing has changed; this method runs for each event of a drag
    this.shown = key;
    const numbers = numbersOf(crop);
    showText($("#crop"), crop);
    for (const [name] of PARTS) $(`#${name}`).checked = options[name] === "keep";
    $("#denoise-auto").checked = denoise === "auto";
    this.showNoise(denoise === "auto" ? this.facts?.noise ?? 0 : Number(denoise));
    for (const cut of this.cuts)
      this.showCut(cut, 100 * (WHOLE[cut.at] === 1 ? 1 - numbers[cut.at] : numbers[cut.at]));
  }

  tell(facts) {
    this.facts = facts;
    const notes = facts ? this.notesOn(facts) : [];
    const entry = ({text, option, value, label = REMEDIES[`${option} ${value}`]}) => make("li", {}, text,
      ...(label ? [make("button", {class: "quiet", onclick: () => this.set({[option]: value})}, label)] : []));
    $("#notes").replaceChildren(...notes.map(entry));
    this.offered = notes.filter(isOffered);
    $("#offers ul").replaceChildren(...this.offered.map((note) => entry({...note, text: note.short ?? note.text})));
    $("#offers").hidden = this.offered.length === 0 || this.hidden === this.offeredKey;
    $("#remarks").hidden = notes.length === 0;
    $("#remarks").textContent = notes.length === 1 ? "1 note on the scan" : `${notes.length} notes on the scan`;
    this.show();
  }

  // Returns the notes to show: the remarks of the engine, and a note on small pieces that were kept, which the engine
  // does not report.
  notesOn({remarks, depth_image: depth}) {
    const {crumbs} = this.doc.now.options;
    const kept = {text: "Small pieces are kept.", option: "crumbs", value: "drop", label: "Leave them out"};
    const notes = remarks.map((note) => (depth ? noteOn(note, depth) : withOption(note)));
    return crumbs === "keep" ? [...notes, kept] : notes;
  }

  get offeredKey() {
    return JSON.stringify(this.offered);
  }

  set = (options) => this.doc.change({options});
}
