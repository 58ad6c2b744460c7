/** Which questions get an answer, how often the page asks whether the service is alive, and what it tells of one that is lost. */

import assert from "node:assert/strict";
import { afterEach, beforeEach, mock, test } from "node:test";

globalThis.document = { hidden: false, querySelector: () => null, querySelectorAll: () => [], documentElement: { dataset: {} } };
const { Problem, Service, Superseded } = await import("../../../app/page/api.js");
const begun = (tell = {}) => new Service({ lost() {}, back() {}, busy() {}, refused: async () => {}, ...tell });
const answering = (status, body, headers = {}) => ({ ok: status === 200, status, headers: new Headers(headers), json: async () => body });
let clock = 0;
const passes = (milliseconds) => {
  clock += milliseconds;
  mock.timers.tick(milliseconds);
  return new Promise((resolve) => setImmediate(resolve));
};

beforeEach(() => {
  mock.timers.enable({ apis: ["setTimeout"] });
  mock.method(performance, "now", () => clock);
});
afterEach(() => {
  mock.timers.reset();
  mock.restoreAll();
});

test("a service that answers is asked every five seconds whether it is alive, also while much is asked", async () => {
  const asked = [];
  globalThis.fetch = async (url) => (asked.push(url), answering(200, {}));
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
    if (answers) return answering(200, "answer");
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

test("who drags a number sees answers meanwhile, also slow ones, and the newest one at last; others are given up", async () => {
  const shown = [];
  let aborted = 0;
  globalThis.fetch = (url, { signal }) =>
    new Promise((resolve, reject) => {
      setTimeout(() => resolve(answering(200, url)), 400);
      signal.addEventListener("abort", () => {
        aborted++;
        reject(signal.reason);
      });
    });
  const service = begun();
  for (let k = 0; k < 60; k++) {
    service.ask("contact", `dragged-${k}`).then((answer) => shown.push(answer), (error) => assert.ok(error instanceof Superseded));
    await passes(50);
  }
  assert.ok(shown.length >= 2, `${shown.length} answers in 3 s`);
  assert.ok(aborted >= 1);
  for (let k = 0; k < 40; k++) await passes(50);
  assert.equal(shown.at(-1), "dragged-59");
});

test("a refusal that comes late is not shown beside numbers that are right again", async () => {
  const held = [];
  globalThis.fetch = () => new Promise((resolve) => held.push(resolve));
  const service = begun();
  const wrong = assert.rejects(service.ask("pitch", "wrong"), Superseded);
  const right = service.ask("pitch", "right");
  held.pop()(answering(422, { detail: "wide" }));
  await wrong;
  await passes(0);
  held.pop()(answering(200, 0.45));
  assert.equal(await right, 0.45);
  const again = assert.rejects(service.ask("pitch", "wrong"), Problem);
  await passes(0);
  held.pop()(answering(422, { detail: "wide" }));
  await again;
});

test("a busy service is asked again when it says so, if that is soon", async () => {
  const answers = [answering(503, {}, { "Retry-After": "1" }), answering(200, "answer"), answering(503, {}, { "Retry-After": "60" })];
  globalThis.fetch = async () => answers.shift();
  const service = begun();
  const asked = service.ask("contact", "collision-time");
  await passes(0);
  await passes(999);
  assert.equal(answers.length, 2);
  await passes(1);
  assert.equal(await asked, "answer");
  await assert.rejects(service.ask("contact", "collision-time"), Problem);
});
