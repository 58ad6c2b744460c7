/** A path as a short text: what comes back goes where the path went. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { knotsOf } from "../../../app/page/knots.js";
import { piecesOf, roundedRoute, walkText } from "../../../app/page/walk.js";

const ROUNDED = 2e-6; // [m], by the numbers of a path in an address
const TURN = 2 * Math.PI;
/** The place at a share of a piece, straight from what its numbers mean. */
const PLACES = {
  line: ({ start, end }, share) => start.map((one, axis) => one + share * (end[axis] - one)),
  arc({ centre: [x, y], radius, start_angle: first, sweep }, share) {
    return [x + radius * Math.cos(first + share * sweep), y + radius * Math.sin(first + share * sweep)];
  },
  coil({ pitch, start_turns: first, end_turns: last, centre: [x, y], rotation }, share) {
    const turns = first + share * (last - first);
    return [x + pitch * turns * Math.cos(TURN * turns + rotation), y + pitch * turns * Math.sin(TURN * turns + rotation)];
  },
};
const PIECES = {
  line: { kind: "line", start: [-3.25, 1.5], end: [4.123456, 8.654321] },
  left: { kind: "arc", centre: [2, -1], radius: 3.3333333333, start_angle: 0.7, sweep: 5.123456789 },
  right: { kind: "arc", centre: [2, -1], radius: 3.3333333333, start_angle: 0.7, sweep: -0.123456789 },
  inwards: { kind: "coil", pitch: 1.7, start_turns: 6.12, end_turns: 1.5, centre: [3, -2], rotation: 0.7 },
  outwards: { kind: "coil", pitch: 1.7, start_turns: 1.2, end_turns: 5, centre: [3, -2], rotation: -2.5 },
};
const placeOf = (piece, share) => PLACES[piece.kind](piece, share);
const near = (a, b, within, words) => assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1]) < within, `${words}: ${a} and ${b}`);

for (const [name, piece] of Object.entries(PIECES))
  test(`a path in an address goes where the path went: ${name}`, () => {
    const rounded = roundedRoute({ kind: "route", pieces: [piece] });
    assert.deepEqual(roundedRoute(rounded), rounded);
    for (const share of [0, 0.3, 1]) near(placeOf(rounded.pieces[0], share), placeOf(piece, share), ROUNDED, `at ${share}`);
  });

test("each piece begins where and as the one before it ends", () => {
  const pieces = piecesOf("1,2,0.5_3_2,1.5_2,-0.7_1.7,6,1.5_4");
  assert.deepEqual(pieces.map(({ kind }) => kind), ["line", "arc", "arc", "coil", "line"]);
  const small = 1e-6;
  pieces.slice(1).forEach((piece, k) => {
    const [before, end, begin, after] = [placeOf(pieces[k], 1 - small), placeOf(pieces[k], 1), placeOf(piece, 0), placeOf(piece, small)];
    near(end, begin, 1e-9, `piece ${k + 1}`);
    const [first, last] = [[before, end], [begin, after]].map(([a, b]) => Math.atan2(b[1] - a[1], b[0] - a[0]));
    assert.ok(Math.abs(Math.sin(first - last)) < 1e-4 && Math.cos(first - last) > 0, `heading of piece ${k + 1}`);
  });
});

test("other paths have no such text, and a text that is cut off gives no path", () => {
  assert.equal(walkText({ kind: "waypoints", points: [] }), null);
  assert.equal(walkText({ kind: "route", pieces: [] }), null);
  assert.equal(walkText({ kind: "route", pieces: [{ kind: "waypoints" }] }), null);
  for (const text of ["", "1,2,3", "1,2_3", "1,2,3_x", "1,2,3_1,2,3,4"]) assert.throws(() => piecesOf(text), undefined, text);
});

test("a path of lines and arcs has knots on it, straight where it is", () => {
  const step = 0.3;
  const [x, y] = [[], []];
  // 12 m straight, half a circle of radius 6 m to the left, 12 m back.
  const half = Math.PI * 6;
  for (let s = 0; s <= 24 + half; s += step) {
    const turn = Math.min(Math.max(s - 12, 0), half) / 6;
    const back = Math.max(s - 12 - half, 0);
    x.push(s < 12 ? s : 12 + 6 * Math.sin(turn) - back);
    y.push(6 - 6 * Math.cos(turn));
  }
  const { points, straight } = knotsOf({ x, y });
  assert.deepEqual(straight, [0, points.length - 2]);
  assert.ok(points.length >= 8, `${points.length} knots`);
  // In parts of equal turn and length between the two lines.
  const gaps = points.slice(2, -1).map(([px, py], k) => Math.hypot(px - points[k + 1][0], py - points[k + 1][1]));
  assert.ok(Math.max(...gaps) < 1.3 * Math.min(...gaps), `gaps of ${gaps} m`);
  for (const [k, [px, py]] of points.entries()) {
    const far = px > 12 ? Math.abs(Math.hypot(px - 12, py - 6) - 6) : Math.min(Math.abs(py), Math.abs(py - 12));
    assert.ok(far < 0.02, `knot ${k} is ${far} m beside the path`);
  }
});
