/** The look of both pages, set before anything is drawn: light or dark, and the size of the type. This browser keeps it. */

(() => {
  const KEPT = "bench-dragon-look";
  const VALUES = { theme: ["system", "light", "dark"], type: ["usual", "large"] };
  const root = document.documentElement;
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const look = { theme: "system", type: "usual" };

  /** Take over known values; others are left out. */
  function take(values) {
    for (const [name, allowed] of Object.entries(VALUES)) if (allowed.includes(values?.[name])) look[name] = values[name];
  }

  function read() {
    try {
      take(JSON.parse(localStorage.getItem(KEPT)));
    } catch {
      // Without storage in the browser the look lasts as long as the page.
    }
  }

  function show() {
    const theme = look.theme !== "system" ? look.theme : dark.matches ? "dark" : "light";
    Object.assign(root.dataset, { theme, chosen: look.theme, type: look.type });
    dispatchEvent(new Event("look"));
  }

  addEventListener("choose-look", (/** @type {any} */ { detail }) => {
    take(detail);
    try {
      localStorage.setItem(KEPT, JSON.stringify(look));
    } catch {
      // As above.
    }
    show();
  });
  // Another tab has another look now.
  addEventListener("storage", ({ key }) => {
    if (key !== KEPT) return;
    read();
    show();
  });
  dark.addEventListener("change", show);
  read();
  show();
})();
