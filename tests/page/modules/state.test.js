/** The state of the page in its address, undo and redo, and several dragons as texts of an address. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { EMPTY, fromAddress } from "../../../app/page/drawing.js";
import { Steps } from "../../../app/page/history.js";
import { State } from "../../../app/page/state.js";
import { PRESETS, isForeign, legsOf, recordOf, recordText, recordsIn } from "../../../app/page/together.js";
import { roundedRoute } from "../../../app/page/walk.js";

// What the state needs of a browser: an address, and its entries in the history.
const listeners = {};
const entries = [];
beforeEach(() => {
  entries.length = 0;
  const go = (state, _, url) => Object.assign(location, { href: url, search: url.includes("?") ? url.slice(url.indexOf("?")) : "" }) && (history.state = state);
  globalThis.document = { documentElement: { dataset: {} }, querySelectorAll: () => ["en", "zh"].map((lang) => ({ dataset: { lang } })) };
  globalThis.location = { pathname: "/", search: "", href: "/" };
  globalThis.history = { state: null, replaceState: go, pushState: (...all) => (entries.push(all[2]), go(...all)) };
  globalThis.addEventListener = (name, act) => (listeners[name] = act);
});
function opened(query) {
  Object.assign(location, { search: query, href: `/${query}` });
  return new State();
}
const written = (state) => (state.write(), location.search);

test("an address opens what it says, and is written as it was", () => {
  const query = "?pitch=0.5&benches=40&margin=0.01&time=120.5&rate=5&handle=7&lang=zh&view=1,2,35&csv=a%0Ab";
  const state = opened(query);
  assert.deepEqual([state.get("pitch"), state.get("time"), state.get("rate"), state.get("handle"), state.get("view"), state.get("csv")], ["0.5", 120.5, 5, 7, [1, 2, 35], "a\nb"]);
  assert.equal(new URLSearchParams(written(state)).toString(), new URLSearchParams("?pitch=0.5&benches=40&margin=0.01&time=120.5&rate=5&handle=7&view=1,2,35&lang=zh&csv=a%0Ab").toString());
  assert.deepEqual(state.unread, []);
});

test("defaults are not written; each kind of path has its own", () => {
  assert.equal(written(opened("?pitch=0.55&benches=223")), "?door=all");
  const turn = opened("?path=turn&benches=20");
  assert.deepEqual([turn.get("pitch"), written(turn)], ["1.7", "?benches=20&path=turn"]);
  assert.equal(opened("?path=route").get("benches"), "24");
  turn.choosePath("route");
  assert.deepEqual([turn.get("benches"), turn.get("pitch")], ["20", "0.55"]);
  turn.choosePath("turn");
  assert.deepEqual([turn.get("pitch"), entries.length], ["1.7", 2]);
  turn.reset(["benches"]);
  assert.equal(turn.get("benches"), "223");
});

test("a bare address opens in motion with the doors", () => {
  for (const [query, moves] of [["", true], ["?lang=zh", true], ["?time=0", false], ["?door=all", false]]) {
    const state = opened(query);
    assert.equal(state.opensInMotion, moves, query);
    assert.equal(state.get("door"), moves ? "arrival" : query === "?door=all" ? "all" : null);
  }
});

test("what a newer page wrote is kept, what cannot be read is named, and the rest opens", () => {
  const state = opened("?benches=5&helix=3&path=helix&rate=3&view=1,2&handle=-1&beats=4&begin_clock=25:00&time=soon");
  assert.deepEqual(state.strange, [["helix", "3"]]);
  assert.deepEqual(state.unread.map(([name]) => name), ["path", "rate", "view", "handle", "beats", "begin_clock", "time"]);
  assert.deepEqual([state.get("benches"), state.get("path"), state.get("view"), written(state)], ["5", "spiral", null, "?benches=5&helix=3"]);
  assert.equal(opened("?door=cellar&benches=5").noDoor, "cellar");
  assert.deepEqual(opened("?time=end&benches=5").unread, []);
  for (const view of ["1,2,0", "1,x,3", "1,2,3,4"]) assert.equal(opened(`?view=${view}`).get("view"), null, view);
  assert.deepEqual(["true", "yes"].map((text) => opened(`?follow=${text}`).get("follow")), [true, false]);
});

test("passages are those of the beats until they are changed", () => {
  const state = opened("?beats=4,96,0.6_2,96,0");
  assert.equal(state.get("passages"), "0.96@10d_0@5d");
  assert.equal(new URLSearchParams(written(state)).toString(), "beats=4%2C96%2C0.6_2%2C96%2C0");
  assert.equal(opened("?beats=4,96,0.6&passages=1@5m").get("beats"), "");
  assert.equal(state.extras().beats.length, 2);
});

test("the browser's buttons lead back, and those who listen hear what changed", () => {
  const state = opened("?benches=9");
  const changed = [];
  state.listen((names) => changed.push(...names));
  state.push({ pitch: "0.6", path: "spiral" });
  assert.deepEqual(changed, ["pitch"]);
  assert.equal(location.search, "?pitch=0.6&benches=9");
  Object.assign(location, { search: "?benches=9" });
  changed.length = 0;
  listeners.popstate();
  assert.deepEqual([state.get("pitch"), changed.toSorted()], ["0.55", ["pitch", "view"]]);
  // Undo goes on from where they have led.
  const steps = new Steps(state, () => {});
  steps.change({ benches: "8" });
  steps.change({ path: "turn", pitch: "1.7", csv: "a" });
  Object.assign(location, { search: "?benches=8" });
  listeners.popstate();
  steps.undo();
  assert.deepEqual([state.get("path"), state.get("pitch"), state.get("benches"), steps.canUndo], ["spiral", "0.55", "9", false]);
  steps.redo();
  assert.equal(state.get("benches"), "8");
});

test("a drawing that is too long for an address is kept beside it", () => {
  const state = opened("?path=route");
  const points = Array.from({ length: 900 }, (_, k) => [0.5 * k, 0.01 * (k % 7)]);
  state.set({ drawing: { ...EMPTY, points } }, false);
  const query = written(state);
  assert.deepEqual([state.fits, query], [false, "?path=route"]);
  assert.equal(new State().get("drawing").points.length, 900);
});

test("steps are undone and redone, and those of one kind in a row are one", () => {
  const state = opened("?path=route");
  let possible = "";
  const steps = new Steps(state, () => (possible = `${steps.canUndo} ${steps.canRedo}`));
  const [one, two, three] = [1, 2, 3].map((x) => ({ ...EMPTY, points: [[x, 0]] }));
  steps.take(one);
  steps.take(two, "arrow");
  steps.take(three, "arrow");
  steps.take(three);
  assert.deepEqual([state.get("drawing"), possible, entries.length], [three, "true false", 2]);
  steps.undo();
  assert.deepEqual([state.get("drawing"), possible], [one, "true true"]);
  steps.redo();
  assert.deepEqual([state.get("drawing"), possible], [three, "true false"]);
  steps.undo();
  steps.undo();
  steps.undo();
  assert.deepEqual([state.get("drawing"), possible], [EMPTY, "false true"]);
  // Another step than the one that was taken back leaves nothing to redo.
  steps.take(two, "arrow");
  assert.equal(possible, "true false");
});

test("dragons are the same after an address, whatever they are called", () => {
  const records = [{ name: "West!~1%", benches: "9", path: "route", route: "*0,0_9,0" }, {}, { rotation: "180", passages: "1@5m" }];
  assert.deepEqual(recordsIn(records.map(recordText).join("~")), records);
  assert.deepEqual(recordsIn("rotation:180!what:ever!pitch:1.1~name:%"), [{ rotation: "180", pitch: "1.1" }, {}]);
  for (const preset of Object.values(PRESETS)) assert.ok(preset.map(recordText).join("~").length < 400);
});

test("a proposed dance, written as a walk, is the same as one of several", () => {
  const pieces = [{ kind: "line", start: [0, 0], end: [20, 0] }, { kind: "arc", centre: [20, 5], radius: 5, start_angle: -Math.PI / 2, sweep: Math.PI / 2 }];
  const drawing = { ...EMPTY, path: roundedRoute({ kind: "route", pieces, start: 8 }), begin: 8, start: 8 };
  const texts = Object.fromEntries(legsOf(drawing));
  assert.ok(texts.walk);
  assert.deepEqual(recordsIn(recordText(texts)), [texts]);
  const { path, begin, start } = fromAddress(new URLSearchParams(texts));
  assert.deepEqual({ path, begin, start }, { path: drawing.path, begin: 8, start: 8 });
});

test("a dance of a file becomes a dragon of an address", () => {
  const spiral = { name: "A", delay: 5, dragon: { benches: 9 }, path: { kind: "spiral", pitch: 1.1, rotation: Math.PI }, head_speed: 2, beats: [{ bars: 1, tempo: 60, step: 1 }] };
  assert.deepEqual(recordOf(spiral), { name: "A", delay: "5", rotation: "180", passages: "1@4d", beats: "1,60,1", path: "spiral", pitch: "1.1", benches: "9", head_speed: "2" });
  assert.deepEqual(recordOf({}), { path: "spiral" });
  const drawn = recordOf({ path: { kind: "waypoints", points: [[0, 0], [9, 0]], straight: [0], start: 3 } });
  assert.deepEqual(drawn, { path: "route", route: "*0,0_9,0", begin: "3" });
  // A turn with clothoids has no numbers of its own.
  assert.ok(recordOf({ path: { kind: "turn", pitch: 1.7, middle: 1 } }).raw);
  assert.equal(recordOf({ path: { kind: "turn", pitch: 1.7 } }).path, "turn");
  assert.deepEqual([{}, { centre: [0, 0] }, { centre: [1, 0] }, { clockwise: false }, { kind: "turn", clockwise: false }].map(isForeign), [false, false, true, true, false]);
});
