"""Writes what scenes are made of into files of their own: meshes and heights."""

import pathlib

import numpy as np

from .model import HeightField, Mesh, Panorama


def write_ply(path: pathlib.Path, mesh: Mesh) -> None:
    """Writes a mesh as binary PLY, in single precision."""
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh.positions)}\n"
              "property float x\nproperty float y\nproperty float z\n"
              f"element face {len(mesh.triangles)}\n"
              "property list uchar int vertex_indices\nend_header\n")
    faces = np.zeros(len(mesh.triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = mesh.triangles
    path.write_bytes(header.encode() + mesh.positions.astype("<f4").tobytes() + faces.tobytes())


def write_pgm(path: pathlib.Path, field: HeightField) -> None:
    """Writes heights as a binary PGM of 16 bits, whose first row is at the upper z."""
    rows, columns = field.heights.shape
    path.write_bytes(f"P5\n{columns} {rows}\n65535\n".encode()
                     + field.heights[::-1].astype(">u2").tobytes())


def write_ppm(path: pathlib.Path, panorama: Panorama) -> None:
    rows, columns, _ = panorama.pixels.shape
    path.write_bytes(f"P6\n{columns} {rows}\n255\n".encode()
                     + panorama.pixels.astype("u1").tobytes())
