/** What draws the picture: shapes of benches in metres as paths, and a pen on a canvas. */

import { SMALL_TYPE, USUAL_TYPE, inType } from "./elements.js";

/** Number of colours of a palette. */
export const SHADES = 48;
/** Longest scale bar [px], its distance from the edges, and its possible lengths in metres, times a power of ten. */
const [BAR, BAR_EDGE, ROUND] = [120, 14, [5, 2, 1]];

/** A number of colours interpolated along a list such as "#00224e, #fee838". */
export function palette(ramp) {
  const stops = ramp.split(",").map((colour) => [1, 3, 5].map((at) => parseInt(colour.trim().slice(at, at + 2), 16)));
  return Array.from({ length: SHADES }, (_, k) => {
    const place = (k / SHADES) * (stops.length - 1);
    const [low, high] = [stops[Math.floor(place)], stops[Math.floor(place) + 1]];
    return `rgb(${low.map((one, at) => Math.round(one + (high[at] - one) * (place % 1))).join(" ")})`;
  });
}
/** The scale bar for a number of pixels per metre: {metres, pixels}, as long as fits. */
export function scaleBar(scale) {
  const rough = BAR / scale;
  const power = 10 ** Math.floor(Math.log10(rough));
  const metres = Number((ROUND.find((one) => one * power <= rough) * power).toPrecision(1));
  return { metres, pixels: metres * scale };
}

/** {overhang, width} of bench k of a dragon; listed: its benches one by one, if they are given so. */
export const sizeOf = ({ listed, overhang, width }, k) => (listed ? { overhang: listed.overhangs[k], width: listed.widths[k] } : { overhang, width });

/** Corners of bench k in a drawn pose: front left, front right, rear right, rear left. least: width that it has at least [m] */
export function outline({ x, y }, dragon, k, least = 0) {
  const { overhang, width: own } = sizeOf(dragon, k);
  const width = Math.max(own, least);
  const length = Math.hypot(x[k] - x[k + 1], y[k] - y[k + 1]);
  const [ux, uy] = [(x[k] - x[k + 1]) / length, (y[k] - y[k + 1]) / length];
  const [ox, oy, wx, wy] = [ux * overhang, uy * overhang, (-uy * width) / 2, (ux * width) / 2];
  const [fx, fy, rx, ry] = [x[k] + ox, y[k] + oy, x[k + 1] - ox, y[k + 1] - oy];
  return [[fx + wx, fy + wy], [fx - wx, fy - wy], [rx - wx, ry - wy], [rx + wx, ry + wy]];
}

/**
 * Adds to a path the ground that bench k of a pose covers while each of its holes is within the stray [m] of its place:
 * a side moves out by the stray between the holes, and a corner by (d + D) / chord times the stray, where d and D are
 * its distances from the two holes. The path is left open, as filling closes it.
 */
export function addGround(path, { x, y }, dragon, k, stray) {
  const { overhang, width } = sizeOf(dragon, k);
  const half = width / 2;
  const [dx, dy] = [x[k] - x[k + 1], y[k] - y[k + 1]];
  const chord = Math.hypot(dx, dy);
  const reach = (stray * (Math.hypot(overhang, half) + Math.hypot(chord + overhang, half))) / chord;
  const front = Math.atan2(dy, dx);
  [k, k + 1].forEach((hole, end) => {
    const way = front + end * Math.PI;
    const [ux, uy] = [Math.cos(way), Math.sin(way)];
    const place = (along, left) => [x[hole] + along * ux - left * uy, y[hole] + along * uy + left * ux];
    path[end ? "lineTo" : "moveTo"](...place(0, -half - stray));
    path.arc(...place(overhang, -half), reach, way - Math.PI / 2, way);
    path.arc(...place(overhang, half), reach, way, way + Math.PI / 2);
    path.lineTo(...place(0, half + stray));
  });
}

/** The two ends of an edge by its name in the service; inner is the side nearer to the centre. */
export function edge(corners, name) {
  const far = (/** @type {number[][]} */ [a, b]) => Math.hypot(a[0] + b[0], a[1] + b[1]);
  const [inner, outer] = [[corners[0], corners[3]], [corners[1], corners[2]]].sort((a, b) => far(a) - far(b));
  return { front: [corners[0], corners[1]], rear: [corners[2], corners[3]], inner, outer }[name];
}

/** A path along points [x, y], added to another. */
export function trace(points, path = new Path2D(), isClosed = true) {
  points.forEach(([x, y], k) => (k ? path.lineTo(x, y) : path.moveTo(x, y)));
  if (isClosed) path.closePath();
  return path;
}

