// Draws the outlines of texts and borders over the picture while the picture itself lacks them, and the handle that
// moves the chosen text or drawing. A drag moves the outlines at once; the picture follows later.

import {ARROWS, Pause, make, placeIn} from "../controls.js";
import {isMirrored} from "../document.js";
import {degrees, radians, whole} from "../lights.js";
import {angleOf, hasPlace, isOnArc, nameOf} from "../panels/ornaments.js";
import {GESTURE_END_MS} from "../panels/slider.js";

const BESIDE = 30; // distance from the middle of the letters to their handle, in pixels

export const rounded = (mm) => Math.round(mm * 100) / 100;

// Returns the outlines as the data of an SVG path, in mm.
const pathOf = (outlines) => outlines.map((numbers) => {
  let path = "";
  for (let i = 0; i < numbers.length; i += 2) path += `${i ? "L" : "M"}${numbers[i]} ${numbers[i + 1]}`;
  return `${path}Z`;
}).join("");

// Returns the centre of the outlines' box, and the mean of their least and largest distance from the piece's centre.
function extentOf(outlines) {
  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  let nearest = Infinity, farthest = 0;
  for (const numbers of outlines)
    for (let i = 0; i < numbers.length; i += 2) {
      const place = [numbers[i], numbers[i + 1]], far = Math.hypot(...place);
      [nearest, farthest] = [Math.min(nearest, far), Math.max(farthest, far)];
      place.forEach((x, k) => ([low[k], high[k]] = [Math.min(low[k], x), Math.max(high[k], x)]));
    }
  return {middle: low.map((x, k) => (x + high[k]) / 2), radius: (nearest + farthest) / 2};
}

export class LetterMarks {
  // `panel` knows the document's ornaments and which of them is chosen. panel.set(at, part, gesture) changes an ornament.
  constructor({stage, doc, panel}) {
    Object.assign(this, {stage, doc, panel, placed: [], drag: null});
    this.rest = new Pause(() => doc.endGesture("letters"), GESTURE_END_MS);
    this.handle = make("button", {type: "button", class: "letter-handle", hidden: true});
    this.listen();
    stage.element.append(this.handle);
    stage.letterMarks = (facts) => this.marks(facts);
  }

  // Takes the outlines of the list's ornaments, as the engine has placed them.
  take(list, places) {
    this.placed = places.map(({outlines, at}, i) =>
      ({ornament: list[i], at, path: pathOf(outlines), ...extentOf(outlines)}));
    this.stage.drawOverlay();
  }

  get sign() {
    return isMirrored(this.doc.now) ? -1 : 1;
  }

  // Returns an ornament's movement since the engine placed it, as an SVG transform, and its handle's position in mm.
  movement(ornament, {ornament: was, at, middle, radius}) {
    const {sign} = this;
    if (isOnArc(ornament) && isOnArc(was)) {
      const turn = sign * (angleOf(ornament) - angleOf(was));
      const angle = radians(sign * angleOf(ornament) + (sign < 0 ? 180 : 0));
      return {transform: `rotate(${turn})`, handle: [radius * Math.cos(angle), radius * Math.sin(angle)]};
    }
    const to = ornament.at ?? at, by = to && at && hasPlace(ornament) ? [sign * (to[0] - at[0]), to[1] - at[1]] : [0, 0];
    return {transform: `translate(${by})`, handle: hasPlace(ornament) ? middle.map((x, i) => x + by[i]) : null};
  }

