// The dialog in which the view is chosen: by turning the model in space, or as one of the six sides.

import {about} from "./about.js";
import {$, make} from "./controls.js";
import {paint} from "./stage.js";
import {directionsOf} from "./turning.js";
import {cross, text, triple, turned, unit, upright} from "./vectors.js";

const SIDES = about.views.map(({name}) => name);
const TOWARDS = Object.fromEntries(about.views.map(({name, towards, up}) => [name, [towards, up]]));

// Returns "Front", or "Turned by hand" for other directions.
export const viewName = (view) => (view === "auto" ? "Best side"
  : SIDES.includes(view) ? view[0].toUpperCase() + view.slice(1) : "Turned by hand");

// Returns the view of options with the model turned by degrees, to the left for positive ones.
export function viewTurned({view, up}, degrees) {
  const towards = unit(TOWARDS[view]?.[0] ?? triple(view)), upright = up ? triple(up) : TOWARDS[view]?.[1] ?? [0, 1, 0];
  const right = cross(upright, towards), level = cross(towards, unit(right));
  return {view: text(towards), up: text(turned(level, towards, -degrees * Math.PI / 180))};
}

const SIDE = {width: 120, height: 90}; // pixels of the picture of a side

export class ViewDialog {
  constructor(engine, onApply, onFailed) {
    Object.assign(this, {engine, onApply, onFailed});
    this.dialog = $("#view-dialog");
    this.model = $("#model");
    this.canvas = $("canvas", this.model);
    const button = (side) =>
      make("button", {type: "button", "data-side": side, onclick: () => this.face(side)},
        make("canvas", {width: SIDE.width, height: SIDE.height, "aria-hidden": "true"}), viewName(side));
    $("#sides").append(...SIDES.map(button));
    $("#suggest").onclick = () => this.suggest();
    this.dialog.onclose = () => this.dialog.returnValue === "apply" && this.onApply(this.result());
    this.listen();
  }

  // Shows beside the name of the document's view what it shows: sides have their names by the file's axes, and whoever
  // wrote the file may have had the face of a figure look downwards.
  async tell({options, input}, isThere) {
    $("#view-name").textContent = viewName(options.view);
    const directions = directionsOf(options), picture = $("#view-picture");
    const key = isThere && directions ? JSON.stringify([directions, input]) : "";
    if (key === this.told) return; // this runs for each event of a drag
    this.told = key;
    picture.hidden = true;
    if (!key) return;
    const {width, height} = picture, seen = await this.engine.scan({...directions, width, height}).catch(() => null);
    if (!seen || key !== this.told) return;
    paint(picture, seen.image);
    picture.hidden = false;
  }

  // Draws what each side shows.
  async drawSides() {
    for (const button of $("#sides").children) {
      const [towards, up] = TOWARDS[button.dataset.side];
      const {image} = await this.engine.scan({towards, up, ...SIDE});
      if (!this.dialog.open) return;
      paint($("canvas", button), image);
    }
  }

  show(options) {
    this.dialog.returnValue = "cancel";
    $("#suggestion").textContent = "";
    if (options.view === "auto") this.face("front"); // not chosen yet
    else if (TOWARDS[options.view] && !options.up) this.face(options.view);
    else {
      this.side = null;
      this.towards = unit(TOWARDS[options.view]?.[0] ?? triple(options.view));
      this.up = options.up ? triple(options.up) : [0, 1, 0];
      this.straighten();
    }
    this.dialog.showModal();
    this.draw();
    this.drawSides().catch(this.onFailed);
  }

  // Makes `up` perpendicular to the view.
  straighten() {
    this.up = upright(this.up, this.towards);
    this.right = cross(this.up, this.towards);
    this.mark();
  }

  // Shows a side, upright as usual or with another direction upwards, given as text.
  face(side, up = "") {
    [this.towards, this.up] = TOWARDS[side];
    if (up) this.up = triple(up);
    this.side = up ? null : side;
    this.straighten();
    this.draw();
  }

  mark() {
    for (const button of $("#sides").children) button.setAttribute("aria-pressed", button.dataset.side === this.side);
  }

  // Turns the model with the hand, which is to turn the viewer the other way.
  turn(dx, dy, roll = 0) {
    const {up, right} = this;
    for (const [axis, angle] of [[up, -dx], [right, -dy], [this.towards, -roll]]) {
      this.towards = unit(turned(this.towards, axis, angle));
      this.up = unit(turned(this.up, axis, angle));
    }
    this.side = null;
    this.straighten();
    this.draw();
  }

  result() {
    return this.side ? {view: this.side, up: ""} : {view: text(this.towards), up: text(this.up)};
  }

  async draw() {
    this.isWanted = true;
    if (this.isBusy || !this.dialog.open) return;
    this.isBusy = true;
    while (this.isWanted && this.dialog.open) {
      this.isWanted = false;
      clearTimeout(this.timer);
      try {
        await this.drawAt(1);
      } catch (error) {
        this.onFailed(error);
      }
    }
    this.isBusy = false;
    this.timer = setTimeout(() => !this.isBusy && this.dialog.open && this.drawAt(2).catch(this.onFailed), 200);
  }

  async drawAt(scale) {
    const width = this.model.clientWidth * scale, height = this.model.clientHeight * scale, before = this.towards;
    const {image} = await this.engine.scan({towards: this.towards, up: this.up, width, height});
    if (scale === 1 || before === this.towards) paint(this.canvas, image);
  }

  async suggest() {
    $("#suggestion").textContent = "Looking at all six sides …";
    try {
      const [best, second] = await this.engine.suggestViews();
      this.face(best.view, best.up);
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
      const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
      if (!step) return;
      event.preventDefault();
      const size = 5 * Math.PI / 180;
      event.shiftKey ? this.turn(0, 0, -step[0] * size) : this.turn(step[0] * size, step[1] * size);
    };
  }
}
