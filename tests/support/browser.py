"""A Chrome or Chromium for the tests of the page: found in a usual place, or else installed.

`make test` runs this file before the tests. Where nothing can be installed, the tests of the page are left out, and the
last lines of the run say so.
"""

import os
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path

# Commands that start one, in the order of preference: the one without windows opens a page for less.
NAMES = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
# Places of browsers that are installed without being in PATH.
PLACES = (
    "/usr/bin/chromium",
    "/usr/bin/chromium-browser",
    "/usr/lib/chromium/chromium",
    "/usr/lib/chromium-browser/chromium-browser",
    "/opt/google/chrome/chrome",
    "/snap/bin/chromium",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "C:/Program Files/Google/Chrome/Application/chrome.exe",
)
# Playwright's downloads inside its cache: the browser, or its shell without windows.
DOWNLOADS = (
    "chromium-*/chrome-linux*/chrome",
    "chromium-*/chrome-mac*/*.app/Contents/MacOS/*",
    "chromium-*/chrome-win*/chrome.exe",
    "chromium_headless_shell-*/chrome*/*headless?shell",
    "chromium_headless_shell-*/chrome*/*headless?shell.exe",
)
ANSWER_TIMEOUT = 120.0  # [s] for --version, which takes 0.05 s, and 0.4 s from a cold disk
FONT = "fonts-wqy-microhei"
MISSING = "no Chrome or Chromium starts here: make test installs one if it can; otherwise set CHROME to the path of one"


def _downloads():
    """Browsers that Playwright has downloaded, the newest first."""
    home = Path.home()
    caches = {
        "darwin": home / "Library/Caches",
        "win32": Path(os.environ.get("LOCALAPPDATA") or home / "AppData/Local"),
    }
    usual = caches.get(sys.platform, Path(os.environ.get("XDG_CACHE_HOME") or home / ".cache")) / "ms-playwright"
    folder = Path(os.environ.get("PLAYWRIGHT_BROWSERS_PATH") or usual)
    for pattern in DOWNLOADS:
        yield from map(str, sorted(folder.glob(pattern), key=lambda path: path.stat().st_mtime, reverse=True))


def candidates():
    """Programs that may be a Chrome or Chromium, the preferred first: CHROME, PATH, usual places, Playwright's."""
    if chosen := os.environ.get("CHROME"):
        yield chosen
    yield from filter(None, map(shutil.which, NAMES))
    yield from PLACES
    yield from _downloads()


def version_of(program):
    """What a program answers to --version; empty where it does not run, or fails."""
    try:
        answer = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=ANSWER_TIMEOUT)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return answer.stdout if answer.returncode == 0 else ""


def starts(program):
    """True if it runs and reports its version. Ubuntu's /usr/bin/chromium-browser only says that a snap is missing."""
    if not os.access(program, os.X_OK):
        return False
    if sys.platform == "win32":
        return True  # There --version opens a window.
    return "Chrom" in version_of(program)


@cache
def browser_path():
    """Path of the first Chrome or Chromium that starts."""
    return next(filter(starts, candidates()), None)


def has_chinese():
    """True if there is a font for the page in Chinese; a system without fontconfig has one."""
    if not shutil.which("fc-list"):
        return sys.platform != "linux"
    return bool(subprocess.run(["fc-list", ":lang=zh", "family"], capture_output=True).stdout.strip())


def _succeeds(*command):
    """Whether the command succeeds. Its output is dropped, because one line after the tests lists what was left out."""
    quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, env=quiet).returncode == 0


def get_packages(*packages):
    """Install packages of the system one by one, so that an unknown one does not stop the others."""
    print(f"Installing {' '.join(packages)} for the tests of the page (once)", file=sys.stderr)
    _succeeds("apt-get", "update", "-qq")
    for package in packages:
        _succeeds("apt-get", "install", "-qq", "-y", "--no-install-recommends", package)
    browser_path.cache_clear()


def get_download(is_root):
    """Let Playwright download a browser; as root also the libraries that it lacks."""
    print("Downloading a Chromium for the tests of the page (once)", file=sys.stderr)
    playwright = (sys.executable, "-m", "playwright")
    if _succeeds(*playwright, "install", "chromium") and is_root and not any(map(starts, _downloads())):
        _succeeds(*playwright, "install-deps", "chromium")
    browser_path.cache_clear()


def main():
    chosen = os.environ.get("CHROME")
    if chosen and not starts(chosen):
        print(f"CHROME={chosen} does not start a Chrome or Chromium: looking for another one", file=sys.stderr)
    is_root = hasattr(os, "geteuid") and os.geteuid() == 0
    wanted = ([] if browser_path() else ["chromium"]) + ([] if has_chinese() else [FONT])
    if wanted and is_root and shutil.which("apt-get"):
        get_packages(*wanted)
    if browser_path() is None:
        get_download(is_root)


if __name__ == "__main__":
    main()