  // Returns the outlines to draw over a picture, and shows the handle at its position. While the piece is seen
  // obliquely or is bent, there are no outlines and no handle.
  marks(facts) {
    const {stage, panel} = this, {yaw, pitch} = stage.camera, {list, chosen} = panel;
    const isFlat = facts && yaw === 0 && pitch === 0 && this.doc.now.options.wrap === "none" && !facts.isTurned;
    if (!isFlat || !panel.isShown) return this.showHandle(null), [];
    const [x, y] = stage.toPixels([0, 0]), scale = stage.pixelsPerMm;
    if (!this.placed[chosen]?.path || !list[chosen]) this.showHandle(null);
    const base = `translate(${x} ${y}) scale(${scale} ${-scale}) `;
    return this.placed.flatMap((placed, i) => {
      if (!list[i] || !placed.path) return [];
      const {transform, handle} = this.movement(list[i], placed), isChosen = i === chosen;
      if (isChosen) this.showHandle(list[i], handle);
      const isHidden = facts.has_ornaments && !(isChosen && this.drag);
      const look = facts.ornament_error ? " refused" : "";
      return isHidden ? [] : [make("path", {class: `letter${look}`, d: placed.path, transform: base + transform})];
    });
  }

  // Returns the pixel of the handle: beside the letters, towards the middle of the piece.
  besides(ornament, place) {
    const [x, y] = this.stage.toPixels(place), [middleX, middleY] = this.stage.toPixels([0, 0]);
    if (!isOnArc(ornament)) return [x, y > middleY ? y - BESIDE : y + BESIDE];
    const far = Math.hypot(x - middleX, y - middleY), near = far > 0 ? Math.max(0, far - BESIDE) / far : 1;
    return [middleX + near * (x - middleX), middleY + near * (y - middleY)];
  }

  // Shows the handle of an ornament at a position, or hides it. A handle that is hidden loses the focus.
  showHandle(ornament, place = null) {
    this.handle.hidden = place === null;
    if (place === null) return;
    const [left, top] = this.besides(ornament, place), label = `Move ${nameOf(ornament)} by dragging or arrow keys`;
    Object.assign(this.handle.style, {left: `${left}px`, top: `${top}px`});
    if (this.handle.ariaLabel !== label) Object.assign(this.handle, {ariaLabel: label, title: label});
  }

  listen() {
    const {handle, stage} = this, place = (event) => stage.toPlace(...placeIn(stage.element, event));
    handle.onpointerdown = (event) => {
      event.stopPropagation(); // the picture's tool must not handle it
      handle.setPointerCapture(event.pointerId);
      this.doc.endGesture();
      const {list, chosen} = this.panel, at = list[chosen].at ?? this.placed[chosen]?.at ?? [0, 0];
      this.drag = {from: place(event), ornament: list[chosen], at};
    };
    handle.onpointermove = (event) => {
      event.stopPropagation();
      if (this.drag) this.move(place(event));
    };
    handle.onlostpointercapture = () => {
      this.drag = null;
      this.doc.endGesture("letters");
      this.stage.drawOverlay();
      this.panel.refresh();
    };
    handle.ondblclick = (event) => event.stopPropagation();
    handle.onkeydown = (event) => this.step(event);
  }

  // Moves or turns the chosen ornament as the pointer has moved since the beginning of the drag.
  move([x, y]) {
    const {drag: {from, ornament, at}, sign} = this;
    if (!isOnArc(ornament)) return this.change({at: [at[0] + sign * (x - from[0]), at[1] + y - from[1]]});
    const turn = degrees(Math.atan2(y, x) - Math.atan2(from[1], from[0]));
    this.change({angle: angleOf(ornament) + sign * turn});
  }

  step(event) {
    const step = ARROWS[event.key], {list, chosen} = this.panel, ornament = list[chosen];
    if (!step || !ornament) return;
    event.preventDefault();
    event.stopPropagation();
    const {sign} = this, [right, up] = step;
    const {at = this.placed[chosen]?.at ?? [0, 0]} = ornament, mm = event.shiftKey ? 0.1 : 0.5;
    if (!isOnArc(ornament)) this.change({at: [at[0] + sign * right * mm, at[1] + up * mm]});
    else this.change({angle: angleOf(ornament) - sign * (right || up) * (event.shiftKey ? 1 : 5)});
    this.rest.begin();
  }

  change({at, angle}) {
    this.panel.set(this.panel.chosen, at ? {at: at.map(rounded)} : {angle: whole(angle)}, "letters");
    this.stage.drawOverlay();
  }
}
