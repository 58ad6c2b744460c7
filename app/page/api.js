/** The service: only the newest question of a kind gets an answer, and a lost service is tried until it is back. */

import { pending } from "./pending.js";
import { language, say } from "./text.js";

/**
 * A superseded question may still answer for this long [ms], or for twice the time of the last one, up to a maximum: so
 * a dragged slider also gets answers from a busy service.
 */
const [GRACE, GRACE_MOST] = [150, 2_000];
/** Time between two liveness checks of the service, and longest wait for an answer [ms]; what a person does meanwhile notices a lost one at once. */
const [HEARTBEAT, PATIENCE] = [5_000, 1_600];
const [RETRY_FIRST, RETRY_LAST] = [1_000, 8_000];
const SECOND = 1_000;
/** Methods that may be repeated without harm; a hanging job is not started again. */
const ONCE = ["sweeps", "films"];
const GATEWAY_ERRORS = [502, 504];
const EMPTY = 204;
/** Refusals that a retry may solve, and the longest wait for a retry [s]. */
const BUSY = [429, 503];
const MOMENT = 10;

/** The type of a problem of what takes too long for one answer: a job may take longer. */
export const TOO_LONG = "urn:problem-type:bench-dragon:too-much-work";

/** The command that asks the service from a terminal. body: null for none */
export function commandFor(path, body = null) {
  const sent = body ? ` -H 'Content-Type: application/json' -d '${JSON.stringify(body).replaceAll("'", "'\\''")}'` : "";
  return `curl '${new URL(path, location.href).href}'${sent}`;
}

/** A refused request. problem: the service's problem, whose sentence is in this language; errors: of it */
export class Problem extends Error {
  constructor(status, body) {
    // A proxy before the service may answer in its own words, or without any.
    const sentence = body?.sentence ?? body?.detail ?? say("The service answered with HTTP {status} and gave no reason.", { status });
    super(sentence);
    this.problem = { ...body, sentence, language: language() };
    // That the time did not suffice is no fault of a number.
    this.errors = body?.type === TOO_LONG ? [] : (body?.errors ?? []);
  }
}

/** A newer question of the same kind replaced this one. */
export class Superseded extends Error {}

/** Wait that the service asks for [s]. */
const pauseOf = (response) => Number(response.headers.get("Retry-After")) || 1;

const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

/** One kind of question: at most one is in progress, and the newest one waits. */
class Channel {
  #newest = null;
  #running = null;
  #grace = GRACE;

