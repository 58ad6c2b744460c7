/** The map of a sweep: a value over one parameter as a line, over two as colours with contours. */

import { ticks } from "./charts.js";
import { columnName } from "./columns.js";
import { $, SMALL_TYPE, colours, inType, make } from "./elements.js";
import { LABELS, LIMITS } from "./fields.js";
import { palette } from "./pen.js";
import { say } from "./text.js";

const HEIGHT = 340;
const [LEFT, RIGHT, TOP, BOTTOM] = [64, 16, 12, 44];
const LEVELS = 8;
const TICKS = 6;
const DIGITS = 6;
/** Columns before the values of the answer. */
const DESIGN = "design";
const ERROR = "error.code";

const formatNumber = (number) => (number === null || number === undefined ? "–" : String(Number(Number(number).toPrecision(DIGITS))));

export class SweepMap {
  #table = null;
  #cell = null;
  /** Name of the main value. */
  #own = {};

  /** open(design): values by name, and the answer's under `answer`; colour(name): of the page */
  constructor(box, open) {
    this.box = box;
    this.open = open;
    this.canvas = box.querySelector("canvas");
    this.reading = box.querySelector(".reading");
    this.select = $("#map-value");
    this.select.addEventListener("change", () => this.draw());
    this.canvas.addEventListener("pointermove", (event) => this.#point(this.#at(event)));
    this.canvas.addEventListener("click", (event) => {
      this.#point(this.#at(event));
      this.#go();
    });
    this.canvas.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  /** columns: name -> list, the service's answer; own, title: the first shown column, and its name */
  show(columns, own, title) {
    const names = Object.keys(columns);
    const over = names.slice(names.indexOf(DESIGN) + 1, names.indexOf(ERROR));
    const values = names.slice(names.indexOf(ERROR) + 2).filter((name) => columns[name].some((one) => typeof one === "number"));
    this.box.hidden = false;
    const drawable = over.length <= 2 && over.every((name) => columns[name].every((one) => typeof one === "number")) && values.length > 0;
    this.#table = drawable ? { columns, over, axes: over.map((name) => [...new Set(columns[name])].sort((a, b) => a - b)) } : null;
    this.#own = { [own]: title };
    this.select.replaceChildren(...values.map((name) => make("option", { value: name })));
    if (values.includes(own)) this.select.value = own;
    this.#cell = null;
    this.reading.textContent = "";
    this.draw();
  }

  /** Draw it again, also after a change of language, size or colours. */
  draw() {
    const { canvas } = this;
    for (const option of this.select.options) option.textContent = option.value in this.#own ? say(this.#own[option.value]) : columnName(option.value);
    if (this.box.hidden || !canvas.clientWidth) return;
    const context = canvas.getContext("2d");
    Object.assign(canvas, { width: canvas.clientWidth * devicePixelRatio, height: HEIGHT * devicePixelRatio });
    context.scale(devicePixelRatio, devicePixelRatio);
    if (!this.#table) {
      this.reading.textContent = say("Only numbers over one or two parameters can be drawn.");
      return;
    }
    const { columns, over, axes } = this.#table;
    const values = columns[this.select.value];
    const colour = colours();
    const known = values.filter((one) => one !== null);
    const range = [Math.min(...known), Math.max(...known)];
    const frame = { left: LEFT, top: TOP, width: canvas.clientWidth - LEFT - RIGHT, height: HEIGHT - TOP - BOTTOM };
    const two = over.length === 2;
    const scales = { x: scale(axes[0], two), y: two ? scale(axes[1], true) : { low: range[0], high: range[1] } };
    const at = (x, y) => [
      frame.left + (frame.width * (x - scales.x.low)) / (scales.x.high - scales.x.low || 1),
      frame.top + frame.height * (1 - (y - scales.y.low) / (scales.y.high - scales.y.low || 1)),
    ];
    this.#drawn = { frame, scales, at, range };
    const grid = this.#grid(values);
    if (two) drawCells(context, axes, grid, range, at, colour);
    else drawLine(context, axes[0], grid[0], at, colour);
    drawAxes(context, frame, scales, at, [this.#label(over[0]), two ? this.#label(over[1]) : this.#valueName], colour);
    this.#legend(range, two);
    this.#mark(context, at, colour);
  }

  #drawn = null;

  /** Rows of the value for the second parameter, each over the first; null for a design without it. */
  #grid(values) {
    const { columns, over, axes } = this.#table;
    const places = axes.map((axis) => new Map(axis.map((one, k) => [one, k])));
    const grid = Array.from({ length: axes[1]?.length ?? 1 }, () => Array(axes[0].length).fill(null));
    values.forEach((value, k) => {
      const row = over.length === 2 ? places[1].get(columns[over[1]][k]) : 0;
      grid[row][places[0].get(columns[over[0]][k])] = value;
    });
    return grid;
  }

  /** Name and unit of a parameter. */
  #label(name) {
    if (!(name in LIMITS)) return name;
    const [, , unit] = LIMITS[name];
    return say(LABELS[name]) + (unit ? ` [${unit === "turns" ? say("turns") : unit}]` : "");
  }

  get #valueName() {
    return this.select.selectedOptions[0].textContent;
  }

  #legend(/** @type {number[]} */ [low, high], two) {
    $("#map-legend").hidden = !two;
    const [least, largest] = $("#map-legend").querySelectorAll("span");
    [least.textContent, largest.textContent] = [formatNumber(low), formatNumber(high)];
  }

