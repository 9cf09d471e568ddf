"""This module finds or builds the libraries that go into a Python wheel, and puts them in place.

The package looks for them in crt/_native. There the loader of libcrt finds its module for image
files (see module_loader.cpp): first the one with OpenImageIO, which the system may have or not, and
then the one that knows PNG alone.

    crt/_native/libcrt.so.1
    crt/lib/crt/crt_image_files.so       with OpenImageIO
    crt/_native/crt/crt_image_files.so   PNG alone
    crt/_native/lib*.so.*                what libcrt links, if the wheel is for other machines
    crt/_native/licenses/                and their licences
"""

import ctypes
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[2]

# Every system that a wheel is for has these: see PEP 600 and the policy of manylinux.
PLATFORM = re.compile(
    r"ld-linux.*|lib(c|m|dl|pthread|rt|stdc\+\+|gcc_s|z)\.so\..*|linux-vdso\.so\..*"
)
LOADED_BY_NAME = {"libtbb.so.12": "libtbbmalloc.so.2"}  # by TBB itself, from beside it

FREE_TYPE = "libfreetype.so.6"


def built(build_tree: str | None) -> pathlib.Path:
    """Returns the folder of the libraries of a build tree, or builds them if none is given."""
    if build_tree:
        return pathlib.Path(build_tree).resolve() / "lib"
    tree = SOURCE / "build/wheel"
    left_out = ("BUILD_TESTS", "BUILD_EXAMPLES", "BUILD_CLI", "WITH_STUDIO", "WITH_SERVICE")
    options = [f"-DCRT_{part}=OFF" for part in left_out]
    if shutil.which("ninja"):
        options.append("-GNinja")
    options += shlex.split(os.environ.get("CMAKE_ARGS", ""))
    configure = ["cmake", "-S", SOURCE, "-B", tree, "-DCMAKE_BUILD_TYPE=Release"]
    subprocess.run([*configure, "-DCRT_BUILD_PYTHON=ON", *options], check=True)
    jobs = str(os.cpu_count() or 1)
    subprocess.run(["cmake", "--build", tree, "-j", jobs], check=True)
    return tree / "lib"


def put(libraries: pathlib.Path, package: pathlib.Path, bundle: bool) -> None:
    """Copies the libraries into the package. With `bundle`, what they link comes along."""
    native = package / "_native"
    files = {
        libraries / "libcrt.so.1": native / "libcrt.so.1",
        libraries / "crt/crt_image_files.so": package / "lib/crt/crt_image_files.so",
        libraries / "crt_png/crt_image_files.so": native / "crt/crt_image_files.so",
    }
    for folder in (native, package / "lib"):
        shutil.rmtree(folder, ignore_errors=True)
    for source, target in files.items():
        if not source.exists() and "crt_png" in source.parts:
            continue  # there was no libpng
        target.parent.mkdir(parents=True, exist_ok=True)
        _copy_stripped(source, target)
    licences = native / "licenses"
    licences.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(SOURCE / "share/fonts/LICENSE.Liberation", licences / "LiberationSans.txt")
    if bundle:
        found: dict[str, str] = {}
        for file in (native / "libcrt.so.1", native / "crt/crt_image_files.so"):
            if file.exists():
                _bundle(file, native, found)
        _bring_along(FREE_TYPE, native, found)


def _bring_along(name: str, native: pathlib.Path, found: dict[str, str]) -> None:
    """Copies a library that libcrt loads by its name when it is needed, and what that links."""
    try:
        ctypes.CDLL(name)
    except OSError:
        return  # the system that the wheel runs on may have it
    maps = pathlib.Path("/proc/self/maps").read_text()
    (library,) = {pathlib.Path(place) for place in re.findall(rf"(/\S*/{name}\S*)$", maps, re.M)}
    _copy_stripped(library, native / name)
    _add_licence(library, native / "licenses")
    _bundle(native / name, native, found)


def _copy_stripped(source: pathlib.Path, target: pathlib.Path) -> None:
    shutil.copyfile(source.resolve(), target)
    target.chmod(0o755)
    if shutil.which("strip"):
        subprocess.run(["strip", "--strip-unneeded", target], check=True)


def _bundle(file: pathlib.Path, native: pathlib.Path, found: dict[str, str]) -> None:
    """Brings along what a file links, under names of our own. So no other package's build of the
    same library takes its place, nor does ours take that one's. `found` has what is there."""
    for name, path in _links(file):
        if name not in found:
            content = path.read_bytes()
            stem, _, version = name.partition(".so")
            found[name] = f"{stem}-{hashlib.sha256(content).hexdigest()[:8]}.so{version}"
            ours = native / found[name]
            _copy_stripped(path, ours)
            _add_licence(path, native / "licenses")
            _bundle(ours, native, found)
            _patch("--set-soname", found[name], ours)
            if name in LOADED_BY_NAME:
                beside = path.with_name(LOADED_BY_NAME[name])
                if beside.exists():
                    _copy_stripped(beside, native / beside.name)
        _patch("--replace-needed", name, found[name], file)
    up = "/.." if file.parent != native else ""
    _patch("--set-rpath", f"$ORIGIN{up}", file)


def _links(file: pathlib.Path) -> list[tuple[str, pathlib.Path]]:
    """Returns the names and places of the libraries that a file names, but for the platform's."""
    needed = _output("patchelf", "--print-needed", file).split()
    places = dict(re.findall(r"(\S+) => (/\S+)", _output("ldd", file)))
    links = []
    for name in needed:
        if PLATFORM.fullmatch(name):
            continue
        if name not in places:
            raise RuntimeError(f"{name}, which {file} links, is not installed")
        links.append((name, pathlib.Path(places[name]).resolve()))
    return links


def _add_licence(library: pathlib.Path, folder: pathlib.Path) -> None:
    """Copies the copyright file of the Debian package that a library is from."""
    if not shutil.which("dpkg-query"):
        return
    usual = pathlib.Path(str(library).removeprefix("/usr"))  # if /lib is a link to /usr/lib
    for path in (library, usual):
        done = subprocess.run(["dpkg-query", "-S", path], capture_output=True, text=True)
        package = done.stdout.partition(":")[0]
        licence = pathlib.Path("/usr/share/doc", package, "copyright")
        if done.returncode == 0 and licence.exists():
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(licence, folder / f"{package}.txt")
            return


def _patch(*arguments: str | pathlib.Path) -> None:
    subprocess.run(["patchelf", *arguments], check=True)


def _output(*command: str | pathlib.Path) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout
