# SPDX-License-Identifier: GPL-3.0-or-later
"""NumPy in and out."""

import unittest

import numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

import novelview
from support import DATA, disc_views


class Views(unittest.TestCase):
    def test_views_come_back_as_they_went_in(self):
        random = numpy.random.default_rng(1)
        items = disc_views()
        for item in items:
            item["image"] = random.integers(0, 256, item["image"].shape, numpy.uint8)
        views = novelview.views(items)
        self.assertEqual(novelview.names(views), [item["name"] for item in items])
        for number, item in enumerate(items):
            for back in (novelview.view(views, number), novelview.view(views, item["name"])):
                for key in ("image", "mask", "K", "R", "t"):
                    numpy.testing.assert_array_equal(back[key], item[key])

    def test_the_first_row_is_the_top_one(self):
        item = disc_views(count=1)[0]
        item["image"][0, 0] = (1, 2, 3)
        block = novelview.views([item]).GetBlock(0)
        # VTK's first point is the bottom-left pixel, so the top-left one begins the last row.
        self.assertEqual(block.GetPointData().GetArray("Color").GetTuple3(63 * 64), (1, 2, 3))

    def test_tuples_and_boolean_masks_will_do(self):
        item = disc_views(count=1)[0]
        views = novelview.views(
            [(item["image"], item["mask"] > 127, item["K"], item["R"], item["t"])]
        )
        numpy.testing.assert_array_equal(novelview.view(views, 0)["mask"], item["mask"])
        self.assertEqual(novelview.names(views), ["view0000"])

    def test_contour_distances_are_those_to_the_disc(self):
        block = novelview.views(disc_views(radius=20.0)).GetBlock(0)
        distance = novelview.image(block, "ContourDistance")
        rows, columns = numpy.mgrid[:64, :64]
        expected = 20 - numpy.hypot(rows - 31.5, columns - 31.5)
        # A binary mask knows its contour to half a pixel's diagonal.
        self.assertLess(abs(distance - expected).max(), 0.71)

    def test_without_a_mask_the_silhouette_is_taken_from_the_photograph(self):
        items = disc_views()
        given = [item.pop("mask") for item in items]
        views = novelview.views(items)
        for number, mask in enumerate(given):
            found = novelview.view(views, number)["mask"]
            # A disc of one colour before black: nothing to be mistaken, but for the rim's coverage.
            self.assertLess(numpy.mean((found > 127) != (mask > 127)), 0.005)

    def test_arrays_are_copies(self):
        items = disc_views()
        views = novelview.views(items)
        novelview.view(views, 0)["image"][:] = 7
        before = items[0]["image"].copy()
        items[0]["image"][:] = 9
        numpy.testing.assert_array_equal(novelview.view(views, 0)["image"], before)

    def test_a_data_set_read_is_one_that_can_be_put_together(self):
        read = novelview.read(DATA)
        made = novelview.views([novelview.view(read, name) for name in novelview.names(read)])
        self.assertEqual(novelview.names(made), novelview.names(read))
        for number in range(read.GetNumberOfBlocks()):
            for array in ("Color", "Mask", "ContourDistance"):
                numpy.testing.assert_array_equal(
                    novelview.image(made.GetBlock(number), array),
                    novelview.image(read.GetBlock(number), array),
                )

    def test_photographs_can_be_left_out(self):
        all_names = novelview.names(novelview.read(DATA))
        kept = novelview.names(novelview.read(DATA, exclude=all_names[:2]))
        self.assertEqual(kept, all_names[2:])
        with self.assertRaisesRegex(novelview.Error, "nobody.png"):
            novelview.read(DATA, exclude=["nobody.png"])

    def test_an_unknown_view_or_array_is_an_error_that_lists_the_known(self):
        views = novelview.views(disc_views())
        for which in ("disc9", 6, -1):
            with self.assertRaisesRegex(novelview.Error, "no view .*disc0, disc1"):
                novelview.view(views, which)
        with self.assertRaisesRegex(novelview.Error, "'Colour' .*Color, Mask"):
            novelview.image(views.GetBlock(0), "Colour")
        with self.assertRaises(novelview.Error):
            novelview.image(vtkImageData(), "Color")


