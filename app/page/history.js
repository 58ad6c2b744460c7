/** Undo and redo of a whole dance: path, benches, speeds, dragons and square. Each step is an entry of the browser's history too, so that its back button works. */

import { $, hide, onClick } from "./elements.js";
import { endStepMessage } from "./overlays.js";

/** Changes of the same kind within this time [ms] are one step, such as arrow keys or digits of a number. */
const TOGETHER = 1_000;
/** Where the steps are kept while the page loads again. */
const KEPT = "bench-dragon-steps";

/** Steps of a state: each is kept as the former values of all that it changed. */
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
  take(drawing, kind = null, before = null) {
    if (drawing !== (before ?? this.state.get("drawing"))) this.change({ drawing }, kind, before && { drawing: before });
  }

  /** Change values of the state in one step. before: former values, if a drag has already changed them */
  change(changes, kind = null, before = null) {
    const now = performance.now();
    const together = kind !== null && kind === this.#last.kind && now - this.#last.at < TOGETHER;
    this.#last = { kind, at: now };
    if (!together) this.#past.push({ ...this.#present(changes), ...before });
    this.#future = [];
    if (together) {
      this.state.set(changes);
      this.state.write();
    } else if (before) {
      // The address is still that of the former values.
      this.state.set(changes);
      this.state.push();
    } else this.state.push(changes);
    this.changed();
  }

  /** Keep the steps for a reload of the page; the oldest ones go where there is no room. */
  keep() {
    for (let past = this.#past; ; past = past.slice(Math.ceil(past.length / 2))) {
      try {
        return sessionStorage.setItem(KEPT, JSON.stringify({ address: location.search, past, future: this.#future }));
      } catch {
        if (!past.length) return;
      }
    }
  }

  /** Take over the steps that were kept at this address. */
  restore() {
    try {
      const { address, past, future } = JSON.parse(sessionStorage.getItem(KEPT) ?? "{}");
      if (address === location.search) [this.#past, this.#future] = [past, future];
    } catch {
      // Without storage undo begins anew.
    }
  }

  undo() {
    if (this.canUndo) this.#swap(this.#past, this.#future);
  }

  redo() {
    if (this.canRedo) this.#swap(this.#future, this.#past);
  }

  /** The present values of these names, and the kind of path on which they are. */
  #present(names) {
    return Object.fromEntries(["path", ...Object.keys(names)].map((name) => [name, this.state.get(name)]));
  }

  /** True if these values are the present ones: the browser's back button has taken their step back. */
  #isPresent(values) {
    return JSON.stringify({ ...values, ...this.#present(values) }) === JSON.stringify(values);
  }

  #swap(from, to) {
    const values = from.pop();
    if (from.length && this.#isPresent(values)) return this.#swap(from, to);
    to.push(this.#present(values));
    this.#last.kind = null;
    this.state.push(values);
    endStepMessage();
    this.changed();
  }
}

/** @type {Steps | null} */
let ofPage = null;

/** The steps of the page, with their buttons among the tools and their keys: those of a drawing and of several dragons. */
export const stepsOf = (state) => (ofPage ??= addSteps(state));

function addSteps(state) {
  const steps = new Steps(state, () => {
    const [isRoute, isDrawing] = [state.get("path") === "route", $("#edit").getAttribute("aria-pressed") === "true"];
    const isAny = steps.canUndo || steps.canRedo;
    hide($("#tools"), !isRoute && !isAny);
    hide($("#edit"), !isRoute);
    for (const id of ["#undo", "#redo"]) hide($(id), !isDrawing && !isAny);
    $("#undo").disabled = !steps.canUndo;
    $("#redo").disabled = !steps.canRedo;
  });
  steps.restore();
  steps.changed();
  addEventListener("pagehide", () => steps.keep());
  onClick("#undo", () => steps.undo());
  onClick("#redo", () => steps.redo());
  addEventListener("popstate", endStepMessage);
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    if (event.target instanceof Element && event.target.matches("input, textarea")) return;
    const key = event.key.toLowerCase();
    if (key === "y" || (key === "z" && event.shiftKey)) steps.redo();
    else if (key === "z") steps.undo();
    else return;
    event.preventDefault();
  });
  state.listen((names) => names.has("path") && steps.changed());
  return steps;
}
