# SPDX-License-Identifier: GPL-3.0-or-later
"""No display, and whose OpenGL it is. Each in a process of its own, since OpenGL is chosen once."""

import os
import unittest

from support import run_python

NO_OPENGL = """
import novelview
loaded = open("/proc/self/maps").read()
print("OSMesa" in loaded, "vtkRenderingOpenGL2" in loaded)
"""

PICTURE = """
import novelview.offscreen
import vtk
sphere = vtk.vtkSphereSource()
mapper = vtk.vtkPolyDataMapper()
mapper.SetInputConnection(sphere.GetOutputPort())
actor = vtk.vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(1, 0, 0)
actor.SetPosition(0, 1, 0)
renderer = vtk.vtkRenderer()
renderer.AddActor(actor)
renderer.SetBackground(0, 0, 1)
renderer.GetActiveCamera().SetPosition(0, 0, 5)
pixels = novelview.offscreen.capture(renderer, 80, 60)
# One unit above the middle, seen 5 units away at 30 degrees: 22 of the 30 rows up.
print(pixels.shape, pixels[8, 40, 0] > 100, pixels[52, 40].tolist(), pixels[0, 0].tolist())
try:
    novelview.offscreen.capture(renderer, 0, 60)
except novelview.Error as error:
    print(error)
"""

TOO_LATE = """
import vtk
import novelview
try:
    import novelview.offscreen
except ImportError as error:
    print(error)
"""


class Offscreen(unittest.TestCase):
    def ran(self, program):
        self.assertNotIn("DISPLAY", os.environ)
        result = run_python("-c", program)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout.splitlines()

    def test_the_package_itself_loads_no_opengl(self):
        self.assertEqual(self.ran(NO_OPENGL), ["False False"])

    def test_a_scene_is_drawn_right_way_up_without_a_display(self):
        picture, error = self.ran(PICTURE)
        self.assertEqual(picture, "(60, 80, 3) True [0, 0, 255] [0, 0, 255]")
        self.assertIn("picture size is not positive (got 0x60", error)

    def test_after_vtks_opengl_it_says_that_it_is_too_late(self):
        (line,) = self.ran(TOO_LATE)
        self.assertIn("must be imported before vtk", line)


if __name__ == "__main__":
    unittest.main()
