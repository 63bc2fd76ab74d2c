// Makes a row for a file: the file's name is a button that chooses another file, and a second button removes the file.

import {$, make, sentence} from "./controls.js";

export const fileNameOf = (path) => path.split(/[/\\]/).at(-1);

// Returns a hidden input for files with the endings in `accept`. The input's click() opens the browser's dialog. When
// the user has chosen a file, the input calls take(file).
export const fileInput = (label, accept, take) =>
  make("input", {type: "file", accept, hidden: true, "aria-label": label, onchange: ({target}) => {
    const [file] = target.files;
    target.value = "";
    if (file) take(file);
  }});

// Calls take(file) for a file that is dropped on the element; the page would otherwise open the file as a scan. While
// a file is dragged over the element, shows the text `promise`, which says what a drop will do.
export function takeDropsOn(element, promise, take) {
  const veil = (text) => () => ($("#veil p").textContent = text);
  element.ondragover = veil(promise);
  element.ondragleave = veil("Drop to open");
  element.ondrop = (event) => {
    veil("Drop to open")();
    event.preventDefault();
    const [file] = event.dataTransfer?.files ?? [];
    if (file) take(file);
  };
}

export class FileField {
  // `label` names the row, and `what` the file. Without a file, the button has the text `none`; screen readers say
  // `noneSaid`. Calls take(file) when the user chooses a file, and drop() when the user removes it.
  constructor({label, what, none, noneSaid, accept, option, take, drop, ...attributes}) {
    Object.assign(this, {what, none, noneSaid});
    this.input = fileInput(`File of the ${what}`, accept, take);
    const quiet = {type: "button", class: "quiet"};
    this.button = make("button", {...quiet, "data-option": option, onclick: () => this.choose()});
    this.remove = make("button", {...quiet, "aria-label": `Remove the ${what}`, onclick: drop}, "×");
    this.row = make("div", {class: "pair by-file", ...attributes}, make("span", {}, label),
      make("span", {}, this.button, this.remove), this.input);
  }

  choose = () => this.input.click();

  // Shows the file of a path. A file that is needed can be replaced but not removed.
  show(path, {isGone = false, isNeeded = false} = {}) {
    const name = fileNameOf(path);
    this.button.textContent = isGone ? `${name} is gone` : name || this.none;
    this.button.setAttribute("aria-label", name ? `${sentence(this.what)} ${name}: choose another` : this.noneSaid);
    this.remove.hidden = path === "" || isNeeded;
  }
}
