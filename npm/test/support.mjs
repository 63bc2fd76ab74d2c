// Provides the built package to the tests, and the native program for comparison.
import { execFileSync } from "node:child_process";
import path from "node:path";
import { pathToFileURL } from "node:url";

export { temporaryFolder } from "../../apps/studio/tests/support.mjs";
export const packageFolder = process.env.PACKAGE ?? path.resolve(import.meta.dirname ?? ".", "../../build/web/npm");
export const relievo = await import(pathToFileURL(path.join(packageFolder, "src/index.js")));
export const native = process.env.RELIEVO;

export function run(program, args, options = {}) {
  return execFileSync(program, args, { encoding: "utf8", stdio: "pipe", ...options });
}
