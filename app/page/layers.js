/** A box in which a person chooses what of a large drawing is opened: some of its layers, or an area of it. */

import { Problem, Superseded } from "./api.js";
import { openBox } from "./box.js";
import { make, numberIn, textButton } from "./elements.js";
import { phrase, say } from "./text.js";

/** Labels of the sides of an area, and what stands in their empty fields. */
const SIDES = [[phrase("Least x [m]"), "x"], [phrase("Least y [m]"), "y"], [phrase("Largest x [m]"), "x"], [phrase("Largest y [m]"), "y"]];

/** The name of a layer as the service reads it in a list. */
const quoted = (name) => (/[,"]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name);

/**
 * layers: [{name, edges}]; problem: why the drawing is not opened as a whole; open(part): a promise, which a refusal of
 * the part breaks; part: of the query of /places
 */
export function chooseParts(layers, problem, open) {
  const why = make("p", { className: "error", role: "alert", textContent: problem.sentence });
  const boxes = layers.map(({ name }) => make("input", { type: "checkbox", value: name }));
  const rows = layers.map(({ name, edges }, k) => make("li", {}, make("label", {}, boxes[k], `${name} · ${say("{edges} edges", { edges })}`)));
  const sides = SIDES.map(([label, placeholder]) => make("input", { inputMode: "decimal", autocomplete: "off", "data-label": label, placeholder }));
  const take = async () => {
    const names = boxes.filter(({ checked }) => checked).map(({ value }) => value);
    const numbers = sides.map(({ value }) => numberIn(value));
    const part = { ...(names.length && { layers: names.map(quoted).join() }), ...(numbers.some((one) => one !== "") && { area: numbers.join() }) };
    go.disabled = true;
    try {
      await open(part);
      leave();
    } catch (error) {
      if (error instanceof Problem) why.textContent = error.problem.sentence;
      else if (!(error instanceof Superseded)) throw error;
    } finally {
      go.disabled = false;
    }
  };
  const go = textButton("Open", take, { id: "parts-open", className: "main" });
  const close = textButton("Close", () => leave());
  const area = make("p", {}, make("span", { "data-text": "Only what reaches into x, y to x, y" }), ...sides, make("span", { className: "unit", textContent: "m" }));
  const hint = make("p", { className: "hint", "data-text": "Choose the layers with the square, what stands in it, and the path; or an area." });
  const leave = openBox("drawing-parts", make("h2", { "data-text": "Open a part of the drawing" }), [why, hint, make("ul", {}, ...rows), area, make("p", { className: "buttons" }, go, close)]);
  boxes[0].focus();
}
