/** What the picture draws: its scale, the benches, and the ground that they cover. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { SHADES, addGround, edge, outline, palette, scaleBar } from "../../../app/page/pen.js";
import { isClear, linesIn } from "../../../app/page/venue.js";

const [CHORD, OVERHANG, WIDTH, STRAY] = [1.65, 0.275, 0.3, 0.05];
const SIZE = { overhang: OVERHANG, width: WIDTH };
/** A bench anywhere, and a place in its frame: along it from its middle, and to its left. */
const [X, Y, UX, UY] = [3, -2, 0.6, -0.8];
const POSE = { x: [1, -1].map((way) => X + (way * CHORD * UX) / 2), y: [1, -1].map((way) => Y + (way * CHORD * UY) / 2) };
const placed = ([along, left]) => [X + along * UX - left * UY, Y + along * UY + left * UX];
const close = (a, b) => a.every((one, k) => Math.abs(one - b[k]) < 1e-9);

/** Corners of a path, whose arcs have many. */
class Corners {
  all = [];
  moveTo(x, y) {
    this.all.push([x, y]);
  }
  lineTo = this.moveTo;
  arc(x, y, radius, first, last) {
    for (let k = 0; k <= 256; k++) this.moveTo(...[Math.cos, Math.sin].map((of, axis) => [x, y][axis] + radius * of(first + (k / 256) * (last - first))));
  }
  holds([x, y]) {
    let inside = false;
    for (const [k, [ax, ay]] of this.all.entries()) {
      const [bx, by] = this.all.at(k - 1);
      if (ay > y !== by > y && x < ax + ((bx - ax) * (y - ay)) / (by - ay)) inside = !inside;
    }
    return inside;
  }
}

test("the scale bar is as long as fits, in round metres", () => {
  const bars = [4e-3, 40, 41, 2e4].map(scaleBar);
  assert.deepEqual(bars.map(({ metres }) => metres), [20_000, 2, 2, 0.005]);
  assert.deepEqual(bars.map(({ pixels }) => Math.round(pixels)), [80, 80, 82, 100]);
});

test("colours go from the first of a palette to the last", () => {
  const shades = palette("#000000, #ff8000, #ffffff");
  assert.equal(shades.length, SHADES);
  assert.deepEqual([shades[0], shades[SHADES / 2]], ["rgb(0 0 0)", "rgb(255 128 0)"]);
});

test("a bench is drawn around its two holes, at least as wide as can be seen", () => {
  const corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]];
  for (const [least, width] of [[0, WIDTH], [0.5, 0.5]]) {
    const expected = corners.map(([end, side]) => placed([end * (CHORD / 2 + OVERHANG), (side * width) / 2]));
    assert.ok(outline(POSE, SIZE, 0, least).every((one, k) => close(one, expected[k])));
  }
  const listed = { listed: { overhangs: [0.1], widths: [0.7] } };
  assert.ok(close(outline(POSE, listed, 0)[0], placed([CHORD / 2 + 0.1, 0.35])));
});

test("the inner edge is the one nearer to the centre", () => {
  const corners = [[5, 1], [5, 3], [1, 3], [1, 1]];
  assert.deepEqual(["front", "rear", "inner", "outer"].map((name) => edge(corners, name)), [[[5, 1], [5, 3]], [[1, 3], [1, 1]], [[5, 1], [1, 1]], [[5, 3], [1, 3]]]);
});

test("the drawn ground is what strayed benches cover and little more", () => {
  const ground = new Corners();
  addGround(ground, POSE, SIZE, 0, STRAY);
  let strayed = 0;
  // Every way in which both holes are at most the stray from their places, and the chord keeps its length.
  for (let a = 0; a < 36; a++)
    for (let b = -12; b <= 12; b++) {
      const [angle, turn] = [(a * Math.PI) / 18, (b / 6) * Math.asin(STRAY / CHORD)];
      const front = [CHORD / 2 + STRAY * Math.cos(angle), STRAY * Math.sin(angle)];
      const way = [Math.cos(turn), Math.sin(turn)];
      const rear = front.map((one, axis) => one - CHORD * way[axis]);
      if (Math.hypot(rear[0] + CHORD / 2, rear[1]) > STRAY) continue;
      strayed += 1;
      for (let at = -CHORD - OVERHANG; at <= OVERHANG + 1e-9; at += (CHORD + 2 * OVERHANG) / 8)
        for (const side of [-WIDTH / 2, WIDTH / 2]) {
          const place = [front[0] + at * way[0] - side * way[1], front[1] + at * way[1] + side * way[0]];
          assert.ok(ground.holds(placed(place.map((one) => one * (1 - 1e-4)))), `${place} is not on the ground`);
        }
    }
  assert.ok(strayed > 100, `${strayed} poses`);
  const [beside, end] = [WIDTH / 2 + 1.01 * STRAY, CHORD / 2 + OVERHANG + 1.37 * STRAY];
  for (const along of [-1, 0, 1]) for (const side of [-1, 1]) assert.ok(!ground.holds(placed([(along * CHORD) / 2, side * beside])));
  for (const way of [-1, 1]) assert.ok(!ground.holds(placed([way * end, 0])));
});

test("a name has room where it overlaps no other one and no control", () => {
  const controls = linesIn({ left: 10, top: 10, bottom: 190, width: 35 }, 13);
  assert.ok(controls.every(([left, bottom, width], k) => left === 10 && width === 35 && bottom > 10 && (!k || controls[k - 1][1] - bottom <= 13)));
  const high = 17;
  for (const bottom of [12, 100, 190]) assert.equal(isClear([30, bottom, 60], controls, high), false);
  assert.equal(isClear([46, 100, 60], controls, high), true);
  assert.equal(isClear([30, 190 + high, 60], controls, high), true);
  assert.equal(isClear([0, 16, 50], [[40, 0, 9]], high), false);
});
