// Shows the dialog in which the user chooses the view: one of the six sides, or any view by turning the model.

import {$, ARROWS, Pause, make, oneAtATime, paint} from "./controls.js";
import {SIDES, directionsOf, optionsOf, pictureKey, turnedByHand, viewName} from "./directions.js";

const SIDE = {width: 120, height: 90}; // size of a side's picture in pixels

export class ViewDialog {
  constructor(engine, onApply, onFailed) {
    Object.assign(this, {engine, onApply, onFailed});
    this.dialog = $("#view-dialog");
    this.model = $("#model");
    this.canvas = $("canvas", this.model);
    const button = (side) =>
      make("button", {type: "button", "data-side": side, onclick: () => this.look(SIDES[side])},
        make("canvas", {width: SIDE.width, height: SIDE.height, "aria-hidden": "true"}), viewName(side));
    $("#sides").append(...Object.keys(SIDES).map(button));
    this.drawQuickly = oneAtATime(() => this.drawAt(1).catch(onFailed));
    this.rest = new Pause(() => this.drawAt(2).catch(onFailed), 200);
    $("#suggest").onclick = () => this.suggest();
    this.dialog.onclose = () => this.dialog.returnValue === "apply" && this.onApply(optionsOf(this.view));
    this.listen();
  }

  // Shows a picture of the document's view beside the view's name. The name alone may be misleading, because sides
  // refer to the axes of the file, and a figure may lie on its back in the file.
  async tell(step, isThere) {
    const {options} = step;
    $("#view-name").textContent = viewName(options.view);
    const directions = directionsOf(options), picture = $("#view-picture");
    const key = isThere && directions ? pictureKey(directions, step) : "";
    if (key === this.told) return; // nothing has changed; this method runs for each event of a drag
    this.told = key;
    picture.hidden = true;
    if (!key) return;
    const {width, height} = picture, seen = await this.engine.scan({...directions, width, height}).catch(() => null);
    if (!seen || key !== this.told) return;
    paint(picture, seen.image);
    picture.hidden = false;
  }

  async drawSides() {
    for (const button of $("#sides").children) {
      const {image} = await this.engine.scan({...SIDES[button.dataset.side], ...SIDE});
      if (!this.dialog.open) return;
      paint($("canvas", button), image);
    }
  }

  show(options) {
    this.dialog.returnValue = "cancel";
    $("#suggestion").textContent = "";
    this.dialog.showModal();
    this.look(directionsOf(options) ?? SIDES.front); // perhaps no view is chosen yet
    this.drawSides().catch(this.onFailed);
  }

  look(view) {
    this.view = view;
    const {view: side} = optionsOf(view);
    for (const button of $("#sides").children) button.setAttribute("aria-pressed", button.dataset.side === side);
    this.draw();
  }

  turn = (...angles) => this.look(turnedByHand(this.view, ...angles));

  // Draws the model quickly, and again with more pixels after a pause.
  async draw() {
    this.rest.end();
    await this.drawQuickly();
    this.rest.begin();
  }

  async drawAt(scale) {
    const {dialog, model, view} = this, width = model.clientWidth * scale, height = model.clientHeight * scale;
    if (!dialog.open) return;
    const {image} = await this.engine.scan({...view, width, height});
    if (scale === 1 || view === this.view) paint(this.canvas, image);
  }

  async suggest() {
    $("#suggestion").textContent = "Looking at all six sides …";
    try {
      const [best, second] = await this.engine.suggestViews();
      this.look(directionsOf(best));
      $("#suggestion").textContent = `The ${best.view} suits a relief best, then the ${second.view}.`;
    } catch (error) {
      this.onFailed(error);
    }
  }

  listen() {
    const {model} = this;
    model.onpointerdown = (event) => {
      model.setPointerCapture(event.pointerId);
      this.last = [event.clientX, event.clientY];
    };
    model.onpointermove = (event) => {
      if (!this.last) return;
      const dx = (event.clientX - this.last[0]) * 0.008, dy = (event.clientY - this.last[1]) * 0.008;
      this.last = [event.clientX, event.clientY];
      event.shiftKey ? this.turn(0, 0, -dx) : this.turn(dx, dy);
    };
    model.onpointerup = model.onpointercancel = () => (this.last = null);
    model.onkeydown = (event) => {
      if (!ARROWS[event.key]) return;
      event.preventDefault();
      const [x, y] = ARROWS[event.key].map((step) => step * 5 * Math.PI / 180);
      event.shiftKey ? this.turn(0, 0, -x) : this.turn(x, -y);
    };
  }
}
