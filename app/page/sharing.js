/** Sharing what is shown: its address to select, to copy and for the share sheet of the system, and as a QR code. */

import { make, textButton } from "./elements.js";
import { copy } from "./overlays.js";
import { say, writeTexts } from "./text.js";

/** Width of the light edge of a QR code, in modules; size of a module on the screen [px]. */
const [QUIET, MODULE] = [4, 4];

export class Sharing {
  /**
   * state: has write(), which brings the address up to date, and fits, false where what is shown is too long for it; parts: loads a part
   * @param {{ write: () => void, fits: boolean }} state
   * @param {{ load: (name: string) => Promise<any> }} parts
   */
  constructor(state, parts) {
    this.state = state;
    this.parts = parts;
    const box = make("div", { id: "sharing", popover: "auto", role: "dialog", "aria-labelledby": "sharing-title" });
    this.address = make("input", { id: "address", readOnly: true, "data-label": "Address of what is shown", onfocus: () => this.address.select() });
    this.code = make("canvas", { id: "qr", role: "img", "data-label": "QR code of the address" });
    this.help = make("p", { id: "sharing-help", className: "hint" });
    this.copied = textButton("Copy", () => copy(this.address.value), { id: "copy-address", className: "main" });
    const sheet = () => navigator.share({ title: document.title, url: this.address.value }).catch(() => {});
    const close = textButton("Close", () => box.hidePopover());
    this.sheet = textButton("Send …", sheet, { id: "share-sheet" });
    box.append(make("h2", { id: "sharing-title", "data-text": "Share" }), this.address, this.code, this.help, make("p", { className: "buttons" }, this.copied, this.sheet, close));
    document.body.append(box);
    this.box = box;
  }

  open() {
    this.state.write();
    this.address.value = location.href;
    const { fits } = this.state;
    this.code.hidden = true;
    for (const part of [this.address, this.copied]) part.hidden = !fits;
    this.sheet.hidden = !fits || !navigator.share;
    this.help.textContent = fits ? "" : say("This drawing is too long for an address: save it as a file to share it.");
    writeTexts();
    this.box.showPopover();
    // An address without the drawing would show something else.
    if (!fits) return;
    this.address.focus();
    this.parts.load("qr").then(({ qrCode }) => this.#draw(qrCode(location.href)));
  }

  /** rows: of the code; null for an address too long for one */
  #draw(rows) {
    this.code.hidden = !rows;
    this.help.textContent = say(rows ? "Whoever opens the address, or scans the code, sees the same." : "The address is too long for a QR code: copy it.");
    if (!rows) return;
    const size = (rows.length + 2 * QUIET) * MODULE;
    const canvas = Object.assign(this.code, { width: size, height: size });
    const context = canvas.getContext("2d");
    context.fillStyle = "#fff";
    context.fillRect(0, 0, size, size);
    context.fillStyle = "#000";
    rows.forEach((row, y) => row.forEach((isDark, x) => isDark && context.fillRect((x + QUIET) * MODULE, (y + QUIET) * MODULE, MODULE, MODULE)));
  }
}
