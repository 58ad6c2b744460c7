/** The corners of the thing that is drawn, with typed coordinates, and the length of each side, as measured with a tape. */

import { moved, pointsOf, removed } from "./changes.js";
import { isLine } from "./drawing.js";
import { button, hide, make, numberIn } from "./elements.js";
import { NAMES } from "./route.js";
import { measures } from "./square.js";
import { phrase, say } from "./text.js";

/** Largest coordinate and length that the service takes [m], and number of corners whose list opens by itself. */
const [MOST, FEW] = [1e5, 12];
const HEADS = [phrase("Corner"), "x [m]", "y [m]", NAMES.cornerNext, phrase("angle"), phrase("Remove")];

export class Corners {
  #rows = [];
  #item = null;

  /**
   * refuse(words): says why a number is refused; null: it is right
   * @param {{ state: State, steps: Steps, editor: Editor }} parts
   */
  constructor({ state, steps, editor }, refuse) {
    this.state = state;
    this.steps = steps;
    this.editor = editor;
    this.refuse = refuse;
    this.title = make("summary");
    this.body = make("tbody");
    const heads = HEADS.map((words) => make("th", { scope: "col", "data-text": words }));
    this.box = make("details", { id: "corners" }, this.title, make("table", {}, make("thead", {}, make("tr", {}, ...heads)), this.body));
  }

  get #drawing() {
    return this.state.get("drawing");
  }

  #points() {
    return pointsOf(this.#drawing, this.editor.item);
  }

  /** A field for a number of corner k; take(number, k): changes the drawing */
  #field(key, k, take) {
    const onchange = ({ target }) => {
      const number = numberIn(target.value);
      const isRight = typeof number === "number" && Math.abs(number) <= MOST;
      target.setAttribute("aria-invalid", !isRight);
      this.refuse(isRight ? null : () => say("“{what}” must be a number from {low} to {high}; you typed “{text}”. The dance stays as it was.", { what: say(NAMES[key]), low: -MOST, high: MOST, text: target.value }));
      if (isRight) this.steps.take(take(number));
    };
    return make("input", { inputMode: "decimal", autocomplete: "off", "data-label": NAMES[key], "aria-label": say(NAMES[key]), onchange, "data-corner": k });
  }

  /** The drawing with the next corner at this distance from corner k, in the same direction. */
  #lengthened(length, k) {
    const points = this.#points();
    const next = (k + 1) % points.length;
    const way = points[next].map((one, axis) => one - points[k][axis]);
    const scale = length / (Math.hypot(...way) || 1);
    return moved(this.#drawing, this.editor.item, next, way.map((one, axis) => points[k][axis] + one * scale));
  }

  #row(k) {
    const at = (axis, value) => moved(this.#drawing, this.editor.item, k, this.#points()[k].with(axis, value));
    const fields = [this.#field("pointX", k, (x) => at(0, x)), this.#field("pointY", k, (y) => at(1, y)), this.#field("cornerNext", k, (length) => this.#lengthened(length, k))];
    const angle = make("td");
    const drop = button({ className: "reset", textContent: "✕", "data-label": "Remove", "aria-label": say("Remove") }, () => this.steps.take(removed(this.#drawing, this.editor.item, k)));
    const row = make("tr", {}, make("th", { scope: "row", textContent: k + 1 }), ...fields.map((one) => make("td", {}, one)), angle, make("td", {}, drop));
    return { fields, angle, row };
  }

  /** After a change of anything. */
  show() {
    const { active, item } = this.editor;
    const thing = active && item !== null ? this.#drawing.things[item] : null;
    hide(this.box, !thing);
    if (!thing) {
      this.#item = null;
      return;
    }
    const { points, kind, name } = thing;
    while (this.#rows.length > points.length) this.#rows.pop().row.remove();
    while (this.#rows.length < points.length) {
      this.#rows.push(this.#row(this.#rows.length));
      this.body.append(this.#rows.at(-1).row);
    }
    if (this.#item !== item) this.box.open = points.length <= FEW;
    this.#item = item;
    this.title.textContent = say(points.length === 1 ? "Place of “{name}”" : "Corners of “{name}”: {count}", { name, count: points.length });
    const { lengths, angles } = measures(points, !isLine({ kind }));
    this.#rows.forEach(({ fields, angle }, k) => {
      const next = points.length > 1 ? lengths[k] : null;
      const values = [...points[k], next].map((one) => (one === null ? "" : String(Number(one.toFixed(3)))));
      fields.forEach((one, at) => {
        if (document.activeElement === one || (one.getAttribute("aria-invalid") === "true" && one.kept === values[at])) return;
        if (one.value !== values[at]) one.value = values[at];
        one.kept = values[at];
        one.removeAttribute("aria-invalid");
      });
      hide(fields[2], next === null);
      angle.textContent = angles[k] === null ? "" : `${angles[k].toFixed(1)}°`;
    });
  }
}
