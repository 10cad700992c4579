# SPDX-License-Identifier: GPL-3.0-or-later
"""The VTK classes behave in Python like VTK's own."""

import pydoc
import unittest

import numpy
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersSources import vtkSphereSource

import novelview
from support import Heard, disc_views

FILTERS = [
    "vtkVisualHullSource",
    "vtkPowerCrustMesher",
    "vtkVisibilityCuller",
    "vtkOutlineDeformer",
    "vtkNonOutlineDeformer",
    "vtkViewDependentTextureMapper",
    "vtkReferenceDepthEstimator",
    "vtkCameraRefiner",
    "vtkSilhouetteReconciler",
    "vtkSilhouetteRepairer",
    "vtkTextureAtlasGenerator",
    "vtkTsdfNonOutlineDeformer",
    "vtkTsdfOutlineDeformer",
    "vtkDepthMapFuser",
    "vtkMeshSimplifier",
    "vtkSilhouetteFilter",
    "vtkViewsReader",
    "vtkNovelViewSynthesiser",
]


def front_camera():
    first = disc_views(count=1)[0]
    return novelview.camera(first["K"], first["R"], first["t"], (64, 64))


class Classes(unittest.TestCase):
    def test_every_filter_is_an_algorithm_with_documentation(self):
        for name in FILTERS:
            with self.subTest(name):
                wrapped = getattr(novelview, name)
                self.assertIsInstance(wrapped(), vtkAlgorithm)
                text = pydoc.render_doc(wrapped, renderer=pydoc.plaintext)
                # First the class's own words, as after @brief in its header.
                self.assertIn(f"{name} - ", text)
                # What VTK writes for a class without a comment.
                self.assertNotIn("no description provided", text)
                self.assertGreater(len(wrapped.__doc__.split()), 30)

    def test_help_of_the_package_has_its_functions_and_classes(self):
        text = pydoc.render_doc(novelview, renderer=pydoc.plaintext)
        for function in ("synthesise(views, camera", "views(items)", "class Synthesiser"):
            self.assertIn(function, text)
        for name in FILTERS:
            self.assertIn(f"class {name}(", text)

    def test_help_has_the_methods_words_default_and_range(self):
        text = pydoc.render_doc(
            novelview.vtkOutlineDeformer.SetContourWeight, renderer=pydoc.plaintext
        )
        self.assertIn("SetContourWeight(self, ", text)
        self.assertIn("Default 0.3, range 0 to 100", " ".join(text.split()))

    def test_numbers_of_ports_are_those_of_the_headers(self):
        ports = {
            "vtkVisualHullSource": (1, 2),
            "vtkPowerCrustMesher": (1, 2),
            "vtkOutlineDeformer": (2, 1),
            "vtkViewDependentTextureMapper": (3, 1),
            "vtkTextureAtlasGenerator": (2, 3),
            "vtkDepthMapFuser": (2, 1),
            "vtkMeshSimplifier": (1, 1),
            "vtkNovelViewSynthesiser": (1, 2),
            "vtkViewsReader": (0, 1),
        }
        for name, expected in ports.items():
            made = getattr(novelview, name)()
            self.assertEqual(
                (made.GetNumberOfInputPorts(), made.GetNumberOfOutputPorts()), expected, name
            )

    def test_setters_clamp_and_mark_as_modified(self):
        deformer = novelview.vtkOutlineDeformer()
        before = deformer.GetMTime()
        deformer.SetContourWeight(1000)
        self.assertEqual(deformer.GetContourWeight(), 100)
        self.assertGreater(deformer.GetMTime(), before)

    def test_a_changed_camera_marks_its_filter_as_modified(self):
        culler = novelview.vtkVisibilityCuller()
        camera = front_camera()
        culler.SetCamera(camera)
        before = culler.GetMTime()
        camera.SetTranslation(0, 0, 51)
        self.assertGreater(culler.GetMTime(), before)
        self.assertIs(culler.GetCamera(), camera)

    def test_filters_connect_by_ports_and_tell_their_progress(self):
        hull = novelview.vtkVisualHullSource()
        hull.SetInputData(novelview.views(disc_views()))
        mesher = novelview.vtkPowerCrustMesher()
        mesher.SetInputConnection(hull.GetOutputPort())
        culler = novelview.vtkVisibilityCuller()
        culler.SetInputConnection(mesher.GetOutputPort())
        culler.SetCamera(front_camera())
        told = []
        mesher.AddObserver("ProgressEvent", lambda caller, event: told.append(caller.GetProgress()))
        ended = []
        culler.AddObserver("EndEvent", lambda caller, event: ended.append(event))
        culler.Update()
        self.assertTrue(told)
        self.assertTrue(all(0 <= fraction <= 1 for fraction in told))
        self.assertEqual(ended, ["EndEvent"])
        # A closed mesh of triangles has 3/2 edges per face, so V - F/2 = 2 for a sphere.
        crust = mesher.GetOutput()
        self.assertEqual(crust.GetNumberOfPoints() - crust.GetNumberOfPolys() / 2, 2)
        self.assertGreater(mesher.GetOutputDataObject(1).GetNumberOfPoints(), 0)
        self.assertLess(culler.GetOutput().GetNumberOfPolys(), crust.GetNumberOfPolys())

    def test_the_hull_of_discs_is_where_the_sphere_is(self):
        hull = novelview.vtkVisualHullSource()
        hull.SetInputData(novelview.views(disc_views()))
        hull.Update()
        points, _ = novelview.mesh(hull.GetOutput())
        # 0.5 px is what the hull agrees with silhouettes to, 1/20 of the radius a pixel; the masks are
        # binary, which is another half.
        self.assertLess(abs(points[:, 1].max() - 1), 1 / 20)
        # Six cylinders around the axis leave a prism: up to 1 / cos(30 deg) wide.
        distances = numpy.hypot(points[:, 0], points[:, 2])
        self.assertLess(distances.max(), 1 / numpy.cos(numpy.pi / 6) + 1 / 20)
        self.assertGreater(distances.max(), 1)

    def test_iterations_can_be_watched(self):
        views = novelview.views(disc_views())
        hull = novelview.vtkVisualHullSource()
        hull.SetInputData(views)
        mesher = novelview.vtkPowerCrustMesher()
        mesher.SetInputConnection(hull.GetOutputPort())
        culler = novelview.vtkVisibilityCuller()
        culler.SetInputConnection(mesher.GetOutputPort())
        deformer = novelview.vtkOutlineDeformer()
        deformer.SetInputConnection(0, culler.GetOutputPort())
        deformer.SetInputData(1, views)
        deformer.SetNumberOfIterations(1)
        for each in (culler, deformer):
            each.SetCamera(front_camera())
        seen = []
        deformer.AddObserver(
            novelview.vtkOutlineDeformer.IterationEvent,
            lambda caller, event: seen.append(
                (caller.GetIteration(), caller.GetCurrentMesh().GetNumberOfPoints())
            ),
        )
        deformer.Update()
        self.assertEqual(seen[0][0], 0)
        self.assertGreater(seen[0][1], 0)


