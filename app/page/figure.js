/** A figure on the picture, such as a proposed ring: what can be done with it, and its numbers. */

import { canMirror, dancedOf, figured } from "./changes.js";
import { hide, make, numberIn, textButton } from "./elements.js";
import { announce } from "./overlays.js";
import { extent } from "./square.js";
import { phrase, say } from "./text.js";
import { walkText } from "./walk.js";

const DEGREE = Math.PI / 180;
const narrow = matchMedia("(max-width: 759px)");
/** Numbers of a figure: name; read(drawing): its value, null without one; set(value, was): what of the figure changes; least, most. */
const NUMBERS = {
  x: { words: phrase("Middle of the figure, x [m]"), read: (drawing) => extent(dancedOf(drawing)).middle[0], set: (x, was) => ({ by: [x - was, 0] }), least: -1e5, most: 1e5 },
  y: { words: phrase("Middle of the figure, y [m]"), read: (drawing) => extent(dancedOf(drawing)).middle[1], set: (y, was) => ({ by: [0, y - was] }), least: -1e5, most: 1e5 },
  r: { words: phrase("Largest radius of its bends [m]"), read: ({ path }) => Math.max(...path.pieces.map(({ radius = 0 }) => radius)) || null, set: (r, was) => ({ scale: r / was }), least: 0.5, most: 1e3 },
  "∠": { words: phrase("Direction in which it begins [°]"), read: ({ path }) => Number(walkText(path)?.split("_")[0].split(",")[2]) / DEGREE, set: (angle, was) => ({ angle: (angle - was) * DEGREE }), least: -360, most: 360 },
};

export class Figure {
  /**
   * free(): makes points of it
   * @param {any} stage
   * @param {Editor} editor
   * @param {() => void} free
   */
  constructor(stage, editor, free) {
    this.editor = editor;
    this.turned = textButton("Mirror", () => editor.mirror(), { id: "mirror" });
    const freed = textButton("Free it", free, { id: "free" });
    this.fields = Object.values(NUMBERS).map((number) => {
      const onchange = ({ target }) => this.#set(target, number);
      return make("input", { inputMode: "decimal", autocomplete: "off", "data-label": number.words, onchange });
    });
    const labels = Object.keys(NUMBERS).map((name, k) => make("label", {}, `${name} `, this.fields[k], " "));
    this.box = make("p", { id: "figure", className: "bar", hidden: true }, make("b", { "data-text": phrase("Figure") }), " ", ...labels, this.turned, " ", freed);
    // On a phone below the picture, which keeps its size when a thing is taken next.
    const stand = () => (narrow.matches ? stage.after(this.box) : stage.append(this.box));
    narrow.addEventListener("change", stand);
    stand();
  }

  get #drawing() {
    return this.editor.drawing;
  }

  #set(field, { words, read, set, least, most }) {
    const value = numberIn(field.value);
    const isRight = typeof value === "number" && value >= least && value <= most;
    field.setAttribute("aria-invalid", String(!isRight));
    if (isRight) return this.editor.steps.take(figured(this.#drawing, set(value, read(this.#drawing))));
    const { value: text } = field;
    announce(() => say("“{what}” must be a number from {low} to {high}; you typed “{text}”. The dance stays as it was.", { what: say(words), low: least, high: most, text }));
  }

  /** After a change of anything. */
  show() {
    const { hasFigure } = this.editor;
    hide(this.box, !hasFigure);
    if (!hasFigure) return;
    hide(this.turned, !canMirror(this.#drawing));
    Object.values(NUMBERS).forEach(({ read }, k) => {
      const value = read(this.#drawing);
      hide(this.fields[k].parentElement, value === null);
      if (value === null || document.activeElement === this.fields[k]) return;
      this.fields[k].value = String(Number(value.toFixed(2)));
      this.fields[k].removeAttribute("aria-invalid");
    });
  }
}
