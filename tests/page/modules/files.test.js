/** What is said of an opened file, and of a lost service. */

import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";

const box = { textContent: "", after() {} };
globalThis.document = { body: { append() {} }, documentElement: { dataset: {} }, querySelector: () => box, querySelectorAll: () => [] };
globalThis.addEventListener = () => {};
globalThis.ResizeObserver = class {
  observe() {}
};
const { announceOpened } = await import("../../../app/page/files.js");
const { announce, lost } = await import("../../../app/page/overlays.js");
const NOTE = "Coordinates are in metres. ".repeat(10);

beforeEach(() => mock.timers.enable({ apis: ["setTimeout"] }));
afterEach(() => mock.timers.reset());

test("what an opened file has to say leaves by itself, later the longer it is", () => {
  announceOpened("plan.dxf", [], [NOTE]);
  mock.timers.tick(20_000);
  assert.match(box.textContent, /plan\.dxf.*metres/);
  mock.timers.tick(20_000);
  assert.equal(box.textContent, "");
});

test("it comes back after another message, until a person has had time to read it", () => {
  announceOpened("plan.dxf", [], [NOTE]);
  mock.timers.tick(5_000);
  announce(() => "Saved dance.json.");
  assert.equal(box.textContent, "Saved dance.json.");
  mock.timers.tick(20_000);
  assert.match(box.textContent, /metres/);
  mock.timers.tick(60_000);
  assert.equal(box.textContent, "");
});

test("a lost service is said to be tried again in some seconds, or now", () => {
  lost(2);
  assert.match(box.textContent, /does not answer.*next try in 2 s/);
  lost(0);
  assert.match(box.textContent, /trying again now/);
  assert.equal(box.hidden, false);
});
