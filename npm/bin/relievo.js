#!/usr/bin/env node
// The command line of the package: `relievo make` with the flags of the native program.
import fs from "node:fs";
import path from "node:path";
import { RelievoError } from "../src/engine.js";
import { newEngine } from "../src/new_engine.js";
import { optionTable, version } from "../src/options.js";
import { writeAll } from "./write_all.js";

const OUTPUTS = { output: "solid", preview: "preview", heightmap: "heightmap", "tool-picture": "tool_picture", report: "report" };
const MAP_VALUES = ["pixel", "dpi", "heightmap-bits", "heightmap-area", "heightmap-zero", "heightmap-high"];
const OTHER_VALUES = [...MAP_VALUES, "units", "heightmap-size", "preview-size", "stream-above", "base-image", "threads", ...Object.keys(OUTPUTS)];

// Ends the program with exit code 2 for misuse, and 1 for bad input or output.
function fail(message, code = 1) {
  process.stderr.write(`relievo: ${message}\n`);
  process.exit(code);
}

const misuse = (message) => fail(message, 2);

const USAGE = `Usage: relievo make INPUT... -o OUT [--preview P.png] [--heightmap H.png] [--report R.json] [OPTION VALUE]...
       relievo options
       relievo --version
The native program does the same and more: info, studio, sample, batch, compare and bench.
`;

// Returns ", the nearest is ..." if a user may have meant one of the names; otherwise an empty text.
async function nearest(name, names) {
  const { json } = (await newEngine()).call("nearest", { name, names });
  return json.name && `, the nearest is ${json.name}`;
}

async function refuseFlag(typed, known) {
  const near = await nearest(typed, [...known, "quiet", "help"].map((name) => `--${name}`));
  misuse(`expected only known options, found '${typed}'${near}; see relievo make --help`);
}

// Returns { inputs, values } of the arguments. The value of a flag follows "=" or is the next argument.
async function parse(args) {
  const inputs = [], values = {};
  const known = new Set([...optionTable.map((option) => option.name), ...OTHER_VALUES]);
  for (let i = 0; i < args.length; i++) {
    const arg = args[i] === "-o" ? "--output" : args[i];
    if (arg === "--help" || arg === "-h") values.help = true;
    else if (!arg.startsWith("-") || arg === "-") inputs.push(arg);
    else if (arg === "--quiet") values.quiet = true;
    else {
      const [flag, given] = arg.includes("=") ? [arg.slice(2, arg.indexOf("=")), arg.slice(arg.indexOf("=") + 1)] : [arg.slice(2), args[++i]];
      if (!known.has(flag)) await refuseFlag(arg.split("=")[0], known);
      if (given === undefined) misuse(`--${flag}: expected a value`);
      values[flag] = given;
    }
  }
  return { inputs, values };
}

// Returns whether the text has lengths that --units applies to. The option mm-per-value has its unit in its name.
function isOfUnits(option, text) {
  if (option.unit === "TOOL") return !/^v:[^:]*$/.test(text); // such a tool has an angle but no length
  return ["MM", "WxH", "X,Y"].includes(option.unit) && option.name !== "mm-per-value";
}

// Returns the value of an option. A length without a unit is in the unit of --units, as in the native program.
function optionValue(option, text, units) {
  if (units === "in" && isOfUnits(option, text) && /[\d.]\s*$/.test(text)) return `${text}in`;
  const isNumber = text.trim() !== "" && Number.isFinite(Number(text));
  if (option.unit === "MM") return isNumber ? Number(text) : text;
  const isOfNumbers = "min" in option || "max" in option || typeof option.default === "number";
  if (!isOfNumbers) return text;
  if (!isNumber) misuse(`--${option.name}: expected a number, found '${text}'`);
  return Number(text);
}

function numberOf(values, flag, otherwise) {
  const value = Number(values[flag] ?? otherwise);
  if (!Number.isFinite(value)) misuse(`--${flag}: expected a number, found '${values[flag]}'`);
  return value;
}

