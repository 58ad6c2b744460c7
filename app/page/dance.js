/** The picture: benches as rectangles between their handles, coloured by speed, over the faint path. */

import { View } from "./view.js";

const SHADES = 48;
/** Speeds closer than this [m/s] are one colour: the colours must not show rounding. */
const SPEED_SPREAD_MIN = 1e-9;
const PICK_RADIUS = 22;
const INSET_WIDTHS = 1.6;

/** So many colours along a list of them such as "#00224e, #fee838". */
function palette(ramp) {
  const stops = ramp.split(",").map((colour) => [1, 3, 5].map((at) => parseInt(colour.trim().slice(at, at + 2), 16)));
  return Array.from({ length: SHADES }, (_, k) => {
    const place = (k / SHADES) * (stops.length - 1);
    const [low, high] = [stops[Math.floor(place)], stops[Math.floor(place) + 1]];
    return `rgb(${low.map((one, at) => Math.round(one + (high[at] - one) * (place % 1))).join(" ")})`;
  });
}

/** [smallest, largest] speed of a pose. */
export function speedRange({ speed }) {
  let [low, high] = [Infinity, -Infinity];
  for (const one of speed) [low, high] = [Math.min(low, one), Math.max(high, one)];
  return [low, high];
}

/** Corners of bench k of a pose as drawn: front left, front right, rear right, rear left. */
export function outline({ x, y }, dragon, k) {
  const length = Math.hypot(x[k] - x[k + 1], y[k] - y[k + 1]);
  const [ux, uy] = [(x[k] - x[k + 1]) / length, (y[k] - y[k + 1]) / length];
  const [ox, oy] = [ux * dragon.overhang, uy * dragon.overhang];
  const [wx, wy] = [(-uy * dragon.width) / 2, (ux * dragon.width) / 2];
  const [fx, fy, rx, ry] = [x[k] + ox, y[k] + oy, x[k + 1] - ox, y[k + 1] - oy];
  return [[fx + wx, fy + wy], [fx - wx, fy - wy], [rx - wx, ry - wy], [rx + wx, ry + wy]];
}

/** The two ends of an edge that the service names; inner is the side nearer to the centre. */
function edge(corners, name) {
  const far = ([[ax, ay], [bx, by]]) => Math.hypot(ax + bx, ay + by);
  const [inner, outer] = [[corners[0], corners[3]], [corners[1], corners[2]]].sort((a, b) => far(a) - far(b));
  return { front: [corners[0], corners[1]], rear: [corners[2], corners[3]], inner, outer }[name];
}

function trace(path, corners) {
  corners.forEach(([x, y], k) => (k ? path.lineTo(x, y) : path.moveTo(x, y)));
  path.closePath();
}

/** A smooth line through the middles of the given points. */
function smooth({ x, y }) {
  const path = new Path2D();
  path.moveTo(x[0], y[0]);
  for (let k = 1; k < x.length - 1; k++) path.quadraticCurveTo(x[k], y[k], (x[k] + x[k + 1]) / 2, (y[k] + y[k + 1]) / 2);
  path.lineTo(x.at(-1), y.at(-1));
  return path;
}

export class Dance {
  /**
   * pose {x, y, speed}, its dragon {width, overhang}, contact: the service's answer while its instant is shown, handle:
   * the chosen one, names of head and handle, circle: radius of the turning circle [m]
   */
  scene = { pose: null, dragon: null, contact: null, handle: null, headName: "", handleName: "", circle: null };
  #path = null;
  #bounds = null;
  #colours = {};
  #palette = [];

