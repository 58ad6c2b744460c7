/** Helpers that find, make and listen to elements of the document, read its colours, and save a file. */

/** @type {(selector: string) => any} */
export const $ = (selector) => document.querySelector(selector);
/** @type {(selector: string) => any[]} */
export const $$ = (selector) => [...document.querySelectorAll(selector)];
export const onClick = (selector, act) => $(selector).addEventListener("click", act);

/** Way of a finger after which it drags a slider [px]. */
const SIDEWAYS = 12;

const NUMBER = /^[-+]?(\d+([.,]\d*)?|[.,]\d+)(e[-+]?\d+)?$/i;

/** The number that a person typed, also with a decimal comma; any other text stays. */
export function numberIn(text) {
  const typed = text.trim();
  return NUMBER.test(typed) ? Number(typed.replace(",", ".")) : typed;
}

/** Save a file. blob: its content */
export function download(blob, name) {
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Function that gives a colour of the page by its name. */
export function colours(element = document.documentElement) {
  const style = getComputedStyle(element);
  return (name) => style.getPropertyValue(`--${name}`).trim();
}

/** The two sizes of type in pictures, as those of the page [px]. */
export const [SMALL_TYPE, USUAL_TYPE] = [13.12, 15];
/** Size of the chosen type as a share of the usual one [1]; 0 until it is read, because reading it makes the browser compute all styles. */
let type = 0;
for (const change of ["look", "resize"]) globalThis.addEventListener?.(change, () => (type = 0), { capture: true });
/** A length in the usual size of the type in the chosen one [px]. */
export function inType(pixels) {
  type ||= Number.parseFloat(getComputedStyle(document.documentElement).fontSize) / 16;
  return pixels * type;
}

/** Show or hide an element only on a change, because each assignment makes the browser compute all styles again. */
export function hide(element, hidden) {
  if (element.hidden !== hidden) element.hidden = hidden;
}

/**
 * Call act() when a person moves a slider. A touch changes nothing until it goes sideways or ends: one that goes up or
 * down scrolls the page, and the slider takes back its value.
 */
export function onSlide(slider, act) {
  let touch = null;
  slider.addEventListener("pointerdown", ({ pointerType, clientX }) => (touch = pointerType === "touch" ? { clientX, value: slider.value } : null));
  slider.addEventListener("pointermove", ({ clientX }) => {
    if (!touch || Math.abs(clientX - touch.clientX) < SIDEWAYS) return;
    touch = null;
    act();
  });
  slider.addEventListener("pointerup", () => {
    const moved = touch && touch.value !== slider.value;
    touch = null;
    if (moved) act();
  });
  slider.addEventListener("pointercancel", () => {
    if (touch) slider.value = touch.value;
    touch = null;
  });
  slider.addEventListener("input", () => touch || act());
}

/** The typed token, for calls that may need it. */
export function bearer() {
  const token = $("#token").value.trim();
  return token ? { Authorization: `Bearer ${token}` } : {};
}

/** An element with these properties and children; names with a dash become attributes. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element) element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

/** A button with an action. */
export const button = (properties, onclick, ...children) => make("button", { type: "button", onclick, ...properties }, ...children);
/** A button with a text, in the language of the page at every time. text: in English */
export const textButton = (text, onclick, properties = {}) => button({ "data-text": text, ...properties }, onclick);
