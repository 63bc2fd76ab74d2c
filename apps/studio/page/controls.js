// Helpers that make elements, change their state, and delay calls.

export const $ = (selector, root = document) => root.querySelector(selector);

// Returns the place of a pointer's event in an element, in pixels from its upper left corner.
export function placeIn(element, {clientX, clientY}) {
  const {left, top} = element.getBoundingClientRect();
  return [clientX - left, clientY - top];
}

// Creates an element: make("button", {class: "quiet", "aria-label": "Undo", onclick: f}, ...children)
export function make(tag, attributes = {}, ...children) {
  const svg = ["svg", "path", "g", "circle", "line", "text", "rect"].includes(tag);
  const element = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element[name] = value;
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

export const pair = (label, control, attributes = {}) =>
  make("label", {class: "pair", ...attributes}, make("span", {}, label), control);

// Returns a text field. It calls take(text) with the text that the user typed. After Escape it calls show(), which must
// restore the former text.
export function textField(attributes, {take, show}) {
  const input = make("input", {autocomplete: "off", ...attributes});
  input.onchange = () => take(input.value.trim());
  input.onkeydown = ({key}) => {
    if (key === "Escape") show(); // if the handler returned false, that would cancel the default effect of the key
  };
  return input;
}

// Returns an element whose text, such as a size, is not broken into lines.
export const unbroken = (text) => make("span", {class: "unbroken"}, text);

// Checks or unchecks a radio button. The Tab key can only reach the checked button of a group.
export function check(radio, isChecked) {
  radio.setAttribute("aria-checked", isChecked);
  radio.tabIndex = isChecked ? 0 : -1;
}

// Returns the page's font size divided by the font size on most screens. Drawings with texts grow by this factor.
export const scaleOfType = () => parseFloat(getComputedStyle(document.documentElement).fontSize) / 14.5;

export const clamp = (x, low, high) => Math.min(high, Math.max(low, x));

export const sentence = (text) => text[0].toUpperCase() + text.slice(1);

// Unit vector of each arrow key: x to the right, y up.
export const ARROWS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};

// The largest number of pixels of a picture. It is just below the engine's limit; a screen of 5,120 x 2,880 has more.
const MOST_PIXELS = 7.9e6;

// Returns the width of a picture in its own pixels, divided by its width in pixels of the page. This is `wanted`, or
// less if the picture would have more than MOST_PIXELS.
export const pictureScale = ({width, height}, wanted = Math.min(devicePixelRatio, 2)) =>
  Math.min(wanted, Math.sqrt(MOST_PIXELS / (width * height)));

export function paint(canvas, image) {
  if (canvas.width !== image.width) canvas.width = image.width;
  if (canvas.height !== image.height) canvas.height = image.height;
  canvas.getContext("2d").putImageData(image, 0, 0);
}

// Calls act() after a pause. If begin() is called during the pause, the pause starts again.
export class Pause {
  constructor(act, ms) {
    Object.assign(this, {act, ms, timer: 0});
  }

  get isRunning() {
    return this.timer !== 0;
  }

  begin(ms = this.ms) {
    this.end();
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.act();
    }, ms);
  }

  end() {
    clearTimeout(this.timer);
    this.timer = 0;
  }
}

// Returns a function that calls the asynchronous `act`, which must not throw. If it is called while `act` runs, it
// calls `act` once more afterwards.
export function oneAtATime(act) {
  let isWanted = false, running = null;
  const run = async () => {
    while (isWanted) {
      isWanted = false;
      await act();
    }
    running = null;
  };
  return () => {
    isWanted = true;
    return (running ??= run());
  };
}

// Returns the number as "1,234,567".
export const count = (n) => Math.round(n).toLocaleString("en-US");

export function fileSize(bytes) {
  const units = ["bytes", "kB", "MB", "GB"];
  let unit = 0;
  for (; bytes >= 1000 && unit < 3; ++unit) bytes /= 1000;
  return `${bytes >= 100 || unit === 0 ? bytes.toFixed(0) : bytes.toFixed(1)} ${units[unit]}`;
}

// Lets the user save a file through the browser.
export function download(blob, name) {
  const link = make("a", {href: URL.createObjectURL(blob), download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
