// Lists the options that have a slider, each with its label, its panel and the range of the slider.

import {optionOf} from "../about.js";
import {sentence} from "../controls.js";
import {spread} from "./slider.js";

// A label names the visible effect; the tip adds the paper's symbol. The slider spans the range `hand`, but any number
// that the option allows can be typed. A document has a number for each of these options; only the width may be null.
const SLIDERS = {
  height: {label: "Height", hand: [0.1, 40], decimals: 2, spread: spread.log, place: "#shape"},
  width: {label: "Longer side", hand: [5, 1000], decimals: 1, spread: spread.log, place: "#shape"},
  detail: {label: "Fine detail", symbol: "γ", hand: [0, 0.5], decimals: 3, spread: spread.root, place: "#shape"},
  saturation: {label: "Edge emphasis", symbol: "β", hand: [0, 4], decimals: 3, spread: spread.root, place: "#shape"},
  boundary: {label: "Soft outline", hand: [0.25, 60], decimals: 1, spread: spread.log, place: "#shape"},
  steepest: {label: "Steepest wall", hand: [5, 85], decimals: 0, spread: spread.linear, place: "#tuning"},
  steps: {label: "Kept steps", hand: [0, 0.95], decimals: 2, spread: spread.linear, place: "#tuning"},
  planes: {label: "Step of planes", hand: [0, 0.3], decimals: 2, spread: spread.linear, place: "#tuning"},
  attention: {label: "Attention", hand: [0, 4], decimals: 2, spread: spread.root, place: "#tuning"},
  "light-contrast": {label: "Contrast", hand: [0, 1], decimals: 2, spread: spread.linear, place: "#light-rows"},
  colour: {label: "Dark lines", hand: [0, 1], decimals: 2, spread: spread.root, place: "#light-rows"},
  margin: {label: "Margin", hand: [0.1, 50], decimals: 1, spread: spread.root, place: "#plate-sliders"},
  corner: {label: "Corner radius", hand: [0.1, 100], decimals: 1, spread: spread.root, place: "#plate-sliders"},
  thickness: {label: "Plate thickness", hand: [0.1, 50], decimals: 1, spread: spread.root, place: "#plate-sliders"},
};

// The engine's units, as the page shows them and as screen readers speak them.
const UNITS = {
  MM: {unit: "mm", unitName: "mm"},
  DEG: {unit: "°", unitName: "degrees"},
  W: {unit: "points", unitName: "points of the scan"},
};

export const FIELDS = Object.fromEntries(Object.entries(SLIDERS).map(([name, slider]) => {
  const {unit, help, min, max} = optionOf(name);
  const tip = slider.symbol ? `${sentence(help)}. In the paper: ${slider.symbol}` : sentence(help);
  return [name, {...slider, ...UNITS[unit], min, max, help: tip}];
}));