  constructor(canvas, inset, { moved, picked }) {
    Object.assign(this, { canvas, inset });
    this.view = new View(canvas, { moved, clicked: (x, y) => picked(this.#nearest(x, y)) });
    this.restyle();
  }

  restyle() {
    const style = getComputedStyle(this.canvas);
    for (const name of ["text", "outline", "path", "circle", "head", "first", "second", "pick", "card"])
      this.#colours[name] = style.getPropertyValue(`--${name}`).trim();
    this.#palette = palette(style.getPropertyValue("--ramp"));
  }

  /** The head's way, {x, y}, as the service samples it. */
  setPath(points) {
    this.#path = points && smooth(points);
    if (!points) return;
    const { x, y } = points;
    const pick = (choice, numbers) => numbers.reduce((a, b) => choice(a, b));
    this.#bounds = [pick(Math.min, x), pick(Math.min, y), pick(Math.max, x), pick(Math.max, y)];
  }

  fit() {
    if (this.#bounds && this.view.width) this.view.fit(this.#bounds);
  }

  draw() {
    const { pose } = this.scene;
    const context = this.#cleared(this.canvas);
    if (this.view.fitted) this.fit();
    this.view.apply(context);
    if (this.#path) this.#stroke(context, this.#path, this.#colours.path, 1);
    const { scale } = this.view;
    if (this.scene.circle > 0) this.#ring(context, 0, 0, scale, this.scene.circle * scale, this.#colours.circle, 1.5);
    if (pose) this.#draw(context, pose, this.view.scale);
    if (pose && !this.inset.hidden) this.#drawInset(pose);
  }

  #cleared(canvas) {
    const ratio = devicePixelRatio;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((size) => Math.round(size * ratio));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = canvas.getContext("2d");
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    return context;
  }

  #draw(context, pose, scale) {
    const { dragon, contact, handle, headName, handleName } = this.scene;
    this.#benches(context, pose, dragon, scale);
    const head = new Path2D();
    trace(head, outline(pose, dragon, 0));
    this.#stroke(context, head, this.#colours.head, 2.5, scale);
    if (contact?.benches) this.#pair(context, pose, dragon, contact, scale);
    this.#dot(context, pose.x[0], pose.y[0], 4, this.#colours.head, scale);
    if (handle !== null && handle < pose.x.length) this.#ring(context, pose.x[handle], pose.y[handle], scale);
    this.#label(context, headName, pose.x[0], pose.y[0], this.#colours.head);
    const chosen = handle > 0 && handle < pose.x.length;
    if (chosen) this.#label(context, handleName, pose.x[handle], pose.y[handle], this.#colours.pick);
  }

  #benches(context, pose, dragon, scale) {
    const [low, high] = speedRange(pose);
    const gain = high - low > SPEED_SPREAD_MIN ? (SHADES - 1) / (high - low) : 0;
    const paths = this.#palette.map(() => new Path2D());
    const all = new Path2D();
    for (let k = pose.x.length - 2; k >= 0; k--) {
      const path = paths[gain ? Math.round((pose.speed[k] - low) * gain) : SHADES - 1];
      trace(path, outline(pose, dragon, k));
    }
    paths.forEach((path, k) => {
      context.fillStyle = this.#palette[k];
      context.fill(path);
      all.addPath(path);
    });
    this.#stroke(context, all, this.#colours.outline, 1, scale);
  }

  #pair(context, pose, dragon, contact, scale) {
    contact.benches.forEach((bench, k) => {
      const path = new Path2D();
      trace(path, outline(pose, dragon, bench));
      context.fillStyle = this.#colours[k ? "second" : "first"];
      context.fill(path);
      this.#stroke(context, path, this.#colours.text, 1, scale);
    });
    if (contact.point) this.#ring(context, ...contact.point, scale, 9, this.#colours.text);
  }

  /** The two benches enlarged around the point where they meet. */
  #drawInset(pose) {
    const { dragon, contact } = this.scene;
    if (!contact?.point) return;
    const context = this.#cleared(this.inset);
    const scale = this.inset.clientHeight / (2 * INSET_WIDTHS * dragon.width);
    const [x, y] = contact.point;
    const ratio = this.inset.width / this.inset.clientWidth;
    const [dx, dy] = [this.inset.width / 2 - x * scale * ratio, this.inset.height / 2 + y * scale * ratio];
    context.setTransform(ratio * scale, 0, 0, -ratio * scale, dx, dy);
    this.#benches(context, pose, dragon, scale);
    this.#pair(context, pose, dragon, { benches: contact.benches }, scale);
    if (contact.edge) {
      const [[ax, ay], [bx, by]] = edge(outline(pose, dragon, contact.edge.bench), contact.edge.name);
      const line = new Path2D();
      line.moveTo(ax, ay);
      line.lineTo(bx, by);
      this.#stroke(context, line, this.#colours.text, 4, scale);
    }
    this.#dot(context, x, y, 6, this.#colours.card, scale);
    this.#ring(context, x, y, scale, 6, this.#colours.text);
  }

  #stroke(context, path, colour, width, scale = this.view.scale) {
    context.strokeStyle = colour;
    context.lineWidth = width / scale;
    context.stroke(path);
  }

  #dot(context, x, y, radius, colour, scale) {
    context.fillStyle = colour;
    context.beginPath();
    context.arc(x, y, radius / scale, 0, 2 * Math.PI);
    context.fill();
  }

  #ring(context, x, y, scale, radius = 8, colour = this.#colours.pick, width = 3) {
    const path = new Path2D();
    path.arc(x, y, radius / scale, 0, 2 * Math.PI);
    this.#stroke(context, path, colour, width, scale);
  }

  #label(context, text, x, y, colour) {
    const [px, py] = this.view.toScreen(x, y);
    const ratio = this.canvas.width / this.view.width;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.font = "600 14px system-ui, sans-serif";
    Object.assign(context, { lineWidth: 4, lineJoin: "round", strokeStyle: this.#colours.card, fillStyle: colour });
    context.strokeText(text, px + 10, py - 10);
    context.fillText(text, px + 10, py - 10);
  }

  #nearest(px, py) {
    const { pose } = this.scene;
    let [best, least] = [null, PICK_RADIUS];
    pose?.x.forEach((x, k) => {
      const [sx, sy] = this.view.toScreen(x, pose.y[k]);
      const distance = Math.hypot(sx - px, sy - py);
      if (distance < least) [best, least] = [k, distance];
    });
    return best;
  }
}
