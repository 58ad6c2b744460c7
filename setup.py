"""The part of the build that pyproject.toml cannot express: Babel compiles the catalogues of core/words, and Cython the
modules of core/kernels, to which it declares the names that they share.

All modules or none are compiled: compiled modules call each other in C, so a half-compiled package would not import.
Without a C compiler the install succeeds, and the same files run uncompiled.
No -march=native and no -ffast-math: on one machine, compiled and uncompiled files give the same digits (the last digits
of sin and cos depend on the C library). The flags tell the compiler that nobody reads errno or floating-point traps, so
that square roots and selections vectorise. They forbid fused multiply-add, which would round differently from the
uncompiled files.
"""

import os
import runpy
import subprocess
from enum import EnumType
from pathlib import Path

from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po
from Cython.Build import cythonize
from setuptools import Extension, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_ext import build_ext
from setuptools.command.editable_wheel import editable_wheel

# Flags of every compiler with gcc's options.
UNIX_FLAGS = ["-g0", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=off"]
# The flags of each compiler; no compiler gets a flag that it does not know.
# gcc: of the steps of -O3 those that the loops need. They compile in two thirds of the time of -O3; of the benchmarks
# without HTTP each takes 0.86 to 1.03 times as long, the shortest turn 1.02 times (measured 2026-11-26).
# -finline-limit: inlines functions up to a size that includes the tests of a pair. C passes a memoryview by value,
# 200 bytes, and functions that other modules call cannot have a lighter signature (measured 2026-11-21: first contact
# takes 1.4 times as long without the flag). clang lacks most of these flags.
# msvc: without /fp:contract, /fp:precise leaves multiplications and additions apart.
FLAGS = {
    "gcc": [
        *UNIX_FLAGS,
        *("-O1", "-fcaller-saves", "-fgcse", "-ftree-vectorize", "-fvect-cost-model=dynamic"),
        *("-finline-functions", "-finline-small-functions", "-finline-limit=2000"),
    ],
    "clang": [*UNIX_FLAGS, "-O3"],
    "msvc": ["/O2", "/fp:precise"],
}
# One wheel for all Pythons (Py_LIMITED_API of 3.11) would be slower by more than 2 %: the minimum pitch takes 1.03 to
# 1.05, the highest head speed 1.02 to 1.10, other questions 0.97 to 1.02 times as long (measured 2026-11-27 with Cython
# 3.3.1).
DIRECTIVES = {
    "language_level": 3,
    "boundscheck": False,
    "wraparound": False,
    "cdivision": True,
    "initializedcheck": False,
    # Loops keep nothing between two calls, so Python without its global lock may run them at once:
    # tests/core/test_threads.
    "freethreading_compatible": True,
    "emit_code_comments": False,  # the C compiles in nine tenths of the time
}
# One module for all holds Cython's code for memoryviews, which no loop runs: it takes the compiler half the time, and
# no answer longer (measured 2026-11-25, fifteen questions).
SHARED = "core.kernels._shared"
# Modules of names alone: they are not compiled, and their .pxd follow from them.
NAMES = {"constants", "records"}


def family(kind: str, command: list[str]) -> str:
    """The compiler as a key of FLAGS; an unknown compiler with gcc's options counts as clang.

    kind: setuptools' name for its way of calling the compiler; command: the call, if known
    """
    if kind == "msvc":
        return kind
    english = {**os.environ, "LC_ALL": "C"}
    try:
        said = subprocess.run([*command, "--version"], capture_output=True, text=True, env=english).stdout
    except OSError:
        said = ""  # No compiler: the build reports it.
    # The name proves nothing: on macOS gcc is clang.
    return "gcc" if "Free Software Foundation" in said else "clang"


class AllOrNothing(build_ext):
    """Compiles the modules in parallel, and leaves none compiled if one fails."""

    def finalize_options(self) -> None:
        super().finalize_options()
        self.parallel = os.cpu_count()

    def build_extensions(self) -> None:
        flags = FLAGS[family(self.compiler.compiler_type, getattr(self.compiler, "compiler_so", []))]
        for extension in self.extensions:
            no_loops = extension.name == SHARED and flags is not FLAGS["msvc"]
            extension.extra_compile_args = [*flags, "-O1"] if no_loops else flags
        super().build_extensions()
        built = [Path(self.get_ext_fullpath(extension.name)) for extension in self.extensions]
        self.is_compiled = all(path.exists() for path in built)
        if not self.is_compiled:
            for path in built:
                path.unlink(missing_ok=True)
            print("The loops could not be compiled: they give the same digits uncompiled, many times slower.")


class HonestWheel(bdist_wheel):
    """A wheel with compiled loops is for one platform and Python, one without them for all: its name says which."""

    def run(self) -> None:
        self.run_command("build")
        if not self.get_finalized_command("build_ext").is_compiled:
            self.distribution.ext_modules = []
            self.root_is_pure = True
        super().run()


class ReadableEditable(editable_wheel):
    """An editable install by a .pth of this folder, which type checkers read; they cannot follow a finder.

    Python reads a .pth in the encoding of the locale, so a folder whose name needs one keeps the finder.
    """

    def finalize_options(self) -> None:
        super().finalize_options()
        self.mode = self.mode or ("compat" if str(Path.cwd()).isascii() else None)


def compile_catalogues() -> None:
    """Compile the sentences in other languages than English, beside their sources."""
    for written in Path("core/words").glob("*.po"):
        with written.open("rb") as source, written.with_suffix(".mo").open("wb") as compiled:
            write_mo(compiled, read_po(source))


def declare_names(module: str) -> None:
    """Declare the numbers, states and records of a module of core/kernels to Cython, in a .pxd beside it.

    Numbers become literals, which cost nothing in inner loops, states enums and records structs. A file that stays the
    same is not written, as Cython would translate all modules again.
    """
    types = {float: "double", int: "Py_ssize_t", bool: "bint"}
    declared = [f"# Written by setup.py from {module}.py."]
    for name, value in runpy.run_path(f"core/kernels/{module}.py").items():
        if isinstance(value, float):
            kind, lines = "extern from *", [f'const double {name} "{value!r}"']
        elif isinstance(value, int):
            kind, lines = "enum", [f"{name} = {value}"]
        elif isinstance(value, EnumType):
            kind, lines = f"enum {name}", [f"{state.name} = {state.value}" for state in value]
        elif hasattr(value, "_fields"):
            fields = value.__annotations__.items()
            kind, lines = f"struct {name}", [f"{types.get(hint, hint.__name__)} {field}" for field, hint in fields]
        else:
            lines = []  # a tuple of names, or an imported name
        if lines:
            declared += [f"cdef {kind}:", *(f"    {line}" for line in lines)]
    text = "\n".join([*declared, ""])
    path = Path("core/kernels", f"{module}.pxd")
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def kernels() -> list[Extension]:
    """The modules of core/kernels, translated to C."""
    folder = Path("core/kernels")
    declared = {path.stem for path in folder.glob("*.pxd")} - NAMES
    names = sorted(declared & {path.stem for path in folder.glob("*.py")})
    extensions = cythonize(
        [Extension(SHARED, ["build/_shared.c"])]
        + [Extension(f"core.kernels.{name}", [f"core/kernels/{name}.py"]) for name in names],
        build_dir="build",
        compiler_directives=DIRECTIVES,
        shared_utility_qualified_name=SHARED,
        nthreads=os.cpu_count() or 1,  # the same C from any number of processes
        cache="CYTHON_CACHE_DIR" in os.environ,  # Cython's name of the folder
    )
    for extension in extensions:
        extension.optional = True  # cythonize (3.3) drops this option of Extension
    return extensions


if __name__ == "__main__":
    compile_catalogues()
    for module in NAMES:
        declare_names(module)
    commands = {"build_ext": AllOrNothing, "bdist_wheel": HonestWheel, "editable_wheel": ReadableEditable}
    setup(ext_modules=kernels(), cmdclass=commands)
