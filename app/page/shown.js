/** Layers of the picture that a person hides and shows again. */

import { $, button, hide, make, textButton } from "./elements.js";
import { phrase } from "./text.js";

/** Layers by their names in `dance.hidden`. @type {Phrases} */
const LAYERS = { things: "Things in the square", photo: "Photo or plan", measures: "Measures", marks: "Marks of what is wrong", dragons: "Dragons" };

/** Width of a picture in which the box would hide too much, and distance from the button [px]. */
const [NARROW, ASIDE] = [560, 6];

/** Add the button of the layers beside those of the view: {show(is): shows it or not}. changed(): called when one is hidden or shown */
export function addLayers(dance, changed) {
  const rows = Object.entries(LAYERS).map(([name, words]) => {
    const onchange = ({ target }) => {
      if (target.checked) dance.hidden.delete(name);
      else dance.hidden.add(name);
      opener.setAttribute("aria-pressed", String(dance.hidden.size > 0));
      changed();
    };
    return make("label", {}, make("input", { type: "checkbox", checked: true, name, onchange }), make("span", { "data-text": words }));
  });
  const box = make("div", { id: "shown", popover: "auto", "data-label": "Shown on the picture" }, make("h3", { "data-text": phrase("Shown on the picture") }), ...rows, textButton("Close", () => box.hidePopover()));
  // A drag does not close it by itself.
  $("#canvas").addEventListener("pointerdown", () => box.hidePopover());
  const opener = button({ id: "layers", "data-label": phrase("Layers to show or hide"), textContent: "≡", popoverTargetElement: box, hidden: true });
  // Beside its button, or below the picture of a phone, so that the picture shows what changes.
  box.addEventListener("beforetoggle", () => {
    const [{ right, top, bottom }, stage] = [opener, $("#stage")].map((one) => one.getBoundingClientRect());
    const isNarrow = stage.width < NARROW;
    const isLow = !isNarrow && top > innerHeight / 2;
    Object.assign(box.style, { margin: 0, inset: `${isLow ? "auto" : `${isNarrow ? stage.bottom : top}px`} auto ${isLow ? `${innerHeight - bottom}px` : "auto"} ${isNarrow ? stage.left : right + ASIDE}px` });
  });
  $("#views").append(opener);
  $("#dance").append(box);
  return { show: (is) => hide(opener, !is) };
}
