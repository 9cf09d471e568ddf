"""These tests check where entities are, and what operators make of them."""

import math
import pathlib
import tempfile
import unittest

import numpy as np
from support import INFINITY, shell

import crt


def crossings(entity: crt.Entity, origin=(-5, 0, 0), direction=(1, 0, 0)) -> list[float]:
    hits = crt.Scene([entity]).prepare().crossings(crt.ray(origin, direction, -INFINITY))
    return [round(float(t), 9) for t in hits["t"]]


class Primitives(unittest.TestCase):
    def test_each_is_where_its_arguments_say(self):
        x = 5  # the ray begins at x = -5
        cases = [
            (crt.Empty(), []),
            (crt.Sphere((1, 0, 0), 1), [x, x + 2]),
            (crt.Box((1, 1, 1), (-1, -1, -1)), [x - 1, x + 1]),
            (crt.RoundedBox((1, 1, 1), (-1, -1, -1), 0.5), [x - 1, x + 1]),
            (crt.RoundedBox((1, 0, 1), (-1, -4, -1), 1), []),
            (crt.Plane((-1, 0, 0), (2, 0, 0)), [x + 2]),
            (crt.HalfPlane((1, 0, 0), (2, -1, 0), (0, 1, 0)), [x + 2]),
            (crt.HalfPlane((1, 0, 0), (2, 1, 0), (0, 1, 0)), []),
            (crt.Cylinder((-2, 0, 0), (3, 0, 0), 1), [x - 2, x + 3]),
            (crt.Cone((0, 0, 0), (4, 0, 0), 1), [x, x + 4]),
            (crt.Cone((0, -1, 0), (0, 1, 0), 3, 1), [x - 2, x + 2]),
            (crt.Capsule((-2, 0, 0), (2, 0, 0), 1), [x - 3, x + 3]),
            (crt.Capsule((1, -1, 0), (1, 1, 0), 1), [x, x + 2]),
            (crt.Ellipsoid((1, 0, 0), (2, 0.5, 1)), [x - 1, x + 3]),
            (crt.Torus((0, 0, 0), (0, 1, 0), 2, 0.5), [x - 2.5, x - 1.5, x + 1.5, x + 2.5]),
            (crt.Extrusion([(1, 1), (1, -1), (-1, 0)], (2, 0, 0), (3, 0, 0)), [x + 2, x + 3]),
            (crt.Extrusion([[(2, 0, 1), (-2, 0, 1)]], (0, 0, -1), (0, 0, 1)), [x - 2, x + 2]),
            (crt.Revolution([(0, -1), (0, 1, 1)], (1, 0, 0), (1, 1, 0)), [x, x + 2]),
            (
                crt.Revolution([(1, -1), (2, -1), (2, 1), (1, 1)], (3, 0, 0), (3, 0, 1), 270),
                [x + 1, x + 2],
            ),
            (
                crt.Sweep([(1, 0, 1), (-1, 0, 1)], [(0, -4, 0), (0, 4, 0), (4, 4, 0)], 2),
                [x - 1, x + 1],
            ),
            (
                crt.Sweep(
                    [(1, 1), (-1, 1), (-1, -1), (1, -1)],
                    [(-4, 0, 0), (4, 0, 0), (4, 0, 8), (-4, 0, 8)],
                    up=(0, 2, 0),
                    closed=True,
                ),
                [0, x + 5],
            ),
            (crt.Tube([(0, -2, 0), (0, 2, 0)], 1), [x - 1, x + 1]),
            (
                crt.Polyhedron(
                    [(-1, -1, -1), (3, -1, -1), (-1, 3, -1), (-1, -1, 3)],
                    [(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 2, 3)],
                ),
                [x - 1, x + 1],
            ),
            (crt.Hull([(-1, -2, 0), (-1, 2, 2), (-1, 2, -2), (1, 0, 0)]), [x - 1, x + 1]),
            (
                crt.ShapedExtrusion([(-1, -1), (3, -1), (3, 1), (-1, 1)], 2, bevel=0.5).moved(
                    (0, 0, -1)
                ),
                [x - 1, x + 3],
            ),
            (crt.Helix((0, 0, -4), (0, 0, 4), 2, 0.5, 8 / 3), [x - 2.5, x - 1.5]),
            (crt.Thread((-1, 0, 0), (3, 0, 0), 8, 1.25), [x - 1, x + 3]),
            (crt.Tube([(0, 0, 0), (2, 0, 0)], [1, 0]), [x - 1, x + 2]),
            (crt.HeightField([[1, 1], [1, 1]], (1, 1, 1), (-2, -1, -1)), [x - 2, x + 1]),
            (crt.HeightField([[0, 1, 0], [0, 1, 0]], (-2, -2, -2), (2, 2, 2)), [x - 1, x + 1]),
            (crt.Quadric((1, 2, 3), (0, 0, 0), (-2, 0, 0), -3), [x - 1, x + 3]),
            (crt.Quadric((0, 0, 0), (0, 2, 0), (0, 1, -1), 0), []),
            (crt.Quadric((-1, 0, 0), (2, 0, 0), (0, 1, 0), 4), [x - 2, x + 2]),
            (crt.Implicit("y ** 2 - 4", (-1, -1, -1), (1, 1, 1)), [x - 1, x + 1]),
            (crt.Blob([((0, 0, 0), 2, 2)], 9 / 8), [x - 1, x + 1]),
            (crt.Superellipsoid(1, 1), [x - 1, x + 1]),
            (crt.Disc((1, 0, 0), (1, 0, 0), 1), [x + 1]),
            (crt.Triangle((1, -1, -1), (1, 2, -1), (1, 0, 2)), [x + 1]),
            (crt.Mesh([[1, -1, -1], [1, 2, -1], [1, 0, 2]], [[0, 1, 2]]), [x + 1]),
        ]
        for entity, expected in cases:
            self.assertEqual(crossings(entity), expected, type(entity).__name__)

    def test_the_empty_one_is_what_the_empty_set_is(self):
        ball, nothing = crt.Sphere((0, 0, 0), 1), crt.Empty(material=crt.Material(), id=4)
        for same in (ball + nothing, nothing + ball, ball - nothing):
            self.assertEqual((crossings(same), same.primitive_count), ([4, 6], 1))
        for empty in (nothing, ball ^ nothing, nothing - ball, nothing.moved((1, 2, 3))):
            self.assertEqual(
                (crossings(empty), empty.primitive_count, empty.is_solid), ([], 0, True)
            )

    def test_an_entity_is_described_with_its_parts_behind_it(self):
        red = crt.Material(color=(1, 0, 0))
        cut = crt.Box((0, 0, 0), (1, 1, 1)) - crt.Sphere((0, 0, 0), 0.5)
        placed, difference, box, ball = cut.moved((2, 0, 0)).with_material(red).describe()
        self.assertEqual((placed["kind"], placed["parent"]), ("Placed", None))
        self.assertEqual(placed["values"]["translation"], [2, 0, 0])
        self.assertEqual(placed["values"]["color"], [1, 0, 0])
        self.assertEqual(difference, {"kind": "Difference", "parent": 0, "values": {}})
        self.assertEqual((box["kind"], box["parent"]), ("Box", 1))
        values = {"center": [0, 0, 0], "radius": 0.5}
        self.assertEqual(ball, {"kind": "Sphere", "parent": 1, "values": values})

    def test_a_mesh_takes_whole_numbers_below_the_number_of_positions(self):
        corners = np.eye(3)
        for wrong in ([[0, 1, 3]], [[0, 1, -1]], [[0.0, 1.0, 2.0]], [0, 1, 2]):
            with self.assertRaises(ValueError):
                crt.Mesh(corners, wrong)

    def test_a_mesh_has_normals_texture_coordinates_and_materials(self):
        corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])
        triangles = [[0, 1, 2], [1, 3, 2]]
        colors = [crt.Material(color=(1, 0, 0)), crt.Material(color=(0, 1, 0))]
        mesh = crt.Mesh(
            corners,
            triangles,
            normals=[[0, 0.6, -0.8]],
            normal_indices=np.zeros((2, 3), int),
            uv=2 * corners[:, :2],
            materials=colors,
            material_of_triangle=[0, 1],
        )
        places = [(0.25, 0.25, -1), (0.75, 0.75, -1)]
        hits = crt.Scene([mesh]).prepare().intersect(crt.rays(places, (0, 0, 1)))
        np.testing.assert_array_equal(hits["u"], [0.5, 1.5])
        camera = crt.Camera(position=(0.25, 0.25, -1), pointing=(0.25, 0.25, 0))
        settings = crt.Settings(width=1, height=1)
        for entity, color in ((mesh, [1, 0, 0]), (mesh.with_material(colors[1]), [0, 1, 0])):
            scene = crt.Scene([entity], camera=camera, settings=settings)
            image = scene.prepare().render(aovs=["albedo", "normal"])
            channels = [image.channels[f"albedo.{c}"][0, 0] for c in "RGB"]
            self.assertEqual(channels, color)
            self.assertAlmostEqual(float(image.channels["N.Y"][0, 0]), 0.6, 6)
        for wrong in (
            {"normals": [[0, 0, 1]]},
            {"normals": [[0, 0, 1]], "normal_indices": [[0, 0, 1], [0, 0, 0]]},
            {"normals": [[0, 0, math.nan]] * 4},
            {"uv": [[0, 0, 0]] * 4},
            {"uv_indices": [[0, 0, -1], [0, 0, 0]], "uv": [[0, 0]]},
            {"material_of_triangle": [0]},
            {"material_of_triangle": [0, 2], "materials": colors},
            {"smooth": 3.2},
        ):
            with self.assertRaises((ValueError, crt.Error), msg=wrong):
                crt.Mesh(corners, triangles, **wrong)

    def test_triangles_of_a_mesh_have_materials_of_either_kind(self):
        corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]
        brass = crt.PrincipledMaterial(color=(0, 0.5, 1), metallic=1)
        materials = [crt.Material(color=(1, 0, 0)), brass]
        settings = crt.Settings(width=1, height=1)

        def colors_of(**attributes):
            mesh = crt.Mesh(corners, [[0, 1, 2], [1, 3, 2]], **attributes)
            for x in (0.25, 0.75):
                camera = crt.Camera(position=(x, x, -1), pointing=(x, x, 0))
                scene = crt.Scene([mesh], camera=camera, settings=settings)
                image = scene.prepare().render(aovs=["albedo"])
                yield [float(image.channels[f"albedo.{c}"][0, 0]) for c in "RGB"]

        red, blue = [1, 0, 0], [0, 0.5, 1]
        both = {"materials": materials, "material_of_triangle": [0, 1]}
        self.assertEqual(list(colors_of(**both)), [red, blue])
        self.assertEqual(list(colors_of(**{**both, "material_of_triangle": [1, 0]})), [blue, red])
        self.assertEqual(list(colors_of(materials=[brass])), [blue, blue])
        self.assertEqual(list(colors_of(**both, material=brass)), [blue, blue])
        for wrong in (None, "brass", crt.Camera()):
            with self.assertRaisesRegex(TypeError, r"Mesh: materials\[1\] must be a Material"):
                crt.Mesh(corners, [[0, 1, 2]], materials=[brass, wrong])
        brass.metallic = 2
        with self.assertRaisesRegex(crt.Error, "metallic"):
            crt.Mesh(corners, [[0, 1, 2]], materials=[brass])

    def test_a_mesh_has_a_rule_of_what_is_inside_and_a_report(self):
        bits = np.array([[i >> axis & 1 for axis in range(3)] for i in range(8)])
        sides = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
        box = np.array([t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))])
        positions = np.vstack((4 * bits, 1 + bits))
        indices = np.vstack((box, box + 8))
        ray = crt.rays([(1.5, 1.25, -1)], (0, 0, 1))
        for fill, count in (("evenodd", 4), ("nonzero", 2)):
            mesh = crt.Mesh(positions, indices, fill=fill)
            self.assertEqual(len(crt.Scene([mesh]).prepare().crossings(ray[0])), count)
            report = crt.mesh_report(mesh)
            self.assertEqual((report.fill, report.shells, report.overlapping_shells), (fill, 2, 1))
            self.assertEqual(report.first_overlap[0], 1)
            self.assertEqual(len(report.warnings), 1)
        loose = positions[indices.ravel()] + np.linspace(0, 1e-7, indices.size)[:, None]
        corners = np.arange(indices.size).reshape(-1, 3)
        self.assertFalse(crt.Mesh(loose, corners).is_solid)
        welded = crt.Mesh(loose, corners, weld=1e-6, stitch=1e-6)
        self.assertTrue(welded.is_solid)
        self.assertEqual(crt.mesh_report(welded).welded_vertices, indices.size - 16)
        for wrong in ({"fill": "odd"}, {"weld": -1}, {"stitch": 1e101}, {"weld": math.nan}):
            with self.assertRaises(ValueError, msg=wrong):
                crt.Mesh(positions, indices, **wrong)
        with self.assertRaises(crt.Error):
            crt.mesh_report(crt.Sphere((0, 0, 0), 1))
    def test_a_height_field_takes_rows_of_numbers_from_0_to_1(self):
        for wrong in ([1, 2], [[1, 2], [3]], [["a"]], np.ones((2, 2, 2))):
            with self.assertRaises((ValueError, TypeError)):
                crt.HeightField(wrong, (0, 0, 0), (1, 1, 1))
        for wrong in ([[1]], [[1, 2], [0, 0]], [[0, 0], [0, float("nan")]], np.ones((0, 5))):
            with self.assertRaises(crt.Error):
                crt.HeightField(wrong, (0, 0, 0), (1, 1, 1))

    def test_a_field_that_is_wrong_says_where(self):
        ball = crt.Implicit("x ** 2 + y ** 2 + z ** 2 - 1", (-1, -1, -1), (1, 1, 1))
        self.assertTrue(ball.is_solid)
        for wrong, place in (("x +", "1:4"), ("x + w", "1:5"), ("x <\n 1", "1:3")):
            with self.assertRaisesRegex(crt.Error, place):
                crt.Implicit(wrong, (-1, -1, -1), (1, 1, 1))
        with self.assertRaises(TypeError):
            crt.Implicit(5, (-1, -1, -1), (1, 1, 1))
        with self.assertRaises(crt.Error):
            crt.Implicit("x", (1, 1, 1), (-1, -1, -1))

    def test_blobs_and_superellipsoids_check_their_numbers(self):
        line = crt.Blob([((0, 0, 0), (1, 0, 0), 1, 1), ((0, 1, 0), 1, -0.5)], 0.5)
        self.assertTrue(line.is_solid)
        for wrong in (5, [1], [((0, 0, 0), 1)], [((0, 0), 1, 1)], [("a", 1, 1)]):
            with self.assertRaises(TypeError):
                crt.Blob(wrong, 0.5)
        for parts, threshold in (([], 1), ([((0, 0, 0), 1, 1)], 0), ([((0, 0, 0), 0, 1)], 1)):
            with self.assertRaises(crt.Error):
                crt.Blob(parts, threshold)
        with self.assertRaises(crt.Error):
            crt.Superellipsoid(0, 1)

    def test_a_mesh_file_is_read_and_a_broken_one_says_where(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "one.obj")
            path.write_text("v 1 -1 -1\nv 1 2 -1\nv 1 0 2\nf 1 2 3\n")
            mesh = crt.load_mesh(path, material=crt.Material(), id=7)
            self.assertEqual(crossings(mesh), [6])
            path.write_text("v 1 -1 -1\nf 1 2 3\n")
            with self.assertRaisesRegex(crt.Error, "line 2: there is no vertex 2"):
                crt.load_mesh(str(path))

    def test_what_cannot_be_is_an_error_that_says_so(self):
        with self.assertRaisesRegex(crt.Error, "radius"):
            crt.Sphere((0, 0, 0), -1)
        with self.assertRaises(crt.Error):
            crt.Sphere((0, 0, float("nan")), 1)


