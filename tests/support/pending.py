"""Until a page of the product is at rest: it names in one attribute what it has begun and will end by itself."""

# Nothing of these kinds is pending for some frames: the page requests what comes into sight one frame later.
QUIET = """async (kinds) => {
  const root = document.documentElement;
  const isQuiet = () => root.dataset.pending?.split(" ").some((one) => one && (kinds?.includes(one) ?? true)) === false;
  const changed = () => new Promise((resolve) => new MutationObserver((_, observer) => {
    observer.disconnect();
    resolve();
  }).observe(root, { attributes: true }));
  for (let frames = 0; frames < 4; frames++) {
    while (!isQuiet()) {
      await changed();
      frames = 0;
    }
    await new Promise(requestAnimationFrame);
  }
  return true;
}"""


def settled(page, *kinds):
    """Return when nothing, or nothing of these kinds, is pending: names of the page's channels and pauses."""
    page.wait_for_function(QUIET, arg=list(kinds) or None)


# As the Tab key reaches it, but nothing scrolls, and no chart comes into sight on the way.
REACH = "document.querySelector('#keep').dispatchEvent(new FocusEvent('focusin', { bubbles: true }))"
