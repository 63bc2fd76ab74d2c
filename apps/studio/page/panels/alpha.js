// Shows the control for flatness, which is the paper's height coefficient alpha. If the height is not locked, alpha and
// the saturation determine it.

import {optionOf} from "../about.js";
import {$, pair, sentence, textField} from "../controls.js";
import {uOfAlpha} from "../document.js";
import {showText} from "../inputs.js";
import {typedNumber} from "../lengths.js";

export class AlphaRow {
  constructor({doc, say}) {
    Object.assign(this, {doc, say});
    const {help, min, max} = optionOf("alpha");
    this.range = {label: "Flatness", unit: "", min, max};
    this.input = textField({id: "alpha", "data-option": "alpha", inputmode: "decimal", "aria-label": "Flatness",
      placeholder: "no effect"}, {take: (text) => this.take(text), show: () => this.show(this.facts)});
    this.help = sentence(help);
    this.element = pair("Flatness", this.input);
    $("#tuning").before(this.element);
  }

  take(text) {
    const alpha = typedNumber(text, this.range, this.say);
    if (alpha === null) return this.show(this.facts);
    this.doc.change({isHeightLocked: false, u: uOfAlpha(alpha, this.doc.now.options.saturation)});
  }

  // Shows the alpha of a picture. At saturation 0 and with a tone curve, alpha has no effect.
  show(facts) {
    this.facts = facts;
    this.input.disabled = facts.alpha === null;
    this.element.title = this.input.disabled ? "Has no effect with a tone curve or with Edge emphasis 0" : this.help;
    showText(this.input, facts.alpha === null ? "" : Number(facts.alpha.toPrecision(4)));
  }
}
