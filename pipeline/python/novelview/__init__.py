# SPDX-License-Identifier: GPL-3.0-or-later
"""Views of an object that no camera took, from about a dozen calibrated photographs.

    views = novelview.read("folder")                   # or novelview.views([...]) from NumPy arrays
    camera = novelview.between(views, 0, 1)            # or novelview.camera(K, R, t, (width, height))
    picture = novelview.synthesise(views, camera)      # a vtkImageData
    pixels = novelview.image(picture, "Color")         # height x width x 3, uint8

Conventions: camera frame x right, y down, z forward; x_cam = R x_world + t; pixel u ~ K x_cam with
pixel centres on integers, (0, 0) = centre of the top-left pixel; depth = z in the camera frame.
Pictures in NumPy have their first row at the top; in vtkImageData the first row is the bottom one, as
always in VTK. Masks: above 127 is object.

The stages are VTK filters, novelview.vtkVisualHullSource and so on, with ports, observers and help()
as all VTK classes have them. No display is needed, and no OpenGL is loaded; novelview.offscreen
draws VTK's scenes without a display.

What fails in the functions here raises novelview.Error with one line of text; what a user should
know of the data is a Python warning. Filters used directly report by ErrorEvent and WarningEvent.
"""

try:
    from .vtkNovelViewFilters import *
    from .vtkNovelViewSynthesis import *
except ModuleNotFoundError as missing:
    raise ImportError("novelview is not built here: app/setup.sh builds it, app/demo.sh only the "
                      f"program ({missing})") from missing

from ._blocks import names
from ._reporting import Error
from .cameras import between, camera, camera_of, look_at, matrices
from .pictures import image, mesh, view, views
from .synthesis import Synthesiser, options, read, read_camera, synthesise

__all__ = [
    "Error",
    "Synthesiser",
    "between",
    "camera",
    "camera_of",
    "image",
    "look_at",
    "matrices",
    "mesh",
    "names",
    "options",
    "read",
    "read_camera",
    "synthesise",
    "view",
    "views",
]
__all__ += [
    name
    for name, value in list(globals().items())
    if name.startswith("vtk") and isinstance(value, type)
]
