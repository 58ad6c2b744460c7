/** A small challenge for those who just look: how tight can the spiral be, so that the head still gets to the circle? */

import { $, download, hide, make, textButton } from "./elements.js";
import { bound, fixed } from "./numbers.js";
import { say, sentencesOf, writeTexts } from "./text.js";

/** Decimals of a pitch, a step of the buttons, and how near the tightest one counts as it [m]. */
const [DECIMALS, STEP, NEAR] = [4, 1e-3, 1e-3];
/** Size of the card, its edge, and the height of its picture [px]. */
const [SIDE, EDGE, HIGH] = [1080, 60, 690];

export class Challenge {
  /** The tightest pitch that got there, and of which dragon and circle. */
  #best = { pitch: Infinity, key: "" };

  /** @param {{ state: State, questions: Questions }} parts */
  constructor({ state, questions }) {
    this.state = state;
    this.questions = questions;
    this.hint = make("p", { className: "hint" });
    this.words = make("p", { id: "challenge-words", ariaLive: "polite" });
    this.card = textButton("A card to share", () => this.#share(), { id: "challenge-card" });
    const steps = make("p", { className: "buttons" }, textButton("1 mm tighter", () => this.#step(-STEP)), textButton("1 mm wider", () => this.#step(STEP)), this.card);
    this.box = make("section", { id: "challenge", "aria-labelledby": "challenge-title" }, make("h3", { id: "challenge-title", "data-text": "How tight can you make it?" }), this.hint, this.words, steps);
    this.feast = $(".feast").cloneNode(true);
    $("#controls").append(this.feast);
    $("#dragons").before(this.box);
    this.show();
  }

  get #diameter() {
    return Number(this.state.get("turning_diameter"));
  }

  /** After a change of the dance, its answers, the door or the language. */
  show() {
    const { dance, answers } = this.questions;
    const isOn = this.state.get("door") === "look" && dance?.kind === "spiral" && !this.state.get("dances");
    for (const part of [this.box, this.feast]) hide(part, !isOn);
    if (!isOn) return;
    writeTexts();
    this.hint.textContent = say("Drag the pitch below, the distance from one turn of the spiral to the next. The head has to get to the circle in the middle, {diameter} m across, before two benches touch.", { diameter: this.#diameter });
    const { answer, query, numbers } = dance;
    const { pitch: text, ...others } = query;
    const [pitch, key] = [Number(text), JSON.stringify([others, this.#diameter])];
    const far = answer.head && answer.head.radius - this.#diameter / 2;
    const isInside = pitch * numbers.start_turns <= this.#diameter / 2;
    const gets = !isInside && (answer.time === null ? answer.end?.reason === "centre" : far <= 0);
    if (key !== this.#best.key) this.#best = { pitch: Infinity, key };
    if (gets) this.#best.pitch = Math.min(this.#best.pitch, pitch);
    const best = this.#best.pitch;
    const least = answers.minimum?.answer.pitch;
    const tightest = least && best - least < NEAR ? say("You are at the limit: from {least} m on, every wider spiral gets there.", { least: bound(least, DECIMALS, 1) }) : "";
    const at = fixed(pitch, DECIMALS);
    const arrived = () => (answer.time === null ? say("✓ At {pitch} m the head gets to the circle, and nothing touches.", { pitch: at }) : say("✓ At {pitch} m the head gets to the circle. Two benches touch only after that, {inside} m farther in.", { pitch: at, inside: fixed(-far, 2) }));
    const inside = () => say("✕ At {pitch} m the head already begins inside the circle, so this does not count.", { pitch: at });
    const now = isInside ? inside() : gets ? arrived() : far > 0 ? say("✕ At {pitch} m two benches touch while the head is still {far} m outside the circle.", { pitch: at, far: fixed(far, 2) }) : "";
    const hint = far > 0 && !gets && !isInside ? say("A wider one gets there; then there is a card to share.") : "";
    const record = best < Infinity ? say("Your tightest: {pitch} m.", { pitch: fixed(best, DECIMALS) }) : hint;
    this.words.textContent = sentencesOf([now, gets && best === pitch ? tightest || say("Tighter?") : record]);
    this.card.disabled = !gets || best !== pitch;
  }

  /** Make the spiral wider by [m]. */
  #step(by) {
    this.state.set({ pitch: String(Number((Number(this.state.get("pitch")) + by).toFixed(DECIMALS))) });
  }

  /** Share the dance shown as a picture, or save it where there is no sheet to share. */
  async #share() {
    const name = `bench-dragon-${fixed(this.#best.pitch, DECIMALS)}.png`;
    const blob = await new Promise((resolve) => this.#drawn().toBlob(resolve, "image/png"));
    const files = [new File([blob], name, { type: blob.type })];
    if (navigator.canShare?.({ files })) await navigator.share({ files }).catch(() => {});
    else download(blob, name);
  }

  #drawn() {
    const card = Object.assign(document.createElement("canvas"), { width: SIDE, height: SIDE });
    const context = card.getContext("2d");
    const { backgroundColor, color } = getComputedStyle($("#front > *"));
    context.fillStyle = backgroundColor;
    context.fillRect(0, 0, SIDE, SIDE);
    const picture = $("#canvas");
    const scale = Math.min((SIDE - 2 * EDGE) / picture.width, HIGH / picture.height);
    const [width, height] = [scale * picture.width, scale * picture.height];
    context.drawImage(picture, (SIDE - width) / 2, EDGE + (HIGH - height) / 2, width, height);
    context.fillStyle = color;
    context.textAlign = "center";
    const { fontFamily } = getComputedStyle(document.body);
    const lines = [
      [100, `${fixed(this.#best.pitch, DECIMALS)} m`],
      [38, say("My tightest spiral in which {benches} benches get to the circle", { benches: this.questions.dance.numbers.benches })],
      [32, `${say("Bench Dragon")} · ${location.host}`],
    ];
    let low = EDGE + HIGH + 20;
    for (const [size, text] of lines) {
      low += 1.25 * size;
      context.font = `${size === 100 ? "bold " : ""}${size}px ${fontFamily}`;
      context.fillText(text, SIDE / 2, low, SIDE - 2 * EDGE);
    }
    return card;
  }
}
