"""The one part of the build that pyproject.toml cannot say: the modules of core/kernels are compiled by Cython.

All of them or none: without a C compiler the install succeeds and the same files run uncompiled, and as compiled
modules call each other in C, a half-compiled package would not import.
No -march=native and no -ffast-math: every machine gives the same digits. The flags say that nobody reads errno or
floating-point traps, so that square roots and selections vectorise, and forbid fused multiply-add, which would round
differently from the uncompiled files.
"""

import os
import subprocess
from pathlib import Path

from Cython.Build import cythonize
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

# What every compiler with gcc's options knows.
UNIX_FLAGS = ["-O3", "-g0", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=off"]
# The flags of each compiler; none of them gets one that it does not know.
# gcc: functions are copied into their callers up to a size that holds the tests of a pair whole: C passes a memoryview
# by value, 200 bytes, and what other modules may call cannot be given a lighter signature (measured 2026-11-21: without
# it first contact takes 1.4 times as long). clang lacks that flag.
# msvc: without /fp:contract, /fp:precise leaves multiplications and additions apart.
FLAGS = {
    "gcc": [*UNIX_FLAGS, "-finline-limit=2000"],
    "clang": UNIX_FLAGS,
    "msvc": ["/O2", "/fp:precise"],
}
DIRECTIVES = {
    "language_level": 3,
    "boundscheck": False,
    "wraparound": False,
    "cdivision": True,
    "initializedcheck": False,
}
# What Cython needs for memoryviews stands in one module for all.
SHARED = "core.kernels._shared"


def family(kind: str, command: list[str]) -> str:
    """Which compiler this is, a key of FLAGS; an unknown one that takes gcc's options counts as clang.

    kind: setuptools' name for its way of calling the compiler; command: how it is called, where that is known
    """
    if kind == "msvc":
        return kind
    english = {**os.environ, "LC_ALL": "C"}
    try:
        said = subprocess.run([*command, "--version"], capture_output=True, text=True, env=english).stdout
    except OSError:
        said = ""  # No compiler: the build will say so.
    # The name proves nothing: on macOS clang answers to gcc.
    return "gcc" if "Free Software Foundation" in said else "clang"


class AllOrNothing(build_ext):
    """Compiles side by side, and leaves nothing compiled where one module fails."""

    def finalize_options(self) -> None:
        super().finalize_options()
        self.parallel = os.cpu_count()

    def build_extensions(self) -> None:
        flags = FLAGS[family(self.compiler.compiler_type, getattr(self.compiler, "compiler_so", []))]
        for extension in self.extensions:
            extension.extra_compile_args = flags
        super().build_extensions()
        built = [Path(self.get_ext_fullpath(extension.name)) for extension in self.extensions]
        if not all(path.exists() for path in built):
            for path in built:
                path.unlink(missing_ok=True)


def kernels() -> list[Extension]:
    """The modules of core/kernels, as C."""
    declared = {path.stem for path in Path("core/kernels").glob("*.pxd")}
    names = sorted(declared - {"constants", "records"})  # these hold names alone
    extensions = cythonize(
        [Extension(SHARED, ["build/_shared.c"])]
        + [Extension(f"core.kernels.{name}", [f"core/kernels/{name}.py"]) for name in names],
        build_dir="build",
        compiler_directives=DIRECTIVES,
        shared_utility_qualified_name=SHARED,
    )
    for extension in extensions:
        extension.optional = True  # cythonize (3.3) forgets what Extension was told
    return extensions


if __name__ == "__main__":
    setup(ext_modules=kernels(), cmdclass={"build_ext": AllOrNothing})
