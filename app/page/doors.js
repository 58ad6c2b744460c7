/** The doors of the page: what a person came for decides which numbers, answers and sections stand there. */

import { EMPTY } from "./drawing.js";
import { $, $$, onClick } from "./elements.js";
import { setExact } from "./numbers.js";
import { announce } from "./overlays.js";
import { PRESETS } from "./presets.js";
import { say } from "./text.js";

/** The kinds of path behind a door, of which the first one opens; behind `all` is the whole page, as behind an old address. */
const PATHS = { contest: ["spiral", "turn"], village: ["route"], look: ["spiral", "turn"] };

/** Longest name of an unknown door in a message [characters]. */
const LONGEST = 40;

/** A first dance for a village, with its things named in the language of the page. */
const village = () => ({ ...PRESETS.village, things: PRESETS.village.things.map((thing) => ({ ...thing, name: say(`placed_${thing.name}`) })) });

export class Doors {
  /** @param {State} state */
  constructor(state) {
    this.state = state;
    for (const button of $$("[data-door]")) button.addEventListener("click", () => this.#enter(button.dataset.door));
    onClick("#more", () => this.#offerMore(!$("main").classList.contains("more")));
  }

  get door() {
    return this.state.get("door") ?? "all";
  }

  #enter(door) {
    const [path] = PATHS[door] ?? [];
    const stays = !path || PATHS[door].includes(this.state.get("path"));
    const begins = door === "village" && this.state.get("drawing") === EMPTY;
    this.state.choosePath(stays ? this.state.get("path") : path, { door, ...(begins && { drawing: village() }) });
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
