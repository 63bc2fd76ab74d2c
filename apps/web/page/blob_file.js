// Lets the engine read a file of the browser block by block.

const PIECE = 4 << 20; // size of a block in bytes

// Returns a file as npm/src/files.js describes it. Works only in workers, because only they can read blobs
// synchronously. Throws if the browser cannot read the blob.
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
