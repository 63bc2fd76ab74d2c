// Converts directions of light between vectors and angles, and lists the lights of the light table.

export const TABLE_LIGHTS = [
  {name: "Upper left", light: [-1, 1, 1]},
  {name: "Upper right", light: [1, 1, 1]},
  {name: "Raking, left", light: [-1, 0.12, 0.3]},
  {name: "Raking, above", light: [0.1, 1, 0.3]},
];

export const degrees = (radians) => radians * 180 / Math.PI;
export const radians = (angle) => angle * Math.PI / 180;

// Returns an angle as a whole number of degrees from 0 to 359.
export const whole = (angle) => ((Math.round(angle) % 360) + 360) % 360;

// Converts an azimuth and an elevation in degrees to a vector, and back.
export const direction = (azimuth, elevation) => {
  const flat = Math.cos(radians(elevation));
  return [flat * Math.cos(radians(azimuth)), flat * Math.sin(radians(azimuth)), Math.sin(radians(elevation))];
};
export const angles = ([x, y, z]) =>
  ({azimuth: degrees(Math.atan2(y, x)), elevation: degrees(Math.atan2(z, Math.hypot(x, y)))});
