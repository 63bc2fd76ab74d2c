// Handles keys, and files that are dropped on the page.

// Remembers which panels are open.
export function keepPanels(panels, storage) {
  for (const panel of panels) {
    const key = `panel:${panel.querySelector("summary").textContent.trim()}`, was = storage.getItem(key);
    if (was) panel.open = was === "open";
    panel.addEventListener("toggle", () => storage.setItem(key, panel.open ? "open" : "closed"));
  }
}

// Lets arrow keys move within a radio group.
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
    const isTaken = event.defaultPrevented; // the element below has taken the files
    show(false)(event);
    if (!isTaken) open([...(event.dataTransfer?.files ?? [])]);
  });
}

// The field whose typed text is neither entered nor taken back. Ctrl Z applies to this field, and its text stays when
// the document changes.
let unfinished = null;
export const isUnfinished = (field) => field === unfinished;

export function finish() {
  unfinished = null;
  if (postponed) setTimeout(doPostponed); // after the field's own handlers
}

let postponed = null;
function doPostponed() {
  if (unfinished || !postponed) return;
  const act = postponed;
  postponed = null;
  act();
}

// Calls `act` as soon as the user types nothing, because `act` moves fields, and a moved field can lose the focus. A
// new call replaces a function that is still waiting.
export function whenFinished(act) {
  postponed = act;
  doPostponed();
}

// Confirms the text that is being typed, like Enter.
export const confirmTyping = () => unfinished?.dispatchEvent(new Event("change", {bubbles: true}));

// These listeners run before the field's own, which may then show the document's value in the field.
addEventListener("input", ({target}) => (unfinished = target), true);
for (const end of ["change", "focusout"]) addEventListener(end, finish, true);
addEventListener("keydown", ({key}) => key === "Escape" && finish(), true);

// A finger on a slider may be about to scroll the panel. The slider follows the finger after a sideways movement or a
// tap, and is unchanged if the browser uses the finger for scrolling.
const SIDEWAYS = 6; // pixels
let swipe = null; // {range, x, before, wanted} until the gesture is clear; {isScrolling} after a scroll

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

// Chromium gives the focus back to a field after a dialog, but not the selection: Ctrl A would then select nothing in
// the field. All its text is selected, as after the Tab key.
addEventListener("close", () => {
  const {activeElement: field} = document;
  if (field?.matches(TEXTS)) field.select();
}, true);

// Calls the function of a key. With Ctrl or Cmd it is one of `commands`. Without them it is one of `always` or, while
// isReady(), one of `keys`; hold(isHeld) is called when B is pressed and released. Keys are ignored while a dialog is
// open, and letters while the user types.
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
    // A field gives up the focus after it has taken its text, so that letters are keys of the page again. Tab continues
    // from the field.
    if (key === "Enter" && target.matches?.(`.inspector :is(${TEXTS})`)) target.blur();
  });
}