class Operators(unittest.TestCase):
    left, right = crt.Sphere((-0.5, 0, 0), 1), crt.Sphere((0.5, 0, 0), 1)

    def test_sum_difference_and_intersection(self):
        self.assertEqual(crossings(self.left + self.right), [3.5, 6.5])
        self.assertEqual(crossings(self.left - self.right), [3.5, 4.5])
        self.assertEqual(crossings(self.left ^ self.right), [4.5, 5.5])

    def test_those_of_sets_are_the_same(self):
        self.assertEqual(crossings(self.left | self.right), crossings(self.left + self.right))
        self.assertEqual(crossings(self.left & self.right), crossings(self.left ^ self.right))

    def test_they_leave_their_operands_as_they_are(self):
        whole = self.left
        whole -= self.right
        self.assertEqual(crossings(self.left), [3.5, 5.5])
        self.assertEqual(crossings(whole), [3.5, 4.5])

    def test_functions_take_any_number(self):
        parts = [crt.Sphere((x, 0, 0), 0.5) for x in (0, 2, 4)]
        self.assertEqual(
            crossings(crt.union(part for part in parts)), [4.5, 5.5, 6.5, 7.5, 8.5, 9.5]
        )
        self.assertEqual(
            crossings(crt.difference(crt.Box((0, -1, -1), (4, 1, 1)), parts)), [5.5, 6.5, 7.5, 8.5]
        )
        self.assertEqual(crt.union(parts).primitive_count, 3)

    def test_surfaces_can_only_be_joined(self):
        disc = crt.Disc((0, 0, 0), (1, 0, 0), 1)
        self.assertFalse((disc + self.left).is_solid)
        with self.assertRaises(crt.Error):
            self.left - disc

    def test_other_operands_are_type_errors(self):
        with self.assertRaises(TypeError):
            self.left + 1


