// Names documents, and finds the files of their inputs and options.
import {filesIn} from "../../studio/page/ornament_list.js";

const MASK = (1n << 64n) - 1n;

// Returns the name of the document for an input. document_of() in apps/studio/store.cpp computes the same name.
export function documentOf({sample, path}) {
  let hash = 0xCBF29CE484222325n;
  for (const byte of new TextEncoder().encode(sample ? `sample:${sample}` : `path:${path}`))
    hash = ((hash ^ BigInt(byte)) * 0x100000001B3n) & MASK;
  return hash.toString(16).padStart(16, "0");
}

// Returns the hash of a scan as hexadecimal digits; "" for a sample, and for a scan that was never read.
export const scanOf = ({path = "", hash = ""}) =>
  path.match(/^scans\/([0-9a-f]{16})\//)?.[1] ?? hash.match(/:([0-9a-f]{16})$/)?.[1] ?? "";

// Returns the current input in the state of a document; null if the value is not such a state.
export const inputOf = (state) => state?.steps?.[state.at]?.input ?? null;

// Returns the paths of the files that options name: the height map of a base, fonts and drawings.
export const pathsIn = (options = {}) => [options["base-image"], ...filesIn(options)].filter(Boolean);

// Returns a list of objects with options: those of a project, those that the project keeps for other kinds of pieces,
// and those of each snapshot in the project.
export const optionsIn = ({options, studio}) => [options, studio?.kept ?? {},
  ...(studio?.snapshots ?? []).map((snapshot) => snapshot.options)];

// Returns the hashes, as hexadecimal digits, of all files that the state of a document needs.
export const scansOf = (state) => [scanOf(inputOf(state)),
  ...[...state.steps, ...(state.snapshots ?? [])].flatMap(({options}) => pathsIn(options)).map((path) => scanOf({path}))];

const endingOf = ({name}) => name.slice(name.lastIndexOf(".") + 1).toLowerCase();
const BESIDE = new Set(["mtl", "bin", "png", "jpg", "jpeg", "tif", "tiff"]); // endings of files that accompany a model

// Returns the file to open: the only file, the scene file, or the only model, to which the other files belong. If there
// are several models, returns a new scene file that places them side by side.
export function mainOf(files) {
  const scene = files.find((file) => endingOf(file) === "json");
  if (files.length === 1 || scene) return scene ?? files[0];
  const models = files.filter((file) => !BESIDE.has(endingOf(file)));
  if (models.length === 1) return models[0];
  const entries = (models.length > 0 ? models : files).map(({name}) => ({file: name}));
  return new File([JSON.stringify({models: entries}, null, 1) + "\n"], "scene.json", {type: "application/json"});
}

// Returns the list `files`, [[path, file], ...], with bytes in place of the browser's blobs.
export function bytesOf(files) {
  return Promise.all(files.map(async ([path, file]) =>
    [path, file instanceof Blob ? new Uint8Array(await file.arrayBuffer()) : file]));
}
