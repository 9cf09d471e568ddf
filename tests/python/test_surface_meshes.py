"""These tests make triangles of solids, and files of them."""

import json
import math
import os
import struct
import tempfile
import unittest
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

import crt

PLATE = crt.Box((0, 0, 0), (4, 2, 1)) - crt.Cylinder((1, 1, -1), (1, 1, 2), 0.5)


def volume_of(mesh: crt.SurfaceMesh) -> float:
    a, b, c = np.moveaxis(mesh.positions[mesh.triangles], 1, 0)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def glb_chunks(content: bytes) -> tuple[Any, bytes]:
    magic, version, length = struct.unpack_from("<4sII", content)
    assert (magic, version, length) == (b"glTF", 2, len(content))
    size, kind = struct.unpack_from("<I4s", content, 12)
    assert kind == b"JSON" and size % 4 == 0
    binary_size, binary_kind = struct.unpack_from("<I4s", content, 20 + size)
    assert binary_kind == b"BIN\0"
    binary = content[28 + size :]
    assert len(binary) == binary_size and binary_size % 4 == 0
    return json.loads(content[20 : 20 + size]), binary


class Surfaces(unittest.TestCase):
    def test_triangles_are_within_the_deviation(self):
        mesh = PLATE.tessellate(0.01)
        self.assertLessEqual(mesh.deviation, 0.01)
        self.assertEqual(mesh.positions.dtype, np.float64)
        self.assertEqual(mesh.triangles.dtype, np.uint32)
        self.assertLess(mesh.triangles.max(), len(mesh.positions))
        self.assertAlmostEqual(volume_of(mesh), 8 - math.pi / 4, delta=0.05)
        distances = PLATE.distance(mesh.positions).distance
        self.assertLess(np.abs(distances).max(), 0.01)
        self.assertIn("triangles", repr(mesh))

    def test_arrays_keep_what_they_show(self):
        positions = PLATE.tessellate(0.1).positions
        self.assertTrue(np.isfinite(positions).all())
        with self.assertRaises(ValueError):
            positions[0] = 1

    def test_wrong_arguments_are_refused(self):
        with self.assertRaisesRegex(crt.Error, "deviation"):
            PLATE.tessellate(0)
        with self.assertRaisesRegex(TypeError, "tessellate: deviation"):
            PLATE.tessellate("fine")
        with self.assertRaisesRegex(crt.Error, "infinite"):
            crt.Plane((0, 1, 0)).tessellate(0.1)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.mesh = PLATE.tessellate(0.05)

    def test_each_format_is_read_again_as_the_same_solid(self):
        for name in ("a.stl", "a.obj", "a.ply", "a.3mf"):
            with self.subTest(name):
                self.mesh.write(self.folder / name)
                read = crt.load_mesh(self.folder / name)
                self.assertTrue(read.is_solid)
                self.assertAlmostEqual(read.volume().middle, volume_of(self.mesh), 4)

    def test_gltf_is_in_metres_with_names_and_colours(self):
        path = self.folder / "a.glb"
        crt.write_surface_meshes(
            path,
            [self.mesh, self.mesh],
            unit="mm",
            colors=[(1, 0.5, 0), (0, 0, 1, 0.5)],
            names=["lid", 'the "base"'],
        )
        document, binary = glb_chunks(path.read_bytes())
        self.assertEqual([mesh["name"] for mesh in document["meshes"]], ["lid", 'the "base"'])
        self.assertEqual(len(document["scenes"][0]["nodes"]), 2)
        for i, mesh in enumerate(document["meshes"]):
            primitive = mesh["primitives"][0]
            arrays = []
            for number in (primitive["attributes"]["POSITION"], primitive["indices"]):
                accessor = document["accessors"][number]
                view = document["bufferViews"][accessor["bufferView"]]
                kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
                part = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
                arrays.append((accessor, np.frombuffer(part, kind)))
            (accessor, numbers), (_, indices) = arrays
            positions = numbers.reshape(-1, 3)
            np.testing.assert_allclose(positions, 1e-3 * self.mesh.positions, rtol=1e-6, atol=1e-9)
            np.testing.assert_array_equal(positions.min(axis=0), np.float32(accessor["min"]))
            np.testing.assert_array_equal(positions.max(axis=0), np.float32(accessor["max"]))
            np.testing.assert_array_equal(indices.reshape(-1, 3), self.mesh.triangles)
            material = document["materials"][primitive["material"]]
            color = material["pbrMetallicRoughness"]["baseColorFactor"]
            self.assertEqual(color, [[1, 0.5, 0, 1], [0, 0, 1, 0.5]][i])

    def test_3mf_is_an_archive_with_its_unit(self):
        self.mesh.write(self.folder / "a.3mf", unit=crt.Unit.IN, color=(0, 1, 0), name="plate")
        with zipfile.ZipFile(self.folder / "a.3mf") as archive:
            self.assertIsNone(archive.testzip())
            self.assertIn("[Content_Types].xml", archive.namelist())
            model = archive.read("3D/3dmodel.model").decode()
        self.assertIn('unit="inch"', model)
        self.assertIn('displaycolor="#00FF00FF"', model)
        self.assertIn('name="plate"', model)

    def test_what_cannot_be_written_is_refused(self):
        with self.assertRaisesRegex(crt.Error, ".3mf"):
            self.mesh.write(self.folder / "a.step")
        with self.assertRaises(crt.Error):
            self.mesh.write(self.folder / "none" / "a.stl")
        with self.assertRaisesRegex(TypeError, "unit"):
            self.mesh.write(self.folder / "a.stl", unit="parsec")
        with self.assertRaisesRegex(TypeError, "colour"):
            self.mesh.write(self.folder / "a.stl", color=(1, 2))
        with self.assertRaisesRegex(ValueError, "names"):
            crt.write_surface_meshes(self.folder / "a.stl", [self.mesh], names=[])
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    unittest.main()