  async ask(question) {
    this.#newest = question;
    while (this.#running) {
      const { since, abort, settled } = this.#running;
      setTimeout(() => abort.abort(), since + this.#grace - performance.now());
      await settled;
      if (question !== this.#newest) throw new Superseded();
    }
    const abort = new AbortController();
    const answer = question(abort.signal);
    const since = performance.now();
    this.#running = { since, abort, settled: Promise.allSettled([answer]) };
    try {
      return await answer;
    } catch (error) {
      // A late refusal would be about numbers that are gone.
      throw abort.signal.aborted || question !== this.#newest ? new Superseded() : error;
    } finally {
      this.#running = null;
      this.#grace = Math.min(Math.max(GRACE, 2 * (performance.now() - since)), GRACE_MOST);
    }
  }

  /** Cancel the question, because nobody needs the answer any more. */
  drop() {
    this.#newest = null;
    this.#running?.abort.abort();
  }
}

export class Service {
  #channels = new Map();
  /** channel -> {url, options} of its last question that was answered */
  asked = new Map();
  #return = null;
  /** The check of the service that is in progress. @type {Promise<boolean> | null} */
  #health = null;
  #retryNow = () => {};
  /** End the requests to a service that does not answer any more. */
  #hanging = new AbortController();

  /**
   * tell: {lost(seconds until the next try, 0 during one), back(), busy(channel, whether it is busy)}
   */
  constructor(tell) {
    this.tell = tell;
    this.#beat();
  }

  /**
   * The newest answer on a channel; null for an empty one. body: sent as JSON; file: sent as it is; how: method, cache.
   * throws: Problem, Superseded
   */
  async ask(channel, path, /** @type {Question} */ { query, body, file, accept = "application/json", headers: more, ...how } = {}) {
    if (!this.#channels.has(channel)) this.#channels.set(channel, new Channel());
    const url = query ? `${path}?${new URLSearchParams(query)}` : path;
    const type = file ? "application/octet-stream" : body && "application/json";
    const headers = { Accept: accept, ...(type && { "Content-Type": type }), ...more };
    const options = { method: type ? "POST" : "GET", headers, body: file ?? (body && JSON.stringify(body)), ...how };
    const request = Symbol(channel);
    pending(request, true);
    this.tell.busy(channel, true);
    try {
      const answer = await this.#channels.get(channel).ask((signal) => this.#patiently(url, options, signal));
      this.tell.busy(channel, false);
      if (!file) this.asked.set(channel, { url, options });
      return answer;
    } catch (error) {
      if (!(error instanceof Superseded)) this.tell.busy(channel, false);
      throw error;
    } finally {
      pending(request, false);
    }
  }

  /** What a stream of server-sent events tells, one after another, until it ends or is lost. */
  async *events(path, signal) {
    const response = await this.#fetch(path, { headers: { Accept: "text/event-stream" }, cache: "no-store", signal });
    const reader = response?.ok && response.body.pipeThrough(new TextDecoderStream()).getReader();
    for (let text = ""; reader; ) {
      const { done, value } = await reader.read().catch(() => ({ done: true, value: "" }));
      if (done) return;
      const blocks = (text + value).split("\n\n");
      text = blocks.pop();
      for (const block of blocks) for (const line of block.split("\n")) if (line.startsWith("data: ")) yield JSON.parse(line.slice(6));
    }
  }

  /** End the questions on these channels. */
  drop(channels) {
    for (const channel of channels) {
      this.asked.delete(channel);
      this.#channels.get(channel)?.drop();
      this.tell.busy(channel, false);
    }
  }

  /** Try again now. */
  retry() {
    this.#retryNow();
  }

  /** Ask until there is an answer, also while the service is lost or busy. */
  async #patiently(url, options, signal) {
    for (;;) {
      const wanted = ONCE.includes(url) ? signal : AbortSignal.any([signal, this.#hanging.signal]);
      const response = await this.#fetch(url, { ...options, signal: wanted }, signal);
      if (response?.status === EMPTY) return null;
      const body = response?.ok && (await this.#read(response, options.headers.Accept.includes("json")));
      if (body) return body.content;
      // A body that was cut off because nobody needs it is no sign of a lost service.
      signal.throwIfAborted();
      if (!response || response.ok) await this.#untilBack();
      else if (BUSY.includes(response.status) && pauseOf(response) <= MOMENT) await wait(1000 * pauseOf(response));
      else throw new Problem(response.status, await response.json().catch(() => null));
      signal.throwIfAborted();
    }
  }

  /** The response; null if the service cannot be reached. cancel: signal of the caller, which may end the question */
  async #fetch(url, options, cancel = null) {
    try {
      const language = { "Accept-Language": document.documentElement.lang };
      const response = await fetch(url, { ...options, headers: { ...language, ...options.headers } });
      return GATEWAY_ERRORS.includes(response.status) ? null : response;
    } catch {
      cancel?.throwIfAborted();
      return null;
    }
  }

  /** {content} of a response; null if the connection ended within it. */
  async #read(response, isJson) {
    try {
      return { content: await (isJson ? response.json() : response.blob()) };
    } catch (error) {
      if (error instanceof SyntaxError) throw error;
      return null;
    }
  }

  #untilBack() {
    this.#return ??= this.#knock().finally(() => (this.#return = null));
    return this.#return;
  }

  async #knock() {
    this.#hanging.abort();
    this.#hanging = new AbortController();
    for (let pause = RETRY_FIRST; ; pause = Math.min(2 * pause, RETRY_LAST)) {
      await this.#countDown(pause);
      this.tell.lost(0);
      if (await this.#alive()) break;
    }
    this.tell.back();
  }

  /** Wait, and report the remaining time every second; ends early when a person wants to try now. */
  async #countDown(pause) {
    const now = new Promise((resolve) => (this.#retryNow = () => resolve(true)));
    for (let left = pause; left > 0; left -= SECOND) {
      this.tell.lost(left / SECOND);
      if (await Promise.race([wait(SECOND), now])) return;
    }
  }

  /** Whether the service is alive; whoever asks meanwhile waits for the same answer. */
  #alive() {
    this.#health ??= this.#fetch("healthz", { cache: "no-store", signal: AbortSignal.timeout(PATIENCE) })
      .then((response) => Boolean(response?.ok))
      .finally(() => (this.#health = null));
    return this.#health;
  }

  /** Check regularly whether the service is alive, while the page is visible. */
  async #beat() {
    for (;;) {
      await wait(HEARTBEAT);
      if (document.hidden || this.#return) continue;
      if (!(await this.#alive())) await this.#untilBack();
    }
  }
}
