/** A box with all keys of the page, and buttons that lead to what can be done next, so that nobody has to search for it. */

import { openBox } from "./box.js";
import { button, make, textButton } from "./elements.js";
import { phrase, say } from "./text.js";

/** Where the buttons lead: name -> the first of these places that is there, in the order of the work. @type {Record<string, [string, string]>} */
const PLACES = {
  path: [phrase("The size of the square"), "#place-shape"],
  tools: [phrase("Things in the square"), "#place [data-add], #tools [aria-pressed=true]:not(#edit)"],
  propose: [phrase("Propose a dance"), "#propose:enabled"],
  choose: [phrase("Choose one of the dances"), "#cards button:enabled"],
  picture: [phrase("The picture, to draw and to look"), "#canvas"],
  answers: [phrase("The answers"), "#judgement button, #answers summary"],
  dragons: [phrase("Several dragons"), "#dragon-add, #several"],
  files: [phrase("Open a file"), "#open"],
  keep: [phrase("Save"), "#to-keep"],
  share: [phrase("Share"), "#share"],
};
/** Keys and what they do. @type {[string, [string, string][]][]} */
const KEYS = [
  [
    phrase("On the picture"),
    [
      ["← → ↑ ↓", phrase("move the picture, or what is chosen by 0.1 m, with Shift by 1 cm")],
      ["+ − 0", phrase("enlarge, make smaller, show all")],
      ["Space, F", phrase("play or stop; follow the head")],
      ["[ ]", phrase("choose a handle of the dragon; while drawing: a thing of the square")],
    ],
  ],
  [
    phrase("While drawing"),
    [
      ["N", phrase("put the next point or thing")],
      ["Enter", phrase("insert a point after this one")],
      ["Delete", phrase("remove this point, or what is chosen")],
      ["Ctrl+C Ctrl+V Ctrl+D", phrase("copy, paste, duplicate what is chosen")],
      ["Shift+F10", phrase("menu of what is chosen")],
      ["Esc", phrase("leave what is chosen")],
    ],
  ],
  [
    phrase("Everywhere"),
    [
      ["Ctrl+Z Ctrl+Shift+Z", phrase("undo, redo")],
      ["?", phrase("this list")],
    ],
  ],
];

/** Opens the box. next: what comes next, by its name in PLACES; null: nothing in particular */
export function openKeys(next) {
  const before = document.activeElement;
  const leave = (to) => {
    close();
    if (to instanceof HTMLElement) to.focus();
  };
  const buttons = Object.entries(PLACES).flatMap(([name, [words, selector]]) => {
    const place = [...document.querySelectorAll(selector)].find((one) => one.checkVisibility());
    const isNext = name === next;
    return place ? [button({ className: isNext ? "main" : "", textContent: isNext ? say("Next: {what}", { what: say(words) }) : say(words) }, () => leave(place))] : [];
  });
  const groups = KEYS.flatMap(([title, keys]) => {
    const rows = keys.flatMap(([key, words]) => [make("dt", {}, make("kbd", { textContent: key })), make("dd", { "data-text": words })]);
    return [make("h3", { "data-text": title }), make("dl", {}, ...rows)];
  });
  const end = textButton("Close", () => leave(before));
  const close = openBox("keys", make("h2", { "data-text": phrase("Keys") }), [make("h3", { "data-text": phrase("Go to") }), make("p", { className: "buttons" }, ...buttons, end), ...groups], () => leave(before));
  (buttons.find((one) => one.className) ?? buttons[0] ?? end).focus();
}
