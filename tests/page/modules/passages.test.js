/** Speeds one after another, beats of a drum, and times of day. */

import assert from "node:assert/strict";
import { test } from "node:test";
import * as passages from "../../../app/page/passages.js";

const SOME = [{ speed: 0.5, until_s: 20 }, { speed: 0, until_time: 100 }, { speed: 1.5, until_s: 60 }];

test("passages are the same after an address", () => {
  const all = [...SOME, { speed: 2, duration: 10 }];
  assert.equal(passages.passagesText(all), "0.5@20m_0@100s_1.5@60m_2@10d");
  assert.deepEqual(passages.passagesIn(passages.passagesText(all)), all);
  // The service refuses what is wrong, so it reaches the service.
  assert.deepEqual(passages.passagesIn("x_1@ym"), [{ speed: "x", until_time: "" }, { speed: 1, until_s: "y" }]);
  assert.deepEqual(passages.passagesIn(""), []);
});

test("faster passages end earlier and at the same places", () => {
  assert.deepEqual(passages.quickened([...SOME, { speed: 1, duration: 8 }], 2), [
    { speed: 1, until_s: 20 }, { speed: 0, until_time: 50 }, { speed: 3, until_s: 60 }, { speed: 2, duration: 4 },
  ]);
});

test("beats of a drum give passages, and are kept while these are those", () => {
  const beats = [{ bars: 4, tempo: 96, step: 0.6, beats: 4 }, { bars: 2, tempo: 96, step: 0, beats: 4 }, { bars: 6, tempo: 120, step: 0.5, beats: 3 }];
  const text = "4,96,0.6_2,96,0_6,120,0.5,3";
  assert.equal(passages.beatsText(beats), text);
  assert.deepEqual(passages.beatsIn(text), beats);
  assert.deepEqual(passages.pacesOf({ beats }), [{ speed: 0.96, duration: 10 }, { speed: 0, duration: 5 }, { speed: 1, duration: 9 }]);
  const texts = passages.paceTexts({ beats });
  assert.deepEqual(texts, { passages: "0.96@10d_0@5d_1@9d", beats: text });
  assert.deepEqual(passages.beatsOf(texts), beats);
  assert.equal(passages.beatsOf({ ...texts, passages: "0.96@10d" }), null);
  assert.deepEqual(passages.paceTexts({ passages: SOME, beats }).beats, "");
  for (const wrong of ["4,96", "4,96,x", "1,2,3,4,5"]) assert.equal(passages.beatsIn(wrong), null);
});

test("the head is where its passages lead", () => {
  // 20 m at 0.5 m/s, a rest until 100 s, 40 m at 1.5 m/s, then 1 m/s.
  for (const [time, way] of [[0, 0], [20, 10], [40, 20], [70, 20], [100, 20], [110, 35], [140, 60 + 40 / 3], [-3, -3]])
    assert.ok(Math.abs(passages.wayAt(time, 1, SOME) - way) < 1e-9, `at ${time} s`);
  for (const [way, time] of [[10, 20], [35, 110], [70, 100 + 80 / 3 + 10]]) assert.ok(Math.abs(passages.timeAfter(way, 1, SOME) - time) < 1e-9, `after ${way} m`);
  assert.equal(passages.wayAt(-3, 2, []), -6);
  const moving = [{ speed: 2, until_time: 10 }, { speed: 1, until_s: 30 }, { speed: 4, duration: 2 }];
  assert.deepEqual([5, 10, 15, 20, 21, 25].map((time) => passages.wayAt(time, 3, moving)), [10, 20, 25, 30, 34, 47]);
});

test("a dance begun later keeps the places and the times that are still to come", () => {
  assert.deepEqual(passages.laterBy(SOME, 15, 30), [{ speed: 0.5, until_s: 5 }, { speed: 0, until_time: 70 }, { speed: 1.5, until_s: 45 }]);
  assert.deepEqual(passages.laterBy(SOME, 20, 40), [{ speed: 0, until_time: 60 }, { speed: 1.5, until_s: 40 }]);
  assert.deepEqual(passages.laterBy(SOME, 20, 60), [{ speed: 0, until_time: 40 }, { speed: 1.5, until_s: 40 }]);
  assert.deepEqual(passages.laterBy([{ speed: 1, duration: 50 }, { speed: 2, duration: 9 }], 30, 30), [{ speed: 1, until_time: 20 }, { speed: 2, duration: 9 }]);
});

test("a time of day may be typed in many ways", () => {
  for (const [typed, clock] of [
    ["19:30", "19:30"], ["19.30", "19:30"], ["2015", "20:15"], ["7.30", "07:30"], ["7.30 AM", "07:30"], ["8:45 pm", "20:45"], ["12:05am", "00:05"], ["12:00 pm", "12:00"],
    ["19：30", "19:30"], ["19:30:15", "19:30:15"], ["", ""], [" 9:05 ", "09:05"],
  ]) assert.equal(passages.clockIn(typed), clock, typed);
  for (const wrong of ["20", "25 o'clock", "24:00", "19:60", "7:30:60", "soon"]) assert.equal(passages.clockIn(wrong), null, wrong);
});

test("the time of day begins anew at midnight", () => {
  for (const [time, clock, shown] of [[50.9, "07:30", "07:30:50"], [3600, "23:30", "00:30:00"], [-1, "00:00", "23:59:59"], [1e5, "23:59:59", "03:46:39"]])
    assert.equal(passages.timeOfDay(time, clock), shown);
  for (const [from, to, seconds] of [["19:30", "19:30:20", 20], ["19:30", "19:29:55", -5], ["23:59", "00:01", 120], ["00:01", "23:59", -120]])
    assert.equal(passages.secondsBetween(from, to), seconds);
});

test("the time of day is that at time 0, or when the dance begins", () => {
  assert.equal(passages.clockAtZero({ clock: "19:30", beginClock: "" }, -13.9), "19:30");
  assert.equal(passages.clockAtZero({ clock: "", beginClock: "19:30" }, -13.94), "19:30:13.94");
  assert.equal(passages.clockAtZero({ clock: "", beginClock: "00:00:10" }, 16), "23:59:54");
  assert.equal(passages.clockAtZero({ clock: "", beginClock: "19:30:10" }, 5), "19:30:05");
  assert.equal(passages.clockAtZero({ clock: "", beginClock: "19:30:10" }, 0), "19:30:10");
  assert.equal(passages.clockAtZero({ clock: "", beginClock: "00:00:10" }, 10), "00:00:00");
  assert.equal(passages.clockAtZero({ clock: "", beginClock: "" }, 1), null);
});

test("a passage has one end", () => {
  assert.deepEqual(SOME.map(passages.endOf), [["m", 20], ["s", 100], ["m", 60]]);
  assert.deepEqual(passages.endOf({ speed: 1 }), ["s", undefined]);
});
