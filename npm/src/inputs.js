// Converts arguments of users to files and requests for the engine.
import { cloudFile, depthFile } from "./arrays.js";
import { RelievoError } from "./engine.js";
import { optionTable } from "./options.js";

const camelCase = (keyword) => keyword.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
const nameOf = new Map(optionTable.map(({ keyword, name }) => [camelCase(keyword), name]));
const isNumber = new Set(optionTable.filter((option) => "min" in option).map(({ name }) => name));
const keywordOf = new Map([...nameOf].map(([keyword, name]) => [name, keyword]));
const OF_THE_CALL = new Set(["progress", "signal", "baseImage", "streamAboveMb", "name"]);
// Maps keywords to themselves, and keywords without their unit to the full keywords, because users often omit the unit.
const all = [...nameOf.keys(), ...OF_THE_CALL];
const keywords = new Map([...all.map((keyword) => [keyword.replace(/(Mm|Deg|Mb)$/, ""), keyword]), ...all.map((keyword) => [keyword, keyword])]);

const isBytes = (source) => source instanceof ArrayBuffer || ArrayBuffer.isView(source);
const isReadable = (source) => typeof source?.read === "function";

// Returns a name for a file whose first bytes are given, because readers recognise some formats only by the name. Of
// these formats only STL can be binary; a text STL begins with "solid".
function guessName(bytes) {
  const head = String.fromCharCode(...new Uint8Array(bytes.buffer ?? bytes, bytes.byteOffset ?? 0, Math.min(512, bytes.byteLength)));
  const known = [["ply", "scan.ply"], ["LASF", "scan.las"], ["glTF", "scan.glb"], ["\x89PNG", "scan.png"], ["\xFF\xD8\xFF", "scan.jpg"], ["\x93NUMPY", "scan.npy"],
    ["II*\0", "scan.tif"], ["MM\0*", "scan.tif"], ["ASTM-E57", "scan.e57"], ["OFF", "scan.off"], ["PK\x03\x04", "scan.zip"],
    ["# .PCD", "scan.pcd"], ["VERSION", "scan.pcd"], ["solid", "scan.stl"]];
  const name = known.find(([mark]) => head.startsWith(mark))?.[1];
  if (name || /[\0-\x08\x0e-\x1f]/.test(head)) return name ?? "scan.stl";
  return /^(v|o|g|mtllib) /m.test(head) ? "scan.obj" : "scan.xyz";
}

// Returns [[name, source], ...] for bytes, for arrays, or for an object that maps names to bytes.
export function filesOf(source, name) {
  if (isBytes(source)) return [[name ?? guessName(source), source]];
  if (isReadable(source)) return [[name ?? source.name ?? "scan.ply", source]];
  if (source?.points) return [[name ?? "points.ply", cloudFile(source)]];
  if (source?.depths) return [[name ?? "depths.tif", depthFile(source)]];
  const files = source && typeof source === "object" ? Object.entries(source) : [];
  if (files.length === 0 || !files.every(([, file]) => isBytes(file) || isReadable(file)))
    throw new TypeError("expected bytes, { points }, { depths, width, height } or an object of names and bytes");
  return files;
}

// Returns the files that are models. Leaves out files to which other files refer (materials, buffers, textures, and the
// models of a scene), fonts, drawings, and the list of ornaments that the options name.
export function modelsOf(files, { ornaments } = {}) {
  const names = files.map(([name]) => name).filter((name) => name !== ornaments);
  const ending = (name) => name.slice(name.lastIndexOf(".") + 1).toLowerCase();
  const scene = names.find((name) => ["json", "relievo"].includes(ending(name)));
  if (scene) return [scene];
  const beside = new Set(["mtl", "bin", "ttf", "otf", "ttc", "svg", ...(names.some((n) => ["gltf", "obj"].includes(ending(n))) ? ["png", "jpg", "jpeg", "tif"] : [])]);
  return names.filter((name) => !beside.has(ending(name)));
}

// Converts numbers to a text: a list to X,Y and a list of lists to X,Y;X,Y. Returns other values unchanged.
function textOf(value) {
  if (typeof value === "number") return String(value);
  if (!Array.isArray(value) && !ArrayBuffer.isView(value)) return value;
  const parts = [...value];
  return parts.map(textOf).join(parts.some((part) => Array.isArray(part)) ? ";" : ",");
}

export function optionError(input, expected) {
  return new RelievoError({ kind: "option", input, expected, message: `${input}: ${expected}` });
}

// Throws if a number anywhere in a request is not finite, since JSON has no such numbers.
export function checkNumbers(request) {
  for (const [name, value] of Object.entries(request)) {
    if (typeof value === "number" && !Number.isFinite(value)) throw optionError(name, `expected a finite number, found ${value}`);
    if (value && typeof value === "object") checkNumbers(value);
  }
}

// Returns the request for a user's options. Throws for unknown options; nearest(name, names) suggests a known one.
export function requestOf(options, nearest) {
  const request = { options: {} };
  for (const [keyword, value] of Object.entries(options)) {
    if (value === undefined || OF_THE_CALL.has(keyword)) continue;
    const name = nameOf.get(keyword);
    if (!name) {
      const meant = keywords.get(nearest(keyword, [...keywords.keys()]));
      throw optionError(keyword, `expected the name of an option${meant ? `, the nearest is ${meant}` : ""}`);
    }
    if (typeof value === "number" && !Number.isFinite(value)) throw optionError(keyword, `expected a finite number, found ${value}`);
    request.options[name] = isNumber.has(name) || value === null ? value : textOf(value);
  }
  if (options.streamAboveMb !== undefined) request.stream_above_mb = options.streamAboveMb;
  return request;
}

// Replaces the name of an option in an error by its name in this package.
export function withKeyword(error) {
  const keyword = error.kind === "option" ? keywordOf.get(error.input) : undefined;
  if (!keyword) return error;
  return new RelievoError({ ...error, input: keyword, message: `${keyword}: ${error.expected}` });
}
