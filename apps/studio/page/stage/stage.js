// Shows the relief in the middle of the page: requests pictures from the engine, and lets the user turn, light and
// section the relief by mouse and keys.

import {Comparing} from "./comparing.js";
import {$, Pause, clamp, make, paint, pictureScale} from "../controls.js";
import {hasScale, shownOptions} from "../document.js";
import {TABLE_LIGHTS} from "../lights.js";
import {Measure} from "./measure.js";
import {takeFingers} from "./pinch.js";
import {scaleMarks} from "./ruler.js";
import {TOOLS, takeKey} from "./tools.js";
import {Turning} from "./turning.js";

const FRONT = Object.freeze({yaw: 0, pitch: 0, zoom: 1, x: 0, y: 0});
const FINE_AFTER_MS = 160; // time without changes until the fine picture is requested
const FINISHED_AFTER_MS = 500; // time without changes until the finished piece is requested

export class Stage {
  // Calls on.picture(facts, ms, isFine), on.section(heights, from, to), on.failed(error), and on.viewRests() when the
  // view of the document has to be prepared again.
  constructor(engine, doc, on) {
    Object.assign(this, {engine, doc, on});
    this.element = $("#stage");
    this.picture = $("#picture");
    this.overlay = $("#overlay");
    this.camera = {...FRONT};
    this.tool = "light";
    this.share = 1; // while the picture keeps changing, its width and height in pixels are multiplied by this factor
    // The states to be shown are numbered. `wanted` is the number of the newest state, and `drawn` is the number of the
    // last state that was drawn. The other three are numbers of states whose picture was drawn or has failed: `shown`
    // is the newest state with any such picture, `fine` the newest with a fine one, and `finished` the newest with its
    // last one. The last picture of a state shows the finished piece if one is wanted.
    this.wanted = this.shown = this.drawn = this.fine = this.finished = 0;
    Object.assign(this, {isReady: false, pixelsPerMm: 1, resting: []}); // resting: the callbacks of rest()
    this.pause = new Pause(() => this.pump());
    this.measure = new Measure(this);
    this.comparing = new Comparing(this);
    this.turning = new Turning(this);
    this.listen();
  }

  // ------------------------------------------------------------------ pictures

  get size() {
    return {width: Math.max(1, this.element.clientWidth), height: Math.max(1, this.element.clientHeight)};
  }

  request(extra = {}, step = this.doc.now) {
    const {material, light} = step;
    const request = {options: shownOptions(step), material, light, camera: this.camera, ...extra};
    if (this.turning.shown) request.turned = this.turning.shown;
    if (!step.isHeightLocked && step.u !== null && !hasScale(step) && !extra.original) request.u = step.u;
    return request;
  }

  invalidate() {
    ++this.wanted;
    this.changedAt = performance.now();
    this.unwanted?.abort(); // aborts the request for a fine picture
    this.showBusy();
    this.pump();
  }

  // Prepares for another scan, which has no pictures yet, and removes all marks of the former one.
  clear() {
    Object.assign(this, {isReady: false, model: 0, facts: null, line: null, camera: {...FRONT}});
    this.measure.clear();
    this.drawOverlay();
  }

  // Shows that another model is being prepared. Meanwhile shows a turned relief.
  await(isAwaiting) {
    this.isAwaiting = isAwaiting;
    this.turning.await(isAwaiting);
    this.showBusy();
  }

  showBusy() {
    const isBusy = Boolean(this.isAwaiting || this.finished !== this.wanted);
    this.element.setAttribute("aria-busy", isBusy);
    if (!isBusy) for (const resolve of this.resting.splice(0)) resolve();
  }

  // Waits until the last picture of the document's current state is shown or has failed. Returns whether it is shown.
  async rest() {
    await new Promise((resolve) => {
      this.resting.push(resolve);
      this.showBusy();
    });
    return this.drawn === this.wanted;
  }

  // Requests the next picture of the relief, always of the newest state.
  async pump() {
    if (this.isAsking || !this.isReady) return;
    if (this.shown !== this.wanted) return this.draw(false);
    if (this.finished === this.wanted) return;
    const pause = this.fine === this.wanted ? FINISHED_AFTER_MS : FINE_AFTER_MS;
    const rest = this.changedAt + pause - performance.now();
    rest > 0 ? this.pause.begin(rest) : this.draw(true);
  }

