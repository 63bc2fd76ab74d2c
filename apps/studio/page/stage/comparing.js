// Compares the relief with its rival: the model, or the relief of a snapshot. Draws the picture of the rival over that
// of the relief, with the same size and position of the figure. The engine fits each picture to its own plate. The
// model's plate is the figure with its margin, so the two pictures need different zooms.

import {$, clamp, make} from "../controls.js";
import {isMirrored} from "../document.js";
import {isRound} from "./measure.js";

const NEAR = 12; // the pointer grabs the divider within this distance, in pixels
// If the ratio of two zooms differs from 1 by less than this, the pictures differ by less than a pixel.
const ALIKE = 1e-3;
const LEAST_ZOOM = 0.05, MOST_ZOOM = 100; // the engine's limits of the zoom

export class Comparing {
  constructor(stage) {
    this.stage = stage;
    this.canvas = $("#before");
    this.split = 0.5;
    this.ratio = 1; // zoom of the model divided by the zoom of the relief
  }

  get isShown() {
    return Boolean(this.isComparing || this.isHolding);
  }

  // Shows the model on one side of a divider (isComparing) or in place of the relief (isHolding). With hasAttention the
  // model is coloured by its attention. If `rival` is not null, it has the settings of a snapshot, and the relief with
  // these settings takes the place of the model.
  set(how) {
    Object.assign(this, how);
    this.canvas.hidden = !this.isShown;
    this.setSplit(this.split);
    this.stage.invalidate();
  }

  setSplit(share) {
    const {stage, isComparing, isHolding} = this;
    this.split = share;
    $("#split").value = 1000 * share;
    this.canvas.style.clipPath = isHolding ? "none" : `inset(0 ${(1 - share) * 100}% 0 0)`;
    const cut = isComparing ? `inset(0 0 0 ${share * 100}%)` : "none";
    stage.picture.style.clipPath = isHolding ? "inset(100%)" : cut;
    stage.drawOverlay();
  }

  // Returns whether the divider is near the coordinate `x`, which is in pixels.
  isAt(x) {
    const isShown = this.isComparing && !this.isHolding;
    return isShown && Math.abs(x - this.split * this.stage.size.width) < NEAR;
  }

  drag = (x) => this.setSplit(clamp(x / this.stage.size.width, 0, 1));

  marks({width, height}) {
    const x = this.split * width;
    return this.isComparing && !this.isHolding
      ? [make("line", {class: "divide", x1: x, y1: 0, x2: x, y2: height})] : [];
  }

  // Returns the settings that are compared; null for the model.
  get shownRival() {
    return this.isHolding ? null : this.rival ?? null;
  }

  rivalRequest(isFine, isLast) {
    const {stage} = this, {light} = stage.doc.now;
    return stage.request({...stage.pictureSize(isFine), fine: isFine, finished: isLast, light},
      {...stage.doc.now, ...this.shownRival});
  }

  // Returns the request for the picture of the model. The camera looks at the centre of the figure, which need not be
  // the centre of the plate. If the figure is mirrored, camera and light are mirrored for the request, and paint()
  // mirrors the picture.
  request(isFine) {
    const {stage} = this, request = stage.request({...stage.pictureSize(isFine), fine: isFine, original: true,
      attention: Boolean(this.hasAttention)});
    const {camera, light} = request, [x, y] = stage.figureMiddle(), sign = isMirrored(stage.doc.now) ? -1 : 1;
    request.camera = {...camera, yaw: sign * camera.yaw, x: sign * (camera.x - x), y: camera.y - y};
    request.light = [sign * light[0], light[1], light[2]];
    return request;
  }

  // Draws the model, or the snapshot, at the size and position of the relief, unless the same picture is already drawn.
  // `isLast` is true for the last picture of a state, which shows the finished piece.
  async draw(isFine, isLast) {
    const {stage, shownRival: rival} = this, request = rival ? this.rivalRequest(isFine, isLast) : this.request(isFine);
    const {options, ...rest} = request, {margin, thickness, form} = options, {width_mm: width} = stage.facts;
    const wanted = rival ? [options] : [width, margin, thickness, form];
    const key = JSON.stringify([stage.model, stage.pixelsPerMm, Boolean(rival), wanted, rest]);
    if (key === this.drawn) return;
    request.camera = {...request.camera};
    const {zoom} = request.camera;
    for (let isAgain = false; ; isAgain = true) {
      request.camera.zoom = clamp(zoom * this.ratio, LEAST_ZOOM, MOST_ZOOM);
      const {image, facts} = await stage.engine.picture(request);
      const wrong = stage.pixelsPerMm / (facts.pixels_per_mm * stage.size.width / image.width);
      if (isAgain || Math.abs(wrong - 1) < ALIKE) return this.paint(image, key);
      this.ratio *= wrong;
    }
  }

  paint(image, key) {
    this.drawn = key;
    const {canvas} = this, context = canvas.getContext("2d");
    [canvas.width, canvas.height] = [image.width, image.height];
    context.putImageData(image, 0, 0);
    if (this.shownRival) return;
    if (isMirrored(this.stage.doc.now)) {
      context.globalCompositeOperation = "copy";
      context.setTransform(-1, 0, 0, 1, image.width, 0);
      context.drawImage(canvas, 0, 0);
      context.resetTransform();
    }
    this.layOnPlate(context, image.width / this.stage.size.width);
  }

  // In the front view, replaces the model's own rectangular plate by the plate of the piece, if the plate of the piece
  // is round or has a given size. `scale` is the number of the picture's pixels per pixel of the page.
  layOnPlate(context, scale) {
    const {stage} = this, {camera, facts: {relief_mm: figure, size_mm: size}} = stage;
    const {outline, plate, wrap, margin} = stage.doc.now.options, isEllipse = isRound(outline);
    if (!(isEllipse || plate) || wrap !== "none" || camera.yaw || camera.pitch || !figure) return;
    const at = (x, y) => stage.toPixels([x, y]).map((pixel) => pixel * scale);
    const [[left, bottom], [right, top]] = figure, [red, green, blue, opacity] =
      context.getImageData(...at(left, bottom).map(Math.round), 1, 1).data;
    if (opacity < 255) return; // the lower left corner of the figure is outside the picture
    const fill = (how, draw, from, to) => {
      context.globalCompositeOperation = how;
      context.beginPath();
      draw(from[0], to[1], to[0] - from[0], from[1] - to[1]);
      context.fill();
    };
    const box = (...sides) => context.rect(...sides), piece = (x, y, wide, high) => (isEllipse
      ? context.ellipse(x + wide / 2, y + high / 2, wide / 2, high / 2, 0, 0, 2 * Math.PI) : box(x, y, wide, high));
    const corners = [at(-size[0] / 2, -size[1] / 2), at(size[0] / 2, size[1] / 2)];
    context.fillStyle = `rgb(${red} ${green} ${blue})`;
    fill("destination-in", box, at(left - margin, bottom - margin), at(right + margin, top + margin));
    fill("destination-in", piece, ...corners);
    fill("destination-over", piece, ...corners);
  }
}
