"""A wheel is made of what is built, installed into a fresh virtual environment, and used there. No
network is needed. With CRT_RELEASE in the environment, the wheel is that in this folder, which is
to be released."""

import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile

from support import SOURCE

FOLDERS = ("cmake", "include", "python", "src")
BUILD_TREE = pathlib.Path(os.environ["CRT_LIBRARY"]).parents[1]

# What a user does. The first line says where the libraries are that libcrt links.
PROGRAM = """
import importlib.metadata, pathlib, re, sys, tempfile
import numpy as np
import crt

maps = pathlib.Path("/proc/self/maps").read_text()
print(*sorted(set(re.findall(r"/.*/lib(?:crt|embree|tbb)[^/]*\\.so.*", maps))))
assert crt.__version__ == importlib.metadata.version("crt")
scene = crt.Scene([crt.Sphere((0, 0, 0), 1)], [crt.Light.point(origin=(-3, 4, -5))])
scene.camera.position = (0, 0, -4)
scene.settings.set(width=40, height=30, title="Größe")
image = scene.render()
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "ball.png"
    image.save(file)
    np.testing.assert_array_equal(crt.Image.read(file).to_rgba8(), image.to_rgba8())
assert image._repr_png_().startswith(b"\\x89PNG")
try:
    print(len(image.encode("exr")) > 100)
except crt.Error as error:
    print(error.status.name, error)
"""


def run(*command: object, **environment: str) -> str:
    """Runs a program in an environment of its own, which names neither package nor library."""
    kept = {name: os.environ[name] for name in ("PATH", "HOME") if name in os.environ}
    done = subprocess.run(
        list(map(str, command)),
        env={**kept, "PIP_CONFIG_FILE": "/dev/null", "PIP_NO_INDEX": "1", **environment},
        capture_output=True,
        text=True,
    )
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        for program in ("patchelf", "ldd"):
            if not shutil.which(program):
                raise unittest.SkipTest(f"there is no {program} (Debian: patchelf)")
        for module in ("ensurepip", "pip", "setuptools", "wheel"):
            if importlib.util.find_spec(module) is None:
                raise unittest.SkipTest(f"this Python has no {module} (Debian: python3-{module})")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        source = cls.folder / "source"
        for folder_name in (*FOLDERS, "share"):
            ignored = shutil.ignore_patterns("__pycache__", ".*")
            shutil.copytree(SOURCE / folder_name, source / folder_name, ignore=ignored)
        for file in ("pyproject.toml", "LICENSE", "MANIFEST.in", "CMakeLists.txt"):
            shutil.copy(SOURCE / file, source)
        released = os.environ.get("CRT_RELEASE")
        if not released:
            make = "-m pip wheel . --no-build-isolation --no-deps --wheel-dir".split()
            run(
                "env", "-C", source, sys.executable, *make, cls.folder,
                CRT_BUILD_TREE=str(BUILD_TREE), CRT_BUNDLE="1",
            )  # fmt: skip
        (cls.wheel,) = pathlib.Path(released or cls.folder).glob("*.whl")
        run(sys.executable, "-m", "venv", "--system-site-packages", cls.folder / "venv")
        cls.python = cls.folder / "venv/bin/python"
        run(cls.python, "-m", "pip", "install", "--no-deps", cls.wheel)
        where = run(cls.python, "-c", "import crt; print(crt.__path__[0])")
        cls.package = pathlib.Path(where.strip())

    def test_its_name_says_where_it_runs(self):
        libc = os.confstr("CS_GNU_LIBC_VERSION").removeprefix("glibc ").replace(".", "_")
        cmake = (SOURCE / "CMakeLists.txt").read_text()
        version = re.search(r"^project\(crt VERSION ([\d.]+) ", cmake, re.MULTILINE)[1]
        self.assertEqual(self.wheel.name, f"crt-{version}-py3-none-manylinux_{libc}_x86_64.whl")

    def test_it_holds_types_licences_and_what_libcrt_links(self):
        names = zipfile.ZipFile(self.wheel).namelist()
        for name in ("crt/py.typed", "crt/values.pyi", "crt/_native/libcrt.so.1"):
            self.assertIn(name, names)
        for library in ("libembree", "libtbb", "libpng", "libfreetype"):
            found = [name for name in names if f"_native/{library}" in name]
            self.assertTrue(found, f"{library} of {names}")
            licences = [name for name in names if f"licenses/{library}" in name]
            self.assertTrue(licences or not shutil.which("dpkg"), f"{library} of {names}")
        self.assertTrue(any(name.endswith(".dist-info/LICENSE") for name in names))

    def test_it_runs_with_its_own_libraries(self):
        self.assertTrue(self.package.is_relative_to(self.folder), self.package)
        libraries, exr = run(self.python, "-c", PROGRAM).splitlines()
        self.assertGreaterEqual(len(libraries.split()), 3, libraries)
        for library in libraries.split():
            self.assertTrue(library.startswith(str(self.package / "_native")), library)
        self.assertEqual(exr, "True")

    def test_without_open_image_io_there_is_png_and_the_rest_is_an_error_that_says_so(self):
        module = self.package / "lib/crt/crt_image_files.so"
        whole = module.read_bytes()
        needed = run("patchelf", "--print-needed", module).split()
        (oiio,) = [name for name in needed if name.startswith("libOpenImageIO.so")]
        run("patchelf", "--replace-needed", oiio, "libNotThere.so", module)
        try:
            exr = run(self.python, "-c", PROGRAM).splitlines()[1]
        finally:
            module.write_bytes(whole)
        self.assertRegex(exr, "^UNSUPPORTED .*PNG files alone; those of openexr need OpenImageIO")

    def test_a_source_archive_has_what_a_build_needs(self):
        make = "from setuptools import build_meta; build_meta.build_sdist('made')"
        source = self.folder / "source"
        run("env", "-C", source, sys.executable, "-c", make)
        (archive,) = source.glob("made/*.tar.gz")
        with tarfile.open(archive) as content:
            names = {name.partition("/")[2] for name in content.getnames()}
        for folder in FOLDERS:
            files = {
                str(file.relative_to(source))
                for file in (source / folder).rglob("*")
                if file.is_file() and "__pycache__" not in file.parts
            }
            self.assertGreater(len(files), 5, folder)
            self.assertEqual(files - names, set())
        self.assertLessEqual({"CMakeLists.txt", "pyproject.toml", "LICENSE"}, names)
        library = {f"share/crt/{file.name}" for file in (SOURCE / "share/crt").glob("*.crt")}
        self.assertIn("share/crt/metals.crt", library)
        self.assertEqual(library - names, set())

    def test_its_program_runs(self):
        scene, depth = self.folder / "scene.crt", self.folder / "depth.png"
        scene.write_text("Scene { Sphere { center -> vec3(0, 0, 5) radius -> 1 } }")
        run(self.python, "-m", "crt.depth", scene, "-o", depth, "--width", 16, "--height", 16)
        self.assertEqual(depth.read_bytes()[1:4], b"PNG")
