// What the tests share: the package as it was built, and the native program to compare with.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

export const packageFolder = process.env.PACKAGE ?? path.resolve(import.meta.dirname ?? ".", "../../build/web/npm");
export const relievo = await import(pathToFileURL(path.join(packageFolder, "src/index.js")));
export const native = process.env.RELIEVO;

export function temporaryFolder(t) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "relievo-npm-"));
  t.after(() => fs.rmSync(folder, { recursive: true, force: true }));
  return folder;
}

export function run(program, args, options = {}) {
  return execFileSync(program, args, { encoding: "utf8", stdio: "pipe", ...options });
}

// Returns the corners and triangles of a PLY solid that Relievo wrote.
export function readPly(bytes) {
  const text = Buffer.from(bytes.buffer, bytes.byteOffset, Math.min(bytes.length, 4096)).toString("latin1");
  const at = text.indexOf("end_header\n") + "end_header\n".length;
  const count = (element) => Number(text.match(new RegExp(`element ${element} (\\d+)`))[1]);
  const properties = [...text.slice(0, text.indexOf("element face")).matchAll(/property (\w+) \w+/g)].map(([, type]) => type);
  const sizes = { float: 4, double: 8, uchar: 1 }, stride = properties.reduce((sum, type) => sum + sizes[type], 0);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const points = [], faces = [];
  for (let i = 0; i < count("vertex"); i++) {
    const p = at + i * stride;
    points.push(properties[0] === "double" ? [0, 8, 16].map((k) => view.getFloat64(p + k, true)) : [0, 4, 8].map((k) => view.getFloat32(p + k, true)));
  }
  for (let i = 0, p = at + points.length * stride; i < count("face"); i++, p += 13)
    faces.push([1, 5, 9].map((k) => view.getUint32(p + k, true)));
  return { points, faces };
}
