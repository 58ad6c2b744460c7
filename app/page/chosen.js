/** What of a drawing is chosen, and what is done with it as a whole. */

import { aligned, copied, figured, shiftedAll, withoutThings } from "./changes.js";
import { extent } from "./square.js";
import { between } from "./text.js";
import { decimetres } from "./touch.js";

/** Distance of a copy from what was copied [px]. */
const ASIDE = 40;

export class Chosen {
  tool = "path";
  /** True if taps draw. */
  active = false;
  /** The edited item: null for the path, else the number of a thing. */
  item = null;
  /** Further things that are chosen together with this one. @type {number[]} */
  others = [];
  /** True while taps add points to the edited thing; false after it was chosen by a touch. */
  isDrawing = false;
  /** Copied things. */
  #copy = [];

  /**
   * chosen(): called when another item is edited
   * @param {State} state
   * @param {Steps} steps
   */
  constructor(dance, state, steps, chosen) {
    this.dance = dance;
    this.state = state;
    this.steps = steps;
    this.chosen = chosen;
  }

  get drawing() {
    return this.state.get("drawing");
  }

  get isRoute() {
    return this.state.get("path") === "route";
  }

  /** A place of the window on the picture [px]. */
  inBox(x, y) {
    const { left, top } = this.dance.canvas.getBoundingClientRect();
    return [x - left, y - top];
  }

  /** The numbers of the chosen things. @type {number[]} */
  get items() {
    return this.thing ? [this.item, ...this.others] : [];
  }

  /** The chosen thing; null without one. */
  get thing() {
    return this.active && this.isRoute && this.item !== null ? this.drawing.things[this.item] : null;
  }

  /** The names of the chosen things. */
  get names() {
    return this.items.map((item) => this.drawing.things[item].name).join(between());
  }

  /** Choose a thing by a touch, whatever the tool, which goes on to draw on free ground; or several together. */
  choose(item, others = []) {
    this.active = true;
    [this.item, this.others] = [item, others];
    this.isDrawing = false;
    this.chosen();
  }

  /** Choose a thing beside those that are chosen already, or no longer. */
  toggle(item) {
    const items = this.items.includes(item) ? this.items.filter((one) => one !== item) : [...this.items, item];
    this.choose(items[0] ?? null, items.slice(1));
  }

  /** Choose nothing. */
  leave() {
    if (this.tool === "photo") this.tool = "path";
    [this.item, this.others] = [null, []];
    this.chosen();
  }

  get canPaste() {
    return this.#copy.length > 0;
  }

  copy() {
    this.#copy = this.items.map((item) => this.drawing.things[item]);
  }

  /** Things like the copied ones beside them, which are chosen now. */
  paste() {
    this.duplicate(this.#copy);
  }

  /** The same with the first of them at a place of the window [px]. */
  pasteAt(x, y) {
    this.duplicate(this.#copy, this.dance.view.toWorld(...this.inBox(x, y)));
  }

  /** Things like the chosen ones beside them, which are chosen now. things: others; point: where the first of them goes */
  duplicate(things = this.items.map((item) => this.drawing.things[item]), point = null) {
    const copies = things.filter(({ kind }) => kind !== "area");
    if (!copies.length) return;
    const drawing = copies.reduce(copied, this.drawing);
    const items = copies.map((_, k) => this.drawing.things.length + k);
    const far = ASIDE / this.dance.view.scale;
    const { middle } = extent(copies[0].points);
    this.steps.take(shiftedAll(drawing, items, decimetres(point ? point.map((one, axis) => one - middle[axis]) : [far, -far])));
    this.choose(items[0], items.slice(1));
  }

  /** Take the chosen things away. */
  remove() {
    const { items } = this;
    if (!items.length) return;
    [this.item, this.others] = [null, []];
    this.steps.take(withoutThings(this.drawing, items));
    this.chosen();
  }

  /** Bring the chosen things into a row, a column, or equal gaps. */
  align(how) {
    this.steps.take(aligned(this.drawing, this.items, how));
  }

  /** The figure as its mirror image. */
  mirror() {
    this.steps.take(figured(this.drawing, { isMirrored: true }));
  }
}
