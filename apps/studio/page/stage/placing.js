// Moves, turns and scales the figure on its plate by hand.

import {clamp} from "../controls.js";
import {viewTurned} from "../directions.js";
import {isMirrored} from "../document.js";
import {FREE_OUTLINES} from "../panels/kinds.js";

const LEAST = 1, MOST = 1e5; // range of a figure's longer side in mm
const TURN_STEP = 1; // in degrees

const rounded = (x) => Number(x.toFixed(2));

export class Placing {
  // `shownWidth` returns the longer side of the figure in mm, `setWidth` sets it, and `say` shows a line to the user.
  constructor({doc, entries, shownWidth, setWidth, say}) {
    Object.assign(this, {doc, entries, shownWidth, setWidth, say});
  }

  // Begins a movement on a piece of the given size. If the plate's size depends on the figure, the plate keeps its
  // current size from now on, so that the figure can move on it. Returns whether the figure can be moved.
  begin([width, height]) {
    const {outline, diameter, plate, form, shift} = this.doc.now.options;
    if (this.entries.pending.length > 0)
      return this.say("Wait until what was entered is tried: then the figure can be moved."), false;
    this.from = (shift || "0,0").split(",").map(Number);
    this.part = {};
    if (diameter || plate) return true;
    if (outline === "circle" && form !== "die") this.part = {diameter: rounded(width), width: null};
    else if (FREE_OUTLINES.includes(outline))
      this.part = {plate: `${rounded(width)}x${rounded(height)}`, width: null};
    else return this.say("Give the plate a size first: then the figure can be moved on it."), false;
    return true;
  }

  // Moves the figure from its initial position by millimetres to the right and up in the picture.
  move(right, up) {
    const x = this.from[0] + (isMirrored(this.doc.now) ? -right : right), y = this.from[1] + up;
    const isMiddle = Math.hypot(x, y) < 0.2;
    this.doc.change({options: {...this.part, shift: isMiddle ? "" : `${rounded(x)},${rounded(y)}`}}, "place");
  }

  // Scales the figure to `factor` times `width`. The piece keeps its current `size`.
  scale(factor, size, width = this.shownWidth()) {
    if (!this.begin(size)) return;
    if (Object.keys(this.part).length > 0) this.doc.change({options: this.part}, "width");
    this.setWidth(clamp(width * factor, LEAST, MOST)); // is undone together with the change above
  }

  // Turns the figure in the picture by degrees, counterclockwise if positive.
  turn(degrees) {
    const angle = Math.round(degrees / TURN_STEP) * TURN_STEP;
    if (angle === 0) return;
    const {options} = this.doc.now;
    this.doc.change({options: viewTurned(options, isMirrored(this.doc.now) ? -angle : angle)}, this.doc.gesture);
    if (options.crop) this.say("The crop frame stays upright, so that it may keep other parts now.");
  }

  // Corrects a figure that does not fit its plate. The correction belongs to the same step of the document as the
  // change that caused the error. The first argument is the error of the newest picture; `shown` has the facts of the
  // picture that is still shown. A figure that was moved too far returns to its shown position. A figure that is too
  // large gets the largest width that fits; if no width fits, it moves to the centre of the plate. Returns whether
  // the figure was corrected.
  fit({kind, input, message}, shown) {
    if (kind !== "option" || input !== "width") return false;
    const {width, shift} = this.doc.now.options, before = this.doc.steps[this.doc.at - 1]?.options;
    const isMoved = before && before.shift !== shift && (width === null || before.width === width);
    const hasNoRoom = shift && message.includes("at most 0 mm");
    if (isMoved && shown && shown.options.shift !== shift)
      this.correct({shift: shown.options.shift}, "The plate has no room for the figure there: it stays where it is.");
    else if (hasNoRoom)
      this.correct({shift: ""}, "The plate has no room for the figure there: it is in the middle again.");
    else if (width !== null)
      this.correct({width: null}, "The figure was too large for its plate: now it is as large as fits.");
    else return false;
    return true;
  }

  correct(options, text) {
    this.doc.note({options});
    this.say(text);
  }
}
