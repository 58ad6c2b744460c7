/** Sharing what is shown: its address to select, to copy and for the share sheet of the system, and as a QR code. */

import { make, textButton } from "./elements.js";
import { copy } from "./overlays.js";
import { say, writeTexts } from "./text.js";

export class Sharing {
  /**
   * state: has write(), which brings the address up to date, and fits, false where what is shown is too long for it
   * @param {{ write: () => void, fits: boolean }} state
   */
  constructor(state) {
    this.state = state;
    const box = make("div", { id: "sharing", popover: "auto", role: "dialog", "aria-labelledby": "sharing-title" });
    this.address = make("input", { id: "address", readOnly: true, "data-label": "Address of what is shown", onfocus: () => this.address.select() });
    this.code = make("img", { id: "qr", "data-label": "QR code of the address", onload: () => this.#offer(true), onerror: () => this.#offer(false) });
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
    this.code.src = `code.svg?${encodeURIComponent(location.href)}`;
  }

  #offer(isRead) {
    this.code.hidden = !isRead;
    this.help.textContent = say(isRead ? "Whoever opens the address, or scans the code, sees the same." : "There is no QR code: the address is too long for one, or the service is away. Copy it.");
  }
}
