// Limits the size of the files that a page loads and that npm installs.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { test } from "node:test";
import zlib from "node:zlib";
import { packageFolder, temporaryFolder } from "./support.mjs";

const LARGEST_MODULE = 1_230_000; // in bytes, compressed by gzip -9
const LARGEST_PAGE = 2_045_000; // in bytes, without the pictures of samples
const LARGEST_TARBALL = 1_250_000;

for (const module of process.env.MODULES.split(":"))
  test(`the module ${path.basename(module)} keeps to its size`, (t) => {
    const size = zlib.gzipSync(fs.readFileSync(module), { level: 9 }).length;
    t.diagnostic(`${size} bytes of gzip -9`);
    assert.ok(size <= LARGEST_MODULE, `${size} bytes`);
  });

test("the page keeps to its size", (t) => {
  const page = fs.readFileSync(path.join(process.env.PAGE, "relievo.html"), "utf8");
  const size = page.replace(/"data:image\/jpeg[^"]*"/g, "").length;
  t.diagnostic(`${size} bytes`);
  assert.ok(size <= LARGEST_PAGE, `${size} bytes`);
});

test("the tarball keeps to its size and has no dependencies", (t) => {
  const folder = temporaryFolder();
  execFileSync("npm", ["pack", packageFolder, "--silent", "--pack-destination", folder]);
  const [name] = fs.readdirSync(folder);
  const { size } = fs.statSync(path.join(folder, name));
  t.diagnostic(`${size} bytes`);
  assert.ok(size <= LARGEST_TARBALL, `${size} bytes`);
  const { dependencies, peerDependencies } = JSON.parse(fs.readFileSync(path.join(packageFolder, "package.json")));
  assert.deepEqual({ ...dependencies, ...peerDependencies }, {});
});

test("nothing is evaluated from text", () => {
  const sources = fs.readdirSync(path.join(packageFolder, "src")).filter((name) => name.endsWith(".js") && name !== "module.js");
  for (const name of sources)
    assert.doesNotMatch(fs.readFileSync(path.join(packageFolder, "src", name), "utf8"), /\beval\(|new Function\(/, name);
});
