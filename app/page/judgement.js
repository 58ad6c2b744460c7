/** The verdict on the drawn dance, and each failure in order of time with a button that shows it. */

import { $, make } from "./elements.js";
import { benchName, handleName, refusalWords, say, sayOf } from "./text.js";

const OUTCOMES = { passes: ["clear", "✓"], fails: ["contact", "✕"], undecided: ["undecided", "?"] };
const DECIMALS = 6;

/** One failure of /check in a sentence. */
function words({ kind, benches, area, peak_speed: peak }, { numbers, drawing }) {
  const name = (k) => benchName(k, numbers.benches);
  const [a, b] = benches;
  const values = { a: a === undefined ? "" : name(a), b: b === undefined ? "" : name(b), area: area ?? "", limit: drawing.limit };
  if (kind === "contact") return sayOf("fail_contact", numbers, values);
  if (kind === "venue") return sayOf("fail_venue", numbers, values);
  if (kind === "outside") {
    const square = drawing.things.find((thing) => thing.kind === "area");
    return say(area === square?.name ? "fail_outside" : "fail_inside", values);
  }
  if (kind === "speed") {
    const handle = a === undefined ? say("handle") : handleName(a, numbers.benches);
    return say(peak === null ? "fail_speedOnly" : "fail_speed", { ...values, handle, peak: peak?.toFixed(DECIMALS) });
  }
  return say(`fail_${kind}`, values);
}

export class Judgement {
  /** seek(failure): shows the dance at its time; look(point): moves the picture there */
  constructor(box, seek, look) {
    Object.assign(this, { box, seek, look });
  }

  /** Show the verdict on a dance that the service has checked. */
  show(dance, course) {
    const [outcome, mark] = OUTCOMES[dance.verdict];
    const rows = dance.failures.map((failure) => this.#row([`${failure.time.toFixed(DECIMALS)} s`, failure.clock].filter(Boolean).join(" · "), words(failure, dance), () => this.seek(failure)));
    const { length } = course ?? {};
    const lines = [length === undefined ? "" : say("pathLength", { length: length.toFixed(2), time: (dance.end - dance.begin).toFixed(1) })];
    this.#fill(outcome, mark, say(`verdict_${dance.verdict}`), lines, rows);
  }

  /** Show why there is no verdict: no drawing yet, bends that are too tight, or the service's refusal. */
  refuse(message, course, benches) {
    const bends = course?.bends ?? [];
    const said = ({ radius, least_radius: least, bench }) =>
      say("tightBend", { radius: radius.toFixed(2), least: least.toFixed(2), bench: benchName(bench, benches) });
    const rows = bends.map((bend) => this.#row(say("show"), said(bend), () => this.look(bend.points[Math.floor(bend.points.length / 2)])));
    const drawn = message === null;
    const lines = drawn ? [say("drawFirst")] : rows.length ? [] : [refusalWords(message)];
    this.#fill(drawn ? "" : "contact", drawn ? "" : "✕", say(drawn ? "verdict_none" : "verdict_fails"), lines, rows);
  }

  #row(button, text, act) {
    const go = make("button", { type: "button", textContent: button });
    go.addEventListener("click", act);
    return make("li", {}, go, " ", make("span", { textContent: text }));
  }

  #fill(outcome, mark, value, lines, rows) {
    const sign = make("span", { className: "mark", "aria-hidden": "true", textContent: mark });
    this.box.dataset.outcome = outcome;
    // On a phone the verdict also appears below the picture.
    Object.assign($("#verdict"), { hidden: false, textContent: [mark, value, rows[0] ? `· ${rows[0].textContent}` : ""].join(" ") });
    const said = lines.filter(Boolean).map((line) => make("p", typeof line === "string" ? { textContent: line } : line));
    const list = make("ol", { className: "failures" }, ...rows);
    this.box.replaceChildren(make("h3", { textContent: say("verdictTitle") }), make("p", { className: "value" }, sign, value), ...said, ...(rows.length ? [list] : []));
  }
}