  async draw(isFine) {
    this.isAsking = true;
    const start = performance.now(), isLast = this.fine === this.wanted;
    this.unwanted = isFine ? new AbortController() : null;
    const asked = this.ahead?.model === this.model ? this.ahead : this.ask(isFine, isLast), {number} = asked;
    this.ahead = null;
    try {
      await (this.isTable ? this.drawTable(isFine) : this.drawRelief(asked));
      if (isFine) this.fine = number;
      else this.adapt(performance.now() - start);
      this.shown = this.drawn = number;
      if (isFine && (this.isTable || this.isAwaiting || this.turning.shown || this.isLikeFile)) this.finished = number;
      else if (isLast) this.changedAt = performance.now(); // another tab cancelled the picture, so try again later
    } catch (error) {
      const isCancelled = error.kind === "cancelled" || error.name === "AbortError", isNewest = number === this.wanted;
      if (!isCancelled) this.shown = this.fine = this.finished = number;
      if (!isCancelled && isNewest) this.on.failed(error); // errors of older states do not matter
      if (isCancelled && isNewest) this.changedAt = performance.now(); // try again after a pause
    }
    this.isAsking = false;
    this.unwanted = null;
    this.showBusy();
    this.pump();
  }

  // Returns whether the picture shows the piece as it is exported. If the engine cannot draw while it makes a piece,
  // any picture of a plain piece counts, too.
  get isLikeFile() {
    return this.facts?.is_finished || (this.facts?.is_plain && !this.engine.drawsMeanwhile);
  }

  pictureSize(isFine) {
    const {width, height} = this.size, scale = pictureScale(this.size, isFine ? undefined : this.share);
    return {width: Math.round(width * scale), height: Math.round(height * scale)};
  }

  // Requests a picture of the newest state. The last picture of a state shows the piece as it is exported.
  ask(isFine, isLast) {
    const request = this.request({...this.pictureSize(isFine), fine: isFine, finished: isLast});
    const asked = {number: this.wanted, model: this.model, changedAt: this.changedAt, isFine, isLast};
    const onSolved = () => {
      asked.isSolved = true;
      if (this.drawing === asked) this.askAhead(asked);
    };
    if (!this.isTable) asked.picture = this.requestPicture(request, {signal: this.unwanted?.signal, onSolved});
    return asked;
  }

  // Requests the next picture before the requested one is shown, if the picture keeps changing.
  askAhead({isFine, number}) {
    if (isFine || this.ahead || number === this.wanted || this.isTable || this.waitsForPicture) return;
    this.ahead = this.ask(false, false);
    this.ahead.picture.catch(() => {}); // drawRelief() reports the error
  }

  // Returns a picture of the newest state. Its facts also have the document's options and `isTurned`: whether it shows
  // the turned relief of a view that is not prepared yet.
  async requestPicture(request, calling) {
    const {options} = this.doc.now, {image, facts} = await this.engine.picture(request, calling);
    return {image, facts: {...facts, options, isTurned: Boolean(request.turned)}};
  }

  // Draws the picture that ask() has requested.
  async drawRelief(asked) {
    const {model, changedAt, isFine, isLast, picture} = asked;
    this.drawing = asked;
    if (asked.isSolved) this.askAhead(asked);
    const {image, facts} = await picture;
    if (!this.isReady || model !== this.model) return; // another document or view was opened meanwhile
    this.askAhead(asked);
    paint(this.picture, image);
    this.pixelsPerMm = facts.pixels_per_mm * this.size.width / image.width;
    this.facts = facts;
    if (this.tool === "section") this.line ??= this.measure.middleLine();
    this.drawOverlay();
    this.on.picture(facts, performance.now() - changedAt, isFine);
    if (this.comparing.isShown) await this.comparing.draw(isFine, isLast);
    // The tool and the document may have changed meanwhile. The next picture will show that.
    if (this.tool === "section" && this.line && this.facts) await this.measure.cut(this.line);
    if (this.tool === "measure") this.measure.pictured();
  }

