/** The shape of a square, and gates on its border. Points are [x, y] in metres. */

import { strayOf } from "./fields.js";

/** Corners of a round square, all of them on the circle, so that the whole of it is inside. */
const ROUND = 48;

const decimals = (number) => Number(number.toFixed(4));

/** Corners of a rectangle around a middle. */
export const rectangle = (width, height, [x, y]) =>
  [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => [decimals(x + (a * width) / 2), decimals(y + (b * height) / 2)]);

/** Corners of a rectangle without parts of it: an L without its upper right one, a T without both lower ones, a U without the middle of its upper side. */
const shape = (cornersOf) => (width, height, across, deep, [x, y]) => cornersOf(width, height, across, deep).map(([px, py]) => [decimals(x + px - width / 2), decimals(y + py - height / 2)]);
export const lShape = shape((w, h, a, d) => [[0, 0], [w, 0], [w, h - d], [w - a, h - d], [w - a, h], [0, h]]);
export const tShape = shape((w, h, a, d) => [[a, 0], [w - a, 0], [w - a, d], [w, d], [w, h], [0, h], [0, d], [a, d]]);
export const uShape = shape((w, h, a, d) => [[0, 0], [w, 0], [w, h], [(w + a) / 2, h], [(w + a) / 2, h - d], [(w - a) / 2, h - d], [(w - a) / 2, h], [0, h]]);

/** Corners of a round square of a diameter around a middle. */
export const circle = (diameter, [x, y]) =>
  Array.from({ length: ROUND }, (_, k) => (2 * Math.PI * k) / ROUND).map((turn) => [decimals(x + (diameter / 2) * Math.cos(turn)), decimals(y + (diameter / 2) * Math.sin(turn))]);

/** {width, height, middle} of points. */
export function extent(points) {
  const [low, high] = [Math.min, Math.max].map((most) => [0, 1].map((axis) => most(...points.map((point) => point[axis]))));
  return { width: high[0] - low[0], height: high[1] - low[1], middle: low.map((one, axis) => (one + high[axis]) / 2) };
}

/** Twice the area inside of a ring, negative if it goes clockwise [m2]. */
const twiceArea = (ring) => ring.reduce((sum, [x, y], k) => sum + ring.at(k - 1)[0] * y - x * ring.at(k - 1)[1], 0);

/** True for a point inside of a ring: a ray to the right crosses its sides an odd number of times. */
export const isInside = (ring, [x, y]) =>
  ring.filter(([bx, by], k) => {
    const [ax, ay] = ring.at(k - 1);
    return ay > y !== by > y && x < ax + ((y - ay) * (bx - ax)) / (by - ay);
  }).length % 2 === 1;

/** The nearest place on the border of a ring: {point, heading: straight into the square [rad], far: how far away it is [m]}. */
export function onBorder(ring, [x, y]) {
  const left = Math.sign(twiceArea(ring)) || 1;
  const sides = ring.map(([bx, by], k) => {
    const [ax, ay] = ring.at(k - 1);
    const [dx, dy] = [bx - ax, by - ay];
    const along = Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1), 0), 1);
    const point = [ax + along * dx, ay + along * dy];
    return { point, heading: Math.atan2(left * dx, -left * dy), far: Math.hypot(point[0] - x, point[1] - y) };
  });
  const { point, heading, far } = sides.reduce((best, side) => (side.far < best.far ? side : best));
  return { point: point.map(decimals), heading: decimals(heading), far };
}

/** Length of every side [m], from each corner to the next one, and the angle at every corner [degrees]; ends of an open line have none. */
export function measures(points, isClosed) {
  const way = (k) => [0, 1].map((axis) => points[(k + 1) % points.length][axis] - points[k][axis]);
  const count = points.length;
  const lengths = points.map((_, k) => ((isClosed && count > 2) || k < count - 1 ? Math.hypot(...way(k)) : null));
  const angles = points.map((_, k) => {
    if (count < 3 || (!isClosed && (k === 0 || k === count - 1))) return null;
    const [before, after] = [way((k + count - 1) % count), way(k)];
    const turn = Math.atan2(before[0] * after[1] - before[1] * after[0], before[0] * after[0] + before[1] * after[1]);
    return 180 - (Math.sign(isClosed ? twiceArea(points) : turn) * turn * 180) / Math.PI;
  });
  return { lengths, angles };
}

/** True if two sides of a ring cross each other. */
export function crossesItself(ring) {
  const side = ([ax, ay], [bx, by], [px, py]) => Math.sign((bx - ax) * (py - ay) - (by - ay) * (px - ax));
  return ring.some((b, k) => {
    const a = ring.at(k - 1);
    return ring.slice(k + 1).some((d, j) => side(a, b, ring[k + j]) * side(a, b, d) < 0 && side(ring[k + j], d, a) * side(ring[k + j], d, b) < 0);
  });
}

/** What a square of one of these shapes looks like as numbers: {name, cut: [width, length] of what is cut out, or nothing}; null for another square. shapes: [name, draw] */
export function shapeOf(ring, shapes) {
  const { width, height, middle } = /** @type {any} */ (extent(ring));
  const drawn = JSON.stringify(ring);
  const lengths = ring.length > 8 ? [] : measures(ring, true).lengths.map(decimals);
  const cuts = lengths.flatMap((across) => lengths.map((deep) => [across, deep]));
  for (const [name, draw] of shapes) {
    const cut = (draw === circle || draw === rectangle ? [[]] : cuts).find((one) => JSON.stringify(draw === circle ? circle(width, middle) : draw(width, height, ...one, middle)) === drawn);
    if (cut) return { name, cut };
  }
  return null;
}

/** What a street has beyond the dragon, beside the margin, the stray and the overhang of a bench: a place to begin [m]. */
const STREET_MORE = 0.7;

/** Length of the dragon between its outermost handles [m], and its overhangs. */
export function dragonOf(state) {
  const { csv, listed } = state.extras();
  const number = (name) => Number(state.get(name));
  const [count, overhang] = [number("benches"), number("overhang")];
  const lengths = csv ? listed.lengths : [number("head_length"), ...Array(Math.max(count - 1, 0)).fill(number("body_length"))];
  const overhangs = csv ? listed.overhangs : lengths.map(() => overhang);
  return { overhangs, length: lengths.reduce((sum, length, k) => sum + length - 2 * overhangs[k], 0) };
}

/** Length of the street that the service adds beyond a gate, in whole metres; a stray counts once, where the service counts what it moves the benches by [m]. */
export function streetLength(state) {
  const { overhangs, length } = dragonOf(state);
  const [stray, hole, pin, margin] = ["stray", "hole", "pin", "margin"].map((name) => Number(state.get(name)));
  const free = margin + strayOf({ stray, hole, pin });
  return Math.ceil(length + Math.max(overhangs[0], overhangs.at(-1)) + free + STREET_MORE);
}
