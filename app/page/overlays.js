/** What lies over the picture and the page: the inset, the mark of the contact, messages that go away. */

import { $ } from "./elements.js";
import { say } from "./text.js";

/** How long a message stays, and for each letter of a long one [ms]. */
const [SAID, LETTER] = [6_000, 80];
/** Where the inset may stand, the favourite first; the lower left has the legend. */
const CORNERS = ["top-right", "bottom-right", "top-left"];

let said = 0;

/** Say what happened; the words go away by themselves, or when they are clicked. */
export function announce(words) {
  const box = $("#status");
  const end = () => (box.textContent = "");
  Object.assign(box, { textContent: words, onclick: end });
  clearTimeout(said);
  said = setTimeout(end, Math.max(SAID, LETTER * words.length));
}

/**
 * Let the inset stand in the corner where it covers least of the dragon; where it stands is left only for a better one.
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
  mark.style.setProperty("--share", end > begin ? (time - begin) / (end - begin) : 1);
  mark.title = say("contactMark", { time: time.toFixed(6) });
  mark.setAttribute("aria-label", mark.title);
}
