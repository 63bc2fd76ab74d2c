// Handles keys, and files that are dropped on the page.

// Stores in the browser which panels are open.
export function keepPanels(panels, storage) {
  for (const panel of panels) {
    const key = `panel:${panel.querySelector("summary").textContent.trim()}`, was = storage.getItem(key);
    if (was) panel.open = was === "open";
    panel.addEventListener("toggle", () => storage.setItem(key, panel.open ? "open" : "closed"));
  }
}

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

// Calls `open` with files that the user drops. Shows the veil while a file is dragged over the page.
export function takeDrops(veil, open) {
  const show = (isShown) => (event) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    veil.hidden = !isShown;
  };
  addEventListener("dragover", show(true));
  addEventListener("dragleave", (event) => event.relatedTarget === null && show(false)(event));
  addEventListener("drop", (event) => {
    const isTaken = event.defaultPrevented; // a control below the pointer has taken the files
    show(false)(event);
    if (!isTaken) open([...(event.dataTransfer?.files ?? [])]);
  });
}

// The field with typed text that is neither confirmed nor cancelled. Ctrl Z applies to this field, and the text stays
// when the document changes.
let unfinished = null;
export const isUnfinished = (field) => field === unfinished;

// Shows a text in a field, unless the user is typing there. If all text of a focused field was selected, then all of the
// new text is, so that typing replaces it.
export function showText(field, text) {
  if (isUnfinished(field) && !field.disabled) return;
  const isFocused = field === document.activeElement;
  const isSelected = isFocused && field.selectionEnd - field.selectionStart === field.value.length;
  field.value = text;
  if (isSelected) field.select();
}

export function finish() {
  unfinished = null;
  if (postponed) setTimeout(doPostponed); // runs after the field's own handlers
}

let postponed = null;
function doPostponed() {
  if (unfinished || !postponed) return;
  const act = postponed;
  postponed = null;
  act();
}

// Calls `act` when the user is not typing, because `act` moves fields, and a moved field can lose the focus. If an
// earlier function still waits, `act` replaces that function.
export function whenFinished(act) {
  postponed = act;
  doPostponed();
}

// Confirms the text that the user is typing, as Enter does.
export const confirmTyping = () => unfinished?.dispatchEvent(new Event("change", {bubbles: true}));

// These listeners run before those of the field, which may then write the document's value into the field.
addEventListener("input", ({target}) => (unfinished = target), true);
for (const end of ["change", "focusout"]) addEventListener(end, finish, true);
addEventListener("keydown", ({key}) => key === "Escape" && finish(), true);

// A finger that touches a slider may be about to scroll the panel. So the slider follows the finger only after a
// sideways movement or a tap. If the browser scrolls, the slider keeps its value.
const SIDEWAYS = 6; // in pixels
let swipe = null; // {range, x, before, wanted} until the kind of gesture is known, {isScrolling} during a scroll

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

// After a dialog, Chromium gives the focus back to a field, but does not select its text again, and Ctrl A would then
// select nothing. So all text of the field is selected here, as the Tab key does it.
addEventListener("close", () => {
  const {activeElement: field} = document;
  if (field?.matches(TEXTS)) field.select();
}, true);

// Calls the function of each key that is pressed. `commands` has the functions of keys with Ctrl or Cmd. The functions
// in `always` and `keys` are for other keys; those in `keys` are called only while isReady(). Calls hold(isHeld) when B
// is pressed and released. While a dialog is open, keys do nothing; while the user types, keys without Ctrl do nothing.
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
    // After Enter the field loses the focus, so that letters are shortcuts of the page again. The Tab key continues
    // from this field.
    if (key === "Enter" && target.matches?.(`.inspector :is(${TEXTS})`)) target.blur();
  });
}
