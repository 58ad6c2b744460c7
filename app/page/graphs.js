/** The charts of the page: the content, the reading and the help text of each. */

import { gapWords, headlineOf, instantWords } from "./answers.js";
import { Chart, clearancePlan, curvePlan, scanPlan } from "./charts.js";
import { $, make } from "./elements.js";
import { CONTACT, strayOf } from "./fields.js";
import { bound } from "./numbers.js";
import { benchName, phrase, say } from "./text.js";

const PITCH_DECIMALS = 4;
/** Difference of two times that are shown as one [s]. */
const INSTANT = 0.005;
/** Charts for which the service needs seconds. */
const SLOW = ["curve", "scan"];
/** Distance from the view at which they are requested: small at first, because on wide screens they are just below it. */
const [IN_VIEW, A_SCREEN] = ["0px", "100%"];

export class Graphs {
  #charts;
  #watch = null;

  /**
   * seek(time): shows the dance at this time [s]
   * @param {State} state
   * @param {Questions} questions
   */
  constructor(state, questions, seek) {
    this.state = state;
    this.questions = questions;
    const choosePitch = (pitch) => state.set({ pitch: pitch.toFixed(PITCH_DECIMALS) });
    this.#charts = {
      clearance: new Chart($("#clearance .plot"), clearancePlan, seek),
      curve: new Chart($("#curve .plot"), curvePlan, choosePitch),
      scan: new Chart($("#scan .plot"), scanPlan, choosePitch),
    };
    this.#watchFrom(IN_VIEW);
    addEventListener("scroll", () => this.#watchFrom(A_SCREEN), { once: true });
    // Printing does not wait: missing charts are left out, and appear when the page is printed again.
    addEventListener("beforeprint", () => SLOW.forEach((kind) => questions.near(kind)));
  }

  /** Request slow charts as soon as they are this near to the view. margin: as in CSS */
  #watchFrom(margin) {
    this.#watch?.disconnect();
    const tell = (seen) => seen.filter((one) => one.isIntersecting).forEach(({ target }) => this.questions.near(target.parentElement.id));
    this.#watch = new IntersectionObserver(tell, { rootMargin: margin });
    for (const kind of SLOW) this.#watch.observe(this.#charts[kind].box);
  }

  restyle() {
    for (const chart of Object.values(this.#charts)) chart.show();
  }

  /** The help texts, which depend on the definition of a contact. */
  help() {
    const request = this.state.texts(CONTACT);
    const strays = strayOf(request) > 0;
    const gaps = strays
      ? phrase("Smallest gap between two benches that share no handle, with everybody in their place. Dots: local minima; dashed: the margin; cross: from then on two may be in contact. Click or drag to move the dance.")
      : phrase("Smallest gap between two benches that share no handle. Dots: local minima; dashed: the margin; cross: the first time at the margin. Click or drag to move the dance.");
    $("#clearance .hint").textContent = say(gaps);
    const radii = Number(request.margin) > 0
      ? phrase("Radius of the head when two benches first come within {margin} m of each other; the curve jumps. Dashed: turning circle; dotted: minimum pitch; line: your pitch. Click to set the pitch.")
      : phrase("Radius of the head at first contact; the curve jumps. Dashed: turning circle; dotted: minimum pitch; line: your pitch. Click to set the pitch.");
    $("#scan .hint").textContent = say(radii, request) + (strays ? say(" The curve is for people exactly in their places.") : "");
  }

  /** Show a refusal in place of the chart of this kind, if there is one. problem: null if it is shown elsewhere */
  refuse(kind, problem) {
    if (!(kind in this.#charts)) return;
    this.#say(kind, problem?.sentence ?? say("See the reason above."));
  }

  /** Say something in place of the chart of this kind. */
  #say(kind, textContent) {
    this.#charts[kind].show(null);
    $(`#${kind} .reading`).replaceChildren(make("span", { textContent }));
  }

  clearance() {
    const { answer, dance } = this.questions.answers.clearance;
    if (!answer) {
      $("#clearance").setAttribute("aria-busy", false);
      return this.#say("clearance", say("Only benches that share no handle have a gap: it takes three of them."));
    }
    const { time, gap } = dance.answer;
    const { margin } = dance.numbers;
    const contact = time === null ? null : { time, gap: strayOf(dance.numbers) > 0 ? gap : margin };
    this.#charts.clearance.show({ ...answer, margin, contact });
  }

  /** Mark this time [s] on the chart of the clearance. */
  time(now) {
    this.#charts.clearance.now(now);
    const { answer, dance } = this.questions.answers.clearance ?? {};
    if (!answer || dance !== this.questions.dance) return;
    const step = (dance.end - dance.begin) / (answer.time.length - 1) || 1;
    const k = Math.min(Math.round((now - dance.begin) / step), answer.time.length - 1);
    const [a, b] = answer.benches[k].map((bench) => benchName(bench, dance.numbers.benches));
    const gap = gapWords(answer.clearance[k]);
    const is = Math.abs(answer.time[k] - now) < INSTANT ? phrase("{time} s: {gap}, {a} and {b}") : phrase("{time} s, the nearest time of the curve: {gap}, {a} and {b}");
    $("#clearance .reading").textContent = say(is, { time: instantWords(k === answer.time.length - 1 ? dance.end : answer.time[k], dance), gap, a, b });
  }

  /** Draw the proven stray against the pitch, with the current stray and the minimum pitch for it. */
  curve() {
    const { curve, minimum, tolerance } = this.questions.answers;
    if (!curve) return;
    const [own, least] = minimum ? [strayOf(minimum.request), minimum.answer.pitch] : [0, null];
    this.#charts.curve.show({ ...curve.answer, own, least });
    const pitch = tolerance?.request.pitch ?? null;
    this.#charts.curve.now(pitch && Number(pitch));
    const words = () => say("pitch {pitch} m: everybody may be {stray} cm from their place", { pitch, stray: bound(100 * tolerance.answer.stray, 2, -1) });
    $("#curve .reading").textContent = pitch ? words() : "";
  }

  /** Draw the first view of the staircase, or all of it. kind: look or scan */
  scan(kind) {
    const { answer, request } = this.questions.answers[kind];
    const coarse = kind === "look";
    $("#scan").classList.toggle("coarse", coarse);
    this.#charts.scan.show({ ...answer, circle: Number(request.turning_diameter) / 2, coarse });
    this.pitch();
  }

  /** Mark the shown dance on the staircase. */
  pitch() {
    const { answer, numbers, kind } = this.questions.dance ?? {};
    const { look, scan } = this.questions.answers;
    if (!(scan ?? look) || !answer?.words || kind === "route") return;
    const { pitch } = numbers;
    this.#charts.scan.now(pitch);
    // With a stray the head need not stop there.
    const stops = answer.head && !(strayOf(numbers) > 0);
    const words = stops
      ? say("pitch {pitch} m: the head stops at {radius} m", { pitch, radius: answer.head.radius.toFixed(6) })
      : `${say("Pitch")} ${pitch} m${say(": ")}${headlineOf(answer.words)}`;
    $("#scan .reading").textContent = [kind === "spiral" && words, !scan && say("first view; the jumps are still being located")].filter(Boolean).join(" · ");
  }
}
