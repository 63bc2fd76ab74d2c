// What the page says while it works: progress with the stage's name, and lines for people.

import {$} from "./controls.js";

const STAGES = {
  "take in": "Taking in the file", waiting: "Getting ready", read: "Reading the scan", view: "Turning the model", spacing: "Measuring the spacing", normals: "Looking at normals",
  visible: "Finding what is seen", curvature: "Measuring curvature", triangulation: "Connecting the points", boundary: "Finding the rim", layers: "Splitting the normals in layers",
  factorisation: "Preparing live work",
};
const stageName = (stage) => STAGES[stage] ?? "Preparing";

// `isAlone` while there is no relief to look at.
export function showProgress({busy, stage, fraction = 0}, isAlone) {
  const box = $("#progress"), percent = Math.round(fraction * 100);
  box.hidden = !busy;
  box.classList.toggle("alone", isAlone);
  box.setAttribute("aria-valuenow", percent);
  box.setAttribute("aria-valuetext", `${stageName(stage)}, ${percent} percent`);
  $(".fill", box).style.width = `${Math.max(4, percent)}%`;
  $("#stage-name").textContent = `${stageName(stage)} …`;
}

let timer = 0, isLost = false;

// A line for people, for eight seconds or until the next.
export function toast(text, isLasting = false) {
  $("#toast").textContent = text;
  $("#toast").hidden = false;
  clearTimeout(timer);
  if (!isLasting) timer = setTimeout(hideToast, 8000);
}

function hideToast() {
  $("#toast").hidden = true;
  isLost = false;
}

export function engineLost() {
  isLost = true;
  toast("The engine has stopped. Start relievo studio again: your work is kept.", true);
}

export function engineBack() {
  if (isLost) hideToast();
}
