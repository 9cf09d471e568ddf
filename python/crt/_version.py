"""This is the version of the package, which is that of CRT."""

__version__ = "1.1.0"
