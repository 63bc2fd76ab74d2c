// Builds the package: build.mjs MODULE FOLDER. MODULE is the WebAssembly module and FOLDER a new folder. The options,
// their types and their documentation are generated from the module.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import zlib from "node:zlib";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const [module, folder] = process.argv.slice(2);

const camelCase = (keyword) => keyword.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

function writeModule() {
  const packed = zlib.gzipSync(fs.readFileSync(module), { level: 9 });
  fs.writeFileSync(path.join(folder, "src/module.js"),
    `// The WebAssembly module, compressed by gzip, in base64.\nexport const compressedModule = "${packed.toString("base64")}";\n`);
}

// The TypeScript type of an option follows from its unit and stage. OF_NUMBERS matches the units of texts that may also
// be numbers, and the units of texts that start with a word. WITH_SETTINGS matches the units of words that a colon and
// settings may follow. All other options that have words accept only these words.
const OF_NUMBERS = /,|^(SIDE|NOISE|WHAT)$/, WITH_SETTINGS = /^(SHAPE|BODY)$/;

function typeOf(option) {
  const words = (option.choices ?? []).map((choice) => JSON.stringify(choice));
  if (OF_NUMBERS.test(option.unit)) return [...words, "(string & {})", "number", "Numbers"].join(" | ");
  if (option.stage === "body" && WITH_SETTINGS.test(option.unit)) return [...words, "(string & {})"].join(" | ");
  if (words.length > 0) return words.join(" | ");
  if (!("min" in option)) return "string";
  return option.unit === "MM" ? "number | string" : "number";
}

function optionTypes(table) {
  const lines = table.map((option) => {
    const range = "min" in option ? ` From ${option.min} to ${option.max}.` : "";
    const initial = option.default_text ? ` Default: ${option.default_text}.` : "";
    const text = `${option.help.charAt(0).toUpperCase()}${option.help.slice(1)}.${range}${initial}`.replaceAll("*/", "* /");
    return `  /** ${text} */\n  ${camelCase(option.keyword)}?: ${typeOf(option)};`;
  });
  return `import type { Numbers } from "./index.js";\n\n/** What a relief is made by. Lengths are millimetres, or texts with a unit such as "4in". */\nexport interface ReliefOptions {\n${lines.join("\n")}\n}\n`;
}

fs.rmSync(folder, { recursive: true, force: true });
fs.mkdirSync(folder, { recursive: true });
for (const part of ["src", "bin", "README.md"]) fs.cpSync(path.join(here, part), path.join(folder, part), { recursive: true });
fs.copyFileSync(path.join(here, "../LICENSE"), path.join(folder, "LICENSE"));
fs.writeFileSync(path.join(folder, "LIBRARIES.txt"), execFileSync(path.join(here, "../scripts/licence-texts"), ["web"]));
writeModule();
const { Engine } = await import(pathToFileURL(path.resolve(folder, "src/engine.js")));
const { json: about } = (await Engine.create(await WebAssembly.compile(fs.readFileSync(module)))).call("about");
fs.writeFileSync(path.join(folder, "src/options.js"),
  ["version", "options", "samples", "endings", "stages"].map((name) =>
    `export const ${name === "options" ? "optionTable" : name} = ${JSON.stringify(about[name], null, 1)};\n`).join(""));
fs.writeFileSync(path.join(folder, "src/options.d.ts"), optionTypes(about.options));
const packageJson = JSON.parse(fs.readFileSync(path.join(here, "package.json"), "utf8"));
fs.writeFileSync(path.join(folder, "package.json"), JSON.stringify({ ...packageJson, version: about.version }, null, 2) + "\n");
