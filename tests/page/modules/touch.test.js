/** What is under a finger, and what a drag or a key makes of it. */

import assert from "node:assert/strict";
import { test } from "node:test";
import * as changes from "../../../app/page/changes.js";
import { EMPTY } from "../../../app/page/drawing.js";
import { carried, ringOf } from "../../../app/page/photo_place.js";
import { nearestLeg, squared, thingUnder } from "../../../app/page/touch.js";

const THINGS = [
  { kind: "area", name: "square", points: [[0, 0], [40, 0], [40, 20], [0, 20]] },
  { kind: "block", name: "stage", points: [[10, 5], [20, 5], [20, 10], [10, 10]], holes: [[[12, 6], [13, 6], [13, 7]]] },
  { kind: "circle", name: "tree", points: [[19, 9]], radius: 0.5 },
  { kind: "gate", name: "gate", points: [[0, 8]], heading: null },
];
const DRAWING = { ...EMPTY, things: THINGS, yard: [[0, 0], [40, 0], [40, 20], [0, 20]] };
/** Ten pixels a metre. */
const view = { scale: 10, toScreen: (x, y) => [10 * x, -10 * y] };
const under = (x, y, kinds) => thingUnder(THINGS, view, [10 * x, -10 * y], kinds);

test("of several things under a finger the smallest is meant, and a square by its border alone", () => {
  assert.deepEqual([under(15, 7), under(18.5, 8.5), under(30, 15), under(30, 0.5), under(0.5, 8)], [1, 2, null, 0, 3]);
  assert.deepEqual([under(21.5, 7), under(22, 7), under(30, 1), under(30, 0.5, ["circle"])], [1, null, null, null]);
});

test("the nearest leg closes a ring and not a line", () => {
  const places = [[0, 0], [10, 0], [10, 10]];
  assert.deepEqual([nearestLeg(places, [4, 6], true).k, nearestLeg(places, [4, 1], false)], [3, { k: 1, far: 1 }]);
});

test("a dragged corner rests in line with its neighbours, or else in whole decimetres", () => {
  assert.deepEqual(squared(THINGS[0].points, 2, [39.55, 20.67], true, 10), [40, 20.7]);
  assert.deepEqual(squared(THINGS[0].points, 0, [0.12, 0.34], false, 100), [0.1, 0.3]);
});

test("a square takes its gates and its streets along, a copy has a name of its own, a stage turns with its holes", () => {
  const { things, yard } = changes.shifted(DRAWING, 0, [1, -2]);
  assert.deepEqual([things[3].points, yard[2], things[1]], [[[1, 6]], [41, 18], THINGS[1]]);
  assert.deepEqual(changes.shifted(DRAWING, 1, [1, -2]).things[1].holes, [[[13, 4], [14, 4], [14, 5]]]);
  assert.deepEqual(changes.copied(DRAWING, THINGS[2]).things.map(({ name }) => name).slice(-2), ["gate", "tree 2"]);
  const stage = changes.turned(DRAWING, 1, Math.PI / 2, 2).things[1];
  assert.deepEqual([stage.points[0], stage.holes[0][0]], [[20, -2.5], [18, 1.5]]);
});

test("a drawing comes beside another one at its place on a survey grid, and a path with pieces too", () => {
  const [one, other] = [{ ...DRAWING, grid: { x: 500, y: 100 } }, { ...DRAWING, grid: { x: 510, y: 90 } }];
  const { drawing, left } = changes.joined(one, { ...other, path: { kind: "route", start: 3, pieces: [{ kind: "line", start: [0, 0], end: [9, 0] }] } });
  assert.deepEqual(drawing.things.map(({ name }) => name), ["square", "stage", "tree", "gate", "stage 2", "tree 2"]);
  assert.deepEqual([drawing.things[5].points, drawing.things[4].holes[0][0], left.map(({ name }) => name)], [[[29, -1]], [22, -4], ["square", "gate"]]);
  assert.deepEqual(drawing.path, { kind: "route", start: 3, pieces: [{ kind: "line", start: [10, -10], end: [19, -10] }] });
  // A hundredth of a degree at 30 degrees north, by the formulas of the ellipsoid WGS 84.
  const [east, north] = changes.offsetOf({ origin: { longitude: 120, latitude: 30 } }, { origin: { longitude: 120.01, latitude: 30 } });
  assert.deepEqual([east.toFixed(1), north], ["964.9", 0]);
});

