/** What is said over the page and told to those who listen, and the corner of the inset. */

import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";

const boxes = {};
const boxOf = (selector) => (boxes[selector] ??= { textContent: "", dataset: {} });
globalThis.document = { documentElement: { dataset: {} }, querySelector: boxOf, querySelectorAll: () => [] };
const { lost, placeInset, tell } = await import("../../../app/page/overlays.js");

beforeEach(() => mock.timers.enable({ apis: ["setTimeout"] }));
afterEach(() => mock.timers.reset());

test("a lost service is said to be tried again in some seconds, or now", () => {
  lost(2);
  assert.match(boxes["#lost span"].textContent, /does not answer.*next try in 2 s/);
  lost(0);
  assert.match(boxes["#lost span"].textContent, /trying again now/);
  assert.equal(boxes["#lost"].hidden, false);
});

test("an answer is told once nothing changes any more, and no answer is told twice", () => {
  const told = [];
  boxes["#heard"] = { get textContent() { return told.at(-1) ?? ""; }, set textContent(words) { told.push(words); } };
  const answer = (hidden, ...sentences) => ({ hidden, querySelectorAll: () => sentences.map((textContent) => ({ textContent })) });
  for (const words of ["✓Can be danced", "✕Cannot be danced", "✕Cannot be danced"]) {
    tell(answer(false, "Verdict", words));
    mock.timers.tick(500);
  }
  assert.deepEqual(told, []);
  mock.timers.tick(500);
  tell(answer(false, "Verdict", "✕Cannot be danced"));
  mock.timers.tick(1_000);
  assert.deepEqual(told, ["Verdict Cannot be danced"]);
  tell(answer(true, "Verdict"));
  mock.timers.tick(1_000);
  assert.deepEqual(told.slice(1), [""]);
});

test("the inset goes where it covers least of the dragon, and stays where no corner is better", () => {
  const lefts = { "top-right": 900, "bottom-right": 901, "top-left": 100 };
  const inset = (boxes["#inset"] = { hidden: false, dataset: { corner: "top-right" } });
  inset.getBoundingClientRect = () => ({ left: lefts[inset.dataset.corner], top: 70, right: 950, bottom: 170 });
  boxes["#stage"] = { getBoundingClientRect: () => ({ left: 100, top: 50 }) };
  const corner = (...counts) => {
    placeInset((rectangles) => {
      assert.deepEqual(rectangles.map(({ left, top, right, bottom }) => [left, top, right, bottom]), [[800, 20, 850, 120], [801, 20, 850, 120], [0, 20, 850, 120]]);
      return counts;
    });
    return inset.dataset.corner;
  };
  assert.equal(corner(3, 4, 5), "top-right");
  assert.equal(corner(3, 4, 1), "top-left");
  assert.equal(corner(1, 4, 1), "top-left");
  assert.equal(corner(0, 0, 1), "top-right");
  inset.hidden = true;
  assert.equal(corner(9, 0, 9), "top-right");
});
