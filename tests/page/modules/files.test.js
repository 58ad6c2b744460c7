/** What is said of an opened file. */

import assert from "node:assert/strict";
import { mock, test } from "node:test";

const box = { textContent: "", after() {} };
globalThis.document = { body: { append() {} }, documentElement: { dataset: {} }, querySelector: () => box, querySelectorAll: () => [] };
const { announceOpened } = await import("../../../app/page/files.js");

test("what an opened file has to say leaves by itself, later the longer it is", () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  announceOpened("plan.dxf", [], ["Coordinates are in metres. ".repeat(10)]);
  mock.timers.tick(20_000);
  assert.match(box.textContent, /plan\.dxf.*metres/);
  mock.timers.tick(20_000);
  assert.equal(box.textContent, "");
});
