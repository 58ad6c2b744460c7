"""What a person does and sees on a page of the product."""

import base64
import io
import re
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

from playwright.sync_api import expect

from tests.support import axe
from tests.support.pending import REACH, settled

TABLET = {"viewport": {"width": 820, "height": 1180}, "has_touch": True}
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True}
# A layout that changes the height of the picture lets it be drawn once more.
IS_SIZED = """() => {
  const { height, clientHeight } = document.querySelector("#canvas");
  return Math.abs(height - clientHeight * devicePixelRatio) < 1;
}"""
# Controls, and lines of what to do next, that lie below the message.
COVERED = """() => [
  ...document.querySelectorAll("button, input, select, a, summary, #draw-help, #add-help"),
].filter((one) => {
  const { left, right, top, bottom } = one.getBoundingClientRect();
  const above = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
  return one.checkVisibility({ visibilityProperty: true }) && above?.closest("#status");
}).map((one) => one.outerHTML)"""
# Share of pixels in which two equal pictures may differ [1]: Chromium does not always smooth an edge in the same way.
PIXELS_UNLIKE = 1e-3
COLOUR_WITHIN = 0.02  # difference of a pixel from a colour of the page, in each of red, green and blue [1]


class Person:
    """One tab, and who looks at it."""

    def __init__(self, page):
        self.page = page

    def at(self, place):
        return self.page.locator(place).first

    def all(self, place):
        return self.page.locator(place)

    def sees(self, wanted):
        """Wait for each place: True: visible, False: hidden, a count, a text or texts in it, a pattern of its text."""
        for place, what in wanted.items():
            one = self.at(place)
            if isinstance(what, bool):
                expect(one).to_be_visible() if what else expect(one).to_be_hidden()
            elif isinstance(what, int):
                expect(self.all(place)).to_have_count(what)
            elif isinstance(what, re.Pattern):
                expect(one).to_have_text(what)
            else:
                for text in [what] if isinstance(what, str) else what:
                    expect(one).to_contain_text(text)
        return self

    def reads(self, wanted):
        """Wait until each place has exactly this text."""
        for place, text in wanted.items():
            expect(self.at(place)).to_have_text(text)
        return self

    def misses(self, unwanted):
        """Wait until no place has its text in it."""
        for place, text in unwanted.items():
            expect(self.at(place)).not_to_contain_text(text)
        return self

    def holds(self, wanted):
        """Wait until each field has this value."""
        for place, value in wanted.items():
            expect(self.at(place)).to_have_value(value)
        return self

    def has(self, place, **attributes):
        """Wait until an element has these attributes; aria_busy stands for aria-busy."""
        for name, value in attributes.items():
            expect(self.at(place)).to_have_attribute(name.replace("_", "-"), value)
        return self

    def opens(self, query):
        """Load another address of the page in this tab; it has all its answers."""
        self.page.goto(f"{self.page.url.partition('?')[0]}{query}")
        return self.settles()

    def arrives(self, address):
        """Wait for an address of this pattern."""
        self.page.wait_for_url(address)
        return self

    def views(self, *places):
        """Wait until each place is within the window."""
        for place in places:
            expect(self.at(place)).to_be_in_viewport()
        return self

    def focuses(self, place):
        self.at(place).focus()
        return self

    def takes(self, file, place="#open-file"):
        """Choose a file, or files, for a button that opens them."""
        self.at(place).set_input_files(file)
        return self

    def presses(self, *places):
        for place in places:
            self.at(place).click()
        return self

    def chooses(self, choices):
        for place, value in choices.items():
            self.at(place).select_option(value)
        return self

    def types(self, texts, key="Enter"):
        """Fill each field, and press a key in it."""
        for place, text in texts.items():
            self.at(place).fill(text)
            self.at(place).press(key)
        return self

    def strikes(self, *keys):
        for key in keys:
            self.page.keyboard.press(key)
        return self

    def speaks(self, language):
        """Choose a language of the page: en or zh."""
        self.at(f"[data-lang={language}]:visible").click()
        return self.settles()

    def settles(self, *kinds):
        settled(self.page, *kinds)
        return self

    def reaches(self, place="#keep"):
        """Scroll to a place: the charts on the way are drawn, and nothing moves any more."""
        self.at(place).scroll_into_view_if_needed()
        return self.settles()

    def reaches_below(self):
        """What stands below the dance loads as by the Tab key: nothing scrolls, and no chart comes into sight."""
        self.page.evaluate(REACH)
        self.at("#kept li").wait_for(state="attached")
        return self.settles()

    def looks_at(self, *kinds):
        """Scroll to these slow charts, curve or scan, until they are drawn to the end."""
        for kind in kinds:
            self.settles()  # an answer that came after the scrolling would push the chart out of sight again
            self.at(f"#{kind} .plot").scroll_into_view_if_needed()
            self.at(f"#{kind}:not(.coarse) .uplot").wait_for()
        return self.settles()

    def drags(self, place, dx, dy):
        """Press the mouse on the middle of an element, move it by pixels, and release it."""
        return self.drags_from(*self.spot(place), dx, dy)

    def drags_from(self, x, y, dx, dy):
        """The same from a place in the window."""
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + dx, y + dy, steps=5)
        self.page.mouse.up()
        return self

    def swipes(self, x, y, dx, dy, rest=0.0):
        """Move a finger from a place by pixels. rest: how long it stays before it is lifted [ms]"""
        self.pinches([(x, y, dx, dy)], rest)

    def pinches(self, ways, rest=0.0):
        """Move several fingers together, each from a place by pixels: (x, y, dx, dy)."""
        finger = self.page.context.new_cdp_session(self.page)
        for k in range(4):
            points = [{"x": x + dx * k / 3, "y": y + dy * k / 3, "id": n} for n, (x, y, dx, dy) in enumerate(ways)]
            kind = "touchMove" if k else "touchStart"
            finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        self.page.wait_for_timeout(rest)
        finger.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        self.settles()

    def saves(self, place, name=""):
        """Content of the file that a press saves. name: that it must have"""
        with self.page.expect_download() as download:
            self.at(place).click()
        assert name in ("", download.value.suggested_filename)
        return Path(download.value.path()).read_bytes()

    def text(self, place):
        return self.at(place).inner_text()

    def texts(self, place):
        return self.all(place).all_inner_texts()

    def box(self, place):
        return self.at(place).bounding_box()

    def spot(self, place, right=0.0, down=0.0):
        """A place in the window, by pixels from the middle of an element."""
        box = self.box(place)
        return box["x"] + 0.5 * box["width"] + right, box["y"] + 0.5 * box["height"] + down

    def style(self, place, name):
        return str(self.at(place).evaluate(f"one => getComputedStyle(one).{name}"))

    def ask(self, code, *values):
        """Value of a JavaScript expression, or of a function for a value."""
        return self.page.evaluate(code, *values)

    def counts(self, place):
        return self.page.locator(place).count()

    def address(self):
        """The parts of the address, once the page has written it."""
        self.settles("address")
        return {name: values[0] for name, values in parse_qs(urlsplit(self.page.url).query).items()}

    def holds_back(self, pattern):
        """Requests of this pattern wait from now on."""
        return Held(self.page, pattern)

    def findings(self, place=None, **how):
        return axe.findings(self.page, place, **how)

    def overflows(self, width):
        """Whether the page is wider than a screen of this width [px]."""
        return bool(self.page.evaluate("document.documentElement.scrollWidth") > width)

    def picture(self):
        """The pixels of the dance (height, width, 4), drawn in the size that its canvas has."""
        from matplotlib.image import imread  # takes a third of the start of a process

        self.page.wait_for_function(IS_SIZED)
        address = self.page.locator("#canvas").evaluate("canvas => canvas.toDataURL()")
        return imread(io.BytesIO(base64.b64decode(address.partition(",")[2])))

    def coloured(self, colour):
        """Number of pixels of the picture in a colour, such as #008080, or in one of the page by its name."""
        if not colour.startswith("#"):
            code = "name => getComputedStyle(document.querySelector('#canvas')).getPropertyValue(`--${name}`).trim()"
            colour = self.page.evaluate(code, colour)
        wanted = [int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]
        return int((abs(self.picture()[..., :3] - wanted).max(axis=-1) < COLOUR_WITHIN).sum())


class Held:
    """Requests that wait until they are let go."""

    def __init__(self, page, pattern):
        self._waiting = []
        self._passes = False
        page.route(pattern, lambda route: self.take(route))

    def take(self, route):
        route.continue_() if self._passes else self._waiting.append(route)

    def let_go(self):
        """Let go what waits, and what comes after it."""
        self._passes = True
        while self._waiting:
            self._waiting.pop(0).continue_()


def alike(a, b):
    """Two pictures show the same."""
    return a.shape == b.shape and float((a != b).any(axis=-1).mean()) < PIXELS_UNLIKE
