# SPDX-License-Identifier: GPL-3.0-or-later
"""The blocks of a vtkMultiBlockDataSet of views."""

from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

from ._reporting import Error


def names(views):
    """The views' names, in their order."""
    result = []
    for number in range(views.GetNumberOfBlocks()):
        known = views.HasMetaData(number)
        name = views.GetMetaData(number).Get(vtkCompositeDataSet.NAME()) if known else None
        result.append(name or f"view{number}")
    return result


def block(views, which):
    """Name and vtkImageData of a view, given its number or name."""
    known = names(views)
    number = known.index(which) if which in known else which
    if isinstance(number, str) or not 0 <= number < len(known):
        raise Error(f"views: there is no view {which!r} (known: {', '.join(known)})")
    return known[number], views.GetBlock(number)