class Errors(unittest.TestCase):
    def test_bad_input_is_an_error_event_with_the_filters_words(self):
        culler = novelview.vtkVisibilityCuller()
        sphere = vtkSphereSource()
        culler.SetInputConnection(sphere.GetOutputPort())
        heard = Heard(culler)
        culler.GetExecutive().AddObserver("ErrorEvent", lambda caller, event: None)
        culler.Update()
        self.assertEqual(len(heard.texts), 1)
        self.assertIn("novel camera: none is set", heard.texts[0])
        self.assertEqual(culler.GetOutput().GetNumberOfPolys(), 0)

    def test_a_camera_that_is_none_is_named_with_its_numbers(self):
        with self.assertRaisesRegex(novelview.Error, "novel camera: R is not a rotation"):
            novelview.synthesise(
                disc_views(),
                novelview.camera(numpy.eye(3), 2 * numpy.eye(3), (0, 0, 1), (4, 4)),
            )

    def test_a_missing_folder_is_an_error_of_the_reader(self):
        with self.assertRaisesRegex(novelview.Error, "no/such/folder"):
            novelview.read("no/such/folder")
        with self.assertRaisesRegex(novelview.Error, "no folder is set"):
            novelview.read("")

    def test_arrays_of_the_wrong_shape_name_view_and_shapes(self):
        items = disc_views()
        items[2]["mask"] = items[2]["mask"][:-1]
        with self.assertRaisesRegex(
            novelview.Error, r"view 2 \(disc2\): mask .*\(63, 64\) uint8, expected \(64, 64\)"
        ):
            novelview.views(items)
        items = disc_views()
        items[1]["image"] = items[1]["image"].astype(float)
        with self.assertRaisesRegex(novelview.Error, r"view 1 \(disc1\): image .*float64"):
            novelview.views(items)
        items = disc_views()
        items[0]["R"] = numpy.eye(2)
        with self.assertRaisesRegex(novelview.Error, r"view 0 \(disc0\): R .*\(2, 2\)"):
            novelview.views(items)
        del items[0]["R"]
        with self.assertRaisesRegex(novelview.Error, r"view 0 \(disc0\): R is missing"):
            novelview.views(items)

    def test_an_empty_mask_is_an_error_that_names_the_view(self):
        items = disc_views()
        items[3]["mask"][:] = 0
        with self.assertRaisesRegex(novelview.Error, "disc3"):
            novelview.views(items)

    def test_an_unknown_preset_option_or_stage_is_named(self):
        camera = front_camera()
        with self.assertRaisesRegex(novelview.Error, "preset: unknown .*'?worst"):
            novelview.synthesise(disc_views(), camera, preset="worst")
        with self.assertRaisesRegex(novelview.Error, 'mean "outline_alpha"'):
            novelview.synthesise(disc_views(), camera, outline_alhpa=1)
        with self.assertRaisesRegex(novelview.Error, "references.* out of range .*1 to 64"):
            novelview.synthesise(disc_views(), camera, references=0)
        with self.assertRaisesRegex(novelview.Error, "stage: unknown"):
            novelview.synthesise(disc_views(), camera, stage="crust")

    def test_a_former_name_of_an_option_works_with_a_warning(self):
        with self.assertWarnsRegex(UserWarning, '"rimSamples" is now "boundarySamples"'):
            chain = novelview.Synthesiser(disc_views(), rim_samples=5)
        self.assertIn('"boundarySamples":5', chain.filter.GetOptions().replace(" ", ""))

    def test_what_a_user_should_know_of_a_silhouette_is_a_warning(self):
        items = disc_views()
        items[0]["mask"][0, :] = 255
        with self.assertWarnsRegex(UserWarning, "disc0"):
            novelview.views(items)


if __name__ == "__main__":
    unittest.main()
