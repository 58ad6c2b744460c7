/** The dance between the samples of the service. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Problem } from "../../../app/page/api.js";
import { Track, speedTimes } from "../../../app/page/track.js";

const RADIUS = 2; // [m]: on wider curves motion is smoother
const SMOOTH = 1e-3; // [m]; a bench is 0.3 m wide
const HANDLES = 3_000; // many, so that a chunk holds few instants
const SPAN = [-5, 55];

/** Handles one after another on a circle, at a speed of 1 m/s. */
const angle = (time, k) => (time - 0.5 * k) / RADIUS;
const row = (time, of) => Array.from({ length: HANDLES }, (_, k) => RADIUS * of(angle(time, k)));
function table({ start, stop, step }) {
  const time = Array.from({ length: Math.round((stop - start) / step) + 1 }, (_, k) => Math.min(start + k * step, stop));
  return { time, x: time.map((one) => row(one, Math.cos)), y: time.map((one) => row(one, Math.sin)), speed: time.map(() => Array(HANDLES).fill(1)) };
}

/** A track, and what it asked for. */
function begun(answer = async (_, times) => table(times)) {
  const asked = [];
  let arrived = () => {};
  const track = new Track((chunk, times, decimals) => (asked.push(chunk), answer(chunk, times, decimals)), SPAN, HANDLES, 1, () => arrived());
  const at = async (time) => {
    while (!track.at(time)) await new Promise((resolve) => (arrived = resolve));
    return track.at(time);
  };
  return { track, asked, at };
}

test("motion between samples is true to a millimetre", async () => {
  const { at } = begun();
  for (const time of [-5, -4.9, 0, 23.33, 37.77, 54.99, 55]) {
    const { x, y, speed } = await at(time);
    for (const k of [0, 7, HANDLES - 1]) {
      const [dx, dy] = [x[k] - RADIUS * Math.cos(angle(time, k)), y[k] - RADIUS * Math.sin(angle(time, k))];
      assert.ok(Math.hypot(dx, dy) < SMOOTH, `handle ${k} at ${time} s is off by ${Math.hypot(dx, dy)} m`);
      assert.ok(Math.abs(speed[k] - 1) < 1e-12);
    }
  }
});

test("chunks are asked for once, ahead of the time shown, and all of them where a film is to be whole", async () => {
  const { track, asked, at } = begun();
  await at(-5);
  await at(-4.5);
  assert.deepEqual(asked, [0]);
  await at(1);
  assert.deepEqual(asked, [0, 1]);
  assert.equal(track.isWhole, false);
  await track.hold();
  assert.equal(track.isWhole, true);
  assert.equal(new Set(asked).size, asked.length);
  assert.equal(track.cells, track.samples * HANDLES);
});

test("what the service refuses is kept and not asked again until somebody plays again", async () => {
  const { track, asked } = begun(async () => { throw new Problem(422, { detail: "too many", template: "too many" }); });
  assert.equal(track.at(-4), null);
  await new Promise(setImmediate);
  assert.equal(track.refusal.detail, "too many");
  assert.equal(track.at(-4), null);
  assert.equal(asked.length, 1);
  track.retry();
  track.at(-4);
  assert.equal(asked.length, 2);
});

test("a dance that was replaced asks for nothing more", async () => {
  const { track, asked } = begun(async () => { throw new Error("aborted"); });
  track.at(-4);
  await new Promise(setImmediate);
  track.at(30);
  assert.deepEqual([asked.length, track.stopped], [1, true]);
});

test("the colours of a dance are those of fewer instants where it has more handles", () => {
  const count = (benches) => {
    const { start, stop, step } = speedTimes({ begin: 2, end: 102, numbers: { benches } });
    assert.deepEqual([start, stop], [2, 102]);
    return Math.round((stop - start) / step);
  };
  assert.deepEqual([5, 223, 2000, 100_000].map(count), [100, 53, 8, 8]);
  assert.deepEqual(speedTimes({ begin: 3, end: 3, numbers: { benches: 5 } }), [3]);
});
