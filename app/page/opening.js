/** A box in which a person chooses whether an opened file comes beside what is there, or in its place. */

import { make, textButton } from "./elements.js";
import { say, writeTexts } from "./text.js";

/** Takes away a box to which nobody has answered. */
let leave = () => {};

/** "beside", "instead", or null if the file is not opened after all. name: of the file */
export function chooseHow(name) {
  leave();
  return new Promise((resolve) => {
    const end = (how) => {
      box.remove();
      removeEventListener("keydown", hear);
      leave = () => {};
      resolve(how);
    };
    const hear = ({ key }) => key === "Escape" && end(null);
    leave = () => end(null);
    const title = make("h2", { id: "opening-title", textContent: say("Open {name}", { name }) });
    const beside = textButton("Beside what is there", () => end("beside"), { id: "beside-it", className: "main" });
    const box = make(
      "div",
      { id: "opening", popover: "manual", role: "dialog", "aria-labelledby": title.id },
      title,
      make("p", { "data-text": "You have drawn a square or a dance. Beside it, yours stays: what you open joins it, and the dance of a file becomes a further dragon. In its place, only what you open is there. Undo takes back either." }),
      make("p", { className: "buttons" }, beside, textButton("In its place", () => end("instead"), { id: "instead" }), textButton("Close", () => end(null))),
    );
    document.body.append(box);
    writeTexts();
    box.showPopover();
    addEventListener("keydown", hear);
    beside.focus();
  });
}
