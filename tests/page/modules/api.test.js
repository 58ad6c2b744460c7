/** How often the page asks whether the service is alive, and what it tells of one that is lost. */

import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";

globalThis.document = { hidden: false, querySelector: () => null, querySelectorAll: () => [], documentElement: { dataset: {} } };
const { Service } = await import("../../../app/page/api.js");
const begun = (tell = {}) => new Service({ lost() {}, back() {}, busy() {}, refused: async () => {}, ...tell });
const passes = (milliseconds) => (mock.timers.tick(milliseconds), new Promise((resolve) => setImmediate(resolve)));

beforeEach(() => mock.timers.enable({ apis: ["setTimeout"] }));
afterEach(() => mock.timers.reset());

test("a service that answers is asked every five seconds whether it is alive, also while much is asked", async () => {
  const asked = [];
  globalThis.fetch = async (url) => (asked.push(url), { ok: true, status: 200, json: async () => ({}) });
  const service = begun();
  for (let k = 0; k < 300; k++) {
    await service.ask("contact", "collision-time");
    await passes(100);
  }
  const beats = asked.filter((url) => url === "healthz").length;
  assert.ok(beats >= 4 && beats <= 6, `${beats} beats in 30 s`);
});

test("one check at a time asks whether a service that hangs is alive, however often somebody tries again", async () => {
  let [checks, running, most] = [0, 0, 0];
  globalThis.fetch = async (url) => {
    if (url === "healthz") {
      [checks, running] = [checks + 1, running + 1];
      most = Math.max(most, running);
      await new Promise((resolve) => setTimeout(resolve, 300));
      running--;
    }
    throw new TypeError("lost");
  };
  const service = begun();
  await passes(5_000); // the usual check is on its way when a question finds that the service is lost
  for (const channel of ["contact", "pitch"]) service.ask(channel, channel);
  for (let k = 0; k < 30; k++) {
    await passes(100);
    for (let press = 0; press < 3; press++) service.retry();
  }
  assert.ok(checks > 2, `${checks} checks`);
  assert.equal(most, 1);
});

test("the next try at a service that hangs is counted down, after a longer time each, until it is back", async () => {
  const told = [];
  let [answers, hung] = [false, null];
  globalThis.fetch = async (url, { signal }) => {
    if (answers) return { ok: true, status: 200, json: async () => "answer" };
    if (url === "healthz" && !hung) await (hung = new Promise((resolve) => signal.addEventListener("abort", resolve)));
    throw new TypeError("lost");
  };
  const service = begun({ lost: (seconds) => told.push(seconds), back: () => told.push("back") });
  const asked = service.ask("contact", "collision-time");
  await passes(0);
  await passes(1_000);
  assert.deepEqual(told, [1, 0]);
  const running = setInterval(() => {}, 1_000);
  await hung; // The first check has neither an answer nor an end.
  clearInterval(running);
  for (let k = 0; k < 15; k++) await passes(1_000);
  assert.deepEqual(told, [1, 0, 2, 1, 0, 4, 3, 2, 1, 0, 8, 7, 6, 5, 4, 3, 2, 1, 0, 8]);
  answers = true;
  service.retry();
  await passes(0);
  assert.equal(await asked, "answer");
  assert.deepEqual(told.slice(-2), [0, "back"]);
});
