// The flatness, which is the paper's height coefficient alpha: it and the saturation decide how high a relief is, which has no height to keep.

import {optionOf} from "./about.js";
import {$, make} from "./controls.js";
import {uOfAlpha} from "./document.js";
import {isUnfinished} from "./inputs.js";
import {typedNumber} from "./lengths.js";

export class AlphaRow {
  constructor({doc, say}) {
    Object.assign(this, {doc, say});
    const {help, min, max} = optionOf("alpha");
    this.range = {label: "Flatness", unit: "", min, max};
    this.input = make("input", {id: "alpha", "data-option": "alpha", autocomplete: "off", inputmode: "decimal",
      "aria-label": "Flatness", placeholder: "no effect"});
    this.input.onchange = () => this.take();
    this.input.onkeydown = ({key}) => {
      if (key === "Escape") this.show(this.frame);
    };
    this.help = help[0].toUpperCase() + help.slice(1);
    this.element = make("label", {class: "pair"}, make("span", {}, "Flatness"), this.input);
    $("#tuning").before(this.element);
  }

  take() {
    const alpha = typedNumber(this.input.value, this.range, this.say);
    if (alpha === null) return this.show(this.frame);
    this.doc.change({isHeightLocked: false, u: uOfAlpha(alpha, this.doc.now.options.saturation)});
  }

  // Shows the alpha of a frame. Without a saturation alpha has no effect.
  show(frame) {
    this.frame = frame;
    this.input.disabled = frame.alpha === null;
    this.element.title = this.input.disabled ? "Has no effect with a tone curve or with Edge emphasis 0" : this.help;
    if (!isUnfinished(this.input) || this.input.disabled)
      this.input.value = frame.alpha === null ? "" : Number(frame.alpha.toPrecision(4));
  }
}