  #mark(context, at, colour) {
    if (!this.#cell) return;
    const { axes, columns } = this.#table;
    const [i, j] = this.#cell;
    const value = columns[this.select.value][this.#design(i, j)];
    const [x, y] = at(axes[0][i], axes.length === 2 ? axes[1][j] : (value ?? this.#drawn.scales.y.low));
    Object.assign(context, { strokeStyle: colour("contact"), lineWidth: 2 });
    context.beginPath();
    context.arc(x, y, 7, 0, 2 * Math.PI);
    context.stroke();
  }

  /** Row number of a design, from its places on the axes. */
  #design(i, j) {
    const { columns, over, axes } = this.#table;
    const [first, second] = over.map((name) => columns[name]);
    return first.findIndex((x, k) => x === axes[0][i] && (!second || second[k] === axes[1][j]));
  }

  #at(event) {
    if (!this.#table || !this.#drawn) return null;
    const { frame, scales } = this.#drawn;
    const x = scales.x.low + ((event.offsetX - frame.left) / frame.width) * (scales.x.high - scales.x.low);
    const y = scales.y.low + (1 - (event.offsetY - frame.top) / frame.height) * (scales.y.high - scales.y.low);
    const { axes } = this.#table;
    return [nearest(axes[0], x), axes[1] ? nearest(axes[1], y) : 0];
  }

  #point(cell) {
    if (!cell) return;
    this.#cell = cell;
    const { columns, over } = this.#table;
    const k = this.#design(...cell);
    const places = over.map((name) => `${this.#label(name)} ${formatNumber(columns[name][k])}`);
    const value = columns[this.select.value][k];
    const reading = value === null ? (columns["error.message"][k] ?? say("no value")) : `${this.#valueName} ${formatNumber(value)}`;
    this.reading.textContent = `${places.join(say(", "))}${say(": ")}${reading}`;
    this.draw();
  }

  #go() {
    if (!this.#cell) return;
    const { columns, over } = this.#table;
    const k = this.#design(...this.#cell);
    const row = Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, column[k]]));
    this.open(Object.fromEntries(over.map((name) => [name, row[name]])), row);
  }

  #key(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
    const { axes } = this.#table ?? {};
    if (!axes || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Enter") this.#go();
    else if (event.key in steps) {
      const move = (k, step, axis) => Math.min(Math.max(k + step, 0), (axis?.length ?? 1) - 1);
      const [i, j] = this.#cell ?? [0, 0];
      const [di, dj] = this.#cell ? steps[event.key] : [0, 0];
      this.#point([move(i, di, axes[0]), move(j, dj, axes[1])]);
    } else return;
    event.preventDefault();
  }
}

