"""Describes what the measurements were made on."""

import os
import pathlib
import platform
import subprocess

PACKAGES = {"povray": "POV-Ray", "libembree-dev": "Embree", "g++": "g++"}


def field(file: str, name: str, separator: str) -> str:
    for line in pathlib.Path(file).read_text().splitlines():
        key, found, value = line.partition(separator)
        if found and key.strip() == name:
            return value.strip().strip('"')
    return "unknown"


def output(command: list[str], folder: pathlib.Path | None = None) -> str:
    try:
        return subprocess.run(
            command, capture_output=True, text=True, check=True, cwd=folder
        ).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def described(source: pathlib.Path) -> str:
    memory = int(field("/proc/meminfo", "MemTotal", ":").split()[0]) / 2**20
    versions = ", ".join(
        f"{name} {output(['dpkg-query', '-W', '-f=${Version}', package])}"
        for package, name in PACKAGES.items())
    return (f"{field('/proc/cpuinfo', 'model name', ':')} (model"
            f" {field('/proc/cpuinfo', 'model', ':')}),"
            f" {os.cpu_count()} cores, {memory:.0f} GiB of memory;"
            f" {field('/etc/os-release', 'PRETTY_NAME', '=')},"
            f" Linux {platform.release()}; {versions};"
            f" CRT at commit {output(['git', 'rev-parse', '--short', 'HEAD'], source)}.")
