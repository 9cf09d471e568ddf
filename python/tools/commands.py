"""These commands of setuptools put libcrt into the wheel. pyproject.toml names them.

Variables of the environment say how:

- CRT_BUILD_TREE names a build tree with libraries that are built. Otherwise they are built, by
  CMake with what CMAKE_ARGS says.
- CRT_BUNDLE=1 makes a wheel for other machines: it holds what libcrt links. Otherwise the wheel
  uses the libraries of this machine.
"""

import importlib.util
import os
import pathlib
import re
import shutil

from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel  # of setuptools 70 or later
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).resolve().parent

# setuptools wants it to be there.
(HERE.parents[1] / "build/python").mkdir(parents=True, exist_ok=True)


def _native():
    """Loads the module beside this one, which belongs to no package."""
    spec = importlib.util.spec_from_file_location("crt_native", HERE / "native.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _bundles() -> bool:
    return os.environ.get("CRT_BUNDLE", "") not in ("", "0")


class BuildPy(build_py):
    """Copies the package, and adds the libraries."""

    def run(self) -> None:
        if self.editable_mode:
            super().run()
            return  # the package stays where it is; CRT_LIBRARY names the library
        shutil.rmtree(pathlib.Path(self.build_lib) / "crt", ignore_errors=True)  # of another time
        super().run()
        native = _native()
        libraries = native.built(os.environ.get("CRT_BUILD_TREE"))
        native.put(libraries, pathlib.Path(self.build_lib) / "crt", _bundles())


class BdistWheel(bdist_wheel):
    """Makes a wheel for any Python on this kind of machine."""

    def initialize_options(self) -> None:
        super().initialize_options()
        self.distribution.has_ext_modules = lambda: True  # for all that setuptools knows

    def get_tag(self) -> tuple[str, str, str]:
        platform = super().get_tag()[2]
        if _bundles():
            # What was built here runs wherever the C library is not older than here.
            libc = re.fullmatch(r"glibc (\d+)\.(\d+)", os.confstr("CS_GNU_LIBC_VERSION"))
            platform = platform.replace("linux", f"manylinux_{libc[1]}_{libc[2]}", 1)
        return "py3", "none", platform
