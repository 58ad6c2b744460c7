/** What can be done with a figure, such as a proposed ring, on the picture. */

import { canMirror } from "./changes.js";
import { hide, make, textButton } from "./elements.js";
import { phrase } from "./text.js";

export class Figure {
  /**
   * free(): makes points of it
   * @param {any} stage
   * @param {Editor} editor
   * @param {() => void} free
   */
  constructor(stage, editor, free) {
    this.editor = editor;
    this.turned = textButton("Mirror", () => editor.mirror(), { id: "mirror" });
    const freed = textButton("Free it", free, { id: "free" });
    this.box = make("p", { id: "figure", hidden: true }, make("b", { "data-text": phrase("Figure") }), " ", this.turned, " ", freed);
    stage.append(this.box);
  }

  /** After a change of anything. */
  show() {
    const { hasFigure, state } = this.editor;
    hide(this.box, !hasFigure);
    if (hasFigure) hide(this.turned, !canMirror(state.get("drawing")));
  }
}
