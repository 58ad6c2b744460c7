/** What the page has begun and will end by itself, named in <html data-pending>: whoever drives it by a program, as its tests do, sees when it is at rest. */

const begun = new Set();

/** what: a symbol, whose description is its name; is: has it begun, or ended? */
export function pending(what, is) {
  if (is) begun.add(what);
  else begun.delete(what);
  document.documentElement.dataset.pending = [...begun].map(({ description }) => description.replaceAll(" ", "-")).join(" ");
}

/** A pause in what a person does, after which something is done. */
export class Pause {
  #timer = 0;
  #what;

  /** name: of what is done after it */
  constructor(name) {
    this.#what = Symbol(name);
  }

  get lasts() {
    return this.#timer !== 0;
  }

  /** Begin, or begin anew. milliseconds: how long it lasts; act: called at its end */
  begin(milliseconds, act) {
    this.end();
    pending(this.#what, true);
    this.#timer = setTimeout(() => {
      this.end();
      act();
    }, milliseconds);
  }

  /** End it, so that nothing is done. */
  end() {
    clearTimeout(this.#timer);
    this.#timer = 0;
    pending(this.#what, false);
  }
}