test("things come into a row with the first of them, and have equal gaps; a square takes its gates along once", () => {
  const tree = (x, y) => ({ kind: "circle", name: `${x}`, points: [[x, y]], radius: 0.5 });
  const trees = { ...EMPTY, things: [tree(5, 1), tree(0, 2), tree(12, 4)] };
  const placesOf = ({ things }) => things.map(({ points }) => points[0]);
  assert.deepEqual(placesOf(changes.aligned(trees, [2, 0, 1], "row")), [[5, 4], [0, 4], [12, 4]]);
  assert.deepEqual(placesOf(changes.aligned(trees, [0, 1], "column")), [[5, 1], [5, 2], [12, 4]]);
  assert.deepEqual(placesOf(changes.aligned(trees, [0, 1, 2], "gaps")), [[6, 1], [0, 2], [12, 4]]);
  const { things } = changes.shiftedAll(DRAWING, [3, 0, 2], [2, 1]);
  assert.deepEqual([things[0].points[0], things[2].points, things[3].points], [[2, 1], [[21, 10]], [[2, 9]]]);
});

test("a photo is turned and scaled about a point that stays, and keeps its right angles", () => {
  const place = { x: -10, y: 20, scale: 0.1, angle: 0, width: 80, height: 60 };
  assert.deepEqual(carried(place, { about: [0, 10], scale: 2 }), { ...place, x: -20, y: 30, scale: 0.2 });
  const turned = ringOf(carried(place, { about: [-10, 20], angle: Math.PI / 2, by: [1, 2] }));
  assert.deepEqual(turned.map((corner) => corner.map(Math.round)), [[-9, 22], [-9, 30], [-3, 30], [-3, 22]]);
});

test("a figure stays one: moved, turned, scaled and mirrored about its middle", () => {
  const pieces = [{ kind: "line", start: [0, 0], end: [10, 0] }, { kind: "arc", centre: [10, 5], radius: 5, start_angle: -Math.PI / 2, sweep: Math.PI }, { kind: "line", start: [10, 10], end: [0, 10] }];
  const ring = { ...EMPTY, path: { kind: "route", pieces, start: 4 }, points: [[0, 0], [15, 5], [0, 10]], begin: 4, start: 0 };
  const near = (a, b) => a.flat().forEach((one, k) => assert.ok(Math.abs(one - b.flat()[k]) < 1e-5, `${a} ${b}`));
  assert.ok(changes.isFigure(ring) && !changes.isFigure(EMPTY));
  const twice = changes.figured(ring, { by: [1, 2], scale: 2 });
  near([twice.path.pieces[0].start, twice.path.pieces[1].centre, [twice.path.pieces[1].radius, twice.begin, twice.path.start]], [[-6.5, -3], [13.5, 7], [10, 8, 8]]);
  assert.equal(twice.start, null);
  const mirrored = changes.figured(ring, { isMirrored: true });
  near([mirrored.path.pieces[0].start, mirrored.path.pieces[0].end, mirrored.path.pieces[1].centre, mirrored.path.pieces[2].end, mirrored.points[1]], [[15, 0], [5, 0], [5, 5], [15, 10], [0, 5]]);
  assert.equal(mirrored.path.pieces[1].sweep, -Math.PI.toFixed(9));
  near([changes.figured(ring, { angle: Math.PI }).path.pieces[0].start], [[15, 10]]);
});
