// Crops the scan: shows a picture of the whole scan with a frame that the user draws, moves and resizes. The relief
// leaves out everything outside the frame.

import {$, clamp, make, paint, pictureScale, placeIn} from "../controls.js";
import {directionsOf, pictureKey} from "../directions.js";
import {WHOLE, cropText, numbersOf} from "../panels/scan_panel.js";

const LEAST = 0.05; // least width and height of the frame, as a share of the scan's box
const NEAR = 14; // the pointer grabs a side within this distance, in pixels
const KEY_STEP = 0.01; // a fraction of the scan's box

// Returns the bounding box of the pixels that are not transparent, in pixels of the page. `scale` is the number of the
// picture's pixels per pixel of the page.
function boxOf({data, width, height}, scale) {
  const colours = new Uint32Array(data.buffer, data.byteOffset, width * height); // 0 for transparent pixels
  let left = width, right = 0, top = height, bottom = 0;
  for (let y = 0, i = 0; y < height; ++y)
    for (let x = 0; x < width; ++x, ++i) {
      if (colours[i] === 0) continue;
      left = Math.min(left, x);
      right = Math.max(right, x + 1);
      top = Math.min(top, y);
      bottom = Math.max(bottom, y + 1);
    }
  return right === 0 ? null : {left: left / scale, top: top / scale, width: (right - left) / scale,
    height: (bottom - top) / scale};
}

// Returns the crop after one side was moved to the fraction `share` of the box. Sides are numbered: 0 left, 1 bottom, 2
// right, 3 top.
function withSide(numbers, side, share) {
  const other = numbers[(side + 2) % 4], moved = [...numbers];
  moved[side] = side < 2 ? clamp(share, 0, other - LEAST) : clamp(share, other + LEAST, 1);
  return moved;
}

function movedBy(numbers, x, y) {
  const [dx, dy] = [clamp(x, -numbers[0], 1 - numbers[2]), clamp(y, -numbers[1], 1 - numbers[3])];
  return [numbers[0] + dx, numbers[1] + dy, numbers[2] + dx, numbers[3] + dy, ...numbers.slice(4)];
}

export class CropFrame {
  // Calls done() when the user closes the frame, and failed(error) if the scan cannot be drawn.
  constructor({engine, doc, done, failed}) {
    Object.assign(this, {engine, doc, failed, key: "", box: null, drag: null});
    this.element = $("#crop-frame");
    this.canvas = $("canvas", this.element);
    this.overlay = $("svg", this.element);
    $("#crop-done").onclick = done;
    $("#crop-whole").onclick = () => this.choose([...WHOLE.slice(0, 4), ...this.numbers.slice(4)]);
    this.listen();
  }

  show(isShown) {
    this.element.hidden = !isShown;
    this.drag = null;
    if (isShown) this.refresh();
  }

  // Returns the document's crop; during a drag, the crop as dragged so far.
  get numbers() {
    return this.drag?.numbers ?? numbersOf(this.doc.now.options.crop);
  }

  choose(numbers) {
    this.doc.change({options: {crop: cropText(numbers)}});
    this.draw();
  }

  // Draws the frame. Also draws the scan if its view or the size of the page has changed.
  async refresh() {
    if (this.element.hidden) return; // must come first: reading sizes makes the browser compute the layout
    const {clientWidth: width, clientHeight: height} = this.element, directions = directionsOf(this.doc.now.options);
    if (!width || !directions) return;
    const key = `${width} x ${height} ${pictureKey(directions, this.doc.now)}`;
    if (key === this.key) return this.draw();
    this.key = key;
    this.box = null;
    try {
      const scale = pictureScale({width, height}), [wide, high] = [width, height].map((x) => Math.round(x * scale));
      const {image} = await this.engine.scan({...directions, width: wide, height: high});
      if (key !== this.key) return;
      paint(this.canvas, image);
      this.box = boxOf(image, scale);
    } catch (error) {
      this.key = "";
      return this.failed(error);
    }
    this.draw();
  }

  get frame() {
    const [x0, y0, x1, y1] = this.numbers, {left, top, width, height} = this.box;
    return {left: left + x0 * width, right: left + x1 * width, top: top + (1 - y1) * height,
      bottom: top + (1 - y0) * height};
  }

  draw() {
    if (this.element.hidden || !this.box) return this.overlay.replaceChildren();
    const {left, right, top, bottom} = this.frame, {clientWidth, clientHeight} = this.element;
    this.overlay.setAttribute("viewBox", `0 0 ${clientWidth} ${clientHeight}`);
    const xs = [left, (left + right) / 2, right], ys = [top, (top + bottom) / 2, bottom];
    const handles = xs.flatMap((x, i) => ys.map((y, j) => (i === 1 && j === 1 ? null
      : make("rect", {class: "handle", x: x - 5, y: y - 5, width: 10, height: 10, rx: 2})))).filter(Boolean);
    const inside = `M${left} ${top}V${bottom}H${right}V${top}Z`;
    this.overlay.replaceChildren(
      make("path", {class: "outside", d: `M0 0H${clientWidth}V${clientHeight}H0Z${inside}`}),
      make("rect", {class: "frame", x: left, y: top, width: right - left, height: bottom - top}), ...handles);
    $("#crop-whole").disabled = this.numbers.slice(0, 4).every((x, i) => x === WHOLE[i]);
  }