  // Returns whether this picture needs more answers of the engine, so that the next picture must not be requested yet.
  get waitsForPicture() {
    return this.comparing.isShown || ["section", "measure"].includes(this.tool);
  }

  async drawTable(isFine) {
    const half = (n) => Math.max(1, Math.round(n / 2));
    const {width, height} = this.pictureSize(isFine), {model} = this;
    for (const [i, {light}] of TABLE_LIGHTS.entries()) {
      const cell = $(`#table [data-cell="${i}"] canvas`);
      const {image, facts} = await this.requestPicture(
        this.request({width: half(width), height: half(height), fine: isFine, light}), {signal: this.unwanted?.signal});
      if (!this.isReady || model !== this.model) return;
      paint(cell, image);
      if (i === 0) this.on.picture(facts, 0, isFine);
    }
  }

  // Reduces the number of pixels of later pictures if pictures are slow, and increases it if they are fast.
  adapt(ms) {
    const {slowMs} = this.engine;
    this.mean = this.mean ? 0.7 * this.mean + 0.3 * ms : ms;
    if (this.mean > slowMs && this.share > 0.5) this.share = Math.max(0.5, this.share - 0.25);
    else if (this.mean < slowMs / 2 && this.share < 1) this.share = Math.min(1, this.share + 0.25);
    else return;
    this.mean = 0;
  }

  // ---------------------------------------------------------------------- modes

  setTool(tool) {
    this.tool = tool;
    this.element.dataset.tool = tool;
    this.element.setAttribute("aria-label", `Relief. Drag or use the arrow keys to ${TOOLS[tool].does}.`);
    this.look(TOOLS[tool].isLevel ? {yaw: 0, pitch: 0} : {});
    this.drawOverlay();
  }

  setTable(isTable) {
    this.isTable = isTable;
    this.invalidate();
  }

  look(part) {
    this.camera = {...this.camera, ...part};
    this.invalidate();
  }

  fit = () => this.look(FRONT);

  // --------------------------------------------------------------------- section

  // Returns the heights along a line, in mm.
  heights = (from, to) => this.engine.profile(this.request({from, to}));

  // ------------------------------------------------------------------- positions

  toPlace(x, y) {
    const {width, height} = this.size;
    return [(x - width / 2) / this.pixelsPerMm + this.camera.x, (height / 2 - y) / this.pixelsPerMm + this.camera.y];
  }

  toPixels([x, y]) {
    const {width, height} = this.size;
    return [width / 2 + (x - this.camera.x) * this.pixelsPerMm, height / 2 - (y - this.camera.y) * this.pixelsPerMm];
  }

  drawOverlay() {
    const {width, height} = this.size, marks = [...scaleMarks(this), ...this.comparing.marks(this.size)];
    this.overlay.setAttribute("viewBox", `0 0 ${width} ${height}`);
    marks.push(...this.letterMarks?.(this.facts) ?? []);
    if (this.tool === "section" && this.line) marks.push(...this.measure.lineMarks(this.line));
    if (["measure", "place"].includes(this.tool)) marks.push(...this.measure.marks());
    marks.push(...this.on.brush.marks(this));
    if (this.sun) {
      const [x, y] = this.sun;
      marks.push(make("line", {class: "ray", x1: x, y1: y, x2: width / 2, y2: height / 2}),
        make("circle", {class: "sun", cx: x, cy: y, r: 9}));
    }
    this.overlay.replaceChildren(...marks);
  }

  // ----------------------------------------------------------------------- input

  listen() {
    const stage = this.element;
    stage.onpointerdown = (event) => this.press(event);
    const isOther = ({pointerId}) => this.drag && pointerId !== this.drag.pointerId; // e.g. a palm while a pen draws
    stage.onpointermove = (event) => (!this.drag ? this.hover(event) : isOther(event) || this.move(event));
    stage.onpointerleave = () => {
      if (this.tool === "measure") this.measure.point(null);
      if (this.tool === "brush" && !this.drag) this.on.brush.point(this, null);
    };
    stage.onpointerup = stage.onpointercancel = (event) => isOther(event) || this.release();
    stage.ondblclick = () => this.fit();
    stage.addEventListener("wheel", (event) => this.zoom(event), {passive: false});
    stage.onkeydown = (event) => takeKey(this, event);
    takeFingers(this);
    new ResizeObserver(() => this.invalidate()).observe(stage);
  }

