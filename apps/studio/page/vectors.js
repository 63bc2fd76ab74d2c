// Computes with vectors, which are arrays of three numbers.

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const unit = (a) => a.map((x) => x / Math.hypot(...a));

// Returns `a` rotated about a unit axis.
export const turned = (a, axis, angle) => {
  const c = Math.cos(angle), s = Math.sin(angle), side = cross(axis, a), along = dot(axis, a) * (1 - c);
  return a.map((x, i) => x * c + side[i] * s + axis[i] * along);
};

// Returns the unit vector along the part of `up` that is perpendicular to the unit vector `towards`. If `up` is
// parallel to `towards`, uses another axis in its place.
export const upright = (up, towards) => {
  let right = cross(up, towards);
  const other = Math.abs(towards[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0];
  if (Math.hypot(...right) < 1e-6) right = cross(other, towards);
  return cross(towards, unit(right));
};

// Convert directions to the text of the command line, and back.
export const text = (a) => a.map((x) => Number(x.toFixed(4))).join(",");
export const triple = (t) => t.split(",").map(Number);
