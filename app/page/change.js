/** One line on the picture that says what a change of the drawing has done: at once by the quick verdict, then by the certified answer. */

import { isFigure } from "./changes.js";
import { make } from "./elements.js";
import { say } from "./text.js";

/** Least difference that is worth a word [m], [m/s]; most differences in the line; distance beyond which the edge of a plain is, which nobody has drawn [m]. */
const [LEAST, MOST, FAR] = [0.005, 2, 10_000];

/** What a certified answer says in numbers: name of a thing, or a key -> its distance [m] or speed [m/s]. */
function factsOf({ venue, least_clearance: least, highest_speed: speed }) {
  const gaps = (venue?.areas ?? []).filter(({ nearest }) => nearest && nearest.distance < FAR).map(({ name, nearest }) => [say("“{name}”", { name }), nearest.distance]);
  return new Map([...gaps, ...(least ? [["benches", least.distance]] : []), ...(speed ? [["speed", speed.speed]] : [])]);
}

/** A fact and what it was, in words. isStrayed: distances are those of people who stray */
function wordsOf(key, now, was, isStrayed) {
  const numbers = { now: now.toFixed(2), was: was.toFixed(2) };
  if (key === "speed") return say("highest speed {now} m/s (was {was})", numbers);
  if (key === "benches") return say(isStrayed ? "benches {now} m apart while people stray (was {was})" : "benches {now} m apart (was {was})", numbers);
  return say(isStrayed ? "{name}: {now} m free while people stray (was {was})" : "{name}: {now} m free (was {was})", { name: key, ...numbers });
}

/** The largest differences between two certified answers, in words; none without any. */
export function differences(before, now, isStrayed = false) {
  const [old, own] = [before, now].map(factsOf);
  const changed = [...own].filter(([key, value]) => old.has(key) && Math.abs(value - old.get(key)) >= LEAST);
  changed.sort(([a, x], [b, y]) => Math.abs(y - old.get(b)) - Math.abs(x - old.get(a)));
  return changed.slice(0, MOST).map(([key, value]) => wordsOf(key, value, old.get(key), isStrayed));
}

/** True if a drawing has the path of another one, or all its things and some of its points or the pieces of its figure, as after a change by hand. */
function isEdited(before, now) {
  if (before.points === now.points && before.path === now.path) return true;
  const keepsThings = before.things.length === now.things.length && before.things.every((thing, k) => thing === now.things[k]);
  return keepsThings && (before.points.some((point) => now.points.includes(point)) || (isFigure(before) && isFigure(now) && before.path.pieces.length === now.path.pieces.length));
}

export class Change {
  /** The newest certified answer, and the one before the change that is being made: {report, drawing}. @type {any} */
  #newest = null;
  #before = null;
  /** The drawing before the last drag. */
  #base = null;

  /** @param {any} stage */
  constructor(stage) {
    this.line = make("p", { id: "change", hidden: true });
    stage.append(this.line);
  }

  #say(verdict, words) {
    this.line.hidden = !words.length;
    this.line.textContent = `${verdict === "passes" ? "✓" : "✕"} ${words.join(say(", "))}`;
  }

  /** While a hand drags: the quick verdict. dance: as judged; base: the drawing before the drag */
  quick({ verdict, failures }, base) {
    this.#begin(base);
    this.#say(verdict, [verdict === "passes" ? say("Can be danced") : (failures[0]?.sentence ?? say("Undecided"))]);
  }

  #begin(base) {
    if (base !== this.#base) [this.#base, this.#before] = [base, this.#newest];
  }

  /** Once the hand rests: what differs from before, unless a file, an example or a proposal has taken its place. report: the certified answer; base: the drawing before the drag, or null without one; isStrayed: whether people stray in it */
  certified(report, base, drawing, isStrayed) {
    if (base) this.#begin(base);
    else this.#before = this.#newest;
    this.#newest = { report, drawing };
    const before = this.#before;
    if (!before || !isEdited(before.drawing, drawing)) return this.clear();
    this.#say(report.verdict, report.verdict === "passes" ? differences(before.report, report, isStrayed) : report.failures.slice(0, 1).map(({ sentence }) => sentence));
  }

  /** There is no dance any more with which the next one could be compared. */
  forget() {
    this.#newest = null;
    this.clear();
  }

  /** Another dance than a drawn one, or another language. */
  clear() {
    this.line.hidden = true;
  }
}
