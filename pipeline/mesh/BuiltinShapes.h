// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_BuiltinShapes_h
#define novelview_BuiltinShapes_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace novelview
{
/**
 * A test object made by formula, about two units across, y up, closed: "part", "stool", "lattice",
 * "bust" or "torus". Null when the name is none of these.
 */
vtkSmartPointer<vtkPolyData> MakeBuiltinShape(const std::string& name);
}

#endif
