/** The small panel of both pages where a person chooses light or dark and the size of the type; theme.js does the rest. */

import { button, make } from "./elements.js";

/**
 * Name of a choice: the attribute of the document that holds it, and its values.
 * @type {Record<string, [string, string[]]>}
 */
const CHOICES = { theme: ["chosen", ["system", "light", "dark"]], type: ["type", ["usual", "large"]] };

/** Add the panel to the page, hidden until a button opens it. */
export function addLook() {
  const { dataset } = document.documentElement;
  const groups = Object.entries(CHOICES).map(([name, [held, values]]) => {
    const choose = (value) => dispatchEvent(new CustomEvent("choose-look", { detail: { [name]: value } }));
    const buttons = values.map((value) => button({ "data-look": value, "data-text": `look_${value}` }, () => choose(value)));
    const press = () => buttons.forEach((one) => one.setAttribute("aria-pressed", one.dataset.look === dataset[held]));
    addEventListener("look", press);
    press();
    return make("div", { className: "choice", role: "group", "data-label": `look_${name}` }, ...buttons);
  });
  document.body.append(make("div", { id: "look", popover: "auto", role: "dialog", "aria-labelledby": "look-title" }, make("h2", { id: "look-title", "data-text": "look" }), ...groups));
}
