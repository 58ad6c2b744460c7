/** The doors of the page: what a person came for decides which numbers, answers and sections stand there. */

import { EMPTY } from "./drawing.js";
import { $, $$, onClick } from "./elements.js";
import { setExact } from "./numbers.js";
import { announce } from "./overlays.js";
import { say } from "./text.js";

/** The kinds of path behind a door, of which the first one opens; behind `all` is the whole page, as behind an old address. */
const PATHS = { contest: ["spiral", "turn"], village: ["route"], look: ["spiral", "turn"] };

/** Longest part of an address in a message [characters]. */
const LONGEST = 40;

export class Doors {
  #pressed = "";
  /** Numbers and answers stand side by side. */
  wide = matchMedia("(min-width: 760px)");

  /**
   * @param {State} state
   * @param {Parts} parts
   */
  constructor(state, parts) {
    this.state = state;
    this.parts = parts;
    for (const button of $$("[data-door]")) button.addEventListener("click", () => this.#enter(button.dataset.door));
    this.wide.addEventListener("change", () => this.#arrange(this.door));
    onClick("#more", () => this.#offerMore(!$("main").classList.contains("more")));
  }

  get door() {
    return this.state.get("door") ?? "all";
  }

  /** change(changes): of the state */
  async #enter(door, change = (changes) => this.state.push(changes)) {
    this.#pressed = door;
    const [path] = PATHS[door] ?? [];
    const stays = !path || PATHS[door].includes(this.state.get("path"));
    const begins = door === "village" && this.state.get("drawing") === EMPTY;
    const example = begins && (await this.parts.load("drawn")).village();
    if (this.#pressed !== door) return; // Another door was pressed meanwhile.
    change({ ...(stays ? {} : this.state.changesOf(path)), door, ...example });
  }

  /** An address of the village with no dance of its own opens with the example, as if the door were pressed. */
  begin() {
    if (this.door === "village" && !new URLSearchParams(location.search).has("path")) this.#enter("village", (changes) => this.state.set(changes));
  }

  /** Show or hide what stands behind "more". */
  #offerMore(is) {
    $("main").classList.toggle("more", is);
    $("#more").setAttribute("aria-expanded", is);
  }

  /** Say that the address names a door that the page does not have, or something else that it does not know. */
  refuse() {
    const { noDoor, strange, unread } = this.state;
    const [first] = [...unread, ...strange];
    if (noDoor !== null) announce(() => say("The page has no door “{door}”: here is everything.", { door: noDoor.slice(0, LONGEST) }));
    else if (first) announce(() => say("This page does not know “{text}” in the address: here is the rest.", { text: first.join("=").slice(0, LONGEST) }));
  }

  /** Show what belongs to the door. */
  show() {
    const { door } = this;
    const main = $("main");
    this.#arrange(door);
    main.dataset.door = door;
    main.classList.toggle("compact", door !== "all");
    for (const button of $$("[data-door]:is(button)")) button.setAttribute("aria-pressed", button.dataset.door === door);
    this.#offerMore(false);
    setExact(door === "all");
  }

  /** Put numbers and answers into the order in which they stand. */
  #arrange(door) {
    // The order is that of reading and of the Tab key: in the village the verdict comes first, and so it does where all is one column.
    const verdictFirst = door === "village" || (door === "all" && !this.wide.matches);
    const order = verdictFirst ? ["#answers", "#controls"] : ["#controls", "#answers"];
    if ($("main").dataset.door !== door || $(order[0]).compareDocumentPosition($(order[1])) & Node.DOCUMENT_POSITION_PRECEDING) {
      $("#front").append(...order.map($));
      // The square by its size comes first in the village, and among the numbers of the whole page.
      if (door === "village") $("#dance").after($("#place"));
      else $("#route").prepend($("#place"));
    }
    // In the village how far people may stray is with the people, whom a phone has beside their numbers.
    const people = $("#people");
    if (door === "village") $("#people-title").after($("#tolerance"));
    else $("#head-speed").after($("#tolerance"));
    if (door === "village" && !this.wide.matches) $("#controls").before(people);
    else $("#charts").after(people);
  }
}
