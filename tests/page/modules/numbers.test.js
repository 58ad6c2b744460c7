/** Numbers as text, and texts as numbers. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { numberIn } from "../../../app/page/elements.js";
import { numbersOf, strayOf } from "../../../app/page/fields.js";
import { bound, formatNumber, setExact } from "../../../app/page/numbers.js";

test("a bound is rounded to the side on which it still holds", () => {
  for (const [value, decimals, way, text] of [
    [0.12341, 3, 1, "0.124"], [0.12349, 3, -1, "0.123"], [0.5, 3, 1, "0.500"], [0.5, 3, -1, "0.500"], [-0.12341, 3, -1, "-0.124"], [-0.12349, 3, 1, "-0.123"],
  ]) assert.equal(bound(value, decimals, way), text);
});

test("numbers have all their digits, or those that people say", () => {
  assert.equal(formatNumber(412.473838, 6, 2), "412.473838");
  setExact(false);
  assert.equal(formatNumber(412.473838, 6, 2), "412.47");
  for (const [value, text] of [[-1e-13, "0.00"], [-0.01, "-0.01"]]) assert.equal(formatNumber(value, 6, 2), text);
  setExact(true);
});

test("a number may be typed with a comma, a sign or an exponent, and any other text stays", () => {
  for (const [text, value] of [[" 2,5 ", 2.5], ["-.5", -0.5], ["+3", 3], ["1e3", 1000], ["5.", 5], [",5", 0.5]]) assert.equal(numberIn(text), value);
  for (const text of ["55cm", "1,2,3", "wide", "", "0x10", "Infinity"]) assert.equal(numberIn(text), text);
});

test("texts that are no numbers reach the service as they are", () => {
  assert.deepEqual(numbersOf({ pitch: "0.5", benches: " 9 ", width: "x", margin: "" }), { pitch: 0.5, benches: 9, width: "x", margin: "" });
});

test("a hole is off its place by the stray and half the play of its pin", () => {
  assert.ok(Math.abs(strayOf({ stray: "0.02", hole: "0.055", pin: "0.045" }) - 0.025) < 1e-15);
});
