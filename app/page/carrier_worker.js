/**
 * The card of a carrier without a network: this worker answers from what kept.js has put on the device, and only where the
 * network does not. It keeps nothing by itself.
 */

/** @type {any} */
const worker = self;
/** Beginning of the names under which kept.js keeps. */
const KEPT = "bench-dragon-carrier";
/** Longest wait for the page itself on a weak network [ms]. */
const PATIENCE = 4_000;
/** Answers of a proxy whose service is gone. */
const GATEWAY_ERRORS = [502, 504];
const HEX = 16;

/** Where the answer to a request is kept: a question with a body stands under its digest. */
async function placeOf(request, body) {
  const url = new URL(request.url);
  if (request.mode === "navigate") return worker.registration.scope;
  if (request.method === "GET") return url.href;
  const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(`${url.href} ${body}`));
  return new URL(`kept-${[...new Uint8Array(digest)].map((one) => one.toString(HEX).padStart(2, "0")).join("")}`, worker.registration.scope).href;
}

/** What is kept for a request, or undefined. */
async function keptFor(request, body) {
  const place = await placeOf(request, body);
  for (const name of (await caches.keys()).filter((one) => one.startsWith(KEPT))) {
    const answer = await (await caches.open(name)).match(place, { ignoreVary: true });
    if (answer) return answer;
  }
  return undefined;
}

async function answer(request) {
  const copy = request.clone();
  const kept = async () => keptFor(copy, copy.method === "GET" ? "" : await copy.text());
  const signal = request.mode === "navigate" ? AbortSignal.timeout(PATIENCE) : undefined;
  try {
    const response = await fetch(request, signal && { signal });
    return GATEWAY_ERRORS.includes(response.status) ? ((await kept()) ?? response) : response;
  } catch (error) {
    const response = await kept();
    if (response) return response;
    throw error;
  }
}

worker.addEventListener("install", () => worker.skipWaiting());
worker.addEventListener("activate", (event) => event.waitUntil(worker.clients.claim()));
worker.addEventListener("fetch", (event) => {
  const { request } = event;
  const url = new URL(request.url);
  const isCard = request.mode !== "navigate" || (url.href.startsWith(worker.registration.scope) && url.pathname === new URL(worker.registration.scope).pathname && ["bench", "z"].some((name) => url.searchParams.has(name)));
  const type = request.headers.get("Content-Type") ?? "application/json";
  const isAnswered = ["GET", "POST"].includes(request.method) && type === "application/json" && !request.headers.get("Accept")?.includes("event-stream");
  // Whether the service is alive is asked of the service alone.
  if (url.origin === worker.location.origin && isCard && isAnswered && !url.pathname.endsWith("/healthz")) event.respondWith(answer(request));
});
