// Tests that the page parses numbers as the library does: both are tested with the same cases.
import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {test} from "node:test";
import {pageModule} from "./support.mjs";

const {parseLength} = await pageModule("lengths.js");
const cases = JSON.parse(readFileSync(new URL("../../../tests/core/lengths.json", import.meta.url), "utf8"));

test("reads lengths as the command line does", () => {
  assert.ok(cases.length > 50);
  for (const [text, mm] of cases) {
    const found = parseLength(text), isRight = mm === null ? Number.isNaN(found) : Math.abs(found - mm) < 1e-12;
    assert.ok(isRight, `'${text}' is ${found}, expected ${mm}`);
  }
});

test("takes units of lengths only", () => {
  assert.equal(parseLength("2,5", false), 2.5);
  assert.ok(Number.isNaN(parseLength("2.5mm", false)));
});
