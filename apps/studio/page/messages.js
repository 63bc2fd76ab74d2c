// Lines for people, at the edge of the page.

import {$, Pause, make} from "./controls.js";

const shown = new Pause(hideToast, 8000);
let isLost = false;

// The parts above the line make room for it, and the element with the focus stays in sight.
new ResizeObserver(() => {
  document.documentElement.style.setProperty("--toast-height", `${$("#toast").offsetHeight}px`);
  if (!$("#toast").hidden) $(".inspector :focus")?.scrollIntoView({block: "nearest"});
}).observe($("#toast"));

$("#toast .close").onclick = hideToast;

// Shows a line until the next, for eight seconds at most unless `isLasting`. Returns a function that takes it back.
export function toast(text, isLasting = false) {
  const line = make("span", {}, text);
  $("#toast p").replaceChildren(line);
  $("#toast").hidden = false;
  isLasting ? shown.end() : shown.begin();
  return () => line.isConnected && hideToast();
}

// Shows a line for `ms` with a button for an action, and with `others`, [label, action] of each. Returns a function
// that takes it back.
export function offer(text, label, action, ms = Infinity, others = []) {
  const takeBack = toast(text, true), act = (chosen) => () => {
    takeBack(); // before the action, which may say something itself
    chosen();
  };
  if (ms < Infinity) shown.begin(ms);
  for (const [name, chosen] of [[label, action], ...others])
    $("#toast p span").append(" ", make("button", {onclick: act(chosen)}, name));
  return takeBack;
}

function hideToast() {
  $("#toast").hidden = true;
  isLost = false;
}

export function engineLost() {
  isLost = true;
  toast("The engine has stopped. Start relievo studio again: this page keeps your work, and goes on by itself.", true);
}

export function engineBack() {
  if (isLost) hideToast();
}
