/** The words of a card of a proposed dance. */

import assert from "node:assert/strict";
import { test } from "node:test";

globalThis.document = { documentElement: { dataset: {} }, querySelectorAll: () => [] };
const { cardWords } = await import("../../../app/page/cards.js");
const { learn } = await import("../../../app/page/text.js");
const { SQUARE } = await import("../../../app/page/words/square.js");

const NEAR = { name: "square", distance: 0.9, in_place: 1.5 };
const PROPOSAL = { duration: 60, length: 60, tolerance: 0.62, turns: 2, near: NEAR, clearance: 0.42, clearance_in_place: 1.02, sharpest_bend: 0.3 };
const tightOf = (dance) => {
  const proposal = { ...PROPOSAL, dance: { dragon: { benches: 9 }, ...dance } };
  return cardWords(proposal, [proposal], "square").tight.match(/[\d.]+ c?m/g);
};

test("a distance is that of people in place, from which the safe stray counts, and beside it that of those who stray", () => {
  learn(SQUARE);
  assert.deepEqual(tightOf({ stray: 0.3 }), ["1.02 m", "0.42 m", "30 cm"]);
  assert.deepEqual(tightOf({}), ["1.02 m"]);
});
