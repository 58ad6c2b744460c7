/** The small panel of both pages where a person chooses light or dark and the size of the type; theme.js does the rest. */

import { button, make } from "./elements.js";
import { phrase } from "./text.js";

/**
 * Name of a choice: the attribute of the document that holds it, its label, and its values with their names.
 * @type {Record<string, [string, string, Record<string, string>]>}
 */
const CHOICES = {
  theme: ["chosen", phrase("Colours"), { system: phrase("As the system"), light: phrase("Light"), dark: phrase("Dark") }],
  type: ["type", phrase("Size of the type"), { usual: phrase("Usual type"), large: phrase("Large type, for a projector") }],
};

/** Add the panel to the page, hidden until a button opens it. */
export function addLook() {
  const { dataset } = document.documentElement;
  const groups = Object.entries(CHOICES).map(([name, [held, label, values]]) => {
    const choose = (value) => dispatchEvent(new CustomEvent("choose-look", { detail: { [name]: value } }));
    const buttons = Object.entries(values).map(([value, words]) => button({ "data-look": value, "data-text": words }, () => choose(value)));
    const press = () => buttons.forEach((one) => one.setAttribute("aria-pressed", one.dataset.look === dataset[held]));
    addEventListener("look", press);
    press();
    return make("div", { className: "choice", role: "group", "data-label": label }, ...buttons);
  });
  document.body.append(make("div", { id: "look", popover: "auto", role: "dialog", "aria-labelledby": "look-title" }, make("h2", { id: "look-title", "data-text": "Look" }), ...groups));
}
