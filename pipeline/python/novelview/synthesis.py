# SPDX-License-Identifier: GPL-3.0-or-later
"""Data sets in, novel views out."""

import json
import os
import re

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

from . import pictures
from ._reporting import Error, reporting
from .vtkNovelViewFilters import vtkPinholeCamera
from .vtkNovelViewSynthesis import vtkNovelViewSynthesiser, vtkViewsReader

_STAGES = ("hull", "outline", "full")


def _reader(folder, calibration, max_size):
    reader = vtkViewsReader()
    reader.SetFolder(os.fspath(folder))
    if max_size is not None:
        reader.SetMaxSize(max_size)
    if calibration is not None:
        reader.SetCalibration(os.fspath(calibration))
    return reader


def read(folder, calibration=None, exclude=(), force_silhouettes=False, max_size=None):
    """The photographs of a data set: a vtkMultiBlockDataSet as views() makes it.

    Reads what the program `novelview` reads. `calibration` chooses among several calibration files;
    photographs named in `exclude` are left out; with `force_silhouettes` masks are not read but taken
    from the photographs. Photographs whose longer side is above `max_size` pixels are reduced (0 =
    none is; None = so far that 4 GiB of memory suffice).
    """
    reader = _reader(folder, calibration, max_size)
    for name in exclude:
        reader.AddExclude(name)
    reader.SetForceSilhouettes(force_silhouettes)
    with reporting(reader):
        reader.Update()
    return reader.GetOutput()


def read_camera(folder, view, calibration=None, max_size=None):
    """The camera that a text describes, as after `novelview run --view`: "between:A,B[,F]", "like:IMAGE"
    or "file:PAR.txt#NAME". The photograph of "like:" is not left out: name it in read(exclude=..).
    `max_size` as in read()."""
    result = vtkPinholeCamera()
    reader = _reader(folder, calibration, max_size)
    with reporting(reader):
        reader.ReadCamera(view, result)
    return result


def options(preset="best"):
    """The options of a preset by their names in synthesise(), each as (value, help)."""
    chain = vtkNovelViewSynthesiser()
    with reporting(chain):
        chain.SetPreset(preset)
    values = json.loads(chain.GetOptions())
    return {_in_python(key): (value, chain.GetOptionHelp(key)) for key, value in values.items()}


def _in_python(key):
    return re.sub("[A-Z]", lambda letter: "_" + letter.group().lower(), key)


def _in_jobs(key):
    return re.sub("_([a-z])", lambda letter: letter.group(1).upper(), key)


def _plain(value):
    """What is no value of JSON but nearly: numbers and arrays of NumPy."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise Error(f"options: a value has the wrong type (got {type(value).__name__})")


class Synthesiser:
    """Novel views of one data set. What does not depend on the camera (hull, crust, depth maps) is
    made for the first view and kept for the others.

    `views` is what read() or views() gave, or a list that views() takes. `stage` is how far the
    geometry is refined: "hull", "outline" or "full". Further arguments are the program's options with
    underscores, references=3 for --references 3; they go over the preset, and options() lists them.

    `progress(stage, fraction)` is called while it works; when it returns False the work stops, which
    raises Error.
    """

    def __init__(self, views, preset="best", stage="full", progress=None, **further):
        if not hasattr(views, "GetNumberOfBlocks"):
            views = pictures.views(views)
        if stage not in _STAGES:
            raise Error(f"stage: unknown (got {stage!r}, expected one of {', '.join(_STAGES)})")
        #: The vtkNovelViewSynthesiser, for what is not covered here.
        self.filter = vtkNovelViewSynthesiser()
        self.filter.SetInputData(views)
        self.filter.SetStage(_STAGES.index(stage))
        given = {_in_jobs(key): value for key, value in further.items()}
        try:
            with reporting(self.filter):
                self.filter.SetOptions(json.dumps({"preset": preset, **given}, default=_plain))
        except Error as error:
            # Names as they are in Python.
            quoted = re.sub('"[A-Za-z]+"', lambda name: _in_python(name.group()), str(error))
            raise Error(quoted) from None
        if progress:
            self.filter.AddObserver("ProgressEvent", _teller(progress))

    def render(self, camera):
        """The picture that a vtkPinholeCamera would take: a vtkImageData with the point arrays Color,
        Mask, Depth (world units, 0 = none), CellId and Seen (0 = filled from the surroundings)."""
        self.filter.SetCamera(camera)
        self.filter.SetAbortExecute(0)
        with reporting(self.filter):
            self.filter.Update()
        result = vtkImageData()
        result.ShallowCopy(self.filter.GetOutput())
        return result

    @property
    def mesh(self):
        """The mesh behind the last picture: a vtkPolyData."""
        result = vtkPolyData()
        result.ShallowCopy(self.filter.GetMesh())
        return result


def _teller(progress):
    def tell(caller, _event):
        if progress(caller.GetProgressText(), caller.GetProgress()) is False:
            caller.SetAbortExecute(1)

    return tell


def synthesise(views, camera, preset="best", stage="full", progress=None, **further):
    """The picture that `camera` would take, in one call; see Synthesiser and its render()."""
    return Synthesiser(views, preset, stage, progress, **further).render(camera)