// Returns a file on disk, which the engine reads in blocks.
function fileOnDisk(name) {
  let descriptor;
  try {
    descriptor = fs.openSync(name, "r");
  } catch ({ message }) { // such as "ENOENT: no such file or directory, open 'scan.ply'"
    const reason = message.replace(/^\w+: |, open .*/g, "");
    throw new RelievoError({ kind: "input", message: `${name}: expected a file that can be read: ${reason}` });
  }
  const status = fs.fstatSync(descriptor);
  if (!status.isFile()) throw new RelievoError({ kind: "input", message: `${name}: expected a file` });
  return { size: status.size, read: (offset, to) => fs.readSync(descriptor, to, 0, to.length, offset) };
}

const REFERRING = [".obj", ".gltf", ".json", ".relievo"];
const NAMING_FILES = ["font", "ornaments"]; // options whose values may be paths

// Gives the engine the input files under the names that the user typed. If these files can refer to other files, also
// gives the engine all files in their folders.
function addFiles(engine, inputs) {
  const add = (file) => {
    const name = file.split(path.sep).join("/");
    engine.addFile(name, fileOnDisk(file));
    return name;
  };
  for (const input of inputs.filter((name) => REFERRING.includes(path.extname(name).toLowerCase()))) {
    const folder = input.slice(0, input.length - path.basename(input).length);
    for (const entry of fs.readdirSync(folder || ".", { withFileTypes: true })) if (entry.isFile()) add(folder + entry.name);
  }
  return inputs.map(add);
}

function showProgress(isQuiet) {
  if (isQuiet || !process.stderr.isTTY) return null;
  return (stage, fraction) => { process.stderr.write(`\r\x1b[K${Math.round(100 * fraction)} % ${stage}`); };
}

async function make(args) {
  const { inputs, values } = await parse(args);
  if (values.help) return listOptions(USAGE);
  if (inputs.length === 0) misuse("expected input, found none; see relievo make --help");
  if (!values.output) misuse("expected --output, found none; see relievo make --help");
  const units = values.units ?? "mm";
  const engine = await newEngine();
  const request = { inputs: addFiles(engine, inputs), options: {} };
  if (values.camera && fs.existsSync(values.camera)) values.camera = fs.readFileSync(values.camera, "utf8");
  if (values["stream-above"]) request.stream_above_mb = numberOf(values, "stream-above");
  addFiles(engine, NAMING_FILES.map((name) => values[name]).filter((name) => name && fs.existsSync(name)));
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
          heightmap_px: numberOf(values, "heightmap-size", 1024), preview_px: numberOf(values, "preview-size", 1200) }).bytes;
    files.push([values[flag], bytes]);
  }
  writeAll(files);
  if (values.quiet) return;
  for (const line of json.remarks) process.stderr.write(`${line}\n`);
  process.stderr.write(`${values.output}: ${json.report.visible_points} of ${json.report.input_points} points are visible in this view, height ${json.report.height_mm.toFixed(4).replace(/\.?0+$/, "")} mm\n`);
}

function listOptions(head = "") {
  process.stdout.write(head);
  for (const { name, unit, help, default_text: initial } of optionTable)
    process.stdout.write(`--${name} ${unit}\n    ${help}${initial ? ` [${initial}]` : ""}\n`);
}

async function refuseCommand(command) {
  misuse(`expected make or options, found '${command}'${await nearest(command, ["make", "options"])}; see relievo --help`);
}

// Ends the program with an error. An error of an option names its flag and counts as misuse, as in the native program.
function end(error) {
  if (error.kind !== "option") fail(error.message);
  const isFlag = optionTable.some(({ name }) => name === error.input) || OTHER_VALUES.includes(error.input);
  misuse(isFlag ? `--${error.message}` : error.message);
}

const [command, ...rest] = process.argv.slice(2);
try {
  if (command === "make") await make(rest);
  else if (command === "options") listOptions();
  else if (command === "--version") process.stdout.write(`relievo ${version}\n`);
  else if (command === "--help" || command === "-h") process.stdout.write(USAGE);
  else if (command === undefined) misuse("expected a command such as make, found none; see relievo --help");
  else await refuseCommand(command);
} catch (error) {
  if (error instanceof RelievoError || error.code) end(error);
  throw error;
}
