/** The doors of the page: what a person came for decides which numbers, answers and sections stand there. */

import { EMPTY } from "./drawing.js";
import { $, $$, onClick } from "./elements.js";
import { setExact } from "./numbers.js";
import { announce } from "./overlays.js";
import { say } from "./text.js";

/** The kinds of path behind a door, of which the first one opens; behind `all` is the whole page, as behind an old address. */
const PATHS = { contest: ["spiral", "turn"], village: ["route"], look: ["spiral", "turn"] };

/** Longest name of an unknown door in a message [characters]. */
const LONGEST = 40;

export class Doors {
  #pressed = "";

  /**
   * @param {State} state
   * @param {Parts} parts
   */
  constructor(state, parts) {
    this.state = state;
    this.parts = parts;
    for (const button of $$("[data-door]")) button.addEventListener("click", () => this.#enter(button.dataset.door));
    onClick("#more", () => this.#offerMore(!$("main").classList.contains("more")));
  }

  get door() {
    return this.state.get("door") ?? "all";
  }

  async #enter(door) {
    this.#pressed = door;
    const [path] = PATHS[door] ?? [];
    const stays = !path || PATHS[door].includes(this.state.get("path"));
    const begins = door === "village" && this.state.get("drawing") === EMPTY;
    const drawing = begins && (await this.parts.load("drawn")).village();
    if (this.#pressed !== door) return; // Another door was pressed meanwhile.
    this.state.choosePath(stays ? this.state.get("path") : path, { door, ...(begins && { drawing }) });
  }

  /** Show or hide what stands behind "more". */
  #offerMore(is) {
    $("main").classList.toggle("more", is);
    $("#more").setAttribute("aria-expanded", is);
  }

  /** Say that the address names a door that the page does not have. */
  refuse() {
    const { noDoor } = this.state;
    if (noDoor !== null) announce(() => say("noDoor", { door: noDoor.slice(0, LONGEST) }));
  }

  /** Show what belongs to the door. */
  show() {
    const { door } = this;
    const main = $("main");
    // In the village the verdict comes first; the order is that of reading and of the Tab key.
    const order = door === "village" || door === "all" ? ["#answers", "#controls"] : ["#controls", "#answers"];
    if (main.dataset.door !== door) {
      $("#front").append(...order.map($));
      // The square by its size comes first in the village, and among the numbers of the whole page.
      if (door === "village") $("#dance").after($("#place"));
      else $("#route").prepend($("#place"));
    }
    main.dataset.door = door;
    main.classList.toggle("compact", door !== "all");
    for (const button of $$("[data-door]:is(button)")) button.setAttribute("aria-pressed", button.dataset.door === door);
    this.#offerMore(false);
    setExact(door === "all");
  }
}
