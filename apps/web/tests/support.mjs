// Provides a static server and helpers for files to the tests of the page.
import {execFileSync} from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import {pathToFileURL} from "node:url";
import zlib from "node:zlib";
import {temporaryFolder} from "../../studio/tests/support.mjs";

const pageFolder = process.env.PAGE ?? path.resolve("build/web/page");

const file = path.join(pageFolder, "relievo.html");
export const fileAddress = pathToFileURL(file).href;
const TYPES = {".html": "text/html; charset=utf-8", ".js": "text/javascript", ".webmanifest": "application/manifest+json"};

// Returns the policy that docs/web.md recommends for servers, with the hashes of this page.
function serverPolicy() {
  const own = fs.readFileSync(file, "utf8").match(/http-equiv="Content-Security-Policy" content="([^"]*)"/)[1];
  const [script] = own.match(/script-src ('sha256-\S+')/).slice(1), [style] = own.match(/style-src ('sha256-[^']+')/).slice(1);
  return `default-src 'none'; script-src 'self' 'wasm-unsafe-eval' ${script}; style-src ${style}; ` +
    "img-src data: blob:; worker-src 'self' blob:; manifest-src 'self'; connect-src 'self'";
}

// Starts a static server for the page's folder, which sends the policy of serverPolicy(). Returns the address of the
// page.
export async function serve(t) {
  const server = http.createServer((request, response) => {
    const wanted = path.join(pageFolder, path.basename(new URL(request.url, "http://localhost").pathname));
    if (!fs.existsSync(wanted)) return response.writeHead(404).end();
    response.writeHead(200, {"Content-Type": TYPES[path.extname(wanted)], "Content-Security-Policy": serverPolicy()});
    fs.createReadStream(wanted).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  t.after(() => server.close() && server.closeAllConnections());
  return `http://127.0.0.1:${server.address().port}/relievo.html`;
}

// Returns the address of a page whose module can use at most 256 MiB of memory. The policy of the page has hashes of
// scripts, but not of the module, so it need not change.
export function pageWithLittleMemory() {
  const page = fs.readFileSync(file, "utf8"), [all, before, packed] = page.match(/(<script id="engine"[^>]*>)([^<]*)/);
  const module = zlib.gunzipSync(Buffer.from(packed, "base64"));
  const most = module.indexOf(Buffer.from([0x80, 0x80, 0x04]), memorySection(module)); // 65536 pages of 64 KiB
  module.set([0x80, 0xa0, 0x00], most); // 4096 pages
  const place = path.join(temporaryFolder(), "relievo.html");
  fs.writeFileSync(place, page.replace(all, () => before + zlib.gzipSync(module).toString("base64")));
  return pathToFileURL(place).href;
}

// Finds the section that describes the memory of a module, and returns the section's offset.
function memorySection(module) {
  const MEMORY = 5;
  for (let at = 8; at < module.length;) {
    const id = module[at++];
    let size = 0, shift = 0, byte;
    do {
      byte = module[at++];
      size |= (byte & 127) << shift;
      shift += 7;
    } while (byte & 128);
    if (id === MEMORY) return at;
    at += size;
  }
  throw new Error("the module has no memory of its own");
}

// Calls a function until it returns something, for at most `seconds`.
export async function eventually(look, seconds = 60) {
  for (const end = Date.now() + seconds * 1000; ;) {
    const found = await look();
    if (found) return found;
    if (Date.now() > end) throw new Error(`nothing after ${seconds} s: ${look}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

// Returns {facets, size, repairs}, as admesh measures them on a solid. `repairs` counts the checks that found a fault.
export function admesh(solid) {
  const text = execFileSync("admesh", [solid], {encoding: "utf8"});
  const number = (pattern) => Number(text.match(pattern)?.[1] ?? NaN);
  const repairs = ["Degenerate facets", "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges"]
    .map((name) => number(new RegExp(`${name}\\s*:\\s*(\\d+)`))).reduce((a, b) => a + b);
  return {facets: number(/Number of facets\s*:\s*(\d+)/), height: number(/Min Z[^\n]*Max Z =\s*([\d.]+)/),
    parts: number(/Number of parts\s*:\s*(\d+)/), repairs};
}
