// Turns one drag of the brush into a stroke of the document.

import {clamp, oneAtATime} from "../controls.js";
import {erased, simplified, strokesOf, textOf} from "../strokes.js";

// `most` is the amount of a stroke at a strength of 100 %.
export const KINDS = {
  soften: {label: "Soften", most: 1}, sharpen: {label: "Sharpen", most: 2}, strengthen: {label: "Strengthen", most: 2},
  raise: {label: "Raise", most: 0.3}, sink: {label: "Sink", most: 0.3}, level: {label: "Level", most: 1},
  protect: {label: "Protect", most: 1}, "in-front": {label: "Bring in front", most: 0.3},
  erase: {label: "Erase strokes"},
};
export const AREAS = {line: "Line", lasso: "Lasso", region: "Region"};
const APART = 1 / 6, LEAST_APART = 2; // least distance between positions along a stroke, in radii and in pixels
const TOLERANCE = 1 / 40; // distance by which a simplified line may deviate from the drawn one, in radii
const DIGITS = 1e5; // points are rounded to multiples of the figure's longer side divided by this

// Returns a new name such as "Soften 2".
function newName({label}, strokes) {
  const numbers = strokes.map(({name}) => Number(name?.match(/^(\D+) (\d+)$/)?.[1] === label && name.match(/\d+$/)[0]));
  return `${label} ${1 + Math.max(0, ...numbers)}`;
}

// One drag of the brush. It changes the document in one step.
export class Painting {
  static count = 0;

  constructor(brush, stage) {
    const {engine: {document}, doc, settings} = brush;
    const area = settings.kind === "erase" ? "line" : settings.area;
    Object.assign(this, {brush, doc, document, settings: {...settings, area}, id: `brush ${++Painting.count}`,
      before: strokesOf(doc.now), ...brush.scaleOf(stage), waiting: [], lines: [[], []], pressures: [], trail: []});
    this.radius = this.longer * settings.size / 200;
    this.name = newName(KINDS[settings.kind], this.before);
    this.look = oneAtATime(() => this.lookUp());
  }

  // Continues the stroke at a pixel, unless that pixel is near the last one. A region has only its first position.
  follow(stage, [x, y], pressure) {
    if (this.last && this.settings.area === "region") return;
    const least = Math.max(LEAST_APART, APART * this.brush.radiusIn(stage));
    if (this.last && Math.hypot(x - this.last[0], y - this.last[1]) < least) return;
    this.last = [x, y];
    this.trail.push(this.last);
    this.pressures.push(pressure);
    this.waiting.push(this.brush.shareOf(stage, [x, y]));
    this.look();
  }

  // Asks the engine for the points of the model under the new positions, and changes the document.
  async lookUp() {
    const places = this.waiting.splice(0), {isMirrored} = this.settings;
    const mirrored = isMirrored ? places.map(([u, v]) => [1 - u, v]) : [];
    if (places.length > 0) {
      const all = [...places, ...mirrored], points = await this.brush.engine.pointsUnder(all).catch(() => []);
      const found = points.map((point, i) => point ?? this.pointBeside(all[i]));
      [found.slice(0, places.length), found.slice(places.length)].forEach((part, i) =>
        this.lines[i].push(...part.filter(Boolean).map((point) => point.map((x) => this.rounded(x)))));
      if (!this.isLasso) this.show();
    }
    if (!this.isOver || this.waiting.length > 0) return;
    if (this.isLasso) this.show();
    this.doc.endGesture(this.id);
  }

  get isLasso() {
    return this.settings.area === "lasso";
  }

  // Returns a lasso's corner at a position beside the model, with the last corner's depth; null for other strokes.
  pointBeside(place) {
    const last = this.lines[0].at(-1);
    return this.isLasso && last ? this.brush.pointAt(place, last) : null;
  }

  rounded(x) {
    const digits = clamp(Math.ceil(Math.log10(DIGITS / this.longer)), 0, 20);
    return Number(x.toFixed(digits));
  }

  // Ends the drag. The stroke is finished when all its points are found.
  end() {
    this.isOver = true;
    this.look();
  }

  strokes() {
    const {kind, strength, softness, area} = this.settings;
    const lines = this.lines.filter((line) => line.length >= (this.isLasso ? 3 : 1));
    if (kind === "erase")
      return lines.flat().reduce((strokes, point) => erased(strokes, point, this.radius), this.before);
    const pressure = this.pressures.reduce((sum, x) => sum + x, 0) / this.pressures.length;
    const amount = Number((KINDS[kind].most * strength / 100 * pressure).toPrecision(3));
    const radius = Number(this.radius.toPrecision(5));
    const own = {line: {}, lasso: {area, direction: this.brush.toViewer}, region: {area, tolerance: this.settings.tolerance}};
    const cornersOf = (line) => (this.isLasso && line.length > 3
      ? [...simplified(line.slice(0, -1), TOLERANCE * this.radius), line.at(-1)] : simplified(line, TOLERANCE * this.radius));
    return [...this.before, ...lines.map((line, i) => ({name: i === 0 ? this.name : `${this.name}, mirrored`,
      brush: kind, amount, radius, softness: softness / 100, ...own[area], points: cornersOf(line)}))];
  }

  // Writes the stroke into the document, unless the document has had another change meanwhile.
  show() {
    const isOther = this.isBegun ? this.doc.gesture !== this.id : this.doc.now.options.strokes !== textOf(this.before);
    if (isOther || this.document !== this.brush.engine.document) this.isGivenUp = true;
    if (this.isGivenUp || this.lines.every((line) => line.length < (this.isLasso ? 3 : 1))) return;
    this.doc.change({options: {strokes: textOf(this.strokes())}}, this.id);
    this.isBegun = this.doc.gesture === this.id;
  }
}
