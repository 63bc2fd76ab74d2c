// Tests the installed package: in an empty folder, as a module, with a bundler, under tsc --strict, and as a program.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { before, test } from "node:test";
import { packageFolder, relievo, temporaryFolder } from "./support.mjs";

const tools = path.join(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname), "node_modules");
let folder;

function node(args) {
  return spawnSync(process.execPath, args, { cwd: folder, encoding: "utf8" });
}

const program = (args) => node([path.join(folder, "node_modules/.bin/relievo"), ...args]);

before(async () => {
  folder = temporaryFolder();
  execFileSync("npm", ["pack", packageFolder, "--silent", "--pack-destination", folder]);
  const [tarball] = fs.readdirSync(folder);
  fs.writeFileSync(path.join(folder, "package.json"), JSON.stringify({ private: true, type: "module" }));
  execFileSync("npm", ["install", "--offline", "--no-audit", "--no-fund", "--silent", `./${tarball}`], { cwd: folder });
  fs.writeFileSync(path.join(folder, "scan.ply"), await relievo.sample("shell", { points: 20000 }));
});

test("README's example runs", () => {
  const readme = fs.readFileSync(path.join(folder, "node_modules/relievo/README.md"), "utf8");
  fs.writeFileSync(path.join(folder, "example.js"), readme.match(/```js\n([^]*?)```/)[1]);
  const { status, stdout, stderr } = node(["example.js"]);
  assert.equal(status, 0, stderr);
  assert.match(stdout, /\[ 1\d\d\./);
  assert.ok(fs.statSync(path.join(folder, "coin.stl")).size > 1e5);
  assert.equal(fs.readFileSync(path.join(folder, "coin.png")).subarray(1, 4).toString(), "PNG");
});

test("the licences of all libraries inside are part of the package", () => {
  const licences = fs.readFileSync(path.join(folder, "node_modules/relievo/LIBRARIES.txt"), "utf8");
  for (const library of ["libeigen3-dev", "libspng-dev", "libtiff-dev", "libzip-dev", "zlib1g-dev",
    "libharfbuzz-dev", "libfribidi-dev", "fonts-noto-core", "wasi-libc"])
    assert.match(licences, new RegExp(`\n${library}, `));
  assert.match(licences, /Permission is hereby granted/);
});

test("the program makes a relief with the native flags", () => {
  const { status, stderr } = program(["make", "scan.ply", "-o", "medal.stl", "--height", "2", "--outline=circle", "--report", "r.json", "--heightmap", "h.png"]);
  assert.equal(status, 0, stderr);
  assert.match(stderr, /medal\.stl: \d+ of 20000 points are visible in this view, height 2 mm/);
  const report = JSON.parse(fs.readFileSync(path.join(folder, "r.json")));
  assert.equal(report.height_mm.toFixed(6), "2.000000");
  assert.equal(fs.statSync(path.join(folder, "medal.stl")).size % 50, 84 % 50);
});

test("fonts and lists of ornaments are files beside the scan, in the program and in calls", async () => {
  const list = "list.json";
  const font = fs.readFileSync(new URL("../../src/lettering/fonts/NotoSerif-Bold.subset.ttf", import.meta.url));
  const ornaments = JSON.stringify([{ text: "LEX", font: "own.ttf" }, { kind: "line" }]);
  fs.writeFileSync(path.join(folder, "own.ttf"), font);
  fs.writeFileSync(path.join(folder, list), ornaments);
  const { status, stderr } = program(["make", "scan.ply", "-o", "list.stl", "--margin", "9", "--ornaments", list]);
  assert.equal(status, 0, stderr);
  const made = fs.readFileSync(path.join(folder, "list.stl"));
  const files = { "scan.ply": fs.readFileSync(path.join(folder, "scan.ply")), "own.ttf": font };
  const solid = async (more, options) => Buffer.from((await relievo.make({ ...files, ...more }, { marginMm: 9, ...options })).solid());
  assert.ok((await solid({ [list]: new TextEncoder().encode(ornaments) }, { ornaments: list })).equals(made));
  assert.ok((await solid({}, { ornaments: '[{"kind": "line"}]', text: "LEX", font: "own.ttf" })).equals(made));
  assert.ok(!(await solid({}, { ornaments: '[{"kind": "line"}]' })).equals(made));
  const alone = program(["make", "scan.ply", "-o", "alone.stl", "--text", "LEX", "--font", "own.ttf"]);
  assert.equal(alone.status, 0, alone.stderr);
});

test("the program fails with one line and the exit codes of the native program", () => {
  fs.writeFileSync(path.join(folder, "broken.ply"), "ply\nformat ascii 1.0\n");
  fs.mkdirSync(path.join(folder, "below"));
  for (const [args, code, message] of [
    [["make", "broken.ply", "-o", "b.stl"], 1, /^relievo: broken\.ply.*expected/],
    [["make", "below/../broken.ply", "-o", "b.stl"], 1, /^relievo: below\/\.\.\/broken\.ply.*expected/],
    [["make", path.join(folder, "broken.ply"), "-o", "b.stl"], 1, new RegExp(`^relievo: ${folder}/broken\\.ply.*expected`)],
    [["make", "scan.ply", "-o", "b.stl", "--height", "500"], 1, /^relievo: scan\.ply: expected a height that can be reached/],
    [["make", "missing.ply", "-o", "b.stl"], 1, /^relievo: missing\.ply: expected a file that can be read: no such file/],
    [["make", "scan.ply", "-o", "b.txt"], 2, /^relievo: .*expected a file ending in/],
    [["make", "scan.ply", "-o", "b.stl", "--height", "-1"], 2, /^relievo: --height: expected/],
    [["make", "scan.ply", "-o", "b.stl", "--points", "many"], 2, /^relievo: --points: expected a number, found 'many'/],
    [["make", "scan.ply", "-o", "b.stl", "--preview", "p.png", "--preview-size", "x"], 2, /^relievo: --preview-size: expected a number/],
    [["make", "scan.ply", "-o", "b.stl", "--heigth", "2"], 2, /found '--heigth', the nearest is --height; see relievo make --help/],
    [["make", "scan.ply", "-o", "b.stl", "--verbose", "2"], 2, /found '--verbose'; see/],
    [["make"], 2, /^relievo: expected input, found none/],
    [["mak"], 2, /found 'mak', the nearest is make; see relievo --help/],
    [[], 2, /^relievo: expected a command such as make, found none/]]) {
    const { status, stderr } = program(args);
    assert.equal(status, code, `${args.join(" ")}: ${stderr}`);
    assert.match(stderr, message);
    assert.equal(stderr.trim().split("\n").length, 1, stderr);
  }
  assert.ok(!fs.existsSync(path.join(folder, "b.stl")));
});

test("the program helps", () => {
  for (const args of [["--help"], ["make", "-h"], ["make", "--help"]]) {
    const { status, stdout, stderr } = program(args);
    assert.equal(status, 0, stderr);
    assert.match(stdout, /^Usage: relievo make INPUT/);
  }
  const scan = path.join("..", path.basename(folder), "scan.ply");
  assert.equal(program(["make", scan, "-o", "up.stl", "--quiet"]).status, 0);
});

test("a worker makes a relief, and can be ended", () => {
  fs.writeFileSync(path.join(folder, "worker.js"), `
    import fs from "node:fs";
    import { RelievoWorker } from "relievo/worker";
    const worker = new RelievoWorker(), scan = fs.readFileSync("scan.ply");
    let stages = 0;
    const { solids, report } = await worker.make(scan, { heightMm: 2, progress: () => { stages++; } }, { solids: ["3mf"] });
    const stop = new AbortController();
    setTimeout(() => stop.abort(), 50);
    const kind = await worker.make(scan, { signal: stop.signal }).then(() => "made", (error) => error.kind);
    const wrong = await worker.make(scan, { heightMm: -1 }).then(() => "made", (error) => error.input);
    console.log(Object.keys(solids), report.height_mm.toFixed(3), stages > 5, kind, wrong);`);
  const { status, stdout, stderr } = node(["worker.js"]);
  assert.equal(status, 0, stderr);
  assert.equal(stdout.trim(), "[ '3mf' ] 2.000 true cancelled heightMm");
});

test("a bundle for browsers has all inside", () => {
  fs.writeFileSync(path.join(folder, "page.js"), `
    import { make, sample } from "relievo";
    const relief = await make(await sample("shell", { points: 20000 }), { heightMm: 2 });
    console.log(relief.solid("stl").length);`);
  execFileSync(path.join(tools, ".bin/esbuild"), ["page.js", "--bundle", "--format=esm", "--platform=browser", "--outfile=bundle.mjs",
    "--log-level=warning"], { cwd: folder, stdio: "pipe" });
  fs.mkdirSync(path.join(folder, "alone"));
  fs.renameSync(path.join(folder, "bundle.mjs"), path.join(folder, "alone/bundle.mjs"));
  const { status, stdout, stderr } = node(["alone/bundle.mjs"]);
  assert.equal(status, 0, stderr);
  assert.ok(Number(stdout) > 1e5);
});

test("types hold under tsc --strict", () => {
  const compile = (name, text) => {
    fs.writeFileSync(path.join(folder, name), text);
    return spawnSync(path.join(tools, ".bin/tsc"), ["--strict", "--noEmit", "--target", "es2022", "--module", "nodenext", "--lib", "es2022,dom",
      "--types", "", name], { cwd: folder, encoding: "utf8" });
  };
  const right = compile("right.ts", `
    import { make, Session, RelievoError, type ReliefOptions } from "relievo";
    import { RelievoWorker } from "relievo/worker";
    const options: ReliefOptions = { heightMm: "4in", outline: "circle", draftDeg: 15, tone: "0,1" };
    const numbers: ReliefOptions = { view: [1, 0, 3], tone: [[0, 1], [1, .5]], base: "wave:height=5", denoise: 0 };
    const relief = await make({ points: new Float64Array(9) }, { ...options, ...numbers, progress: (stage: string) => stage !== "normals" });
    const size: number = relief.report.size_mm[2] + relief.heightMap({ size: 10 }).heights.length;
    const session = await Session.open(new Uint8Array());
    const pixels: Uint8ClampedArray = session.picture(session.frame({ ...options, rimMm: null }), { yawDeg: 3 }).pixels;
    const made = await new RelievoWorker().make(new ArrayBuffer(1), options, { preview: {} });
    try { console.log(size, pixels, made.preview?.length); } catch (error) { if (error instanceof RelievoError) console.log(error.place); }
    export {};`);
  assert.equal(right.status, 0, right.stdout);
  const wrong = compile("wrong.ts", `import { make } from "relievo"; make(new Uint8Array(), { hightMm: 2 }); make("scan.ply");
    make({ points: [[0, 0, 0]] }, { outline: "circel" });`);
  assert.match(wrong.stdout, /hightMm/);
  assert.match(wrong.stdout, /scan\.ply|string/);
  assert.match(wrong.stdout, /circel/);
});
