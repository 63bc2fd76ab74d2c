// Files of the browser as the engine reads them: piece by piece.

const PIECE = 4 << 20; // bytes that are read at once

// Returns a file as npm/src/files.js describes, and throws if the browser does not let it be read. Only workers can
// read without waiting.
export function fileOf(blob) {
  const reader = new FileReaderSync();
  let start = 0, piece = new Uint8Array();
  const load = (offset) => {
    piece = new Uint8Array(reader.readAsArrayBuffer(blob.slice(offset, offset + PIECE)));
    start = offset;
  };
  load(0);
  return {
    size: blob.size,
    read(offset, to) {
      let filled = 0;
      while (filled < to.length && offset + filled < blob.size) {
        const at = offset + filled;
        if (at < start || at >= start + piece.length) load(at);
        const part = piece.subarray(at - start, at - start + to.length - filled);
        to.set(part, filled);
        filled += part.length;
      }
      return filled;
    },
  };
}
