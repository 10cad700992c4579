# SPDX-License-Identifier: GPL-3.0-or-later
"""Events of VTK as exceptions and warnings of Python."""

import contextlib
import warnings

from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING


class Error(RuntimeError):
    """What went wrong: where: what (got .., expected ..), in one line."""


def _own_text(text):
    """The part of VTK's text that the filter wrote: after "class (address): "."""
    return text.partition("): ")[2].strip() or text.strip()


@contextlib.contextmanager
def reporting(vtk_object):
    """Within it, the first ErrorEvent of an object (and of its executive, if it is an algorithm)
    becomes an Error at the end, and each WarningEvent a warning."""
    errors, told = [], []

    @calldata_type(VTK_STRING)
    def on_error(_caller, _event, text):
        errors.append(_own_text(text))

    @calldata_type(VTK_STRING)
    def on_warning(_caller, _event, text):
        told.append(_own_text(text))

    heard = [vtk_object]
    if hasattr(vtk_object, "GetExecutive"):
        heard.append(vtk_object.GetExecutive())
    observers = [
        (each, each.AddObserver(event, callback))
        for each in heard
        for event, callback in (("ErrorEvent", on_error), ("WarningEvent", on_warning))
    ]
    try:
        yield
    finally:
        for each, observer in observers:
            each.RemoveObserver(observer)
    for text in told:
        warnings.warn(text, stacklevel=4)
    if errors:
        raise Error(errors[0])
