// Provides the document for exported files and projects, after all entries are settled and its picture is drawn.

import {engineOptions} from "./document.js";
import {confirmTyping} from "./inputs.js";
import {fileName} from "./panels/kinds.js";
import {withUnit} from "./lengths.js";

export class Outcome {
  // `facts` returns the facts of the newest picture.
  constructor({doc, stage, entries, pieces, facts}) {
    Object.assign(this, {doc, stage, entries, pieces, facts});
  }

  // Waits until all entries are settled, including typed texts that Enter has not confirmed.
  async entered() {
    confirmTyping();
    this.pieces.takeSteps();
    await this.entries.settled();
  }

  // Waits for the picture of the piece. Returns the options for the piece's files. If the wanted height is out of
  // reach, these options have the height of the picture.
  async known() {
    await this.entered();
    const isShown = await this.stage.rest(), {now} = this.doc, options = engineOptions(now), asked = options.height;
    const reached = isShown ? await this.heightOutOfReach(options) : null, isMissed = reached !== null;
    if (isMissed) options.height = reached;
    const note = isMissed && now.isHeightLocked ? `A height of ${withUnit(asked)} is out of reach here.` : "";
    return {options, note, name: fileName(now), material: now.material, step: now};
  }

  // Returns the height of the picture if the wanted height is out of reach; null otherwise. The light table shows no
  // finished piece, so there the engine is asked.
  async heightOutOfReach(options) {
    const facts = this.facts();
    if (this.stage.isTable && options.draft && options.form !== "lithophane") {
      const most = await this.stage.engine.reach(options);
      if (most < options.height) return most;
    }
    return facts && !facts.is_height_met ? facts.height_mm : null;
  }

  // Returns the document's step, with the height that its exported files have.
  async step() {
    const {step, options: {height}} = await this.known();
    return {...step, options: {...step.options, height: height ?? step.options.height}};
  }
}
