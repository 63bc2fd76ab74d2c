// Makes files from arrays: PLY from clouds and meshes, TIFF from depths. The engine reads them like any other file.

function expectLength(name, array, length) {
  if (array.length !== length)
    throw new TypeError(`${name}: expected ${length} numbers, found ${array.length}`);
}

// Converts numbers to a typed array. Also accepts rows of numbers: [[x, y, z], ...].
function typedArray(name, given, Type) {
  const array = Array.isArray(given?.[0]) || ArrayBuffer.isView(given?.[0]) ? Array.from(given, (row) => [...row]).flat() : given;
  if (ArrayBuffer.isView(array) || Array.isArray(array)) return array instanceof Type ? array : Type.from(array);
  throw new TypeError(`${name}: expected an array of numbers`);
}

// Returns a PLY file with points (x, y and z of each point in turn) and, if they are given, normals, colours and faces.
export function cloudFile({ points, normals, colours, faces }) {
  const p = typedArray("points", points, Float64Array), count = Math.ceil(p.length / 3);
  expectLength("points", p, 3 * count);
  const n = normals && typedArray("normals", normals, Float32Array), c = colours && typedArray("colours", colours, Uint8Array);
  const f = faces && typedArray("faces", faces, Uint32Array);
  if (n) expectLength("normals", n, p.length);
  if (c) expectLength("colours", c, p.length);
  if (f) expectLength("faces", f, 3 * Math.ceil(f.length / 3));
  const header = ["ply", "format binary_little_endian 1.0", `element vertex ${count}`,
    ...["x", "y", "z"].map((name) => `property double ${name}`),
    ...(n ? ["nx", "ny", "nz"] : []).map((name) => `property float ${name}`),
    ...(c ? ["red", "green", "blue"] : []).map((name) => `property uchar ${name}`),
    ...(f ? [`element face ${f.length / 3}`, "property list uchar uint vertex_indices"] : []), "end_header", ""].join("\n");
  const head = new TextEncoder().encode(header);
  const stride = 24 + (n ? 12 : 0) + (c ? 3 : 0);
  const bytes = new Uint8Array(head.length + count * stride + (f ? (f.length / 3) * 13 : 0));
  bytes.set(head);
  const view = new DataView(bytes.buffer);
  let at = head.length;
  for (let i = 0; i < 3 * count; i += 3) {
    for (let k = 0; k < 3; k++, at += 8) view.setFloat64(at, p[i + k], true);
    if (n) for (let k = 0; k < 3; k++, at += 4) view.setFloat32(at, n[i + k], true);
    if (c) for (let k = 0; k < 3; k++, at++) bytes[at] = c[i + k];
  }
  for (let i = 0; f && i < f.length; i += 3) {
    bytes[at++] = 3;
    for (let k = 0; k < 3; k++, at += 4) view.setUint32(at, f[i + k], true);
  }
  return bytes;
}

// Returns a TIFF file of depths, row by row.
export function depthFile({ depths, width, height }) {
  const values = typedArray("depths", depths, Float32Array);
  expectLength("depths", values, width * height);
  const LONG = 4, SHORT = 3, FLOAT = 3, fields = [
    [256, LONG, width], [257, LONG, height], [258, SHORT, 32], [259, SHORT, 1], [262, SHORT, 1], [273, LONG, 8],
    [277, SHORT, 1], [278, LONG, height], [279, LONG, 4 * values.length], [339, SHORT, FLOAT]];
  const directory = 8 + 4 * values.length;
  const view = new DataView(new ArrayBuffer(directory + 2 + 12 * fields.length + 4));
  view.setUint32(0, 0x002a4949, true);
  view.setUint32(4, directory, true);
  values.forEach((value, i) => view.setFloat32(8 + 4 * i, value, true));
  view.setUint16(directory, fields.length, true);
  fields.forEach(([tag, type, value], i) => {
    const at = directory + 2 + 12 * i;
    view.setUint16(at, tag, true);
    view.setUint16(at + 2, type, true);
    view.setUint32(at + 4, 1, true);
    type === SHORT ? view.setUint16(at + 8, value, true) : view.setUint32(at + 8, value, true);
  });
  return new Uint8Array(view.buffer);
}