  // ----------------------------------------------------------------------- input

  listen() {
    const {element} = this;
    const place = (act) => (event) => {
      event.stopPropagation(); // the stage below the frame must not handle it
      if (event.target.closest("button")) return;
      act(...placeIn(element, event), event);
    };
    element.onpointerdown = place((x, y, event) => this.press(x, y, event));
    const isOther = ({pointerId}) => this.drag && pointerId !== this.drag.pointerId; // e.g. a palm while a pen draws
    element.onpointermove = place((x, y, event) =>
      (!this.drag ? this.hover(x, y) : isOther(event) || this.move(x, y)));
    element.onpointerup = place((x, y, event) => isOther(event) || this.release());
    element.onpointercancel = (event) => isOther(event) || this.giveUp();
    element.ondblclick = (event) => event.stopPropagation();
    element.addEventListener("wheel", (event) => event.stopPropagation());
    new ResizeObserver(() => this.refresh()).observe(element);
  }

  sidesAt(x, y) {
    const {left, right, top, bottom} = this.frame, isBeside = (at, low, high) => at > low - NEAR && at < high + NEAR;
    const across = [[0, left], [2, right]].filter(([, at]) => Math.abs(x - at) < NEAR && isBeside(y, top, bottom));
    const along = [[1, bottom], [3, top]].filter(([, at]) => Math.abs(y - at) < NEAR && isBeside(x, left, right));
    const nearest = (sides, at) => sides.sort((a, b) => Math.abs(a[1] - at) - Math.abs(b[1] - at)).slice(0, 1);
    return [...nearest(across, x), ...nearest(along, y)].map(([side]) => side);
  }

  isInside(x, y) {
    const {left, right, top, bottom} = this.frame;
    return x > left && x < right && y > top && y < bottom && cropText([...this.numbers.slice(0, 4), 0, 1]) !== "";
  }

  // Returns the position of a pixel as fractions of the width and the height of the scan's box, counted from its lower
  // left corner.
  shares(x, y) {
    const {left, top, width, height} = this.box;
    return [clamp((x - left) / width, 0, 1), clamp(1 - (y - top) / height, 0, 1)];
  }

  // Begins a drag. A drag that begins at a side or a corner moves that side or corner; inside the frame it moves the
  // frame; elsewhere it draws a new frame.
  press(x, y, event) {
    if (!this.box || event.button !== 0 || !event.isPrimary || this.drag) return;
    this.element.setPointerCapture(event.pointerId);
    const {pointerId} = event, sides = this.sidesAt(x, y), isMove = this.isInside(x, y);
    this.drag = {pointerId, x, y, sides, isMove, from: this.numbers};
  }

  move(x, y) {
    const {drag, box} = this, {sides, from} = drag, [across, up] = this.shares(x, y);
    if (Math.hypot(x - drag.x, y - drag.y) < 3) return;
    drag.numbers = from;
    if (sides.length > 0)
      for (const side of sides) drag.numbers = withSide(drag.numbers, side, side % 2 === 0 ? across : up);
    else if (drag.isMove) drag.numbers = movedBy(from, (x - drag.x) / box.width, (drag.y - y) / box.height);
    else drag.numbers = this.drawn(this.shares(drag.x, drag.y), [across, up]);
    this.draw();
  }

  // Returns the crop whose opposite corners are a and b. Its depths stay unchanged.
  drawn(a, b) {
    const low = [0, 1].map((k) => Math.min(a[k], b[k], 1 - LEAST)), depths = this.drag.from.slice(4);
    return [...low, ...low.map((x, k) => Math.max(a[k], b[k], x + LEAST)), ...depths];
  }

  // Sets a cursor that shows whether a drag would move, resize or draw the frame.
  hover(x, y) {
    if (!this.box) return;
    const sides = this.sidesAt(x, y).sort(), isRising = ["0,1", "2,3"].includes(String(sides));
    const one = sides[0] % 2 === 0 ? "ew-resize" : "ns-resize", corner = isRising ? "nesw-resize" : "nwse-resize";
    this.element.style.cursor = sides.length === 2 ? corner : sides.length === 1 ? one
      : this.isInside(x, y) ? "move" : "crosshair";
  }

  release() {
    const {numbers} = this.drag ?? {};
    this.drag = null;
    if (numbers) this.choose(numbers);
  }

  // Cancels the running drag. Returns whether a drag was running.
  giveUp() {
    const ran = Boolean(this.drag);
    this.drag = null;
    this.draw();
    return ran;
  }

  step = (x, y) => this.choose(movedBy(this.numbers, x * KEY_STEP, y * KEY_STEP));
}
