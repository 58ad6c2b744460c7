/** The place of a message over the page. */

import { $, $$ } from "./elements.js";

/** Step of the places of a message that are tried [px], its widths, the widest first, and what it may not cover: controls, and what to do next. */
const [STEP, WIDTHS] = [8, ["", "17rem", "11rem", "8rem"]];
/** Blocks after which it can stand, and parts of the height of a window at which they are looked for [1]: not those of the picture. */
const BLOCKS = "main li, main section:not(#dance) > *, main form > *, main .answer > *";
const IN_SIGHT = [0.7, 0.65, 0.75, 0.6, 0.8, 0.55, 0.5];
const CONTROLS = "button, input, select, textarea, a, summary, #draw-help, #add-help";

let isListening = false;

/**
 * Put the message where it covers no control, as near as it can to its usual place: what a person needs next stays in
 * reach. Where no place is free, as in a small window, it stands among what is in sight.
 */
export function placeMessage() {
  if (!isListening) keepOff();
  const box = $("#status");
  if (!box.textContent || box.parentElement !== document.body) return;
  const controls = $$(CONTROLS).filter((one) => one.checkVisibility({ visibilityProperty: true })).map((one) => one.getBoundingClientRect());
  const near = controls.filter(({ width, height, bottom, top }) => width && height && bottom > 0 && top < innerHeight);
  for (const maxWidth of WIDTHS) {
    Object.assign(box.style, { maxWidth, translate: "" });
    const { left, top, width, height } = box.getBoundingClientRect();
    const isFree = ([x, y]) => near.every((one) => one.right <= x || one.left >= x + width || one.bottom <= y || one.top >= y + height);
    const far = ([x, y]) => Math.hypot(x - left, y - top);
    const lefts = [left, STEP, innerWidth - width - STEP];
    const rows = Math.max(Math.floor((innerHeight - height) / STEP), 0);
    const places = /** @type {[number, number][]} */ (Array.from({ length: rows }, (_, row) => lefts.map((x) => [x, row * STEP])).flat());
    const place = [/** @type {[number, number]} */ ([left, top]), ...places.sort((a, b) => far(a) - far(b))].find(isFree);
    if (!place) continue;
    box.style.translate = `${place[0] - left}px ${place[1] - top}px`;
    return;
  }
  box.remove(); // It is in sight itself.
  const seen = IN_SIGHT.map((part) => document.elementFromPoint(innerWidth / 2, part * innerHeight)?.closest(BLOCKS));
  const block = seen.find(Boolean) ?? $("#stage");
  if (block.matches("li")) block.append(box);
  else block.after(box);
  box.scrollIntoView({ block: "nearest" });
}

/** The message keeps off the controls that come to it later, when a person scrolls or opens something. */
function keepOff() {
  isListening = true;
  const queue = () => requestAnimationFrame(placeMessage);
  for (const type of ["scroll", "click"]) addEventListener(type, queue, { capture: true, passive: true });
  new ResizeObserver(queue).observe(document.body);
  addEventListener("resize", queue);
}
