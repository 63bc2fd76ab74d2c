// The sliders: names as the command line has them, ranges for the hand.

import {spread} from "./controls.js";

export const FIELDS = {
  height: {label: "Height", unit: "mm", unitName: "mm", min: 0.1, max: 40, decimals: 2, spread: spread.log, place: "#shape",
    help: "Lowest to highest point of the front, met exactly"},
  saturation: {label: "Saturation", min: 0, max: 4, decimals: 3, spread: spread.root, place: "#shape", help: "beta: 0 is even, more favours what is strongly curved"},
  detail: {label: "Detail", min: 0, max: 0.5, decimals: 3, spread: spread.root, place: "#shape", help: "gamma: holds coarse forms back, so that fine ones show"},
  boundary: {label: "Soft rim", unit: "×", unitName: "sampling distances", min: 0.25, max: 60, decimals: 1, spread: spread.log, place: "#shape", help: "Width of (7), in sampling distances rho"},
  steepest: {label: "Steepest wall", unit: "°", unitName: "degrees", min: 5, max: 85, decimals: 0, spread: spread.linear, place: "#shape", help: "Steepest slope asked of the surface; walls at jumps can exceed it"},
  width: {label: "Width", unit: "mm", unitName: "mm", min: 5, max: 1000, decimals: 1, spread: spread.log, place: "#plate", help: "Longer side of the relief, without margin"},
  margin: {label: "Margin", unit: "mm", unitName: "mm", min: 0.1, max: 50, decimals: 1, spread: spread.root, place: "#plate", help: "Least flat ground around the relief"},
  corner: {label: "Corner radius", unit: "mm", unitName: "mm", min: 0.1, max: 100, decimals: 1, spread: spread.root, place: "#plate", help: "Of the outline with round corners"},
  thickness: {label: "Thickness", unit: "mm", unitName: "mm", min: 0.1, max: 50, decimals: 1, spread: spread.root, place: "#plate", help: "Smallest thickness of the plate"},
};

// The soft rim that each method starts from.
export const RIMS = {ours: 0.5, paper: 2};

export const MATERIALS = {plaster: "Plaster", silver: "Struck silver", bronze: "Bronze", walnut: "Walnut", porcelain: "Porcelain, lit from behind"};
