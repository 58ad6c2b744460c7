/** Ready-made things of a square: a tap puts one there, of a usual size. */

import { THINGS } from "./drawing.js";
import { $, button, make } from "./elements.js";
import { phrase, say } from "./text.js";

/** Names, and sizes: radius of what is round, width and depth of a block [m]; what has none is drawn along its middle. */
export const KITS = {
  well: { kind: "circle", name: phrase("well"), radius: 1 },
  fountain: { kind: "circle", name: phrase("fountain"), radius: 1.5, tool: "fountain" },
  lamp: { kind: "circle", name: phrase("lamp"), radius: 0.15 },
  stage: { kind: "block", name: phrase("stage"), size: [8, 5] },
  stall: { kind: "block", name: phrase("stall"), size: [3, 2] },
  stairs: { kind: "block", name: phrase("stairs"), size: [6, 1.5] },
  spectators: { kind: "block", name: phrase("spectators"), size: [10, 2] },
  wall: { kind: "wall", name: THINGS.wall },
  lane: { kind: "lane", name: THINGS.lane },
  measure: { kind: "measure", name: phrase("measure a distance") },
};

/** Size of a kit in words. */
const sizeWords = (/** @type {any} */ { radius, size }) => (size ? `${size.join(" × ")} m` : radius ? say("{diameter} m across", { diameter: 2 * radius }) : "");

/** Add the box of the kits, which a button opens by its id. editor: takes the chosen one */
export function addKits(editor) {
  const rows = Object.values(KITS).map((kit) => ({ kit, size: make("span", { className: "hint" }) }));
  const choose = (kit) => () => {
    box.hidePopover();
    editor.turn(true);
    editor.take(kit.kind, kit.radius || kit.size ? kit : null);
    $("#canvas").focus({ preventScroll: true });
  };
  const buttons = rows.map(({ kit, size }) => {
    const name = button({}, choose(kit));
    name.append(make("span", { "data-text": kit.name, textContent: say(kit.name) }), " ", size);
    return name;
  });
  const box = make("div", { id: "kits", popover: "auto", "data-label": "Ready-made things" }, ...buttons);
  // While a person draws, it opens among the tools.
  const opener = button({ "data-tool": "kits", "data-text": phrase("More …"), popoverTargetElement: box, hidden: true });
  $("[data-tool=several]").before(opener);
  $("[data-tool=circle]").after(button({ "data-tool": "fountain", "data-text": phrase("Fountain"), hidden: true }, choose(KITS.fountain)));
  box.addEventListener("beforetoggle", () => rows.forEach(({ kit, size }) => (size.textContent = sizeWords(kit))));
  $("#dance").append(box);
}
