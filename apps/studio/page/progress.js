// Shows the progress of the engine's work in the background.

import {about} from "./about.js";
import {$} from "./controls.js";

// `isAlone` is true while no relief is shown.
export function showProgress({busy, stage, fraction = 0}, isAlone) {
  const box = $("#progress"), percent = Math.round(fraction * 100), name = about.stages[stage] ?? stage;
  box.hidden = !busy;
  box.classList.toggle("alone", isAlone);
  $(".track", box).setAttribute("aria-valuenow", percent);
  $(".track", box).setAttribute("aria-valuetext", `${name}, ${percent} percent`);
  $(".fill", box).style.width = `${Math.max(4, percent)}%`;
  $("#stage-name").textContent = `${name} …`;
}
