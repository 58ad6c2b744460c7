/** What is under a finger, and where what is dragged comes to rest. Places of the picture are [x, y] in pixels, points in metres. */

import { isInside } from "./square.js";

/** Largest distance of a touch from a thing, or from the border of a square, that means it [px]. */
const [REACH, BORDER] = [16, 8];
/** Kinds of things; of several under a finger the one that stands first here is meant. */
const KINDS = ["gate", "circle", "wall", "block", "lane", "area"];
/** Distance at which a corner comes to rest in line with a neighbour [px]. */
const IN_LINE = 6;

/** Step of an arrow key that moves something, alone and with Shift [m]. */
export const [STEP, FINE_STEP] = [0.1, 0.01];
export const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };

/** The leg of a line of places that is nearest to a place: number of its end, and how far away it is. */
export function nearestLeg(places, [px, py], isClosed) {
  const ends = isClosed && places.length > 2 ? [...places.slice(1), places[0]] : places.slice(1);
  const far = ends.map(([bx, by], k) => {
    const [ax, ay] = places[k];
    const share = ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / (Math.hypot(bx - ax, by - ay) ** 2 || 1);
    const on = Math.min(Math.max(share, 0), 1);
    return Math.hypot(ax + on * (bx - ax) - px, ay + on * (by - ay) - py);
  });
  const least = Math.min(...far);
  return { k: far.indexOf(least) + 1, far: least };
}

/** The number of the thing at a place; null without one. A square is met on its border alone, a lane on its middle. kinds: of those that count */
export function thingUnder(things, view, place, kinds = KINDS) {
  let [best, least] = [null, [Infinity, Infinity]];
  things.forEach(({ kind, points, radius = 0 }, k) => {
    if (!points.length || !kinds.includes(kind)) return;
    const places = points.map((point) => view.toScreen(...point));
    const isRing = kind === "block" || kind === "area";
    const beside = places.length > 1 ? nearestLeg(places, place, isRing).far : Math.hypot(places[0][0] - place[0], places[0][1] - place[1]);
    const far = kind === "block" && isInside(places, place) ? 0 : beside;
    const rank = [KINDS.indexOf(kind), far];
    if (far <= Math.max(kind === "lane" ? 0 : radius * view.scale, kind === "area" ? BORDER : REACH) && (rank[0] < least[0] || (rank[0] === least[0] && far < least[1]))) [best, least] = [k, rank];
  });
  return best;
}

/** The number of the thing whose name is drawn at a place; null without one. labels: of the picture; high: of a line of text [px] */
export const nameUnder = (labels, [px, py], high) => labels.find(({ left, bottom, width }) => px >= left && px <= left + width && py <= bottom && py >= bottom - high)?.k ?? null;

/** The numbers of the things that lie in a rectangle between two places. */
export function thingsWithin(things, view, [ax, ay], [bx, by]) {
  const isIn = ([x, y]) => (x - ax) * (x - bx) <= 0 && (y - ay) * (y - by) <= 0;
  return [...things.keys()].filter((k) => things[k].points.length > 0 && things[k].points.every((point) => isIn(view.toScreen(...point))));
}

/** A point in whole decimetres. */
export const decimetres = (point) => point.map((one) => Math.round(10 * one) / 10);

/** A dragged point, in line with the points before and after it where it is nearly so, so that right angles are easy to draw. */
export function squared(points, k, point, isClosed, scale) {
  const neighbours = [k - 1, k + 1].flatMap((one) => (isClosed ? [points.at(one % points.length)] : one >= 0 && one < points.length ? [points[one]] : []));
  return point.map((one, axis) => {
    const near = neighbours.map((other) => other[axis]).filter((other) => Math.abs(other - one) * scale < IN_LINE);
    return near.length ? near.reduce((a, b) => (Math.abs(b - one) < Math.abs(a - one) ? b : a)) : Math.round(10 * one) / 10;
  });
}
