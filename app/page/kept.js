/** The card of a carrier on this device: the page, its files and the answers that it needs, which carrier_worker.js gives without a network. */

/** Beginning of the names under which it is kept; then come the edition of the page and the time. */
const KEPT = "bench-dragon-carrier";
const HEX = 16;
/** Where the page begins, without what its address says. */
const SCOPE = new URL(".", document.baseURI).href;
/** Edition of the files of the page. */
const [EDITION] = /page-\w+/.exec(import.meta.url) ?? ["page"];

/** Where the answer to a question is kept, as carrier_worker.js looks for it. */
async function placeOf({ url, options: { body = "" } }) {
  const { href } = new URL(url, document.baseURI);
  if (!body) return href;
  const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(`${href} ${body}`));
  return new URL(`kept-${[...new Uint8Array(digest)].map((one) => one.toString(HEX).padStart(2, "0")).join("")}`, SCOPE).href;
}

const namesOf = async () => (await caches.keys()).filter((name) => name.startsWith(KEPT));

/** True where a browser can keep a page: with HTTPS, or on its own machine. */
export const canKeep = () => Boolean(isSecureContext && navigator.serviceWorker && globalThis.caches);

/** Where all that this page needs stands, and how it is asked. asked: questions of the service by their channels */
async function needed(asked) {
  const files = performance.getEntriesByType("resource").map(({ name }) => name).filter((name) => name.startsWith(`${SCOPE}${EDITION}/`));
  const questions = await Promise.all([...asked.values()].map(async (one) => [await placeOf(one), one.url, one.options]));
  return [[SCOPE, location.href, { headers: { Accept: "text/html" } }], ...files.map((name) => [name, name, {}]), ...questions];
}

/** True if all that this page needs is kept, and a worker gives it. */
export async function isKept(asked) {
  if (!canKeep() || !(await navigator.serviceWorker.getRegistration(SCOPE))?.active) return false;
  const [name] = (await namesOf()).toReversed();
  const cache = name && (await caches.open(name));
  if (!cache) return false;
  const places = await needed(asked);
  return (await Promise.all(places.map(([place]) => cache.match(place, { ignoreVary: true })))).every(Boolean);
}

/** Keep all that this page needs, in place of what was kept before. True if it is kept. */
export async function keep(asked) {
  if (!canKeep()) return false;
  const name = `${KEPT} ${EDITION} ${Date.now()}`;
  try {
    await navigator.serviceWorker.register(new URL("carrier-worker.js", SCOPE).href, { scope: SCOPE });
    await navigator.serviceWorker.ready;
    const cache = await caches.open(name);
    for (const [place, url, { headers, method, body }] of await needed(asked)) {
      const response = await fetch(url, { headers: { ...headers, "Accept-Language": document.documentElement.lang }, method, body });
      if (!response.ok) throw new Error(`HTTP ${response.status}`);
      await cache.put(place, response);
    }
    for (const other of await namesOf()) if (other !== name) await caches.delete(other);
    return await isKept(asked);
  } catch (error) {
    // No room, no network, or a browser that allows no storage: then the page says that it is not kept.
    console.warn(error);
    await caches.delete(name).catch(() => {});
    return false;
  }
}

/** Take all of it away from this device. */
export async function forget() {
  for (const name of await namesOf()) await caches.delete(name);
  await (await navigator.serviceWorker.getRegistration(SCOPE))?.unregister();
}
