#!/usr/bin/env node
// Runs the command line of the package: `relievo make` with the flags of the native program.
import fs from "node:fs";
import path from "node:path";
import { RelievoError } from "../src/engine.js";
import { newEngine } from "../src/new_engine.js";
import { optionTable, version } from "../src/options.js";
import { writeAll } from "./write_all.js";

const OUTPUTS = { output: "solid", preview: "preview", heightmap: "heightmap", "tool-picture": "tool_picture", report: "report" };
const MAP_VALUES = ["pixel", "dpi", "heightmap-bits", "heightmap-area", "heightmap-zero", "heightmap-high"];
const OTHER_VALUES = [...MAP_VALUES, "units", "heightmap-size", "preview-size", "camera", "stream-above", "base-image", "threads", ...Object.keys(OUTPUTS)];

function fail(message) {
  process.stderr.write(`relievo: ${message}\n`);
  process.exit(1);
}

const USAGE = `Usage: relievo make INPUT... -o OUT [--preview P.png] [--heightmap H.png] [--report R.json] [OPTION VALUE]...
       relievo options
       relievo --version`;

// Returns { inputs, values } of the arguments. The value of a flag follows it, after "=" or as the next argument.
function parse(args) {
  const inputs = [], values = {};
  const known = new Set([...optionTable.map((option) => option.name), ...OTHER_VALUES]);
  for (let i = 0; i < args.length; i++) {
    const arg = args[i] === "-o" ? "--output" : args[i];
    if (!arg.startsWith("--")) inputs.push(arg);
    else if (arg === "--quiet") values.quiet = true;
    else {
      const [flag, given] = arg.includes("=") ? [arg.slice(2, arg.indexOf("=")), arg.slice(arg.indexOf("=") + 1)] : [arg.slice(2), args[++i]];
      if (!known.has(flag)) fail(`${arg}: expected a flag of relievo make; \`relievo options\` lists them`);
      if (given === undefined) fail(`--${flag}: expected a value`);
      values[flag] = given;
    }
  }
  return { inputs, values };
}

// Returns the value of an option. A length without a unit is one of --units, as in the native program.
function optionValue(option, text, units) {
  const isNumber = text.trim() !== "" && Number.isFinite(Number(text));
  if (option.unit === "MM") return isNumber && units === "in" ? `${text}in` : isNumber ? Number(text) : text;
  const isOfNumbers = "min" in option || "max" in option || typeof option.default === "number";
  if (!isOfNumbers) return text;
  if (!isNumber) fail(`${option.name}: expected a number, found '${text}'`);
  return Number(text);
}

// Returns a file on disk that the engine reads block by block.
function fileOnDisk(name) {
  const descriptor = fs.openSync(name, "r");
  const status = fs.fstatSync(descriptor);
  if (!status.isFile()) throw new RelievoError({ kind: "input", message: `${name}: expected a file` });
  return { size: status.size, read: (offset, to) => fs.readSync(descriptor, to, 0, to.length, offset) };
}

const REFERRING = [".obj", ".gltf", ".json", ".relievo"];

// Gives the engine the input files and, if these can refer to other files, all files of their folders.
function addFiles(engine, inputs) {
  const names = new Map();
  const add = (file) => {
    const name = path.relative(process.cwd(), path.resolve(file)).split(path.sep).join("/").replaceAll("../", "_up/");
    if (!names.has(file)) engine.addFile(name, fileOnDisk(file));
    names.set(file, name);
    return name;
  };
  const added = inputs.map(add);
  for (const input of inputs.filter((name) => REFERRING.includes(path.extname(name).toLowerCase())))
    for (const entry of fs.readdirSync(path.dirname(input) || ".", { withFileTypes: true }))
      if (entry.isFile()) add(path.join(path.dirname(input), entry.name));
  return added;
}

function showProgress(isQuiet) {
  if (isQuiet || !process.stderr.isTTY) return null;
  return (stage, fraction) => { process.stderr.write(`\r\x1b[K${Math.round(100 * fraction)} % ${stage}`); };
}

async function make(args) {
  const { inputs, values } = parse(args);
  if (inputs.length === 0 || !values.output) fail(USAGE);
  const units = values.units ?? "mm";
  const engine = await newEngine();
  const request = { inputs: addFiles(engine, inputs), options: {}, camera: values.camera };
  if (request.camera && fs.existsSync(request.camera)) request.camera = fs.readFileSync(request.camera, "utf8");
  if (values["stream-above"]) request.stream_above_mb = Number(values["stream-above"]);
  if (values["base-image"]) [request.base_image] = addFiles(engine, [values["base-image"]]);
  for (const option of optionTable)
    if (option.name in values) request.options[option.name] = optionValue(option, values[option.name], units);
  engine.progress = showProgress(values.quiet);
  const { json } = engine.call("make", request);
  if (engine.progress) process.stderr.write("\r\x1b[K");
  const files = [], map = Object.fromEntries(MAP_VALUES.filter((name) => name in values).map((name) => [name, values[name]]));
  for (const [flag, usual] of Object.entries(OUTPUTS)) {
    if (!values[flag]) continue;
    const kind = flag === "output" && /\.(png|tiff?)$/i.test(values[flag]) ? "heightmap" : usual;
    const bytes = kind === "report" ? JSON.stringify({ ...json.report, units }, null, 2) + "\n"
      : engine.call("file", { relief: json.relief, kind, path: values[flag], units, ...map,
          heightmap_px: Number(values["heightmap-size"] ?? 1024), preview_px: Number(values["preview-size"] ?? 1200) }).bytes;
    files.push([values[flag], bytes]);
  }
  writeAll(files);
  if (values.quiet) return;
  for (const line of json.remarks) process.stderr.write(`${line}\n`);
  process.stderr.write(`${values.output}: ${json.report.visible_points} of ${json.report.input_points} points, height ${json.report.height_mm.toFixed(4).replace(/\.?0+$/, "")} mm\n`);
}

function listOptions() {
  for (const { name, unit, help, default_text: initial } of optionTable)
    process.stdout.write(`--${name} ${unit}\n    ${help}${initial ? ` [${initial}]` : ""}\n`);
}

const [command, ...rest] = process.argv.slice(2);
try {
  if (command === "make") await make(rest);
  else if (command === "options") listOptions();
  else if (command === "--version") process.stdout.write(`relievo ${version}\n`);
  else {
    process.stdout.write(`${USAGE}\n`);
    process.exitCode = command === undefined || command === "--help" || command === "-h" ? 0 : 1;
  }
} catch (error) {
  if (error instanceof RelievoError || error.code) fail(error.message);
  throw error;
}
