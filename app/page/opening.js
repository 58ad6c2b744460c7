/** A box in which a person chooses whether an opened file comes beside what is there, or in its place. */

import { openBox } from "./box.js";
import { make, textButton } from "./elements.js";
import { say } from "./text.js";

/** Answers for a box to which nobody has answered. */
let leave = () => {};

/** "beside", "instead", or null if the file is not opened after all. name: of the file */
export function chooseHow(name) {
  leave();
  return new Promise((resolve) => {
    const end = (how) => {
      close();
      leave = () => {};
      resolve(how);
    };
    leave = () => end(null);
    const beside = textButton("Beside what is there", () => end("beside"), { id: "beside-it", className: "main" });
    const close = openBox(
      "opening",
      make("h2", { textContent: say("Open {name}", { name }) }),
      [
        make("p", { "data-text": "You have drawn a square or a dance. Beside it, yours stays: what you open joins it, and the dance of a file becomes a further dragon. In its place, only what you open is there. Undo takes back either." }),
        make("p", { className: "buttons" }, beside, textButton("In its place", () => end("instead"), { id: "instead" }), textButton("Close", () => end(null))),
      ],
      () => end(null),
    );
    beside.focus();
  });
}