/** A smooth line through the middles of the given points. */
export function smooth({ x, y }) {
  const path = new Path2D();
  path.moveTo(x[0], y[0]);
  for (let k = 1; k < x.length - 1; k++) path.quadraticCurveTo(x[k], y[k], (x[k] + x[k + 1]) / 2, (y[k] + y[k + 1]) / 2);
  path.lineTo(x.at(-1), y.at(-1));
  return path;
}

/** Draws in metres on a cleared canvas centred at (x, y); radii and line widths are in pixels. */
export class Pen {
  constructor(canvas, { x, y, scale, width: wide, height: high }) {
    const [width, height] = [wide, high].map((size) => Math.round(size * devicePixelRatio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const [context, zoom] = [canvas.getContext("2d"), scale * devicePixelRatio];
    context.resetTransform();
    context.clearRect(0, 0, width, height);
    context.setTransform(zoom, 0, 0, -zoom, width / 2 - x * zoom, height / 2 + y * zoom);
    this.context = context;
    this.scale = scale;
    /** Boxes of the names that are drawn, [left, bottom, width]. @type {number[][]} [px] */
    this.names = [];
    this.left = x - wide / (2 * scale);
    this.top = y + high / (2 * scale);
    this.right = x + wide / (2 * scale);
  }

  fill(path, colour) {
    this.context.fillStyle = colour;
    this.context.fill(path);
  }

  stroke(path, colour, width = 1) {
    Object.assign(this.context, { strokeStyle: colour, lineWidth: width / this.scale });
    this.context.stroke(path);
  }

  /** An arrow's tip at (x, y) towards the direction (dx, dy); size: [px] */
  tip(x, y, dx, dy, size) {
    const reach = size / this.scale / Math.hypot(dx, dy);
    const [ux, uy] = [dx * reach, dy * reach];
    return trace([[x - ux - uy, y - uy + ux], [x, y], [x - ux + uy, y - uy - ux]], new Path2D(), false);
  }

  /** The scale, at the lower right or left; no name covers it. */
  bar(words, pixels, colour, halo, isLeft) {
    const { context } = this;
    const { width, height } = context.canvas;
    context.save();
    context.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    const [right, bottom] = [isLeft ? BAR_EDGE + pixels : width / devicePixelRatio - BAR_EDGE, height / devicePixelRatio - BAR_EDGE];
    this.names.push([right - pixels, bottom - 6, pixels], [right - pixels, bottom, pixels]);
    Object.assign(context, { font: `600 ${inType(SMALL_TYPE)}px system-ui, sans-serif`, textAlign: "center", lineJoin: "round" });
    for (const [strokeStyle, lineWidth] of [[halo, 5], [colour, 2]]) {
      Object.assign(context, { strokeStyle, lineWidth });
      context.beginPath();
      for (const [x, y] of [[right - pixels, bottom - 6], [right - pixels, bottom], [right, bottom], [right, bottom - 6]]) context.lineTo(x, y);
      context.stroke();
    }
    Object.assign(context, { strokeStyle: halo, lineWidth: 4, fillStyle: colour });
    context.strokeText(words, right - pixels / 2, bottom - 6);
    context.fillText(words, right - pixels / 2, bottom - 6);
    context.restore();
  }

  circle(x, y, radius) {
    const path = new Path2D();
    path.arc(x, y, radius / this.scale, 0, 2 * Math.PI);
    return path;
  }

  /** A name beside (x, y), where it covers none of the names before it. */
  label(text, x, y, colour, halo) {
    const { context, scale } = this;
    context.save();
    context.translate(x, y);
    context.scale(1 / scale, -1 / scale);
    Object.assign(context, { font: `600 ${inType(USUAL_TYPE)}px system-ui, sans-serif`, lineWidth: 4, lineJoin: "round", strokeStyle: halo, fillStyle: colour });
    const { width } = context.measureText(text);
    const [atX, atY, high] = [(x - this.left) * scale, (this.top - y) * scale, inType(USUAL_TYPE)];
    const sides = x + (10 + width) / scale > this.right ? [-10 - width, 10] : [10, -10 - width];
    const places = [-10, 10 + high].flatMap((dy) => sides.map((dx) => [dx, dy]));
    const isFree = ([dx, dy]) => this.names.every(([left, bottom, wide]) => Math.abs(atY + dy - bottom) >= high || atX + dx > left + wide || left > atX + dx + width);
    const [dx, dy] = places.find(isFree) ?? places[0];
    this.names.push([atX + dx, atY + dy, width]);
    context.strokeText(text, dx, dy);
    context.fillText(text, dx, dy);
    context.restore();
  }
}
