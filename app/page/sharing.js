/** Sharing what is shown: its address to select, to copy and for the share sheet of the system, and as a QR code. */

import { $, onClick } from "./elements.js";
import { copy } from "./overlays.js";
import { say } from "./text.js";

/** Width of the light edge of a QR code, in modules; size of a module on the screen [px]. */
const [QUIET, MODULE] = [4, 4];

export class Sharing {
  /**
   * @param {State} state
   * @param {Parts} parts
   */
  constructor(state, parts) {
    this.state = state;
    this.parts = parts;
    onClick("#share", () => this.#open());
    onClick("#copy-address", () => copy($("#address").value));
    onClick("#share-sheet", () => navigator.share({ title: document.title, url: $("#address").value }).catch(() => {}));
    $("#share-sheet").hidden = !navigator.share;
    $("#address").addEventListener("focus", ({ target }) => target.select());
  }

  #open() {
    this.state.write();
    $("#address").value = location.href;
    $("#qr").hidden = true;
    $("#sharing-help").textContent = this.state.fits ? "" : say("tooLong");
    $("#sharing").showPopover();
    $("#address").focus();
    this.parts.load("qr").then(({ qrCode }) => this.#draw(qrCode(location.href)));
  }

  /** rows: of the code; null for an address too long for one */
  #draw(rows) {
    $("#qr").hidden = !rows;
    if (this.state.fits) $("#sharing-help").textContent = say(rows ? "sharingHelp" : "sharingLong");
    if (!rows) return;
    const size = (rows.length + 2 * QUIET) * MODULE;
    const canvas = Object.assign($("#qr"), { width: size, height: size });
    const context = canvas.getContext("2d");
    context.fillStyle = "#fff";
    context.fillRect(0, 0, size, size);
    context.fillStyle = "#000";
    rows.forEach((row, y) => row.forEach((isDark, x) => isDark && context.fillRect((x + QUIET) * MODULE, (y + QUIET) * MODULE, MODULE, MODULE)));
  }
}
