/** The service: only the newest question of a kind is answered, and a lost service is retried until it is back. */

/** Superseded questions this young [ms] may still answer, so that a dragged slider always sees answers. */
const GRACE = 150;
const HEARTBEAT = 5_000;
const [RETRY_FIRST, RETRY_LAST] = [500, 8_000];
const GATEWAY_ERRORS = [502, 504];
const EMPTY = 204;
/** Refusals that a moment mends, and the longest moment for which a person is kept waiting [s]. */
const BUSY = [429, 503];
const MOMENT = 10;

/** The service's message about a refused request; errors: [{name or pointer, detail}]. */
export class Problem extends Error {
  constructor(status, body) {
    super(body?.detail ?? `HTTP ${status}`);
    this.errors = body?.errors ?? [];
  }
}

/** A newer question of the same kind replaced this one. */
export class Superseded extends Error {}

/** How long the service asks to wait [s]. */
const pauseOf = (response) => Number(response.headers.get("Retry-After")) || 1;

const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** One kind of question: at most one is in progress, and the newest one waits. */
class Channel {
  #newest = null;
  #running = null;

  async ask(question) {
    this.#newest = question;
    while (this.#running) {
      const { since, abort, settled } = this.#running;
      setTimeout(() => abort.abort(), since + GRACE - performance.now());
      await settled;
      if (question !== this.#newest) throw new Superseded();
    }
    const abort = new AbortController();
    const answer = question(abort.signal);
    this.#running = { since: performance.now(), abort, settled: Promise.allSettled([answer]) };
    try {
      return await answer;
    } catch (error) {
      throw abort.signal.aborted ? new Superseded() : error;
    } finally {
      this.#running = null;
    }
  }
}

export class Service {
  #channels = new Map();
  #return = null;
  #retryNow = () => {};

  /** tell: {lost(seconds until the next try), back(), busy(channel, whether it is busy)} */
  constructor(tell) {
    this.tell = tell;
    setInterval(() => document.hidden || this.#return || this.#beat(), HEARTBEAT);
  }

  /** The newest answer on a channel; null for an empty one. body: sent as JSON; file: sent as it is; how: method, cache.
   throws: Problem, Superseded */
  async ask(channel, path, { query, body, file, accept = "application/json", headers: more, ...how } = {}) {
    if (!this.#channels.has(channel)) this.#channels.set(channel, new Channel());
    const url = query ? `${path}?${new URLSearchParams(query)}` : path;
    const type = file ? "application/octet-stream" : body && "application/json";
    const headers = { Accept: accept, ...(type && { "Content-Type": type }), ...more };
    const options = { method: type ? "POST" : "GET", headers, body: file ?? (body && JSON.stringify(body)), ...how };
    this.tell.busy(channel, true);
    try {
      const answer = await this.#channels.get(channel).ask((signal) => this.#patiently(url, options, signal));
      this.tell.busy(channel, false);
      return answer;
    } catch (error) {
      if (!(error instanceof Superseded)) this.tell.busy(channel, false);
      throw error;
    }
  }

  /** Try again now. */
  retry() {
    this.#retryNow();
  }

  /** Asks until there is an answer, also while the service is lost or busy. */
  async #patiently(url, options, signal) {
    for (;;) {
      const response = await this.#fetch(url, { ...options, signal });
      if (response?.status === EMPTY) return null;
      if (response?.ok) return options.headers.Accept.includes("json") ? response.json() : response.blob();
      if (!response) await this.#untilBack();
      else if (BUSY.includes(response.status) && pauseOf(response) <= MOMENT) await wait(1000 * pauseOf(response));
      else throw new Problem(response.status, await response.json().catch(() => null));
      signal.throwIfAborted();
    }
  }

  /** The response; null when the service cannot be reached. */
  async #fetch(url, options) {
    try {
      const response = await fetch(url, options);
      return GATEWAY_ERRORS.includes(response.status) ? null : response;
    } catch {
      options.signal?.throwIfAborted();
      return null;
    }
  }

  #untilBack() {
    this.#return ??= this.#knock().finally(() => (this.#return = null));
    return this.#return;
  }

  async #knock() {
    for (let pause = RETRY_FIRST; ; pause = Math.min(2 * pause, RETRY_LAST)) {
      this.tell.lost(pause / 1000);
      await Promise.race([wait(pause), new Promise((resolve) => (this.#retryNow = resolve))]);
      if (await this.#alive()) break;
    }
    this.tell.back();
  }

  async #alive() {
    return Boolean((await this.#fetch("healthz", { cache: "no-store" }))?.ok);
  }

  async #beat() {
    if (!(await this.#alive())) await this.#untilBack();
  }
}
