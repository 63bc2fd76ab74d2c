// Converts the arguments of users to files and requests for the engine.
import { cloudFile, depthFile } from "./arrays.js";
import { optionTable } from "./options.js";
import { RelievoError } from "./engine.js";

const camelCase = (keyword) => keyword.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
const nameOf = new Map(optionTable.map(({ keyword, name }) => [camelCase(keyword), name]));
const keywordOf = new Map([...nameOf].map(([keyword, name]) => [name, keyword]));
const OF_THE_CALL = new Set(["progress", "signal", "camera", "baseImage", "streamAboveMb", "name"]);

const isBytes = (source) => source instanceof ArrayBuffer || ArrayBuffer.isView(source);
const isReadable = (source) => typeof source?.read === "function";

// Returns a name for a file from its first bytes, as readers recognise some formats only by the name.
function guessName(bytes) {
  const head = String.fromCharCode(...new Uint8Array(bytes.buffer ?? bytes, bytes.byteOffset ?? 0, Math.min(8, bytes.byteLength)));
  const known = [["ply", "scan.ply"], ["LASF", "scan.las"], ["glTF", "scan.glb"], ["\x89PNG", "scan.png"],
    ["\xFF\xD8\xFF", "scan.jpg"], ["\x93NUMPY", "scan.npy"], ["II*\0", "scan.tif"], ["MM\0*", "scan.tif"], ["ASTM-E57", "scan.e57"], ["OFF", "scan.off"], ["PK\x03\x04", "scan.zip"],
    ["# .PCD", "scan.pcd"], ["VERSION", "scan.pcd"]];
  return known.find(([mark]) => head.startsWith(mark))?.[1] ?? "scan.stl";
}

// Returns [[name, source], ...] for bytes, arrays, or an object of names and bytes.
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

// Returns the files that are models. Leaves out files that others refer to: materials, buffers, textures, and the
// models of a scene.
export function modelsOf(files) {
  const names = files.map(([name]) => name);
  const ending = (name) => name.slice(name.lastIndexOf(".") + 1).toLowerCase();
  const scene = names.find((name) => ["json", "relievo"].includes(ending(name)));
  if (scene) return [scene];
  const beside = new Set(["mtl", "bin", ...(names.some((n) => ["gltf", "obj"].includes(ending(n))) ? ["png", "jpg", "jpeg", "tif"] : [])]);
  return names.filter((name) => !beside.has(ending(name)));
}

// Returns the request for a user's options. Throws for unknown option names.
export function requestOf(options = {}) {
  const request = { options: {} };
  for (const [keyword, value] of Object.entries(options)) {
    if (value === undefined || value === null || OF_THE_CALL.has(keyword)) continue;
    if (!nameOf.has(keyword))
      throw new RelievoError({ kind: "option", input: keyword, expected: "expected the name of an option",
        message: `${keyword}: expected the name of an option` });
    request.options[nameOf.get(keyword)] = value;
  }
  if (options.camera) request.camera = options.camera;
  if (options.streamAboveMb !== undefined) request.stream_above_mb = options.streamAboveMb;
  return request;
}

// Replaces the name of an option in an error by its name in this package.
export function withKeyword(error) {
  const keyword = error.kind === "option" ? keywordOf.get(error.input) : undefined;
  if (!keyword) return error;
  return new RelievoError({ ...error, input: keyword, message: `${keyword}: ${error.expected}` });
}
