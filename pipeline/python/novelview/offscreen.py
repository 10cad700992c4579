# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of VTK scenes without a display.

The distribution's VTK draws into windows of an X server. Importing this module makes OSMesa or EGL,
which draw in memory, the OpenGL of the process; so it must be imported before VTK's OpenGL is (`import
vtk` does that), and no windows can be opened in the same process. `import novelview` alone loads no
OpenGL.
"""

import os
import sys

if "vtkmodules.vtkRenderingOpenGL2" in sys.modules:
    raise ImportError(
        "novelview.offscreen must be imported before vtk (or vtkmodules.vtkRenderingOpenGL2), "
        "which has already chosen its OpenGL"
    )

# The functions of this library stand before the system's OpenGL for everything that is loaded from now on.
_flags = sys.getdlopenflags()
sys.setdlopenflags(_flags | os.RTLD_GLOBAL)
try:
    from .vtkNovelViewOffscreen import *
finally:
    sys.setdlopenflags(_flags)

from vtkmodules.vtkCommonDataModel import vtkImageData

from ._reporting import reporting
from .pictures import image


def capture(renderer, width, height):
    """What a vtkRenderer shows, as height x width x 3, uint8, first row at the top."""
    window = vtkOffscreenCapture()
    result = vtkImageData()
    with reporting(window):
        window.Capture(renderer, width, height, result)
    return image(result, "Color")
