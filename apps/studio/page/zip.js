// Packs files of the browser into an uncompressed ZIP archive, because the engine takes a scan as one file.

const TABLE = Uint32Array.from({length: 256}, (_, value) => {
  for (let bit = 0; bit < 8; ++bit) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  return value;
});

// Returns the CRC-32 of the bytes, as ZIP and PNG define it.
function checksum(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = (sum >>> 8) ^ TABLE[(sum ^ byte) & 255];
  return ~sum >>> 0;
}

// Returns the bytes of numbers, [[number, size in bytes], ...], least significant byte first.
const packed = (numbers) =>
  Uint8Array.from(numbers.flatMap(([number, size]) => Array.from({length: size}, (_, i) => number / 256 ** i & 255)));

const LOCAL = 0x04034b50, CENTRAL = 0x02014b50, END = 0x06054b50; // signatures of the records of a ZIP file
const VERSION = 20, UTF8 = 1 << 11, FIRST_DAY = 33; // FIRST_DAY: all files are dated 1 January 1980

// Returns an archive of the files, which together must be smaller than 4 GiB.
export async function zipOf(files, name) {
  const parts = [], directory = [];
  let offset = 0, directorySize = 0;
  for (const file of files) {
    const path = new TextEncoder().encode(file.name), sum = checksum(new Uint8Array(await file.arrayBuffer()));
    const common = [[VERSION, 2], [UTF8, 2], [0, 2], [0, 2], [FIRST_DAY, 2], [sum, 4], [file.size, 4], [file.size, 4],
      [path.length, 2], [0, 2]];
    const head = packed([[LOCAL, 4], ...common]);
    const entry = packed([[CENTRAL, 4], [VERSION, 2], ...common, [0, 2], [0, 2], [0, 2], [0, 4], [offset, 4]]);
    parts.push(head, path, file);
    directory.push(entry, path);
    offset += head.length + path.length + file.size;
    directorySize += entry.length + path.length;
  }
  const end = packed([[END, 4], [0, 2], [0, 2], [files.length, 2], [files.length, 2], [directorySize, 4], [offset, 4],
    [0, 2]]);
  return new File([...parts, ...directory, end], name, {type: "application/zip"});
}
