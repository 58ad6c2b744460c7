/** What is said of an opened file. */

import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";

const box = { textContent: "", after() {} };
globalThis.document = { body: { append() {} }, documentElement: { dataset: {} }, querySelector: () => box, querySelectorAll: () => [] };
globalThis.addEventListener = () => {};
globalThis.ResizeObserver = class {
  observe() {}
};
const { announceOpened } = await import("../../../app/page/files.js");
const { announce } = await import("../../../app/page/overlays.js");
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
