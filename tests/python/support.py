# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the Python package share."""

import os
import pathlib
import subprocess
import sys

import numpy
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING

SOURCE = pathlib.Path(__file__).resolve().parents[2]

#: A generated data set of twelve small photographs on a circle, made once for all tests.
DATA = pathlib.Path(os.environ["NOVELVIEW_TEST_DATA"])


def run_program(*words):
    subprocess.run([os.environ["NOVELVIEW_PROGRAM"], *map(str, words)], check=True)


def run_python(*words):
    """A fresh interpreter; what it printed."""
    return subprocess.run(
        [sys.executable, *map(str, words)], capture_output=True, text=True, check=False
    )


def disc_views(size=64, radius=20.0, count=6):
    """A sphere of radius 1 in the origin as views on a circle around it see it, by hand: a disc in
    each picture, since every camera looks at the middle from 50 units away (parallel rays, nearly).
    """
    focal = radius * 50.0
    middle = (size - 1) / 2
    rows, columns = numpy.mgrid[:size, :size]
    inside = (rows - middle) ** 2 + (columns - middle) ** 2 < radius**2
    items = []
    for number in range(count):
        angle = 2 * numpy.pi * number / count
        forward = numpy.array([-numpy.cos(angle), 0, -numpy.sin(angle)])
        down = numpy.array([0.0, -1.0, 0.0])
        R = numpy.stack([numpy.cross(down, forward), down, forward])
        image = numpy.zeros((size, size, 3), numpy.uint8)
        image[inside] = (200, 100, 50 + number)
        items.append(
            {
                "name": f"disc{number}",
                "image": image,
                "mask": numpy.where(inside, 255, 0).astype(numpy.uint8),
                "K": numpy.array([[focal, 0, middle], [0, focal, middle], [0, 0, 1]]),
                "R": R,
                "t": numpy.array([0.0, 0.0, 50.0]),
            }
        )
    return items


class Heard:
    """Texts of an event of a VTK object."""

    def __init__(self, vtk_object, event="ErrorEvent"):
        self.texts = []

        @calldata_type(VTK_STRING)
        def hear(_caller, _event, text):
            self.texts.append(text)

        vtk_object.AddObserver(event, hear)
