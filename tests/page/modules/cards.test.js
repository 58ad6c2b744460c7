/** The words of a card of a proposed dance. */

import assert from "node:assert/strict";
import { test } from "node:test";

globalThis.document = { documentElement: { dataset: {} }, querySelectorAll: () => [] };
const { cardTitles, cardWords } = await import("../../../app/page/cards.js");
const { setLanguage, teach } = await import("../../../app/page/text.js");

const NEAR = { name: "square", distance: 0.9, in_place: 1.5 };
const PROPOSAL = { duration: 60, length: 60, tolerance: 0.62, turns: 2, near: NEAR, clearance: 0.42, clearance_in_place: 1.02, sharpest_bend: 0.3 };
const tightOf = (dance) => {
  const proposal = { ...PROPOSAL, dance: { dragon: { benches: 9 }, ...dance } };
  return cardWords(proposal, [proposal], "square").tight.match(/[\d.]+ c?m/g);
};

test("a distance is that of people in place, from which the safe stray counts, and beside it that of those who stray", () => {
  assert.deepEqual(tightOf({ stray: 0.3 }), ["1.02 m", "0.42 m", "30 cm"]);
  assert.deepEqual(tightOf({}), ["1.02 m"]);
  const near = { name: "linden", distance: 0.7, in_place: 0.7 };
  assert.match(cardWords({ ...PROPOSAL, dance: { dragon: { benches: 9 } }, near, clearance: 2 }, [], "square").tight, /linden.*0\.70 m|0\.70 m.*linden/);
});

test("two rings are told apart by how wide they are, without the place where the dragon stands before", () => {
  const turns = [...Array(13).keys()].map((k) => (2 * Math.PI * k) / 12);
  const around = (radius) => ({ s: [-9, ...turns], x: [11, ...turns.map((turn) => radius * Math.cos(turn))], y: [0, ...turns.map((turn) => radius * Math.sin(turn))] });
  const rings = { proposals: [9, 6].map(() => ({ ...PROPOSAL, figure: "ring", gates: [] })), courses: [9, 6].map(around), yard: [[-12, -10], [12, -10], [12, 10], [-12, 10]] };
  teach("zh", { Ring: "环形", "{wide} m wide": "宽 {wide} m", "{figure}, {parts}": "{figure}，{parts}" });
  for (const [lang, wide] of [["zh", "环形，宽 ? m"], ["en", "Ring, ? m wide"]]) {
    setLanguage(lang);
    assert.deepEqual(cardTitles(rings, []), ["18", "12"].map((width) => wide.replace("?", width)));
  }
});
