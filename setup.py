"""The one part of the build that pyproject.toml cannot say: the modules of core/kernels are compiled by Cython.

All of them or none: without a C compiler the install succeeds and the same files run uncompiled, and as compiled
modules call each other in C, a half-compiled package would not import.
No -march=native and no -ffast-math: every machine gives the same digits. The flags say that nobody reads errno or
floating-point traps, so that square roots and selections vectorise, and forbid fused multiply-add, which would round
differently from the uncompiled files.
"""

import os
from pathlib import Path

from Cython.Build import cythonize
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

# Functions are copied into their callers up to a size that holds the tests of a pair whole: C passes a memoryview by
# value, 200 bytes, and what other modules may call cannot be given a lighter signature (measured 2026-11-21: without
# it first contact takes 1.4 times as long).
FLAGS = ["-O3", "-finline-limit=2000", "-g0", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=off"]
DIRECTIVES = {
    "language_level": 3,
    "boundscheck": False,
    "wraparound": False,
    "cdivision": True,
    "initializedcheck": False,
}
# What Cython needs for memoryviews stands in one module for all.
SHARED = "core.kernels._shared"


class AllOrNothing(build_ext):
    """Compiles side by side, and leaves nothing compiled where one module fails."""

    def finalize_options(self) -> None:
        super().finalize_options()
        self.parallel = os.cpu_count()

    def build_extensions(self) -> None:
        super().build_extensions()
        built = [Path(self.get_ext_fullpath(extension.name)) for extension in self.extensions]
        if not all(path.exists() for path in built):
            for path in built:
                path.unlink(missing_ok=True)


names = sorted(path.stem for path in Path("core/kernels").glob("*.pxd") if path.stem != "constants")
kernels = cythonize(
    [Extension(SHARED, ["build/_shared.c"], extra_compile_args=FLAGS)]
    + [Extension(f"core.kernels.{name}", [f"core/kernels/{name}.py"], extra_compile_args=FLAGS) for name in names],
    build_dir="build",
    compiler_directives=DIRECTIVES,
    shared_utility_qualified_name=SHARED,
)
for extension in kernels:
    extension.optional = True  # cythonize (3.3) forgets what Extension was told

setup(ext_modules=kernels, cmdclass={"build_ext": AllOrNothing})
