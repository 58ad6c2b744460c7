/** Work in progress, named in <html data-pending>, so that a program such as a test sees when the page is at rest. */

const begun = new Set();

/** what: a symbol, whose description names the work; is: true when it begins, false when it ends */
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
