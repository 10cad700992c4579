# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras: vtkPinholeCamera from and to NumPy."""

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from ._blocks import block
from ._reporting import Error, reporting
from .vtkNovelViewFilters import vtkPinholeCamera


def numbers(value, shape, what):
    """`value` as doubles of a shape; Error with `what` when it has another one."""
    try:
        array = numpy.asarray(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise Error(f"{what} is not an array of numbers") from error
    if array.size != numpy.prod(shape):
        raise Error(f"{what} has the wrong shape (got {array.shape}, expected {shape})")
    return array.reshape(shape)


def camera(K, R, t, size):
    """A vtkPinholeCamera from K (3x3), R (3x3), t (3) and the picture's (width, height).

    K, R and t are checked by the filters that the camera is given to.
    """
    result = vtkPinholeCamera()
    result.SetCameraMatrix(numbers(K, (3, 3), "camera: K").ravel())
    result.SetRotation(numbers(R, (3, 3), "camera: R").ravel())
    result.SetTranslation(numbers(t, (3,), "camera: t"))
    result.SetImageSize([int(length) for length in numbers(size, (2,), "camera: size")])
    return result


def look_at(K, size, centre, target, up):
    """A camera at `centre` that looks at `target`, with the direction `up` upwards."""
    result = camera(K, numpy.eye(3), numpy.zeros(3), size)
    result.LookAt(
        numbers(centre, (3,), "camera: centre"),
        numbers(target, (3,), "camera: target"),
        numbers(up, (3,), "camera: up"),
    )
    return result


def matrices(pinhole):
    """K (3x3), R (3x3) and t (3) of a vtkPinholeCamera."""
    return (
        numpy.array(pinhole.GetCameraMatrix()).reshape(3, 3),
        numpy.array(pinhole.GetRotation()).reshape(3, 3),
        numpy.array(pinhole.GetTranslation()),
    )


def camera_of(views, which):
    """The vtkPinholeCamera of a view, given its number or name."""
    _, data = block(views, which)
    fields = data.GetFieldData()
    K, R, t = (
        vtk_to_numpy(fields.GetArray(name)) for name in ("CameraMatrix", "Rotation", "Translation")
    )
    return camera(K, R, t, data.GetDimensions()[:2])


def between(views, first, second, fraction=0.5):
    """The camera a fraction of the way from one view's camera to another's on their common orbit."""
    result = vtkPinholeCamera()
    with reporting(result):
        result.InterpolateOnOrbit(camera_of(views, first), camera_of(views, second), fraction)
    return result
