// Packs the studio's page into one file: `build.mjs MODULE FOLDER` writes relievo.html into the folder, and the files
// that a browser needs to install the page from a server.
import {execFileSync} from "node:child_process";
import crypto from "node:crypto";
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";
import {fileURLToPath} from "node:url";
import zlib from "node:zlib";

const here = path.dirname(fileURLToPath(import.meta.url)), page = path.join(here, "../../studio/page");
const esbuild = createRequire(path.join(here, "../../../npm/test/"))("esbuild");
const [module, folder] = process.argv.slice(2);
const read = (name) => fs.readFileSync(path.join(page, name), "utf8");

// Replaces apps/studio/page/transport.js, which sends requests by HTTP.
const otherTransport = {
  name: "engine in a worker",
  setup: (build) => build.onResolve({filter: /\/transport\.js$/}, () => ({path: path.join(here, "transport.js")})),
};

function bundle(entry, options) {
  const {outputFiles: [file]} = esbuild.buildSync({bundle: true, write: false, minify: true, target: "es2022",
    charset: "utf8", legalComments: "none", ...entry, ...options});
  return file.text;
}

async function bundlePage() {
  const contents = `import "${path.join(page, "main.js")}"; import "${path.join(here, "installable.js")}";`;
  const {outputFiles: [file]} = await esbuild.build({stdin: {contents, resolveDir: here}, bundle: true, write: false,
    minify: true, format: "esm", target: "es2022", charset: "utf8", legalComments: "none", plugins: [otherTransport]});
  return file.text;
}

const dataAddress = (name) => {
  const type = name.endsWith(".svg") ? "image/svg+xml" : "image/jpeg";
  return `data:${type};base64,${fs.readFileSync(path.join(page, name)).toString("base64")}`;
};
const pictures = Object.fromEntries(fs.readdirSync(page).filter((name) => /\.(jpg|svg)$/.test(name))
  .map((name) => [name, dataAddress(name)]));

const licences = execFileSync(path.join(here, "../../../scripts/licence-texts"), ["web"], {encoding: "utf8"});

const hashOf = (text) => `'sha256-${crypto.createHash("sha256").update(text).digest("base64")}'`;
const script = (await bundlePage()).trim(), style = bundle({entryPoints: [path.join(page, "style.css")]}).trim();
const worker = bundle({entryPoints: [path.join(here, "worker.js")]}, {format: "iife"}).trim();
const packed = zlib.gzipSync(fs.readFileSync(module), {level: 9}).toString("base64");

// The browser refuses to load from or send to any address that this policy does not allow.
const policy = `default-src 'none'; script-src ${hashOf(script)} 'wasm-unsafe-eval'; style-src ${hashOf(style)}; ` +
  "img-src data: blob:; worker-src 'self' blob:; manifest-src 'self'; base-uri 'none'; form-action 'none'";

const html = read("index.html")
  .replace(/<link rel="stylesheet"[^>]*>/, () => `<style>${style}</style>`)
  .replace(/<script type="module" src="main.js"><\/script>\n/, "")
  .replace(/(href|src)="([\w-]+\.(?:svg|jpg))"/g, (_, attribute, name) => `${attribute}="${pictures[name]}"`)
  .replace('<meta charset="utf-8">', () => `<meta charset="utf-8">\n<meta http-equiv="Content-Security-Policy" content="${policy}">`)
  .replace("</body>", () => [
    `<script id="pictures" type="application/json">${JSON.stringify(pictures)}</script>`,
    `<script id="worker" type="text/plain">${worker}</script>`,
    `<script id="engine" type="text/plain">${packed}</script>`,
    `<script type="module">${script}</script>`,
    `<script id="licences" type="text/plain">\n${licences}</script>`, "</body>"].join("\n"));

const manifest = {name: "Relievo", short_name: "Relievo", description: "From scan to bas-relief", start_url: "relievo.html",
  display: "standalone", background_color: "#f4f2ee", theme_color: "#f4f2ee",
  icons: [{src: pictures["icon.svg"], sizes: "any", type: "image/svg+xml"}]};

fs.mkdirSync(folder, {recursive: true});
fs.writeFileSync(path.join(folder, "relievo.html"), html);
fs.writeFileSync(path.join(folder, "relievo.webmanifest"), JSON.stringify(manifest, null, 1) + "\n");
fs.copyFileSync(path.join(here, "offline.js"), path.join(folder, "relievo-offline.js"));
