"""The one part of the build that pyproject.toml cannot say: core/kernels.py is compiled by Cython.

optional: without a C compiler the install succeeds and the same file runs uncompiled.
No -march=native and no -ffast-math: every machine gives the same digits. The flags say that nobody reads errno or
floating-point traps, so that square roots and selections vectorise, and forbid fused multiply-add, which would round
differently from the uncompiled file.
"""

from Cython.Build import cythonize
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.errors import CompileError


class BuildIfPossible(build_ext):
    """build_ext that counts a compiler that is not there as one that failed, which `optional` forgives."""

    def build_extension(self, ext: Extension) -> None:
        try:
            super().build_extension(ext)
        except FileNotFoundError as error:
            raise CompileError(f"no C compiler: {error}") from error


kernels = Extension(
    "core.kernels",
    ["core/kernels.py"],
    extra_compile_args=["-O3", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=off"],
    optional=True,
)

setup(ext_modules=cythonize([kernels], build_dir="build"), cmdclass={"build_ext": BuildIfPossible})
