// Relievo in JavaScript: makes reliefs from scans.
import { RelievoError } from "./engine.js";
import { checkNumbers, filesOf, modelsOf, optionError, requestOf, withKeyword } from "./inputs.js";
import { newEngine } from "./new_engine.js";
import { optionTable, samples, version } from "./options.js";

export { RelievoError, optionTable, samples, version };

const BASE_IMAGE = "base-image/";

function call(engine, name, request = {}) {
  try {
    checkNumbers(request);
    return engine.call(name, request);
  } catch (error) {
    throw withKeyword(error);
  }
}

const nearestIn = (engine) => (name, names) => engine.call("nearest", { name, names }).json.name;

// Calls the engine and reports the progress. Cancels the call as soon as the signal is aborted, or the callback returns
// false or throws. Throws the error that the callback has thrown.
function watchedCall(engine, name, request, { progress, signal } = {}) {
  signal?.throwIfAborted();
  const thrown = [];
  engine.progress = (stage, fraction) => {
    try {
      return thrown.length === 0 && progress?.(stage, fraction) !== false && !signal?.aborted;
    } catch (error) {
      thrown.push(error);
      return false;
    }
  };
  try {
    return call(engine, name, request);
  } catch (error) {
    throw thrown.length > 0 ? thrown[0] : error;
  } finally {
    engine.progress = null;
  }
}

// Returns two things: an engine that has the files of `source`, and the request for the options.
async function engineWith(source, options = {}) {
  const engine = await newEngine();
  const files = filesOf(source, options.name);
  for (const [name, file] of files) engine.addFile(name, file);
  const request = { ...requestOf(options, nearestIn(engine)), inputs: modelsOf(files, options) };
  if (options.baseImage) {
    request.base_image = BASE_IMAGE + (options.baseImage.name ?? "base.png");
    engine.addFile(request.base_image, options.baseImage.bytes ?? options.baseImage);
  }
  return { engine, request };
}

export class Relief {
  #engine;
  #number;

  constructor(engine, json) {
    this.#engine = engine;
    this.#number = json.relief;
    this.report = json.report;
    this.remarks = json.remarks;
  }

  // Returns the solid as the bytes of a file. The format is "stl", "3mf", "ply" or "obj".
  solid(format = "stl", { units = "mm" } = {}) {
    return this.#file("solid", `relief.${format}`, { units });
  }

  // Returns the height map of the front as a file: a 16-bit PNG, or a TIFF ("tif") in millimetres. The options mean
  // the same as on the command line. pixel or dpi replace size; bits, area, zero and high are the flags --heightmap-*.
  heightMapFile(format = "png", { size = 1024, units = "mm", pixel, dpi, bits, area, zero, high } = {}) {
    const given = { pixel, dpi, "heightmap-bits": bits, "heightmap-area": area, "heightmap-zero": zero, "heightmap-high": high };
    const texts = Object.entries(given).filter(([, value]) => value !== undefined).map(([name, value]) => [name, String(value)]);
    return this.#file("heightmap", `heights.${format}`, { heightmap_px: size, units, ...Object.fromEntries(texts) });
  }

  // Returns a picture of the relief with front and oblique view, as the bytes of a PNG.
  preview({ size = 1200 } = {}) {
    return this.#file("preview", "preview.png", { preview_px: size });
  }

  toolPicture() {
    return this.#file("tool_picture", "tool.png", {});
  }

  // Returns the heights of the front in millimetres: { width, height, mmPerPixel, heights }, row by row, the top row
  // first.
  heightMap({ size = 1024 } = {}) {
    const { json, bytes } = call(this.#engine, "heights", { relief: this.#number, size });
    return { width: json.width, height: json.height, mmPerPixel: json.mm_per_pixel, heights: new Float32Array(bytes.buffer) };
  }

  // Returns x, y and z of each vertex, in millimetres.
  get vertices() {
    return new Float64Array(call(this.#engine, "vertices", { relief: this.#number }).bytes.buffer);
  }

  // Returns the indices of the three vertices of each triangle.
  get faces() {
    return new Uint32Array(call(this.#engine, "faces", { relief: this.#number }).bytes.buffer);
  }

  #file(kind, path, options) {
    return call(this.#engine, "file", { relief: this.#number, kind, path, ...options }).bytes;
  }
}

export async function make(source, options = {}) {
  const { engine, request } = await engineWith(source, options);
  return new Relief(engine, watchedCall(engine, "make", request, options).json);
}

// A frame of a session. It uses memory of the engine until release() is called or nothing refers to the frame any more.
export class Frame {
  #engine;
  #number;

  constructor(engine, json) {
    this.#engine = engine;
    this.#number = json.frame;
    this.heightMm = json.height_mm;
    this.isHeightMet = json.is_height_met;
    this.u = json.u;
  }

  // Returns the height of each point of the session's surface, in millimetres.
  get heights() {
    return new Float32Array(call(this.#engine, "frame_heights", { frame: this.#number }).bytes.buffer);
  }

  // Returns { width, height, pixels }. Each pixel has four values, as in ImageData.
  picture(session, { width = 800, height = 600, yawDeg = 0, pitchDeg = 0, zoom = 1, material = "plaster", fine = false } = {}) {
    const { json, bytes } = call(this.#engine, "picture", { session, frame: this.#number, width, height, yaw_deg: yawDeg,
      pitch_deg: pitchDeg, zoom, material, is_fine: fine ? 1 : 0 });
    return { width: json.width, height: json.height, pixels: new Uint8ClampedArray(bytes.buffer) };
  }

  release() {
    call(this.#engine, "release", { number: this.#number });
  }
}

// A scan that is prepared once. After that, frames with other options take milliseconds.
export class Session {
  #engine;
  #number;

  constructor(engine, json) {
    this.#engine = engine;
    this.#number = json.session;
    this.pointCount = json.points;
    this.triangleCount = json.triangles;
  }

  // Prepares a scan. The options are the defaults of frame() and make(). Options for reading the scan and for its view
  // must be given here.
  static async open(source, options = {}) {
    const { engine, request } = await engineWith(source, options);
    return new Session(engine, watchedCall(engine, "open", request, options).json);
  }

  frame(options = {}) {
    return new Frame(this.#engine, call(this.#engine, "frame", this.#request(options)).json);
  }

  picture(frame, options = {}) {
    return frame.picture(this.#number, options);
  }

  make(options = {}) {
    return new Relief(this.#engine, watchedCall(this.#engine, "session_make", this.#request(options), options).json);
  }

  #request(options) {
    if (options.baseImage) throw optionError("baseImage", "expected it in the options of Session.open()");
    return { session: this.#number, ...requestOf(options, nearestIn(this.#engine)) };
  }

  // Return x, y and z of each point of the surface, and the three indices of each triangle's corners.
  get points() {
    return new Float64Array(call(this.#engine, "surface_points", { session: this.#number }).bytes.buffer);
  }

  get triangles() {
    return new Uint32Array(call(this.#engine, "surface_triangles", { session: this.#number }).bytes.buffer);
  }
}

// Returns a generated scan as the bytes of a PLY file. `samples` lists the names.
export async function sample(name, { points = 300000, noise = 0.15 } = {}) {
  const engine = await newEngine();
  return call(engine, "sample", { name, points, noise }).bytes;
}
