// Shows messages for users at the bottom of the page.

import {$, Pause, make} from "./controls.js";

const shown = new Pause(hideToast, 8000);
let isLost = false;

// Moves the parts of the page above a message to make space for it, and keeps the element with the focus visible.
new ResizeObserver(() => {
  document.documentElement.style.setProperty("--toast-height", `${$("#toast").offsetHeight}px`);
  if (!$("#toast").hidden) $(".inspector :focus")?.scrollIntoView({block: "nearest"});
}).observe($("#toast"));

$("#toast .close").onclick = hideToast;

// Shows a message until the next message. Without `isLasting`, it is shown for at most eight seconds. Returns a
// function that removes the message.
export function toast(text, isLasting = false) {
  const line = make("span", {}, text);
  $("#toast p").replaceChildren(line);
  $("#toast").hidden = false;
  isLasting ? shown.end() : shown.begin();
  return () => line.isConnected && hideToast();
}

// Shows a message for `ms` with a button for `action`, and with a button for each [label, action] of `others`. Returns
// a function that removes the message.
export function offer(text, label, action, ms = Infinity, others = []) {
  const takeBack = toast(text, true), act = (chosen) => () => {
    takeBack(); // must come first, as the action may show another message
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
