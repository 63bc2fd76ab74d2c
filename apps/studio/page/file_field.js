// A row for a file: its name, a button that chooses another one, and one that removes it.

import {$, make, sentence} from "./controls.js";

export const fileNameOf = (path) => path.split(/[/\\]/).at(-1);

// Returns a hidden input of files with those endings, which calls take(file). Its click() opens the browser's dialog.
export const fileInput = (label, accept, take) =>
  make("input", {type: "file", accept, hidden: true, "aria-label": label, onchange: ({target}) => {
    const [file] = target.files;
    target.value = "";
    if (file) take(file);
  }});

// Calls take(file) for a file that is dropped on the element, which the page would otherwise open as a scan. `promise`
// is shown meanwhile.
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
  // `label` names the row, and `what` the file. Without a file, the button has the text `none` and says `noneSaid` to
  // screen readers. take(file) and drop() change the file.
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

  // Shows the file of a path. A file that is needed can be replaced and not removed.
  show(path, {isGone = false, isNeeded = false} = {}) {
    const name = fileNameOf(path);
    this.button.textContent = isGone ? `${name} is gone` : name || this.none;
    this.button.setAttribute("aria-label", name ? `${sentence(this.what)} ${name}: choose another` : this.noneSaid);
    this.remove.hidden = path === "" || isNeeded;
  }
}
