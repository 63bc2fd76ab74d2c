// Handles keys, and files that are dropped on the page.

// Panels stay open or closed as they were left.
export function keepPanels(panels, storage) {
  for (const panel of panels) {
    const key = `panel:${panel.querySelector("summary").textContent.trim()}`, was = storage.getItem(key);
    if (was) panel.open = was === "open";
    panel.addEventListener("toggle", () => storage.setItem(key, panel.open ? "open" : "closed"));
  }
}

// Arrow keys move within a radio group.
export function takeArrowKeys(group) {
  group.onkeydown = (event) => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    if (!step) return;
    event.preventDefault();
    const all = [...group.children], next = all[(all.indexOf(document.activeElement) + step + all.length) % all.length];
    next.focus();
    next.click();
  };
}

// Calls `open` with the files that are dropped; shows the veil while a file is dragged over the page.
export function takeDrops(veil, open) {
  const show = (isShown) => (event) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    veil.hidden = !isShown;
  };
  addEventListener("dragover", show(true));
  addEventListener("dragleave", (event) => event.relatedTarget === null && show(false)(event));
  addEventListener("drop", (event) => {
    const isTaken = event.defaultPrevented; // by the part of the page on which they were dropped
    show(false)(event);
    if (!isTaken) open([...(event.dataTransfer?.files ?? [])]);
  });
}

// The field in which something is typed that is neither entered nor taken back. Ctrl Z belongs to it, and what is typed
// there stays when the document changes.
let unfinished = null;
export const isUnfinished = (field) => field === unfinished;

export function finish() {
  unfinished = null;
  if (postponed) setTimeout(doPostponed); // when the field's own functions have run
}

let postponed = null;
function doPostponed() {
  if (unfinished || !postponed) return;
  const act = postponed;
  postponed = null;
  act();
}

// Calls a function when nothing is being typed, in place of one that still waits: a moved field loses the focus.
export function whenFinished(act) {
  postponed = act;
  doPostponed();
}

// Confirms what is being typed, as Enter does.
export const confirmTyping = () => unfinished?.dispatchEvent(new Event("change", {bubbles: true}));

// These listeners run before the field's own, which may then show the document's value in the field.
addEventListener("input", ({target}) => (unfinished = target), true);
for (const end of ["change", "focusout"]) addEventListener(end, finish, true);
addEventListener("keydown", ({key}) => key === "Escape" && finish(), true);

// A finger that comes down on a slider may be about to scroll the panel: the slider follows it when it has moved
// sideways or was a tap, and stays as it was when the browser takes the finger for scrolling.
const SIDEWAYS = 6; // pixels
let swipe = null; // {range, x, before, wanted} until it is known what the finger does; {isScrolling} after a scroll

function follow() {
  const {range, wanted} = swipe;
  swipe = null;
  if (wanted === range.value) return;
  range.value = wanted;
  range.dispatchEvent(new Event("input", {bubbles: true}));
}

addEventListener("pointerdown", ({target, pointerType, clientX: x}) => {
  const isSlider = pointerType === "touch" && target.matches?.("input[type='range']"), {value} = target;
  swipe = isSlider ? {range: target, x, before: value, wanted: value} : null;
}, true);
addEventListener("pointermove", ({clientX}) => {
  if (swipe?.range && Math.abs(clientX - swipe.x) > SIDEWAYS) follow();
}, true);
addEventListener("pointerup", () => swipe?.range && follow(), true);
addEventListener("pointercancel", () => {
  if (!swipe?.range) return;
  swipe.range.value = swipe.before;
  swipe = {isScrolling: true};
}, true);
addEventListener("input", (event) => {
  if (!event.isTrusted || swipe?.range !== event.target) return;
  event.stopPropagation();
  swipe.wanted = event.target.value;
  event.target.value = swipe.before;
}, true);
addEventListener("change", (event) => {
  if (swipe?.isScrolling && event.target.type === "range") event.stopPropagation();
}, true);

const TEXTS = "input:not([type='range'], [type='radio'], [type='checkbox'])";

// Calls the function of a key: `commands` with Ctrl or Cmd; `always` and, while `isReady()`, `keys` without; and
// `hold(true)` while B is down. No key counts while a dialog is open, nor letters while something is typed.
export function takeKeys({commands, always, keys, isReady, hold}) {
  addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]")) return;
    const isTyping = event.target.matches?.(`${TEXTS}, select`);
    if (event.ctrlKey || event.metaKey) {
      const command = commands[event.key];
      if (!command || (isTyping && isUnfinished(event.target) && "zZy".includes(event.key))) return;
      event.preventDefault();
      return command();
    }
    if (isTyping || event.altKey) return;
    if (always[event.key]) return always[event.key]();
    if (!isReady()) return;
    if (event.key === "b" && !event.repeat) return hold(true);
    keys[event.key]?.();
  });
  addEventListener("keyup", ({key, target}) => {
    if (key.toLowerCase() === "b") hold(false);
    // A field that has taken its text gives up the focus, so that letters are keys of the page again. Tab goes on from
    // its place.
    if (key === "Enter" && target.matches?.(`.inspector :is(${TEXTS})`)) target.blur();
  });
}
