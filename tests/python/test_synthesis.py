# SPDX-License-Identifier: GPL-3.0-or-later
"""Novel views from Python are the program's."""

import json
import pathlib
import tempfile
import unittest

import cv2
import numpy

import novelview
from support import DATA, SOURCE, run_program, run_python


class Synthesis(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.views = novelview.read(DATA)
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def program(self, preset):
        """The program's picture and job for the camera between the first two views."""
        out = self.out / preset
        run_program(
            "run", DATA, "--view", "between:0,1", "--out", out, "--preset", preset,
            "--no-iterations", "--quiet", "--non-outline-iterations", "2",
        )  # fmt: skip
        picture = cv2.imread(str(out / "novel.png"))[..., ::-1]
        mask = cv2.imread(str(out / "novel_mask.png"), cv2.IMREAD_GRAYSCALE)
        return picture, mask, json.loads((out / "job.json").read_text())

    def test_every_pixel_is_that_of_the_program(self):
        camera = novelview.between(self.views, 0, 1)
        for preset in ("best", "paper"):
            with self.subTest(preset):
                picture, mask, job = self.program(preset)
                ours = novelview.synthesise(
                    self.views, camera, preset=preset, non_outline_iterations=2
                )
                self.assertGreater(numpy.mean(mask > 127), 0.02)  # there is something to compare
                numpy.testing.assert_array_equal(novelview.image(ours, "Color"), picture)
                numpy.testing.assert_array_equal(novelview.image(ours, "Mask"), mask)
                # Options have one source: what a preset is here is what the program ran.
                values = novelview.options(preset)
                for key in ("references", "power", "feather"):
                    self.assertEqual(values[key][0], job[key])
                self.assertEqual(values["depth_maps"][0], job["depthMaps"])

    def test_further_cameras_get_what_they_would_get_first(self):
        cameras = [novelview.between(self.views, 0, 1, part) for part in (0.3, 0.6)]
        chain = novelview.Synthesiser(self.views, stage="hull")
        stages = []
        chain.filter.AddObserver("ProgressEvent", lambda f, event: stages.append(f.GetProgressText()))
        chain.render(cameras[0])
        self.assertIn("visual hull", stages)
        self.assertIn("power crust", stages)
        del stages[:]
        second = novelview.image(chain.render(cameras[1]))
        # Made once: neither hull nor crust nor depth maps again.
        self.assertEqual(set(stages) - {"culling", "texture"}, set())
        alone = novelview.image(novelview.synthesise(self.views, cameras[1], stage="hull"))
        numpy.testing.assert_array_equal(second, alone)
        self.assertGreater(len(novelview.mesh(chain.mesh)[1]), 100)

    def test_changed_options_and_views_count(self):
        camera = novelview.between(self.views, 0, 1)
        chain = novelview.Synthesiser(self.views, preset="paper", stage="hull")
        before = novelview.image(chain.render(camera))
        chain.filter.SetOptions('{"references": 1}')
        self.assertTrue((novelview.image(chain.render(camera)) != before).any())
        chain.filter.SetInputData(novelview.read(DATA, exclude=novelview.names(self.views)[:1]))
        fewer = novelview.image(chain.render(camera))
        alone = novelview.synthesise(
            novelview.read(DATA, exclude=novelview.names(self.views)[:1]),
            camera, preset="paper", stage="hull", references=1,
        )  # fmt: skip
        numpy.testing.assert_array_equal(fewer, novelview.image(alone))

    def test_progress_is_told_and_can_stop_the_work(self):
        camera = novelview.between(self.views, 0, 1)
        stages = []

        def stop_at_crust(stage, fraction):
            self.assertTrue(0 <= fraction <= 1)
            stages.append(stage)
            return stage != "power crust"

        with self.assertRaisesRegex(novelview.Error, "interrupted"):
            novelview.synthesise(self.views, camera, stage="hull", progress=stop_at_crust)
        self.assertIn("visual hull", stages)
        self.assertNotIn("texture", stages)

    def test_a_stopped_chain_can_go_on(self):
        camera = novelview.between(self.views, 0, 1)
        go_on = []
        chain = novelview.Synthesiser(
            self.views, preset="paper", stage="hull", progress=lambda stage, fraction: bool(go_on)
        )
        with self.assertRaises(novelview.Error):
            chain.render(camera)
        go_on.append(True)
        whole = novelview.synthesise(self.views, camera, preset="paper", stage="hull")
        numpy.testing.assert_array_equal(
            novelview.image(chain.render(camera)), novelview.image(whole)
        )

    def test_a_camera_that_sees_nothing_is_an_error(self):
        K, R, t = novelview.matrices(novelview.camera_of(self.views, 0))
        far = novelview.camera(K, R, t + (0, 0, 1e6 * t[2]), (160, 120))
        with self.assertRaisesRegex(novelview.Error, "covers no pixel"):
            novelview.synthesise(self.views, far, preset="paper", stage="hull")

    def test_options_have_values_and_help(self):
        for preset in ("best", "paper"):
            for name, (_, text) in novelview.options(preset).items():
                self.assertTrue(text, name)
                self.assertEqual(name, name.lower())
        self.assertIn("1 to 64", novelview.options()["references"][1])


class Readme(unittest.TestCase):
    def test_readme_shows_the_example_word_for_word(self):
        example = (SOURCE / "tests/python/readme_example.py").read_text()
        example = example.partition("\n")[2]  # without the licence's line
        shown = f"```python\n{example}```" in (SOURCE / "pipeline/python/README.md").read_text()
        self.assertTrue(shown, "pipeline/python/README.md does not show tests/python/readme_example.py")

    def test_the_example_makes_the_novel_view(self):
        with tempfile.TemporaryDirectory() as folder:
            result = pathlib.Path(folder) / "novel.npz"
            ran = run_python(SOURCE / "tests/python/readme_example.py", DATA, result)
            self.assertEqual((ran.returncode, ran.stderr), (0, ""))
            arrays = numpy.load(result)
            self.assertEqual(arrays["pixels"].shape, (120, 160, 3))
            self.assertEqual(arrays["pixels"].dtype, numpy.uint8)
            # Where there is depth there is the object, which is not black, and nowhere else.
            object_there = arrays["depth"] > 0
            self.assertGreater(object_there.mean(), 0.02)
            self.assertGreater(arrays["pixels"][object_there].mean(), 20)
            # A pixel or so beside it may be partly covered (rim samples), hence not exactly 0.
            self.assertLess(arrays["pixels"][~object_there].mean(), 2)


if __name__ == "__main__":
    unittest.main()
