/** Parts of the page that load when a person first needs them. */

import { $, make } from "./elements.js";
import { announce } from "./overlays.js";
import { pending } from "./pending.js";
import { language, learn, say } from "./text.js";

/** Distance from the view at which a part loads: small until a person scrolls, because answers that come push it down. */
const [IN_VIEW, A_SCREEN] = ["0px", "100%"];
/** Parts with a sheet of style: the name of its file. */
const STYLES = { below: "below.css", carrier: "carrier.css", dragons: "dragons.css", drawn: "place.css", strip: "strip.css" };

/** Add a sheet of style to the page, and wait for it; without it the part works too. */
const addStyle = (file) =>
  new Promise((onload) => document.head.append(make("link", { rel: "stylesheet", href: new URL(`./${file}`, import.meta.url).href, onload, onerror: onload })));

export class Parts {
  #parts = new Map();

  /** @param {Service} service */
  constructor(service) {
    this.service = service;
  }

  /** The module of this name; while the service is lost it waits, as every question does. */
  load(name) {
    if (!this.#parts.has(name)) this.#parts.set(name, this.#fetch(name));
    return this.#parts.get(name);
  }

  async #fetch(name) {
    const what = Symbol(`part ${name}`);
    pending(what, true);
    const url = new URL(`./${name}.js`, import.meta.url).href;
    try {
      // A browser may never repeat an import that has failed, so the file comes first; the import takes it from the cache.
      await this.service.ask(`part ${name}`, url, { accept: "text/javascript" });
      const [module] = await Promise.all([import(url), name in STYLES && addStyle(STYLES[name]), learn(this.service, language(), "more")]);
      return module;
    } catch (error) {
      // The service was lost in between.
      console.warn(error);
      announce(() => say("A part of the page did not load. Load the page again: its address keeps everything."), true);
      return await new Promise(() => {});
    } finally {
      pending(what, false);
    }
  }
}

/** By its type: a function that repeats an event, if it would be lost without the part. */
const AGAIN = {
  click: ({ target }) => target.closest("button") && (() => target.closest("button").click()),
  change: ({ target }) => () => target.dispatchEvent(new Event("change", { bubbles: true })),
  submit: ({ target }) => () => target.requestSubmit(),
  dragover: () => () => {},
  drop({ target, dataTransfer: { files } }) {
    const dataTransfer = new DataTransfer();
    for (const file of files) dataTransfer.items.add(file);
    return () => target.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  },
};
/** Events after which a part is needed: those of files alone, or all. */
export const OF_FILES = ["dragenter", "dragover", "drop"];
const ALL = ["focusin", "dragenter", ...Object.keys(AGAIN)];

/**
 * Call load() at the first of these events in one of the boxes; of all events, also when a box comes near the view. What a
 * person does there until it has loaded is done then, the last of several.
 * load(): Promise, resolved when the part is at work
 */
export function whenReached(selectors, load, types = ALL) {
  const boxes = selectors.map($);
  const listening = new AbortController();
  let [wanted, watch] = [null, null];
  function watchFrom(rootMargin) {
    watch?.disconnect();
    watch = new IntersectionObserver((seen) => seen.some((one) => one.isIntersecting) && begin(), { rootMargin });
    for (const box of boxes) watch.observe(box);
  }
  async function begin() {
    watch?.disconnect();
    await load();
    listening.abort();
    wanted?.();
    wanted = null;
  }
  const hold = (event) => {
    const again = AGAIN[event.type]?.(event);
    if (again) {
      event.preventDefault();
      event.stopPropagation();
      wanted = again;
    }
    begin();
  };
  for (const box of boxes) for (const type of types) box.addEventListener(type, hold, { capture: true, signal: listening.signal });
  if (types !== ALL) return;
  watchFrom(IN_VIEW);
  addEventListener("scroll", () => watchFrom(A_SCREEN), { once: true, signal: listening.signal });
}