  press(event) {
    const isOther = event.target.id === "split" || event.button > 1 || !event.isPrimary;
    if (isOther || this.drag || !this.facts) return;
    this.doc.endGesture(); // earlier changes by keys or the wheel are a separate step
    this.element.setPointerCapture(event.pointerId);
    this.element.classList.add("dragging");
    const isDivider = event.button === 0 && this.comparing.isAt(event.offsetX);
    const tool = event.button === 1 ? "pan" : isDivider ? "divider" : this.tool;
    if (tool === "place" && !this.on.placing.begin(this.facts.size_mm)) return this.release();
    const {offsetX: x, offsetY: y, pointerId} = event, line = tool === "section" ? this.line : this.measure.line;
    this.drag = {pointerId, tool, x, y, from: this.toPlace(x, y), end: this.measure.endAt(line, x, y)};
    TOOLS[tool].press?.(this, event);
  }

  move(event) {
    const {drag} = this, {offsetX: x, offsetY: y} = event, {move, isStepwise} = TOOLS[drag.tool];
    move?.(this, {x, y, dx: x - drag.x, dy: y - drag.y, event});
    if (isStepwise) Object.assign(drag, {x, y});
  }

  // Sets a cursor that shows whether a drag would move the end of a line or the divider.
  hover({offsetX: x, offsetY: y}) {
    const line = {section: this.line, measure: this.measure.line}[this.tool];
    this.element.classList.toggle("at-divider", this.comparing.isAt(x));
    this.element.classList.toggle("at-end", Boolean(line && this.measure.endAt(line, x, y)));
    if (this.tool === "measure") this.measure.point(this.toPlace(x, y));
    if (this.tool === "brush") this.on.brush.point(this, [x, y]);
  }

  release() {
    const {drag} = this;
    this.drag = this.sun = null;
    TOOLS[drag?.tool]?.release?.(this, drag);
    this.element.classList.remove("dragging");
    if (drag?.tool !== "brush") this.doc.endGesture(); // the brush ends its gesture when all its points are found
    this.drawOverlay();
  }

  figureMiddle() {
    const [low, high] = this.facts?.relief_mm ?? [[0, 0], [0, 0]];
    return [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
  }

  orbit(yaw, pitch) {
    const {camera} = this;
    this.look({yaw: clamp(camera.yaw + yaw, -80, 80), pitch: clamp(camera.pitch + pitch, -80, 80)});
  }

  shift = (x, y) => this.look({x: this.camera.x + x, y: this.camera.y + y});

  setLine(line) {
    this.line = line;
    this.drawOverlay();
    this.invalidate();
  }

  // Undoes the changes of the running drag, and ignores the rest of the drag. Returns whether there were any changes.
  takeBack() {
    const isEnded = ["turn", "place"].includes(this.drag?.tool);
    if (isEnded) {
      Object.assign(this.drag, {tool: "none", angle: 0});
      this.turning.await(this.isAwaiting);
      this.drawOverlay();
      this.invalidate();
    }
    const isLifted = this.on.brush.cancel();
    return this.doc.cancelGesture() || isEnded || isLifted;
  }

  zoom(event) {
    event.preventDefault();
    if (this.tool === "place" && !this.facts) return; // there is no figure yet
    if (this.tool === "place") return this.on.placing.scale(Math.exp(-event.deltaY * 0.0005), this.facts.size_mm);
    this.zoomBy(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
  }

  // Zooms, and keeps the point under a pixel where it is.
  zoomBy(factor, atX, atY) {
    const {camera} = this, zoom = clamp(camera.zoom * factor, 0.3, 40), rest = 1 - camera.zoom / zoom;
    const [x, y] = this.toPlace(atX, atY);
    this.look(zoom <= 1 ? {zoom, x: 0, y: 0}
      : {zoom, x: camera.x + rest * (x - camera.x), y: camera.y + rest * (y - camera.y)});
  }
}
