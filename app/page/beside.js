/** The numbers of the chosen thing, or what can be done with several, beside them on the picture. */

import { isLine } from "./drawing.js";
import { $, button, hide, make, textButton } from "./elements.js";
import { measures } from "./square.js";
import { phrase, say } from "./text.js";

/** Distance from the thing, and from the edge of the picture; width of a picture beside whose things there is room [px]. */
const [ASIDE, EDGE, WIDE] = [14, 6, 560];

/** Fingers need the picture around the thing too, for the next one. */
const hasFingers = matchMedia("(pointer: coarse)");

/** What brings several things into line. @type {Phrases} */
export const ALIGNS = { row: "In a row", column: "In a column", gaps: "Equal gaps" };

export class Beside {
  /**
   * form: has the fields of a thing; gaps(): how near benches come to each area, as far as it is known
   * @param {Editor} editor
   */
  constructor(box, dance, editor, form, gaps) {
    this.gaps = gaps;
    this.gap = make("p", { className: "gap" });
    this.box = box;
    this.dance = dance;
    this.editor = editor;
    this.form = form;
    this.row = form.thingRow(() => editor.item);
    this.size = make("p", { className: "hint" });
    addEventListener("resize", () => {
      this.#makeRoom(null);
      this.show();
    });
    // Known before it is asked for, because a drag has no time for a layout.
    new ResizeObserver(([{ contentRect: { width } }]) => {
      this.isNarrow = width < WIDE;
      this.show();
    }).observe($("#stage"));
    const { edit, name, radius, unit, angle, places, use, street } = this.row;
    this.copy = textButton(phrase("Copy"), () => editor.duplicate());
    const remove = textButton(phrase("Remove"), () => editor.remove());
    this.aligns = make("div", {}, ...Object.entries(ALIGNS).map(([how, words]) => textButton(words, () => editor.align(how), { "data-align": how })));
    const close = button({ textContent: "✓", "data-label": "Leave this thing (Escape)", "aria-label": say("Leave this thing (Escape)") }, () => editor.leave());
    // Its kind is known; the list has the button that goes on drawing it.
    edit.remove();
    this.own = make("div", {}, make("label", { className: "radius" }, "r ", radius, unit), places, use, angle, street);
    this.title = make("b");
    box.append(make("div", {}, name, this.title, close), this.own, this.gap, this.size, this.aligns, make("div", {}, this.copy, remove));
  }

  /** True for a picture without room beside a thing. */
  isNarrow = false;

  /** The chosen things. */
  get #things() {
    const { whole, others, items, state } = this.editor;
    return others.length ? items.map((item) => state.get("drawing").things[item]) : whole ? [whole] : [];
  }

  /** After a change of anything. */
  show() {
    const things = this.#things;
    const [thing] = things;
    this.#makeRoom(thing);
    hide(this.box, !thing);
    if (!thing) return;
    const isOne = things.length === 1;
    this.box.classList.toggle("several", !isOne);
    for (const part of [this.row.name, this.own, this.size]) hide(part, !isOne);
    for (const part of [this.title, this.aligns]) hide(part, isOne);
    hide(this.copy, things.every(({ kind }) => kind === "area"));
    this.title.textContent = say("{count} things", { count: things.length });
    hide(this.gap, true);
    if (!isOne) return;
    this.form.fill(this.row, this.editor.item);
    hide(this.box.querySelector(".radius"), thing.radius === undefined);
    // While it is drawn and dragged, the samples of the dance say how near benches come.
    const gap = this.gaps()?.find(({ name }) => name === thing.name);
    hide(this.gap, !gap);
    if (gap) this.gap.textContent = say(gap.enough ? "{distance} m from benches in place; {enough} m are enough" : "{distance} m from the benches", { distance: gap.distance.toFixed(2), enough: gap.enough.toFixed(2) });
    this.gap.classList.toggle("error", Boolean(gap) && gap.distance < gap.enough);
    const { lengths } = measures(thing.points, !isLine(thing));
    this.size.textContent = thing.points.length > 1 ? lengths.filter((one) => one !== null).map((one) => `${Number(one.toFixed(2))} m`).join(" · ") : "";
  }

  /** In a narrow window, and for fingers, the numbers stand below the picture, which keeps its size, so that nothing moves under a finger. */
  #makeRoom(thing) {
    const stage = $("#stage");
    const isBelow = Boolean(thing) && (this.isNarrow || hasFingers.matches);
    if (isBelow === this.box.classList.contains("below")) return;
    stage.style.flex = isBelow ? `0 0 ${stage.offsetHeight}px` : "";
    this.box.classList.toggle("below", isBelow);
    this.box.style.transform = "";
  }

  /** At each drawing of the picture: where there is room beside the thing. */
  place() {
    const things = this.#things;
    if (!things[0]?.points.length || this.box.classList.contains("below")) return;
    const { view } = this.dance;
    const reach = Math.max(...things.map(({ radius = 0 }) => radius)) * view.scale + ASIDE;
    const places = things.flatMap(({ points }) => points).map((point) => view.toScreen(...point));
    const [left, top, right, low] = [0, 1, 0, 1].map((axis, side) => Math[side < 2 ? "min" : "max"](...places.map((one) => one[axis])) + (side < 2 ? -reach : reach));
    const { offsetWidth: wide, offsetHeight: high } = this.box;
    const [middleX, middleY] = [(left + right - wide) / 2, (top + low - high) / 2];
    const tries = [[right, middleY], [left - wide, middleY], [middleX, top - high], [middleX, low]];
    const isIn = ([x, y]) => x >= EDGE && y >= EDGE && x + wide <= view.width - EDGE && y + high <= view.height - EDGE;
    // Beside several things are those that may be chosen too.
    const [x, y] = (things.length === 1 && tries.find(isIn)) || [middleX, view.height - high - EDGE];
    const at = [Math.min(Math.max(x, EDGE), view.width - wide - EDGE), Math.max(y, EDGE)].map(Math.round);
    this.box.style.transform = `translate(${at[0]}px, ${at[1] + $("#stage").offsetTop}px)`;
  }
}
