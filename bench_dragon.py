"""The command bench-dragon, which finds its own modules app and core.

Many programs call their package app. Where a folder of PYTHONPATH holds such a package, Python would import that one,
so such a folder is left out, for this process and for those that it starts. Other folders of PYTHONPATH stay.
"""

import os
import sys
from pathlib import Path

PACKAGES = ("app", "core")


def leave_out_namesakes() -> None:
    """Drop the folders of PYTHONPATH that hold a package of another program with the name of one of ours."""
    own = Path(__file__).parent.resolve()
    stated = os.environ.get("PYTHONPATH", "")
    # An empty entry is the current folder.
    folders = [folder or os.curdir for folder in stated.split(os.pathsep)] if stated else []
    others = {os.path.abspath(folder) for folder in folders if _holds_namesake(Path(folder).resolve(), own)}
    if others:
        kept = [folder for folder in folders if os.path.abspath(folder) not in others]
        os.environ["PYTHONPATH"] = os.pathsep.join(kept)
        sys.path[:] = [place for place in sys.path if os.path.abspath(place) not in others]


def _holds_namesake(folder: Path, own: Path) -> bool:
    return folder != own and any((folder / name).is_dir() or (folder / f"{name}.py").exists() for name in PACKAGES)


def main() -> None:
    leave_out_namesakes()
    from app.command.entry import main

    main()


if __name__ == "__main__":
    main()
