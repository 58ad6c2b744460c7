/** From metres to pixels: pan, zoom, pinch and keys on a canvas. y points up in the world and down on the screen. */

import { $ } from "./elements.js";

const ZOOM_STEP = 1.25;
const PAN_STEP = 60;
const CLICK_TRAVEL = 5;
const [SCALE_MIN, SCALE_MAX] = [0.05, 20_000];
/** Room around all that is shown, in a low picture less, down to that of a point with its name [px]. */
const [PADDING, LEAST_PADDING] = [24, 18];
/** Room beside the buttons on the left, and for the scale below; buttons wider than this have the scale below them [px]. */
const [BESIDE, SCALE, COLUMN] = [19, 20, 60];
/** Height of a picture in multiples of its padding, if it is low. */
const LOW = 16;

const within = (scale) => Math.min(Math.max(scale, SCALE_MIN), SCALE_MAX);

export class View {
  /** True while one pointer does something else than to move the view. */
  stays = false;
  #pointers = new Map();
  #travel = 0;

  /** moved(panned): called after a change of the view; clicked(x, y): in pixels of the canvas */
  constructor(canvas, { moved, clicked }) {
    this.canvas = canvas;
    this.moved = moved;
    this.clicked = clicked;
    this.x = 0;
    this.y = 0;
    this.scale = 20;
    this.fitted = true;
    new ResizeObserver(() => this.measure()).observe(canvas);
    this.measure();
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, (event) => this.#up(event));
    // A tap may move the picture away: the click that a browser sends after it would meet what is there then.
    canvas.addEventListener("touchend", (event) => event.cancelable && event.preventDefault());
  }

  /** Read and keep the size of the canvas, because reading it during a change costs a layout of the whole page. */
  measure() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.width = width;
    this.height = height;
    const { offsetLeft, offsetWidth } = $("#views");
    this.left = offsetLeft + offsetWidth + BESIDE;
    this.scaleIsLeft = offsetWidth > COLUMN;
  }

  toScreen(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  toWorld(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }

  /** Number of the point of {x, y} [m] nearest to a place [px], within a distance [px]; null without one. */
  nearest({ x, y }, px, py, reach) {
    let [best, least] = [null, reach];
    x.forEach((one, k) => {
      const [sx, sy] = this.toScreen(one, y[k]);
      const far = Math.hypot(sx - px, sy - py);
      if (far < least) [best, least] = [k, far];
    });
    return best;
  }

  /** Show these bounds completely, [x min, y min, x max, y max]. inset: width that a low picture leaves free on the right for it [px] */
  fit([left, bottom, right, top], inset = 0) {
    const padding = Math.min(PADDING, Math.max(LEAST_PADDING, this.height / LOW));
    const [below, beside] = this.scaleIsLeft ? [0, Math.max(inset, padding)] : [SCALE, padding];
    const [wide, high] = [this.width - this.left - beside, this.height - 2 * padding - below];
    const scale = within(Math.min(wide / (right - left), high / (top - bottom)));
    this.set((left + right) / 2 - (this.left - beside) / 2 / scale, (bottom + top) / 2 - below / 2 / scale, scale, true);
  }

  set(x, y, scale = this.scale, fitted = false) {
    this.x = x;
    this.y = y;
    this.scale = within(scale);
    this.fitted = fitted;
  }

  /** Move the view to the middle of bench k of a pose, if it has one. */
  centre({ x, y }, k) {
    if (k + 1 < x.length) this.set((x[k] + x[k + 1]) / 2, (y[k] + y[k + 1]) / 2);
  }

  /** Move the view to a point that is outside. */
  reveal(x, y) {
    const [px, py] = this.toScreen(x, y);
    if (px >= 0 && py >= 0 && px <= this.width && py <= this.height) return;
    this.set(x, y);
    this.moved(true);
  }

  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const scale = within(this.scale * factor);
    const gain = 1 / this.scale - 1 / scale;
    this.set(this.x + (px - this.width / 2) * gain, this.y - (py - this.height / 2) * gain, scale);
    this.moved(false);
  }

  pan(dx, dy) {
    this.set(this.x - dx / this.scale, this.y + dy / this.scale);
    this.moved(true);
  }

  /** Handle keys: those that move the view, and others. keys: key -> action */
  listen(keys) {
    this.canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (!this.key(event.key)) {
        if (!keys[event.key]) return;
        keys[event.key]();
      }
      event.preventDefault();
    });
  }

  /** True when the view handles this key. */
  key(key) {
    const arrows = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (arrows[key]) this.pan(...arrows[key].map((way) => way * PAN_STEP));
    else if (key === "+" || key === "=") this.zoom(ZOOM_STEP);
    else if (key === "-") this.zoom(1 / ZOOM_STEP);
    else return false;
    return true;
  }

  /** Zooms once the canvas was clicked or chosen with a key; before, the wheel scrolls the page. */
  #wheel(event) {
    if (document.activeElement !== this.canvas) return;
    event.preventDefault();
    this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), event.offsetX, event.offsetY);
  }

  /** Let go of the pointers: what they pressed is taken over by something else. */
  release() {
    this.#pointers.clear();
  }

  #down(event) {
    if (event.button === 2) return;
    this.canvas.setPointerCapture(event.pointerId);
    if (!this.#pointers.size) this.#travel = 0;
    this.#pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
  }

  #move(event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.offsetX, event.offsetY];
    const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    this.#travel += Math.hypot(dx, dy);
    this.#pointers.set(event.pointerId, now);
    if (this.#travel < CLICK_TRAVEL) return;
    const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
    if (!other) return this.stays || this.pan(dx, dy);
    const spread = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]) || 1;
    this.zoom(spread(now) / spread(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    this.pan(dx / 2, dy / 2);
  }

  #up(event) {
    const place = this.#pointers.get(event.pointerId);
    this.#pointers.delete(event.pointerId);
    if (place && event.type === "pointerup" && this.#travel < CLICK_TRAVEL) this.clicked(...place);
  }
}
