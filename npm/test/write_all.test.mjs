// Tests that the command line of the package writes its outputs and changes no other file.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { temporaryFolder } from "../../apps/studio/tests/support.mjs";
import { writeAll } from "../bin/write_all.js";

// Returns modes, times and contents of all files in a folder except those in `made`.
function seen(folder, made) {
  return fs.readdirSync(folder).filter((name) => !made.includes(name)).sort().map((name) => {
    const file = path.join(folder, name), { mode, mtimeMs } = fs.lstatSync(file);
    return [name, mode, mtimeMs, fs.readFileSync(file, "utf8")];
  });
}

test("files of others stay, whatever their names are and whether the outputs could be written", () => {
  const folder = temporaryFolder();
  const file = (name) => path.join(folder, name);
  const names = ["a.stl.relievo-ABCDEF", `a.stl.relievo-${process.pid}`, `a.stl.relievo-${process.pid}-0`,
    `b.png.relievo-${process.pid}`];
  for (const name of names) fs.writeFileSync(file(name), `of somebody else: ${name}`, { mode: 0o444 });
  fs.writeFileSync(file("precious"), "precious");
  fs.symlinkSync("precious", file(`b.png.relievo-${process.pid}-0`));
  const before = seen(folder, []), outputs = ["a.stl", "b.png"];
  writeAll(outputs.map((name) => [file(name), `new ${name}`]));
  assert.deepEqual(seen(folder, outputs), before);
  for (const name of outputs) assert.equal(fs.readFileSync(file(name), "utf8"), `new ${name}`);
  assert.throws(() => writeAll([[file("a.stl"), "newer"], [file("gone/b.png"), "newer"]]), { code: "ENOENT" });
  assert.deepEqual(seen(folder, outputs), before);
  assert.equal(fs.readFileSync(file("a.stl"), "utf8"), "new a.stl");
});
