/** Elements over the picture and the page: the inset, the mark of the contact, temporary messages. */

import { $ } from "./elements.js";
import { say } from "./text.js";

/** Time that a message stays, and additional time for each letter of a long one [ms]. */
const [SAID, LETTER] = [6_000, 80];
/** Possible corners of the inset, the preferred one first; the lower left has the legend. */
const CORNERS = ["top-right", "bottom-right", "top-left"];

let said = 0;

/** Gives the shown message in the language of the page. */
let message = () => "";

/** Show a message; it disappears by itself, or on a click. words(): its text; stays: only the next message replaces it */
export function announce(words, stays = false) {
  const box = $("#status");
  message = words;
  const end = () => announce(() => "", true);
  Object.assign(box, { textContent: words(), onclick: end });
  clearTimeout(said);
  if (!stays) said = setTimeout(end, Math.max(SAID, LETTER * box.textContent.length));
}

/** Show the message in another language. */
export const announceAgain = () => ($("#status").textContent = message());

/**
 * Put the inset into the corner where it covers least of the dragon; it moves only to a better corner.
 * covered(rectangles): how much of the dragon lies in each {left, top, right, bottom} [px]
 */
export function placeInset(covered) {
  const inset = $("#inset");
  if (inset.hidden) return;
  const now = inset.dataset.corner;
  const stage = $("#stage").getBoundingClientRect();
  const rectangles = CORNERS.map((corner) => {
    inset.dataset.corner = corner;
    const { left, top, right, bottom } = inset.getBoundingClientRect();
    return { left: left - stage.left, top: top - stage.top, right: right - stage.left, bottom: bottom - stage.top };
  });
  const counts = covered(rectangles);
  const least = Math.min(...counts);
  inset.dataset.corner = counts[CORNERS.indexOf(now)] === least ? now : CORNERS[counts.indexOf(least)];
}

/** Mark first contact on the slider of the time. answer: {time, outcome}; begin, end: of the slider [s] */
export function markContact({ time, outcome }, begin, end) {
  const mark = $("#contact-mark");
  mark.hidden = !outcome.startsWith("contact");
  if (mark.hidden) return;
  mark.style.setProperty("--share", end > begin ? (time - begin) / (end - begin) : 0);
  mark.title = say("contactMark", { time: time.toFixed(6) });
  mark.setAttribute("aria-label", mark.title);
}
