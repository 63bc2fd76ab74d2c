// Compiles WebAssembly modules that are stored as text.

async function inflate(base64) {
  const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

// Compiles a module that is compressed by gzip and encoded in base64.
export const compile = (base64) => inflate(base64).then((bytes) => WebAssembly.compile(bytes));