class Cameras(unittest.TestCase):
    def test_matrices_come_back_as_they_went_in(self):
        item = disc_views()[2]
        camera = novelview.camera(item["K"], item["R"], item["t"], (64, 48))
        for back, given in zip(novelview.matrices(camera), (item["K"], item["R"], item["t"])):
            numpy.testing.assert_array_equal(back, given)
        self.assertEqual(camera.GetImageSize(), (64, 48))

    def test_half_way_between_two_views_is_on_their_circle(self):
        views = novelview.views(disc_views(count=6))
        camera = novelview.between(views, 0, "disc1")
        angle = numpy.pi / 6
        centre = [0.0, 0.0, 0.0]
        camera.GetCentre(centre)
        # The circle has radius 50; 1e-9 is some ten thousand roundings of doubles that large.
        numpy.testing.assert_allclose(
            centre, (50 * numpy.cos(angle), 0, 50 * numpy.sin(angle)), atol=1e-9
        )
        self.assertEqual(camera.GetImageSize(), (64, 64))

    def test_between_is_what_the_command_line_calls_so(self):
        views = novelview.read(DATA)
        ours = novelview.between(views, 1, 2, 0.25)
        theirs = novelview.read_camera(DATA, "between:1,2,0.25")
        for a, b in zip(novelview.matrices(ours), novelview.matrices(theirs)):
            numpy.testing.assert_array_equal(a, b)
        with self.assertRaisesRegex(novelview.Error, "beside:1,2"):
            novelview.read_camera(DATA, "beside:1,2")

    def test_max_size_reduces_photographs_and_novel_camera(self):
        camera = novelview.read_camera(DATA, "like:0", max_size=50)
        self.assertEqual(max(camera.GetImageSize()), 50)
        views = novelview.read(DATA, max_size=50)
        self.assertEqual(max(views.GetBlock(0).GetDimensions()), 50)

    def test_look_at_sees_its_target_in_the_principal_point_and_up_upwards(self):
        K = numpy.array([[500.0, 0, 20], [0, 500, 10], [0, 0, 1]])
        camera = novelview.look_at(K, (40, 30), (3, 4, 5), (1, 1, 1), (0, 1, 0))
        K, R, t = novelview.matrices(camera)

        def pixel(point):
            x, y, w = K @ (R @ numpy.array(point) + t)
            return x / w, y / w

        numpy.testing.assert_allclose(pixel((1.0, 1.0, 1.0)), (20, 10), atol=1e-9)
        right, above = pixel((1.0, 1.1, 1.0))
        self.assertAlmostEqual(right, 20)
        self.assertLess(above, 10)
        numpy.testing.assert_allclose(R.T @ -t, (3, 4, 5), atol=1e-12)

    def test_wrong_shapes_are_named(self):
        with self.assertRaisesRegex(novelview.Error, r"camera: t has .*\(2,\), expected \(3,\)"):
            novelview.camera(numpy.eye(3), numpy.eye(3), (0, 0), (4, 4))
        with self.assertRaisesRegex(novelview.Error, "camera: K is not an array of numbers"):
            novelview.camera("K", numpy.eye(3), (0, 0, 0), (4, 4))


class Meshes(unittest.TestCase):
    def test_points_and_triangles_of_a_sphere(self):
        sphere = vtkSphereSource()
        sphere.Update()
        points, triangles = novelview.mesh(sphere.GetOutput())
        self.assertEqual(points.shape, (sphere.GetOutput().GetNumberOfPoints(), 3))
        self.assertEqual(triangles.shape, (sphere.GetOutput().GetNumberOfPolys(), 3))
        # The default radius; the source makes floats.
        numpy.testing.assert_allclose(numpy.linalg.norm(points, axis=1), 0.5, rtol=1e-6)
        corners = points[triangles]
        normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        self.assertTrue(((normals * corners.mean(axis=1)).sum(axis=1) > 0).all())

    def test_an_empty_mesh_is_no_error_and_quads_are(self):
        points, triangles = novelview.mesh(vtkPolyData())
        self.assertEqual((points.shape, triangles.shape), ((0, 3), (0, 3)))
        sphere = vtkSphereSource()
        sphere.Update()
        quads = vtkCellArray()
        quads.InsertNextCell(4, (0, 1, 2, 3))
        data = vtkPolyData()
        data.SetPoints(sphere.GetOutput().GetPoints())
        data.SetPolys(quads)
        with self.assertRaisesRegex(novelview.Error, "not a triangle"):
            novelview.mesh(data)


if __name__ == "__main__":
    unittest.main()
