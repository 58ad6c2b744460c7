/** Elements over the picture and the page: the inset, the mark of the contact, temporary messages, the banner of a lost service. */

import { Problem, Superseded } from "./api.js";
import { $ } from "./elements.js";
import { formatNumber } from "./numbers.js";
import { pending } from "./pending.js";
import { say } from "./text.js";

/** Time that a message stays, and additional time for each letter of a long one [ms]. */
const [VISIBLE_FOR, READ_FOR, LETTER] = [6_000, 30_000, 80];
/** Time without a change after which an answer is told [ms]. */
const STILL = 700;
/** Possible corners of the inset, the preferred one first. */
const CORNERS = ["top-right", "bottom-right", "top-left"];

/** Stays, until what it tells of has ended, or the next message comes. */
export const MEANWHILE = "meanwhile";

let timer = 0;

/** Function that gives the shown message in the language of the page. */
let message = () => "";
/** Function that gives the notes of an opened file, which come back after other messages until they have been read; null without. */
let notes = null;

/** Say that the service is lost. seconds: until the next try, 0 during one */
export function lost(seconds) {
  $("#lost").hidden = false;
  $("#lost span").textContent = say(seconds ? "The service does not answer. The page stays as it is; next try in {seconds} s." : "The service does not answer. The page stays as it is; trying again now.", { seconds });
}

const PLACING = Symbol("message");
/** Put the message where it covers no control; what finds that place loads with the first message. */
async function place() {
  pending(PLACING, true);
  // Without a network the message stays in its usual place.
  const placing = await import("./placing.js").catch(() => null);
  placing?.placeMessage();
  pending(PLACING, false);
}

/**
 * Show a message; it disappears by itself, on a click, or by Escape. words(): its text; stays: only the next message replaces it,
 * and one that also flows comes back after it, but not one of MEANWHILE; flows: it stands below the picture, where it covers nothing, because it takes long to read
 */
export function announce(words, stays = /** @type {boolean | string} */ (false), flows = false) {
  if (stays === true && flows) notes = words;
  else if (notes && !words()) return announce(notes, true, true);
  const box = $("#status");
  if (flows) $("#stage").after(box);
  else if (box.parentElement !== document.body) document.body.append(box);
  message = words;
  Object.assign(box, { textContent: words(), onclick: endMessage });
  if (box.textContent && !flows) place();
  clearTimeout(timer);
  const time = LETTER * box.textContent.length;
  if (stays === true && flows) timer = setTimeout(endMessage, Math.max(READ_FOR, time));
  else if (!stays) timer = setTimeout(() => announce(() => "", true), Math.max(VISIBLE_FOR, time));
}

/** The words of a message about a step. @type {(() => string) | null} */
let aboutStep = null;

/** Show a message about a step, which goes when a step is taken back. flows: as for announce() */
export function announceStep(words, flows = false) {
  announce(words, false, flows);
  aboutStep = words;
}

export function endStepMessage() {
  if (aboutStep && message === aboutStep) announce(() => "", true);
  aboutStep = null;
}

/** The message about what has ended goes, if it is still there. */
export function endMeanwhile(words) {
  if (message === words) announce(() => "", true);
}

export function endMessage() {
  notes = null;
  announce(() => "", true);
}

let hearing = 0;
/** Tell an answer to those who listen, once nothing has changed for a while; the last one of several counts. box: of the answer */
export function tell(box) {
  clearTimeout(hearing);
  hearing = setTimeout(() => {
    const sentences = [...box.querySelectorAll(":scope > h3, :scope > p:not(.old), :scope > .failures span")].map((one) => one.textContent.replace(/^[✓✕?]/, ""));
    const words = box.hidden ? "" : sentences.join(" ");
    if ($("#heard").textContent !== words) $("#heard").textContent = words;
  }, STILL);
}

/** Copy a text, and say whether the browser allowed it: without HTTPS many do not. */
export async function copy(text) {
  const copied = await navigator.clipboard?.writeText(text).then(() => true, () => false);
  announce(() => say(copied ? "Copied" : "The browser did not allow copying"));
}

/** Show the refusal of a question that a person has asked, if it was refused. flows: see announce(); throws: any other error */
export function announceRefusal(error, flows = false) {
  if (error instanceof Problem) announce(() => error.problem.sentence, false, flows);
  else if (!(error instanceof Superseded)) throw error;
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

/** What stands on paper alone: when the dance ends, and the address that shows it. end: in words, or an empty text */
export const showPrinted = (end) => ($("#printed").textContent = `${end && say("The dance ends at {end}.", { end })}\n${location.href}`);

/** Mark first contact on the slider of the time. answer: {time, outcome}; begin, end: of the slider [s] */
export function markContact({ time, outcome, dragons }, begin, end) {
  const mark = $("#contact-mark");
  mark.hidden = !outcome.startsWith("contact");
  if (mark.hidden) return;
  mark.style.setProperty("--share", end > begin ? (time - begin) / (end - begin) : 0);
  mark.title = say(dragons ? "Two dragons meet at {time} s" : "First contact, at {time} s", { time: formatNumber(time, 6, 2) });
  mark.setAttribute("aria-label", mark.title);
}