/** Ends of an axis; cells reach half a step beyond the values. */
function scale(values, cells) {
  const [low, high] = [values[0], values.at(-1)];
  const half = cells ? (high - low) / Math.max(values.length - 1, 1) / 2 || 0.5 : 0;
  return { low: low - half, high: high + half };
}

const nearest = (values, x) => values.reduce((best, one, k) => (Math.abs(one - x) < Math.abs(values[best] - x) ? k : best), 0);

/** Ends of the cell of each value: half way to its neighbours. */
function edges(values) {
  const { low, high } = scale(values, true);
  return [low, ...values.slice(1).map((one, k) => (one + values[k]) / 2), high];
}

function drawCells(context, [xs, ys], grid, /** @type {number[]} */ [low, high], at, colour) {
  const shades = palette(colour("ramp"));
  const [ex, ey] = [edges(xs), edges(ys)];
  grid.forEach((row, j) =>
    row.forEach((value, i) => {
      if (value === null) return;
      const [[left, bottom], [right, top]] = [at(ex[i], ey[j]), at(ex[i + 1], ey[j + 1])];
      context.fillStyle = shades[Math.min(Math.floor(((value - low) / (high - low || 1)) * shades.length), shades.length - 1)];
      // One pixel more, so that no seams are visible.
      context.fillRect(left, top, right - left + 0.7, bottom - top + 0.7);
    }),
  );
  Object.assign(context, { strokeStyle: colour("card"), lineWidth: 1 });
  context.beginPath();
  for (let k = 1; k <= LEVELS; k++) contour(context, [xs, ys], grid, low + ((high - low) * k) / (LEVELS + 1), at);
  context.stroke();
}

/** The contour of a level, cell by cell: a straight line between its crossings with the sides of the cell. */
function contour(context, [xs, ys], grid, level, at) {
  const cross = (a, b, from, to) => (a < level !== b < level ? from.map((one, k) => one + ((level - a) / (b - a)) * (to[k] - one)) : null);
  for (let j = 0; j + 1 < ys.length; j++) {
    for (let i = 0; i + 1 < xs.length; i++) {
      const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
      const values = corners.map(([p, q]) => grid[q][p]);
      if (values.includes(null)) continue;
      const places = corners.map(([p, q]) => at(xs[p], ys[q]));
      const met = [0, 1, 2, 3].map((k) => cross(values[k], values[(k + 1) % 4], places[k], places[(k + 1) % 4])).filter(Boolean);
      for (let k = 0; k + 1 < met.length; k += 2) {
        context.moveTo(...met[k]);
        context.lineTo(...met[k + 1]);
      }
    }
  }
}

function drawLine(context, xs, values, at, colour) {
  Object.assign(context, { strokeStyle: colour("accent"), fillStyle: colour("accent"), lineWidth: 1.5 });
  context.beginPath();
  let apart = true;
  values.forEach((value, k) => {
    if (value !== null) context[apart ? "moveTo" : "lineTo"](...at(xs[k], value));
    apart = value === null;
  });
  context.stroke();
  for (const [k, value] of values.entries()) {
    if (value === null) continue;
    context.beginPath();
    context.arc(...at(xs[k], value), 2, 0, 2 * Math.PI);
    context.fill();
  }
}

function drawAxes(context, { left, top, width, height }, { x, y }, at, [nameX, nameY], colour) {
  Object.assign(context, { strokeStyle: colour("border"), fillStyle: colour("muted"), lineWidth: 1, font: `${inType(SMALL_TYPE)}px system-ui, sans-serif` });
  context.strokeRect(left, top, width, height);
  context.textBaseline = "top";
  context.textAlign = "center";
  for (const tick of ticks([x.low, x.high], Math.min(TICKS, Math.max(Math.floor(width / 60), 2))).values) context.fillText(formatNumber(tick), at(tick, y.low)[0], top + height + 6);
  context.fillText(nameX, left + width / 2, top + height + 24);
  Object.assign(context, { textAlign: "right", textBaseline: "middle" });
  for (const tick of ticks([y.low, y.high], TICKS).values) context.fillText(formatNumber(tick), left - 6, at(x.low, tick)[1]);
  context.save();
  context.translate(12, top + height / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillText(nameY, 0, 0);
  context.restore();
}
