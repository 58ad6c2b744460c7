/** The menu of a place on the picture: by the right button, a long press, or the key for menus. */

import { ALIGNS } from "./beside.js";
import { button, make } from "./elements.js";
import { phrase, say } from "./text.js";

/** Time after which a press that stays in its place is a long one [ms], and how far it may move [px]. */
const [LONG, TRAVEL] = [550, 6];
const WAYS = { ArrowDown: 1, ArrowUp: -1 };

export class Menu {
  #press = 0;
  /** Closes it. */
  leave = () => {};

  /**
   * stage: the box of the picture
   * @param {any} stage
   * @param {Editor} editor
   */
  constructor(stage, editor) {
    this.editor = editor;
    this.box = make("div", { id: "menu", popover: "manual", role: "menu" });
    this.box.addEventListener("keydown", (event) => this.#move(event));
    // The finger that opened it is lifted outside of it, which would end one that the browser ends by itself. A press
    // on the picture that ends it does nothing else.
    const close = (event) => {
      if (!(event.target instanceof Node) || this.box.contains(event.target) || !this.box.matches(":popover-open")) return;
      this.box.hidePopover();
      if (stage.contains(event.target)) event.stopImmediatePropagation();
    };
    addEventListener("pointerdown", close, { capture: true });
    stage.parentElement.append(this.box);
    stage.addEventListener("contextmenu", (event) => {
      if (!editor.canEdit) return;
      event.preventDefault();
      this.#ask(event);
    });
    stage.addEventListener("pointerdown", (event) => this.#wait(event), { capture: true });
    for (const type of ["pointermove", "pointerup", "pointercancel"]) stage.addEventListener(type, (event) => this.#end(event), { capture: true });
  }

  /** A finger that stays in its place opens the menu. */
  #wait(event) {
    clearTimeout(this.#press);
    if (event.pointerType !== "touch" || !event.isPrimary || !this.editor.canEdit) return;
    this.from = [event.clientX, event.clientY];
    this.#press = setTimeout(() => this.#ask(event), LONG);
  }

  /** Open the menu, unless it is open, or what was pressed is being dragged. */
  #ask({ clientX, clientY, button, pointerType, target }) {
    if (this.editor.isDragging || this.box.matches(":popover-open")) return;
    // A key opens it for what is chosen, a hand for what is under it.
    const isKey = button !== 2 && pointerType !== "touch" && target === this.editor.dance.canvas && this.editor.items.length > 0;
    if (!isKey) this.editor.reach(clientX, clientY);
    this.open(clientX, clientY);
  }

  #end({ type, clientX, clientY }) {
    if (this.from && (type !== "pointermove" || Math.hypot(clientX - this.from[0], clientY - this.from[1]) > TRAVEL)) clearTimeout(this.#press);
  }

  /** Open the menu of what is chosen at a place of the window [px]. */
  open(x, y) {
    const { editor } = this;
    const { items, held, canPaste, steps } = editor;
    const isAny = items.length > 0;
    const point = held === null ? null : held + 1;
    const lines = [
      [phrase("Copy"), () => editor.copy(), isAny],
      [phrase("Duplicate"), () => editor.duplicate(), isAny],
      [phrase("Paste here"), () => editor.pasteAt(x, y), canPaste],
      ...Object.entries(ALIGNS).map(([how, words]) => [words, () => editor.align(how), items.length > 1]),
      [phrase("Insert a point"), () => editor.divide(point - 1), point !== null],
      [phrase("Delete point {k}"), () => editor.removePoint(point - 1), point !== null],
      [phrase("Delete"), () => editor.remove(), isAny],
      [phrase("Choose several"), () => editor.take("several"), !isAny && point === null],
      [phrase("Undo"), () => steps.undo(), steps.canUndo],
    ];
    const before = document.activeElement;
    // Keys go on where they were.
    this.leave = () => {
      this.box.hidePopover();
      if (before instanceof HTMLElement) before.focus({ preventScroll: true });
    };
    const act = (does) => () => {
      this.leave();
      does();
    };
    const buttons = lines.filter(([, , isThere]) => isThere).map(([words, does]) => button({ role: "menuitem", textContent: say(words, { k: point }) }, act(does)));
    this.box.setAttribute("aria-label", isAny ? editor.names : say("The dance"));
    this.box.replaceChildren(...buttons);
    this.box.showPopover();
    const { offsetWidth: wide, offsetHeight: high } = this.box;
    Object.assign(this.box.style, { left: `${Math.max(Math.min(x, innerWidth - wide), 0)}px`, top: `${Math.max(Math.min(y, innerHeight - high), 0)}px` });
    buttons[0]?.focus();
  }

  #move(event) {
    if (event.key === "Escape" || event.key === "Tab") {
      this.leave();
      event.stopPropagation();
      event.preventDefault();
    }
    const way = WAYS[event.key];
    if (!way) return;
    event.preventDefault();
    const buttons = [...this.box.children];
    const k = buttons.indexOf(document.activeElement);
    /** @type {HTMLElement} */ (buttons[(k + way + buttons.length) % buttons.length]).focus();
  }
}
