# SPDX-License-Identifier: GPL-3.0-or-later
"""Views, pictures and meshes from and to NumPy. Arrays are copied both ways."""

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkImageData, vtkMultiBlockDataSet

from . import cameras
from ._blocks import block
from ._reporting import Error, reporting
from .vtkNovelViewSynthesis import vtkSilhouetteFilter


def views(items):
    """Photographs as the filters want them: a vtkMultiBlockDataSet with a vtkImageData each.

    Each item is a dict with `image` (height x width x 3, uint8, RGB), `K`, `R`, `t` and, optionally,
    `mask` (height x width; above 127, or True, is object) and `name`; or the tuple
    (image, mask, K, R, t). Without a mask (or with None) the silhouette is extracted from the photograph,
    whose background must then be plain.

    A view's point arrays are Color, Mask and ContourDistance (px), its field arrays CameraMatrix,
    Rotation and Translation.
    """
    data = vtkMultiBlockDataSet()
    for number, item in enumerate(items):
        if not isinstance(item, dict):
            item = dict(zip(("image", "mask", "K", "R", "t"), item))
        name = str(item.get("name", f"view{number:04}"))
        data.SetBlock(number, _block(item, f"view {number} ({name})"))
        data.GetMetaData(number).Set(vtkCompositeDataSet.NAME(), name)
    silhouettes = vtkSilhouetteFilter()
    silhouettes.SetInputData(data)
    with reporting(silhouettes):
        silhouettes.Update()
    return silhouettes.GetOutput()


def _block(item, where):
    """One item of views() as a vtkImageData."""
    for key in ("image", "K", "R", "t"):
        if item.get(key) is None:
            raise Error(f"{where}: {key} is missing")
    pixels = numpy.asarray(item["image"])
    if pixels.ndim != 3 or pixels.shape[2] != 3 or pixels.dtype != numpy.uint8:
        raise Error(
            f"{where}: image has the wrong shape or type "
            f"(got {pixels.shape} {pixels.dtype}, expected (height, width, 3) uint8)"
        )
    data = vtkImageData()
    data.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    _add(data.GetPointData(), "Color", pixels[::-1].reshape(-1, 3))
    if item.get("mask") is not None:
        mask = numpy.asarray(item["mask"])
        mask = mask.astype(numpy.uint8) * 255 if mask.dtype == bool else mask
        if mask.shape != pixels.shape[:2] or mask.dtype != numpy.uint8:
            raise Error(
                f"{where}: mask has the wrong shape or type "
                f"(got {mask.shape} {mask.dtype}, expected {pixels.shape[:2]} uint8 or bool)"
            )
        _add(data.GetPointData(), "Mask", mask[::-1].reshape(-1))
    for key, name, shape in (
        ("K", "CameraMatrix", (3, 3)),
        ("R", "Rotation", (3, 3)),
        ("t", "Translation", (3,)),
    ):
        values = cameras.numbers(item[key], shape, f"{where}: {key}")
        _add(data.GetFieldData(), name, values.reshape(1, -1))
    return data


def _add(attributes, name, values):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def image(data, name="Color"):
    """A point array of a vtkImageData as height x width (x channels), first row at the top."""
    array = data.GetPointData().GetArray(name)
    if array is None:
        count = data.GetPointData().GetNumberOfArrays()
        known = [data.GetPointData().GetArrayName(number) for number in range(count)]
        raise Error(f"image: there is no point array {name!r} (known: {', '.join(known)})")
    width, height, _ = data.GetDimensions()
    values = vtk_to_numpy(array).reshape(height, width, -1)[::-1]
    return numpy.array(values[..., 0] if values.shape[2] == 1 else values)


def view(views, which):
    """One of the views, given its number or name, as a dict that views() takes."""
    name, data = block(views, which)
    K, R, t = cameras.matrices(cameras.camera_of(views, which))
    return {
        "name": name,
        "image": image(data, "Color"),
        "mask": image(data, "Mask"),
        "K": K,
        "R": R,
        "t": t,
    }


def mesh(data):
    """Points (n x 3, double) and triangles (m x 3, point numbers) of a vtkPolyData of triangles."""
    if data.GetNumberOfPoints() == 0:
        return numpy.empty((0, 3)), numpy.empty((0, 3), dtype=int)
    points = numpy.array(vtk_to_numpy(data.GetPoints().GetData()), dtype=float)
    polygons = data.GetPolys()
    if polygons.IsHomogeneous() not in (0, 3):
        raise Error("mesh: a cell is not a triangle")
    triangles = vtk_to_numpy(polygons.GetConnectivityArray())
    return points, numpy.array(triangles, dtype=int).reshape(-1, 3)
