"""The one part of the build that pyproject.toml cannot say: core/kernels.py is compiled by Cython.

optional: without a C compiler the install succeeds and the same file runs uncompiled.
No -march=native and no -ffast-math: every machine gives the same digits. The flags say that nobody reads errno or
floating-point traps, so that square roots and selections vectorise, and forbid fused multiply-add, which would round
differently from the uncompiled file.
"""

from Cython.Build import cythonize
from setuptools import Extension, setup

FLAGS = ["-O3", "-g0", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=off"]

kernels = cythonize([Extension("core.kernels", ["core/kernels.py"], extra_compile_args=FLAGS)], build_dir="build")
for extension in kernels:
    extension.optional = True  # cythonize (3.3) forgets what Extension was told

setup(ext_modules=kernels)
