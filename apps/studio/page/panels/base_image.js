// Shows the control for the height map of a base. The user chooses an image or drops it on the control.

import {engineOptions, isGone, markGone} from "../document.js";
import {FileField, fileNameOf, takeDropsOn} from "../file_field.js";
import {offer} from "../messages.js";

const NAME = "base-image";
const TIP = "Height map under the relief, bright is high: a grey PNG of 8 or 16 bits, or a TIFF. Drop it here, too.";
const isImage = (base) => base === "image" || base.startsWith("image:");

// Returns the options that must change together with a base: a base that is no image gets no height map.
export const withoutImage = (base) => (isImage(base) ? {} : {[NAME]: ""});

export class BaseImage {
  // `say` shows a line to the user. `redraw` updates the whole page.
  constructor({engine, doc, say, redraw}) {
    Object.assign(this, {engine, doc, say, redraw});
    this.field = new FileField({label: "Base image", what: "base image", none: "Choose …",
      noneSaid: "Choose … for the base", accept: ".png,.tif,.tiff", option: NAME, class: "pair by-file base-image",
      title: TIP, take: (file) => this.take(file),
      drop: () => this.doc.change({options: {base: "plane", [NAME]: ""}})});
    this.element = this.field.row;
    takeDropsOn(this.element, "Drop to lay the relief on this image", (file) => this.take(file));
  }

  // Uploads an image and uses it for the base, unless the engine cannot read it or the user has opened another document
  // meanwhile.
  async take(file) {
    const {document} = this.engine;
    try {
      const {path} = await this.engine.upload([file]), {options} = this.doc.now;
      const part = {base: isImage(options.base) ? options.base : "image", [NAME]: path};
      await this.engine.check(engineOptions({...this.doc.now, options: {...options, ...part}}));
      if (document !== this.engine.document) return;
      const wasGone = isGone(path); // the path depends on the content, so the same image has the same path as before
      markGone(path, false);
      this.doc.change({options: part});
      if (wasGone) this.redraw();
    } catch (error) {
      this.say(error.message);
    }
  }

  // Returns whether a picture failed because the height map is missing, and informs the user of it. For later errors
  // about the same height map, only returns false.
  isMissing({kind, input}) {
    const path = this.doc.now.options[NAME];
    if (kind !== "input" || !path || isGone(path) || input !== path) return false;
    markGone(path);
    offer(`The base image ${fileNameOf(path)} is gone: the relief is shown without it.`, "Choose it again",
      this.field.choose);
    return true;
  }

  show() {
    const path = this.doc.now.options[NAME];
    this.field.show(path, {isGone: isGone(path)});
  }
}
