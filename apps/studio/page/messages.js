// Lines for people, at the edge of the page.

import {$, make} from "./controls.js";

let timer = 0, isLost = false;

$("#toast").onclick = hideToast;

// A line for people, for eight seconds or until the next.
export function toast(text, isLasting = false) {
  $("#toast").textContent = text;
  $("#toast").hidden = false;
  clearTimeout(timer);
  if (!isLasting) timer = setTimeout(hideToast, 8000);
}

// A line with a button that does something about it, for so long.
export function offer(text, label, action, ms = Infinity) {
  toast(text, true);
  if (ms < Infinity) timer = setTimeout(hideToast, ms);
  $("#toast").append(" ", make("button", {onclick: action}, label));
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
