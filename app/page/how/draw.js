/** Pictures in metres and charts of the service's answers, as SVG. */

import { ticks } from "../charts.js";
import { inType } from "../elements.js";
import { addGround } from "../pen.js";

const NAMESPACE = "http://www.w3.org/2000/svg";
/** Length of a straight piece of a drawn spiral [rad]. */
const PIECE = 0.05;
/** Margins of a chart in the usual size of the type [px]: left, right, top, bottom; approximate distance of ticks [px]. */
const MARGINS = [52, 14, 14, 42];
const TICKS = { x: 90, y: 48 };

const joined = (points) => points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");

/** Common part of pictures and charts: a part of a drawing, with shapes at the places that `at` gives. */
class Sheet {
  /** Place in the picture [px]; other coordinates in what extends this. */
  at(x, y) {
    return [x, y];
  }

  /** box: {left, top, width, height} in the drawing [px] */
  constructor(svg, { left = 0, top = 0, width, height }) {
    this.left = left;
    this.top = top;
    this.width = width;
    this.height = height;
    this.layer = svg;
    this.layer = this.part([left, top, width, height], [0, 0]);
  }

  /** A nested drawing that clips its content; corner: coordinates of its upper left corner. */
  part([x, y, width, height], corner) {
    const part = this.add("svg", { x, y, width, height, viewBox: [...corner, width, height].join(" ") });
    // The size of the page's icons does not apply here.
    Object.assign(part.style, { width: `${width}px`, height: `${height}px` });
    return part;
  }

  /** Add an element of SVG with these attributes and children. */
  add(tag, attributes, ...children) {
    const element = document.createElementNS(NAMESPACE, tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    element.append(...children);
    this.layer.append(element);
    return element;
  }

  line(points, className, tag = "polyline") {
    this.add(tag, { class: className, points: joined(points.map((point) => this.at(...point))) });
  }

  area(points, className) {
    this.line(points, className, "polygon");
  }

  dot(x, y, className, r = 4) {
    const [cx, cy] = this.at(x, y);
    this.add("circle", { class: className, cx, cy, r });
  }

  text(words, x, y, className = "", [dx, dy] = [0, 0]) {
    const [px, py] = this.at(x, y);
    this.add("text", { class: className, x: px + dx, y: py + dy }, words);
  }
}

/** Least width of a drawing with two parts side by side [px]; in a narrower one the second part is below. */
const WIDE = 600;

/** The boxes of the two parts of a drawing. share: of the width, for the first one where they are side by side */
export function halves(svg, { width, height }, share) {
  if (width > WIDE) {
    const left = Math.round(share * width);
    return [{ width: left, height }, { left, width: width - left, height }];
  }
  const below = Math.round(0.8 * width);
  svg.setAttribute("height", height + below);
  return [{ width, height }, { top: height, width, height: below }];
}

/** The place on a spiral about (0, 0) after a number of turns from the centre [m]. */
export const onSpiral = (pitch, turn) => [pitch * turn * Math.cos(2 * Math.PI * turn), pitch * turn * Math.sin(2 * Math.PI * turn)];

export class Picture extends Sheet {
  /** x, y: the middle [m]; span: visible length of the narrower side [m] */
  constructor(svg, box, { x, y, span }) {
    super(svg, box);
    this.x = x;
    this.y = y;
    this.scale = Math.min(this.width, this.height) / span;
  }

