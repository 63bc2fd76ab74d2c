// Provides the built package to the tests, and the native program for comparison.
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

export const packageFolder = process.env.PACKAGE ?? path.resolve(import.meta.dirname ?? ".", "../../build/web/npm");
export const relievo = await import(pathToFileURL(path.join(packageFolder, "src/index.js")));
export const native = process.env.RELIEVO;

export function temporaryFolder(t) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "relievo-npm-"));
  t.after(() => fs.rmSync(folder, { recursive: true, force: true }));
  return folder;
}

export function run(program, args, options = {}) {
  return execFileSync(program, args, { encoding: "utf8", stdio: "pipe", ...options });
}
