"""Findings of axe, which checks pages for accessibility."""

from axe_playwright_python.sync_playwright import Axe

# Rules whose findings depend on colours, and so on the colour scheme.
IN_COLOURS = ["color-contrast", "link-in-text-block"]


def findings(page, place=None, *, in_colours=False):
    """All findings of axe: the rule, and the first element that breaks it.

    in_colours: only by rules that depend on colours
    """
    # The page's own policy forbids inline scripts; the script of axe comes over the debugging protocol.
    # Selectors of what is found, which nobody reads, take axe a third of its time.
    options = {"resultTypes": ["violations"], "selectors": False, **({"runOnly": IN_COLOURS} if in_colours else {})}
    result = Axe().run(page, place, options).response["violations"]
    return [(one["id"], one["nodes"][0]["html"]) for one in result]
