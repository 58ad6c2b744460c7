/** The verdict on the drawn dance, and each failure in order of time with a button that shows it. */

import { mendWords } from "./answers.js";
import { TOO_LONG } from "./api.js";
import { $, button, hide, make } from "./elements.js";
import { formatNumber } from "./numbers.js";
import { tell } from "./overlays.js";
import { isPresetPath, isPresetVenue } from "./presets.js";
import { phrase, say } from "./text.js";

/** Verdicts on a dance. @type {Phrases} */
const VERDICTS = {
  passes: "Can be danced",
  fails: "Cannot be danced",
  undecided: "Undecided",
};
/** What comes next without a path. */
const NEXT = {
  propose: [phrase("Propose a dance"), phrase("The square is drawn. “Propose a dance” finds dances that fit into it; or draw a path yourself.")],
  choose: [phrase("Choose a dance"), phrase("Show one of the dances that were found: its answers stand here.")],
  path: [phrase("Draw a path"), phrase("Draw the head's path on the picture with a finger or the mouse, or tap its points: two make a path.")],
};
const OUTCOMES = { passes: ["clear", "✓"], fails: ["contact", "✕"], undecided: ["undecided", "?"] };
const DECIMALS = 6;
const SHEET = phrase("Safety sheet, for whoever permits it");

/** True for a dance in a square that stands here to begin with. */
const isExample = ({ drawing }) => Boolean(drawing?.things.length) && isPresetPath(drawing) && isPresetVenue(drawing);

/** Radius of a bend that is too tight, and the one needed, with as many digits as it takes to tell them apart. */
export function radiiOf({ radius, least_radius: least }) {
  const digits = [2, 3, 4, 5].find((count) => radius.toFixed(count) !== least.toFixed(count)) ?? DECIMALS;
  return { radius: radius.toFixed(digits), least: least.toFixed(digits) };
}

export class Judgement {
  /** seek(failure): shows the dance at its time; look(point): moves the picture there */
  constructor(box, seek, look) {
    this.box = box;
    this.seek = seek;
    this.look = look;
  }

  /** Show the verdict on a dance that the service has checked. dance: may have lines to add, and what is known of it */
  show(dance) {
    const [outcome, mark] = OUTCOMES[dance.verdict];
    const rows = dance.failures.map((failure) => this.#row([`${formatNumber(failure.time, DECIMALS, 2)} s`, failure.clock].filter(Boolean).join(" · "), failure.sentence, () => this.seek(failure)));
    const lines = [...dance.sentences, ...(dance.lines ?? [])];
    this.#fill(outcome, mark, say(VERDICTS[dance.verdict]), lines, rows, { known: dance.known, title: say(isExample(dance) ? "Verdict on this example" : "Verdict"), sheet: true });
  }

  /** No verdict until these fields are mended, beside which the reason stands. */
  wait(fields) {
    this.#fill("", "", say("No answer"), [mendWords(fields)], []);
  }

  /** Without a path: what comes next; null hides the verdict, because something else tells it. @param {keyof typeof NEXT | null} next */
  begin(next) {
    if (next) this.#fill("", "", say(NEXT[next][0]), [say(NEXT[next][1])], []);
    hide(this.box, !next);
    Object.assign($("#verdict"), { hidden: !next, href: next === "path" ? "#answers" : "#propose" });
  }

  /** Show why there is no verdict: bends that are too tight, or the service's refusal, which is none where the time did not suffice. */
  refuse({ sentence, type }, course = null) {
    if (type === TOO_LONG) return this.#fill("undecided", "?", say(VERDICTS.undecided), [sentence], []);
    const bends = course?.bends ?? [];
    const rows = bends.map((bend) => this.#row(say("Show"), bend.sentence, () => this.look(bend.points[Math.floor(bend.points.length / 2)])));
    this.#fill("contact", "✕", say(VERDICTS.fails), rows.length ? [] : [sentence], rows);
  }

  #row(name, text, act) {
    return make("li", {}, button({ textContent: name }, act), " ", make("span", { textContent: text }));
  }

  /** known: sentences of the evidence; title: what the verdict is on; sheet: whether there is a safety sheet */
  #fill(outcome, mark, value, lines, rows, { known = [], title = say("Verdict"), sheet = false } = {}) {
    const open = this.box.querySelector("details")?.open ?? false;
    const sign = make("span", { className: "mark", "aria-hidden": "true", textContent: mark });
    this.box.dataset.outcome = outcome;
    // On a phone the verdict also appears below the picture, in one line that leads to its reasons.
    Object.assign($("#verdict"), { hidden: false, href: "#answers", textContent: [mark, value].join(" ").trim() });
    const sentences = lines.filter(Boolean).map((line) => make("p", typeof line === "string" ? { textContent: line } : line));
    const list = make("ol", { className: "failures" }, ...rows);
    const old = make("p", { className: "old", textContent: say("Older than your numbers") });
    const evidence = make("details", { open }, make("summary", { textContent: say("How it is known") }), ...known.map((textContent) => make("p", { textContent })));
    this.box.replaceChildren(old, make("h3", { textContent: title }), make("p", { className: "value" }, sign, value), ...sentences, ...(rows.length ? [list] : []), ...(known.length ? [evidence] : []));
    if (sheet) this.box.append(button({ id: "to-safety", textContent: say(SHEET) }, () => document.dispatchEvent(new Event("safety"))));
    tell(this.box);
  }
}
