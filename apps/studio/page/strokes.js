// Reads, simplifies, erases and packs strokes of a brush. They are plain data: the value of the option `strokes` is
// their JSON. Points are in the coordinates of the scan.

const sub = (a, b) => a.map((x, i) => x - b[i]), dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const along = (a, b, t) => a.map((x, i) => x + t * (b[i] - x));
const apart = (a, b) => Math.hypot(...sub(a, b));

// Returns the strokes of a step. Returns none for a text that is not a list of strokes; the engine refuses that text.
export function strokesOf({options: {strokes: text}}) {
  try {
    const strokes = JSON.parse(text || "[]");
    return Array.isArray(strokes) ? strokes : [];
  } catch {
    return [];
  }
}

export const textOf = (strokes) => (strokes.length > 0 ? JSON.stringify(strokes) : "");

function distanceToLine(p, a, b) {
  const line = sub(b, a), square = dot(line, line);
  const t = square > 0 ? Math.min(1, Math.max(0, dot(sub(p, a), line) / square)) : 0;
  return apart(p, along(a, b, t));
}

// Simplifies a line by the algorithm of Douglas and Peucker. The result deviates from the line by at most `tolerance`.
export function simplified(points, tolerance) {
  const first = points[0], last = points.at(-1);
  let most = 0, at = 0;
  for (let i = 1; i < points.length - 1; ++i) {
    const distance = distanceToLine(points[i], first, last);
    if (distance > most) [most, at] = [distance, i];
  }
  if (most > tolerance)
    return [...simplified(points.slice(0, at + 1), tolerance).slice(0, -1), ...simplified(points.slice(at), tolerance)];
  return points.length > 1 ? [first, last] : [first];
}

// Finds the part of the line through a and b that is within the radius of a point. Returns the two ends of this part,
// as shares of the way from a to b. Returns null if no part of the segment from a to b is within the radius.
function within(a, b, point, radius) {
  const line = sub(b, a), from = sub(a, point);
  const square = dot(line, line), half = dot(from, line), rest = dot(from, from) - radius * radius;
  const root = half * half - square * rest;
  if (square === 0 || root < 0) return square === 0 && rest < 0 ? [0, 1] : null;
  const [low, high] = [-1, 1].map((sign) => (-half + sign * Math.sqrt(root)) / square);
  return high > 0 && low < 1 ? [low, high] : null;
}

// Returns the parts of a line that are further than the radius from a point.
function partsOutside(points, point, radius) {
  if (points.length === 1) return apart(points[0], point) < radius ? [] : [points];
  const parts = [];
  let part = [];
  const close = () => (part.length > 1 && parts.push(part), (part = []));
  for (let i = 1; i < points.length; ++i) {
    const [a, b] = [points[i - 1], points[i]], cut = within(a, b, point, radius);
    if (part.length === 0 && !(cut && cut[0] <= 0)) part.push(a);
    if (cut && cut[0] > 0) part.push(along(a, b, cut[0]));
    if (cut) close();
    if (cut && cut[1] < 1) part.push(along(a, b, cut[1]));
    if (!cut || cut[1] < 1) part.push(b);
  }
  close();
  return parts;
}

// Erases the parts of strokes within the radius of a point. A line that is cut in the middle becomes two strokes. A
// lasso is erased as a whole if a part of its edge is within the radius. A region is erased if its point is within the
// radius.
export const erased = (strokes, point, radius) => strokes.flatMap((stroke) => {
  const {area = "line", points: [first]} = stroke, isLine = area === "line";
  const outline = area === "lasso" ? [...stroke.points, first] : stroke.points;
  const parts = partsOutside(outline, point, radius);
  if (!isLine) return parts.length === 1 && parts[0].length === outline.length &&
    parts[0].every((corner, i) => apart(corner, outline[i]) === 0) ? [stroke] : [];
  return parts.map((points, i) => ({...stroke, ...(i > 0 && {name: `${stroke.name}, part ${i + 1}`}), points}));
});

// Packs steps so that shared strokes are stored once. Returns steps with indices in place of strokes, and the strokes.
export function packed(steps) {
  const strokes = [], numbers = new Map();
  const numberOf = (stroke) => {
    const key = JSON.stringify(stroke);
    if (!numbers.has(key)) numbers.set(key, strokes.push(stroke) - 1);
    return numbers.get(key);
  };
  const pack = (step) => {
    const own = strokesOf(step);
    return own.length > 0 ? {...step, options: {...step.options, strokes: own.map(numberOf)}} : step;
  };
  return {steps: steps.map(pack), ...(strokes.length > 0 && {strokes})};
}

// Unpacks the options of a step that packed() packed together with these strokes.
export const unpacked = (options, strokes = []) => (Array.isArray(options.strokes)
  ? {...options, strokes: textOf(options.strokes.map((number) => strokes[number]).filter(Boolean))} : options);
