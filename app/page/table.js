/** Handles at one instant; only the visible rows exist, as there may be thousands. */

import { make } from "./elements.js";
import { handleName, say } from "./text.js";

const ROW = 30;
const SPARE = 6;
const DECIMALS = 6;
const KEYS = { ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10 };

export class Table {
  #pose = null;
  #handle = null;
  #first = 0;
  #rows = [];
  #count = 0;
  #queued = false;
  /** What is in sight of it, kept because reading it during a change costs a layout of the whole page: its scroll and its height [px]. */
  #sight = [0, 0];

  /** choose(step): called to choose a row some steps further; chosen(handle): called to choose a row */
  constructor(box, { choose, chosen }) {
    this.box = box;
    this.body = box.querySelector("tbody");
    this.table = box.querySelector("table");
    const look = () => {
      this.#sight = [box.scrollTop, box.clientHeight];
      this.#queue();
    };
    box.addEventListener("scroll", look);
    box.addEventListener("keydown", (event) => {
      if (!(event.key in KEYS)) return;
      event.preventDefault();
      choose(KEYS[event.key]);
    });
    this.body.addEventListener("click", (event) => {
      const row = event.target.closest("tr[data-handle]");
      if (row) chosen(Number(row.dataset.handle));
    });
    new ResizeObserver(look).observe(box);
    look();
  }

  show(pose) {
    const first = !this.#pose;
    this.#pose = pose;
    if (first) this.#render();
    if (first) this.#reveal();
    this.#queue();
  }

  select(handle) {
    if (handle === this.#handle) return;
    this.#handle = handle;
    this.#reveal();
    this.#queue();
  }

  #reveal() {
    if (this.#handle === null) return;
    const [top, sight] = [this.#handle * ROW, this.box.clientHeight - 2 * ROW];
    if (top < this.box.scrollTop || top > this.box.scrollTop + sight) this.box.scrollTop = top - sight / 2;
  }

  #queue() {
    if (!this.#queued) requestAnimationFrame(() => this.#render());
    this.#queued = true;
  }

  #render() {
    this.#queued = false;
    if (!this.#pose) return;
    const { x, y, speed } = this.#pose;
    const [top, high] = this.#sight;
    const first = Math.max(0, Math.floor(top / ROW) - SPARE);
    const last = Math.min(x.length, first + Math.ceil(high / ROW) + 2 * SPARE);
    // Rows stay while the same handles are visible, because a row that is replaced under the mouse gets no click.
    if (first !== this.#first || last - first !== this.#rows.length || x.length !== this.#count) {
      [this.#first, this.#count] = [first, x.length];
      this.#rows = Array.from({ length: last - first }, (_, row) => rowOf(first + row));
      this.body.replaceChildren(spacer(first), ...this.#rows, spacer(x.length - last));
      this.table.setAttribute("aria-rowcount", x.length + 1);
    }
    for (const [row, line] of this.#rows.entries()) {
      const k = first + row;
      const numbers = [x[k], y[k], speed[k]].map((one) => one.toFixed(DECIMALS).replace(/^-(0\.0+)$/, "$1"));
      const texts = [say("{k} · {name}", { k, name: handleName(k, x.length - 1) }), ...numbers];
      texts.forEach((text, cell) => (line.cells[cell].textContent = text));
      line.cells[0].title = texts[0];
      line.className = k === this.#handle ? "chosen" : "";
    }
  }
}

function rowOf(k) {
  const cells = Array.from({ length: 3 }, () => make("td"));
  return make("tr", { "data-handle": k, "aria-rowindex": k + 2 }, make("th", { scope: "row" }), ...cells);
}

function spacer(rows) {
  const row = make("tr", { "aria-hidden": "true", hidden: rows <= 0 }, make("td", { colSpan: 4, className: "spacer" }));
  row.firstChild.style.height = `${rows * ROW}px`;
  return row;
}
