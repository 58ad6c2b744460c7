/** Undo and redo of the drawing. Each step is an entry of the browser's history too, so that its back button works. */


/** Changes of the same kind within this time [ms] are one step, such as arrow keys or digits of a number. */
const TOGETHER = 1_000;

export class Steps {
  #past = [];
  #future = [];
  #last = { kind: null, at: 0 };

  /**
   * changed(): called when undo or redo becomes possible or impossible
   * @param {State} state
   */
  constructor(state, changed) {
    this.state = state;
    this.changed = changed;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  /** Replace the drawing. before: the drawing for undo, if a drag has already changed it in steps */
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
