/** The service: the newest question of a kind wins, and a lost service is asked again until it is back. */

/** Superseded questions this young [ms] may still answer, so that a dragged slider always sees answers. */
const GRACE = 150;
const HEARTBEAT = 5_000;
const [RETRY_FIRST, RETRY_LAST] = [500, 8_000];
const GATEWAY_ERRORS = [502, 504];
const BUSY = 503;

/** The service's own words on a request that it refuses; errors: [{name or pointer, detail}]. */
export class Problem extends Error {
  constructor(status, body) {
    super(body?.detail ?? `HTTP ${status}`);
    this.status = status;
    this.errors = body?.errors ?? [];
  }
}

/** A newer question of the same kind took this one's place. */
export class Superseded extends Error {}

const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** One kind of question: at most one is being asked and one waits, the newest. */
class Channel {
  #running = null;
  #next = null;

  ask(question) {
    return new Promise((resolve, reject) => {
      this.#next?.reject(new Superseded());
      this.#next = { question, resolve, reject };
      if (!this.#running) return this.#start();
      const age = performance.now() - this.#running.since;
      const { abort } = this.#running;
      setTimeout(() => abort.abort(), Math.max(0, GRACE - age));
    });
  }

  cancel() {
    this.#next?.reject(new Superseded());
    this.#next = null;
    this.#running?.abort.abort();
  }

  async #start() {
    const { question, resolve, reject } = this.#next;
    this.#next = null;
    const abort = new AbortController();
    this.#running = { abort, since: performance.now() };
    try {
      resolve(await question(abort.signal));
    } catch (error) {
      reject(abort.signal.aborted ? new Superseded() : error);
    } finally {
      this.#running = null;
      if (this.#next) this.#start();
    }
  }
}

/** Events: `lost` (detail: seconds until the next try), `back`, `busy` (detail: [channel, is it]). */
export class Service extends EventTarget {
  #channels = new Map();
  #return = null;
  #retryNow = () => {};

  constructor() {
    super();
    setInterval(() => document.hidden || this.#return || this.#beat(), HEARTBEAT);
  }

  /** The newest answer on a channel. throws: Problem, Superseded */
  async ask(channel, path, { query, body, accept = "application/json" } = {}) {
    if (!this.#channels.has(channel)) this.#channels.set(channel, new Channel());
    const url = query ? `${path}?${new URLSearchParams(query)}` : path;
    const headers = { Accept: accept, ...(body && { "Content-Type": "application/json" }) };
    const options = { method: body ? "POST" : "GET", headers, body: body && JSON.stringify(body) };
    this.#tell("busy", [channel, true]);
    try {
      const answer = await this.#channels.get(channel).ask((signal) => this.#patiently(url, options, signal));
      this.#tell("busy", [channel, false]);
      return answer;
    } catch (error) {
      if (!(error instanceof Superseded)) this.#tell("busy", [channel, false]);
      throw error;
    }
  }

  cancel(channel) {
    this.#channels.get(channel)?.cancel();
    this.#tell("busy", [channel, false]);
  }

  /** Do not wait for the next try. */
  retry() {
    this.#retryNow();
  }

  /** Asks until there is an answer: through a lost service and through a busy one. */
  async #patiently(url, options, signal) {
    for (;;) {
      const response = await this.#fetch(url, options, signal);
      if (response?.ok) return await (options.headers.Accept.includes("json") ? response.json() : response.blob());
      signal.throwIfAborted();
      if (!response) await this.#untilBack();
      else if (response.status === BUSY) await wait(1000 * (Number(response.headers.get("Retry-After")) || 1));
      else throw new Problem(response.status, await response.json().catch(() => null));
      signal.throwIfAborted();
    }
  }

  /** The response; null when the service is not there. */
  async #fetch(url, options, signal) {
    try {
      const response = await fetch(url, { ...options, signal });
      return GATEWAY_ERRORS.includes(response.status) ? null : response;
    } catch (error) {
      signal?.throwIfAborted();
      return null;
    }
  }

  #untilBack() {
    this.#return ??= this.#knock().finally(() => (this.#return = null));
    return this.#return;
  }

  async #knock() {
    for (let pause = RETRY_FIRST; ; pause = Math.min(2 * pause, RETRY_LAST)) {
      this.#tell("lost", pause / 1000);
      await Promise.race([wait(pause), new Promise((resolve) => (this.#retryNow = resolve))]);
      if (await this.#alive()) break;
    }
    this.#tell("back");
  }

  async #alive() {
    return Boolean((await this.#fetch("healthz", { cache: "no-store" }))?.ok);
  }

  async #beat() {
    if (!(await this.#alive())) await this.#untilBack();
  }

  #tell(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}
