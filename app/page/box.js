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
    if (event.key !== "Escape") return;
    event.preventDefault();
    leave();
    closed();
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
