// Implements the functions of WASI by which the engine reads its files.

const BAD_FILE = 8, INVALID = 28, FAILED = 29, NOT_THERE = 44, UNKNOWN = 52;
const REGULAR_FILE = 4, FOLDER = 3, CHARACTER_DEVICE = 2;
const FIRST_FILE = 4; // after the standard streams and the root

// Returns a file: an object with `size` and read(offset, to), which fills `to` up to the end of the file and returns
// the number of bytes. A source that already is such an object, such as a file on disk, is returned unchanged.
export function asFile(source) {
  if (typeof source?.read === "function" && typeof source.size === "number") return source;
  const bytes = asBytes(source);
  return {
    size: bytes.length,
    read(offset, to) {
      const part = bytes.subarray(offset, offset + to.length);
      to.set(part);
      return part.length;
    },
  };
}

export function asBytes(source) {
  if (source instanceof Uint8Array) return source;
  if (source instanceof ArrayBuffer) return new Uint8Array(source);
  if (ArrayBuffer.isView(source)) return new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
  throw new TypeError("expected bytes: a Uint8Array or an ArrayBuffer");
}

// Returns the imports of WASI for these files. `memory` returns the engine's memory. `log` gets the text that the
// engine writes to its standard streams. The engine writes to them only when it aborts.
export function wasi(files, memory, log) {
  const open = new Map(); // {file, position} by descriptor
  const view = () => new DataView(memory());
  const bytes = (at, size) => new Uint8Array(memory(), at, size);
  const name = (at, size) => new TextDecoder().decode(bytes(at, size)).replace(/^\.?\/+|\/+$/g, "");
  const isFolder = (path) => path === "" || path === "." || [...files.keys()].some((file) => file.startsWith(path + "/"));

  function writeStatus(at, type, size) {
    bytes(at, 64).fill(0);
    view().setUint8(at + 16, type);
    view().setBigUint64(at + 32, BigInt(size), true);
    return 0;
  }

  function read(descriptor, vectors, count, offset, total) {
    const entry = open.get(descriptor);
    if (!entry) return BAD_FILE;
    let position = offset ?? entry.position, sum = 0;
    for (let i = 0; i < count; i++) {
      const at = view().getUint32(vectors + 8 * i, true), size = view().getUint32(vectors + 8 * i + 4, true);
      let got;
      try {
        got = entry.file.read(position, bytes(at, size));
      } catch {
        return FAILED; // the file may have changed or vanished since the user chose it
      }
      position += got;
      sum += got;
      if (got < size) break;
    }
    if (offset === undefined) entry.position = position;
    view().setUint32(total, sum, true);
    return 0;
  }

  // The engine gets no environment variables and no arguments.
  const noSizes = (count, size) => {
    view().setUint32(count, 0, true);
    view().setUint32(size, 0, true);
    return 0;
  };

  return {
    environ_get: () => 0,
    environ_sizes_get: noSizes,
    args_get: () => 0,
    args_sizes_get: noSizes,
    clock_res_get: () => UNKNOWN,
    clock_time_get(clock, _precision, at) {
      const ms = clock === 0 ? Date.now() : performance.now();
      view().setBigUint64(at, BigInt(Math.round(ms * 1e6)), true);
      return 0;
    },
    random_get(at, size) {
      for (let i = 0; i < size; i += 65536) crypto.getRandomValues(bytes(at + i, Math.min(65536, size - i)));
      return 0;
    },
    proc_exit(code) {
      throw new Error(`the engine ended with code ${code}`);
    },

    fd_prestat_get(descriptor, at) {
      if (descriptor !== 3) return BAD_FILE;
      view().setUint32(at, 0, true);
      view().setUint32(at + 4, 1, true);
      return 0;
    },
    fd_prestat_dir_name(descriptor, at) {
      if (descriptor !== 3) return BAD_FILE;
      view().setUint8(at, "/".charCodeAt(0));
      return 0;
    },
    fd_fdstat_get(descriptor, at) {
      if (descriptor > 3 && !open.has(descriptor)) return BAD_FILE;
      bytes(at, 24).fill(0);
      view().setUint8(at, descriptor < 3 ? CHARACTER_DEVICE : descriptor === 3 ? FOLDER : REGULAR_FILE);
      view().setBigUint64(at + 8, ~0n & 0xffffffffn, true);
      view().setBigUint64(at + 16, ~0n & 0xffffffffn, true);
      return 0;
    },
    fd_fdstat_set_flags: () => 0,
    fd_filestat_get(descriptor, at) {
      const entry = open.get(descriptor);
      if (!entry) return BAD_FILE;
      return writeStatus(at, entry.file ? REGULAR_FILE : FOLDER, entry.file ? entry.file.size : 0);
    },
    path_filestat_get(_folder, _flags, path, size, at) {
      const wanted = name(path, size);
      const file = files.get(wanted);
      if (file) return writeStatus(at, REGULAR_FILE, file.size);
      return isFolder(wanted) ? writeStatus(at, FOLDER, 0) : NOT_THERE;
    },
    path_open(_folder, _dirFlags, path, size, _openFlags, _rights, _inherited, _flags, at) {
      const wanted = name(path, size);
      const file = files.get(wanted);
      if (!file && !isFolder(wanted)) return NOT_THERE;
      let descriptor = FIRST_FILE;
      while (open.has(descriptor)) descriptor++;
      open.set(descriptor, { file, position: 0 });
      view().setUint32(at, descriptor, true);
      return 0;
    },
    fd_close: (descriptor) => (open.delete(descriptor) ? 0 : BAD_FILE),
    fd_read: (descriptor, vectors, count, total) => read(descriptor, vectors, count, undefined, total),
    fd_pread: (descriptor, vectors, count, offset, total) => read(descriptor, vectors, count, Number(offset), total),
    fd_seek(descriptor, offset, whence, at) {
      const entry = open.get(descriptor);
      if (!entry) return BAD_FILE;
      const from = whence === 0 ? 0 : whence === 1 ? entry.position : entry.file.size;
      if (from + Number(offset) < 0) return INVALID;
      entry.position = from + Number(offset);
      view().setBigUint64(at, BigInt(entry.position), true);
      return 0;
    },
    fd_write(descriptor, vectors, count, total) {
      if (descriptor > 2) return BAD_FILE;
      let sum = 0, text = "";
      for (let i = 0; i < count; i++) {
        const at = view().getUint32(vectors + 8 * i, true), size = view().getUint32(vectors + 8 * i + 4, true);
        text += new TextDecoder().decode(bytes(at, size));
        sum += size;
      }
      log(text);
      view().setUint32(total, sum, true);
      return 0;
    },
  };
}
