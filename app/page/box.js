/** Boxes over the page, which a person answers or closes. */

import { make } from "./elements.js";
import { writeTexts } from "./text.js";

/**
 * Open a box. title: its heading; parts: what follows it; closed(): called when Escape has closed it
 * @returns {() => void} closes it
 */
export function openBox(id, title, parts, closed = () => {}) {
  document.getElementById(id)?.remove();
  const hear = (event) => {
    if (!box.isConnected) return leave();
    if (event.key === "Tab" && box.contains(document.activeElement)) go(event);
    if (event.key !== "Escape") return;
    event.preventDefault();
    leave();
    closed();
  };
  /** The Tab key stays in the box: after its last control comes the first one. */
  const go = (event) => {
    const all = /** @type {any[]} */ ([...box.querySelectorAll("button, input, select, a")]).filter((one) => !one.disabled && one.checkVisibility());
    if (document.activeElement !== all.at(event.shiftKey ? 0 : -1)) return;
    event.preventDefault();
    all.at(event.shiftKey ? -1 : 0).focus();
  };
  const leave = () => {
    box.remove();
    removeEventListener("keydown", hear);
  };
  Object.assign(title, { id: `${id}-title` });
  const box = make("div", { id, popover: "manual", role: "dialog", "aria-labelledby": title.id }, title, ...parts);
  document.body.append(box);
  writeTexts();
  box.showPopover();
  addEventListener("keydown", hear);
  return leave;
}