class Transforms(unittest.TestCase):
    def test_moving_and_scaling(self):
        self.assertEqual(crossings(crt.Sphere((0, 0, 0), 1).moved((2, 0, 0))), [6, 8])
        self.assertEqual(crossings(crt.Sphere((1, 0, 0), 1).scaled(2)), [5, 9])
        self.assertEqual(crossings(crt.Sphere((1, 0, 0), 1).scaled((3, 1, 1))), [5, 11])

    def test_a_matrix_of_three_or_four_rows(self):
        matrix = np.array([[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        self.assertEqual(crossings(crt.Sphere((0, 0, 0), 1).transformed(matrix)), [6, 8])
        self.assertEqual(crossings(crt.Sphere((0, 0, 0), 1).transformed(matrix[:3])), [6, 8])
        with self.assertRaises(ValueError):
            crt.Sphere((0, 0, 0), 1).transformed(np.eye(3))

    def test_rotating_goes_the_way_that_it_does_in_scripts(self):
        box = "Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 2, 3) }"
        angles = 20.0, -50.0, 200.0
        script = f"Scene {{ {box} <rotate vec3{angles}> }}"
        there = crt.Scene.from_script(script).prepare()
        here = crt.Scene([crt.Box((0, 0, 0), (1, 2, 3)).rotated(angles)]).prepare()
        random = np.random.default_rng(1)
        rays = crt.rays(2000)
        rays["origin"] = random.normal(size=(2000, 3)) * 5
        rays["direction"] = random.normal(size=(2000, 3)) - rays["origin"]
        expected, found = there.intersect(rays)["t"], here.intersect(rays)["t"]
        self.assertGreater(np.isfinite(expected).sum(), 500)
        np.testing.assert_allclose(found, expected, rtol=1e-12)

    def test_turning_about_a_line_and_mirroring_are_those_of_scripts(self):
        box = "Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 2, 3) }"
        here = crt.Box((0, 0, 0), (1, 2, 3))
        made = here.rotated_about((1, 2, 3), 40, (1, 0, -1)).mirrored((1, 1, 0), (0, 2, 0))
        self.assertIn(".rotated_about((1, 2, 3), 40, (1, 0, -1))", repr(made))
        script = (
            f"Scene {{ {box} <rotate 40 axis vec3(1, 2, 3) about vec3(1, 0, -1),"
            " mirror vec3(1, 1, 0) about vec3(0, 2, 0)> }"
        )
        there = crt.Scene.from_script(script).entities[0]
        expected, found = there.bounds, made.bounds
        np.testing.assert_allclose(found, expected, rtol=1e-12)
        self.assertEqual(here.mirrored((0, 0, 9)).contains((0.5, 0.5, -0.5)), 1)
        for vector in (0, 0, 0), (math.inf, 0, 0):
            with self.assertRaisesRegex(ValueError, "normal must be"):
                here.mirrored(vector)
            with self.assertRaisesRegex(ValueError, "axis must be"):
                here.rotated_about(vector, 30)

    def test_quarter_turns_are_exact(self):
        box = crt.Box((0.1, 0.2, 0.3), (1.7, 1.3, 1.1))
        turned = box.rotated((90, 0, 0)).rotated((270, 0, 0))
        turned = turned.rotated((0, 0, -90)).rotated((0, 0, 90))
        self.assertEqual(crossings(box - turned, (-5, 0.7, 0.7)), [])


class Materials(unittest.TestCase):
    def test_with_material_paints_what_has_none(self):
        red, blue = crt.Material(color=(1, 0, 0)), crt.Material(color=(0, 0, 1))
        pair = (
            crt.Sphere((-1, 0, 3), 0.5, material=red) + crt.Sphere((1, 0, 3), 0.5)
        ).with_material(blue)
        scene = crt.Scene(
            [pair],
            [crt.Light.point(origin=(0, 0, 0))],
            crt.Camera(),
            None,
            crt.Settings(width=40, height=20),
        )
        pixels = scene.render().pixels
        left, right = pixels[10, 14, :3], pixels[10, 25, :3]
        self.assertGreater(left[0], 0.1)
        self.assertGreater(right[2], 0.1)
        self.assertEqual((left[2], right[0]), (0, 0))

    def test_light_and_the_camera_may_pass_an_entity(self):
        ball = crt.Sphere((0, 0, 0), 1)
        scene = crt.Scene([ball.with_visible(False).with_shadow(False)])
        scene.settings.set(width=3, height=3, no_head_light=1)
        scene.background = crt.Background(color=(0.25, 0.5, 0.75))
        np.testing.assert_array_equal(scene.render().pixels[1, 1], [0.25, 0.5, 0.75, 1])
        self.assertEqual(len(scene.prepare().crossings(crt.ray((0, 0, -5), (0, 0, 1)))), 2)
        with self.assertRaisesRegex(crt.Error, "'visible' false, which is of whole entities"):
            ball - ball.with_visible(False)
        with self.assertRaisesRegex(TypeError, "with_shadow: casts must be True or False, not 1"):
            ball.with_shadow(1)
        self.assertIn("with_shadow(False)", repr(ball.with_shadow(np.bool_(False))))

    def test_principled_materials_paint_as_others_do(self):
        brass = crt.PrincipledMaterial(color=(1, 0, 0), roughness_map=crt.Pattern.noise(scale=2))
        light = crt.Light.point(origin=(0, 0, -3))
        settings = crt.Settings(width=20, height=20)
        given = crt.Sphere((0, 0, 0), 0.5, material=brass)
        self.assertEqual(given.material.roughness_map.scale, 2)
        pictures = [
            crt.Scene([ball], [light], crt.Camera(), None, settings).render().pixels
            for ball in (given, crt.Sphere((0, 0, 0), 0.5).with_material(brass))
        ]
        self.assertTrue((pictures[0] == pictures[1]).all())
        self.assertGreater(pictures[0][10, 10, 0], 0.1)
        self.assertLess(pictures[0][10, 10, 2], pictures[0][10, 10, 0] / 2)
        with self.assertRaisesRegex(crt.Error, "roughness"):
            crt.Sphere((0, 0, 0), 1, material=crt.PrincipledMaterial(roughness=2))

    def test_ids_are_reported(self):
        prepared = crt.Scene(
            [crt.Sphere((9, 0, 0), 1), crt.Sphere((0, 0, 0), 1, id=77), shell()]
        ).prepare()
        self.assertEqual(
            list(prepared.crossings(crt.ray((-5, 0, 0), (1, 0, 0)))["entity_id"][[0, -1]]), [77, 0]
        )


class Arguments(unittest.TestCase):
    def test_they_are_read_back(self):
        red = crt.Material(color=(1, 0, 0), pattern=crt.Pattern.wood(scale=2))
        cone = crt.Cone((0, 0, 0), np.array([0, 1, 0]), np.float32(2), 1, material=red, id=7)
        self.assertEqual((cone.start, cone.end), ((0, 0, 0), (0, 1, 0)))
        self.assertEqual((cone.radius, cone.radius2, cone.id), (2, 1, 7))
        self.assertEqual(cone.material, red)
        ball = crt.Sphere((1, 2, 3), 4)
        self.assertEqual((ball.center, ball.radius), ((1, 2, 3), 4))
        self.assertEqual((ball.material, ball.id), (None, None))

    def test_they_do_not_change(self):
        red = crt.Material(color=(1, 0, 0), pattern=crt.Pattern.wood(scale=2))
        ball = crt.Sphere((1, 2, 3), 4, material=red)
        red.color, red.pattern.scale = (0, 1, 0), 5
        self.assertEqual((ball.material.color, ball.material.pattern.scale), ((1, 0, 0), 2))
        with self.assertRaisesRegex(AttributeError, "crt.Sphere has no 'radius' that can be assig"):
            ball.radius = 5
        for change in (
            lambda: ball.material.set(color=(0, 0, 1)),
            lambda: ball.material.pattern.set(scale=3),
            lambda: ball.material.pattern.set(colors=None),
        ):
            with self.assertRaisesRegex(AttributeError, "an entity keeps a material of its own"):
                change()

    def test_a_representation_has_what_is_not_the_default(self):
        red = crt.Material(color=(1, 0, 0), pattern=crt.Pattern.wood(scale=2))
        ball = crt.Sphere((1, 2, 3), 4, material=red, id=7)
        expected = (
            "Sphere(center=(1, 2, 3), radius=4, material=Material(color=(1, 0, 0),"
            " pattern=Pattern(type='wood', scale=2)), id=7)"
        )
        self.assertEqual(repr(ball), expected)
        self.assertEqual(
            repr(ball.moved((1, 0, 0)).with_id(3)),
            f"<crt.Entity: solid of 1 primitive, {expected}.moved((1, 0, 0)).with_id(3)>",
        )
        self.assertEqual(
            repr((ball - ball).scaled(2)), "<crt.Entity: solid of 2 primitives, .scaled(2)>"
        )
        spun = crt.Sphere((0, 0, 0), 1)
        for _ in range(9):
            spun = spun.rotated((0, 90, 0))
        calls = ".rotated((0, 90, 0))" * 3
        self.assertIn(f"Sphere(center=(0, 0, 0), radius=1) ... {calls}>", repr(spun))


class Lifetime(unittest.TestCase):
    def test_a_closed_entity_cannot_be_used_but_what_is_made_of_it_can(self):
        ball = crt.Sphere((0, 0, 0), 1)
        with ball:
            moved = ball.moved((1, 0, 0))
        with self.assertRaisesRegex(ValueError, "this Sphere is closed"):
            ball.moved((1, 0, 0))
        ball.close()
        self.assertEqual(crossings(moved), [5, 7])
