/** Undo and redo of the drawing. Each step is an entry of the browser's history too, so that its back button works. */

/** Changes of the same kind within this time [ms] are one step: arrow keys, a number that is typed. */
const TOGETHER = 1_000;

export class Steps {
  #past = [];
  #future = [];
  #last = { kind: null, at: 0 };

  /** changed(): called when there is something to undo or redo, or no longer */
  constructor(state, changed) {
    Object.assign(this, { state, changed });
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  /** Replace the drawing. before: what undo brings back, where the drawing has already changed in steps of a drag */
  take(drawing, kind = null, before = this.state.get("drawing")) {
    if (drawing === before) return;
    const now = performance.now();
    const together = kind !== null && kind === this.#last.kind && now - this.#last.at < TOGETHER;
    this.#last = { kind, at: now };
    if (!together) this.#past.push(before);
    this.#future = [];
    this.#show(drawing, together);
  }

  undo() {
    if (this.canUndo) this.#swap(this.#past, this.#future);
  }

  redo() {
    if (this.canRedo) this.#swap(this.#future, this.#past);
  }

  #swap(from, to) {
    to.push(this.state.get("drawing"));
    this.#last.kind = null;
    this.#show(from.pop(), false);
  }

  #show(drawing, together) {
    this.state.set({ drawing });
    if (together) this.state.write();
    else this.state.push();
    this.changed();
  }
}