  at(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  from(px, py) {
    const [right, down] = [px - this.left - this.width / 2, py - this.top - this.height / 2];
    return [this.x + right / this.scale, this.y - down / this.scale];
  }

  /** A spiral about (0, 0) from one number of turns to another. */
  spiral(pitch, from, to) {
    const count = Math.ceil((2 * Math.PI * (to - from)) / PIECE);
    const turns = Array.from({ length: count + 1 }, (_, k) => from + ((to - from) * k) / count);
    this.line(turns.map((turn) => onSpiral(pitch, turn)), "spiral");
  }

  circle(x, y, radius, className) {
    const [cx, cy] = this.at(x, y);
    this.add("circle", { class: className, cx, cy, r: radius * this.scale });
  }

  /** Bench k of a pose {x, y}, drawn from handle to handle with its overhangs. */
  bench({ x, y }, k, { overhang, width }, className) {
    const [[ax, ay], [bx, by]] = [this.at(x[k], y[k]), this.at(x[k + 1], y[k + 1])];
    const [over, wide] = [overhang * this.scale, width * this.scale];
    const turn = (Math.atan2(by - ay, bx - ax) * 180) / Math.PI;
    const place = `translate(${ax} ${ay}) rotate(${turn})`;
    const length = Math.hypot(bx - ax, by - ay) + 2 * over;
    this.add("rect", { class: className, x: -over, y: -wide / 2, width: length, height: wide, transform: place });
  }

  /** All benches of a pose, the last one first; one of them may stand out. */
  dragon(pose, dragon, first = null) {
    for (let k = pose.x.length - 2; k >= 0; k--) this.bench(pose, k, dragon, k === first ? "bench first" : k ? "bench" : "bench head");
  }

  /** The ground that bench k may cover while every hole is within the stray of its place. */
  ground(pose, k, dragon, stray, className) {
    const words = [];
    const put = (letter) => (x, y) => words.push(letter, ...this.at(x, y));
    const path = { moveTo: put("M"), lineTo: put("L"), closePath: () => words.push("Z") };
    path.arc = (x, y, radius, from, to) => {
      path.lineTo(x + radius * Math.cos(from), y + radius * Math.sin(from));
      const r = radius * this.scale;
      words.push("A", r, r, 0, 0, 0, ...this.at(x + radius * Math.cos(to), y + radius * Math.sin(to)));
    };
    addGround(path, pose, dragon, k, stray);
    path.closePath();
    this.add("path", { class: className, d: words.join(" ") });
  }

  /** The scale, at the lower right. metres: length of its bar */
  bar(metres) {
    const [right, bottom] = [this.width - 14, this.height - 12];
    const left = right - metres * this.scale;
    this.add("path", { class: "bar", d: `M${left} ${bottom - 6}V${bottom}H${right}V${bottom - 6}` });
    this.add("text", { class: "tick middle", x: (left + right) / 2, y: bottom - 5 }, `${metres} m`);
  }
}

/** Round numbers in a range as texts, with a largest count. */
function marksOf(range, most) {
  const { values, decimals } = ticks(range, Math.max(most, 1));
  return values.map((value) => value.toFixed(decimals).replace(/^-0$/, "0"));
}

export class Chart extends Sheet {
  /** x, y: ranges; labels: words of both axes */
  constructor(svg, box, { x, y, labels }) {
    super(svg, box);
    this.x = x;
    this.y = y;
    this.margins = MARGINS.map(inType);
    const [left, rightMargin, top, bottomMargin] = this.margins;
    const [right, bottom] = [this.width - rightMargin, this.height - bottomMargin];
    for (const tick of marksOf(y, (bottom - top) / inType(TICKS.y))) {
      const [, py] = this.at(x[0], Number(tick));
      this.add("path", { class: Number(tick) ? "grid" : "zero", d: `M${left} ${py}H${right}` });
      this.add("text", { class: "tick right", x: left - 6, y: py + 4 }, tick);
    }
    for (const tick of marksOf(x, (right - left) / inType(TICKS.x))) {
      const [px] = this.at(Number(tick), y[0]);
      this.add("path", { class: "grid", d: `M${px} ${bottom}v4` });
      this.add("text", { class: "tick middle", x: px, y: bottom + inType(16) }, tick);
    }
    this.add("text", { class: "tick middle", x: (left + right) / 2, y: this.height - 6 }, labels[0]);
    this.add("text", { class: "tick middle", transform: `translate(${inType(13)} ${(top + bottom) / 2}) rotate(-90)` }, labels[1]);
    this.layer = this.part([left, top, right - left, bottom - top], [left, top]);
  }

  at(x, y) {
    const share = (value, [low, high]) => (value - low) / (high - low);
    const [left, right, top, bottom] = this.margins;
    const [wide, high] = [this.width - left - right, this.height - top - bottom];
    return [left + share(x, this.x) * wide, top + (1 - share(y, this.y)) * high];
  }

  from(px) {
    const [left, right] = this.margins;
    return this.x[0] + ((px - this.left - left) / (this.width - left - right)) * (this.x[1] - this.x[0]);
  }

  /** A vertical line through the whole chart at x. */
  up(x, className) {
    this.line([[x, this.y[0]], [x, this.y[1]]], className);
  }

  across(y, className) {
    this.line([[this.x[0], y], [this.x[1], y]], className);
  }
}
