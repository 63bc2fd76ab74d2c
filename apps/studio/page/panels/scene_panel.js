// Shows the panel of a scene with the rotation and the size of each model. When the user changes a value, makes a new
// scene file and opens it.

import {$, make, pair, textField} from "../controls.js";
import {fileNameOf} from "../file_field.js";
import {typedNumber} from "../lengths.js";

const TURN = {label: "Turn", unit: "°", min: -360, max: 360}, SIZE = {label: "Size", unit: "", min: 1, max: 10000};
const MOST_NAMES = 3; // largest number of models that the name of a scene mentions

// Returns a scene file with the models. Models without positions are placed side by side.
export function sceneFile(models) {
  const names = models.slice(0, MOST_NAMES).map(({file}) => fileNameOf(file).replace(/\.[a-z0-9]+$/i, ""));
  const name = names.join(" + ") + (models.length > MOST_NAMES ? " + …" : "");
  return new File([JSON.stringify({models})], `${name}.json`, {type: "application/json"});
}

export class ScenePanel {
  // `open(models)` shows a scene with other models. `say` shows a line to the user.
  constructor({open, say}) {
    Object.assign(this, {open, say, models: []});
  }

  show(models) {
    this.models = models;
    $("#scene").hidden = models.length === 0;
    $("#scene-models").replaceChildren(...models.map((model, i) => this.row(model, i)));
  }

  row(model, at) {
    const name = fileNameOf(model.file), [across, upright, roll] = model.rotate;
    const field = (label, range, value, part) => {
      const show = () => (input.value = value), take = (text) => {
        const number = typedNumber(text, range, this.say);
        number === null ? show() : this.change(at, part(number));
      };
      const input = textField({value, inputmode: "decimal", "aria-label": `${label} of ${name}`}, {take, show});
      return pair(label, input);
    };
    const mirror = make("input", {type: "checkbox", checked: model.mirror, "aria-label": `Mirror ${name}`});
    mirror.onchange = () => this.change(at, {mirror: mirror.checked});
    const remove = make("button", {class: "quiet", "aria-label": `Remove ${name}`}, "Remove");
    remove.onclick = () => this.remove(at);
    remove.disabled = this.models.length === 1;
    return make("li", {}, make("div", {class: "pair"}, make("b", {}, name), remove),
      field("Turn left or right (°)", TURN, upright, (turn) => ({rotate: [across, turn, roll]})),
      field("Tilt (°)", TURN, roll, (turn) => ({rotate: [across, upright, turn]})),
      field("Size (%)", SIZE, Number((100 * model.scale).toPrecision(4)), (size) => ({scale: size / 100})),
      pair("Mirrored", mirror));
  }

  change = (at, part) => this.open(this.models.map((model, i) => (i === at ? {...model, ...part} : model)));

  remove = (at) => this.open(this.models.filter((_, i) => i !== at));
}
