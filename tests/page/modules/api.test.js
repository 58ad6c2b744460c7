/** How often the page asks whether the service is alive. */

import assert from "node:assert/strict";
import { mock, test } from "node:test";

test("a service that answers is asked every five seconds whether it is alive, also while much is asked", async () => {
  globalThis.document = { hidden: false, querySelector: () => null, querySelectorAll: () => [], documentElement: { dataset: {} } };
  const asked = [];
  globalThis.fetch = async (url) => (asked.push(url), { ok: true, status: 200, json: async () => ({}) });
  mock.timers.enable({ apis: ["setTimeout"] });
  const { Service } = await import("../../../app/page/api.js");
  const service = new Service({ lost() {}, back() {}, busy() {}, refused: async () => {} });
  for (let k = 0; k < 300; k++) {
    await service.ask("contact", "collision-time");
    mock.timers.tick(100);
    await new Promise((resolve) => setImmediate(resolve));
  }
  const beats = asked.filter((url) => url === "healthz").length;
  assert.ok(beats >= 4 && beats <= 6, `${beats} beats in 30 s`);
});
