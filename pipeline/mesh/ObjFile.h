// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Wavefront OBJ files: vertices `v x y z` and faces `f`, whose corners are `v`, `v/vt`, `v//vn` or
 * `v/vt/vn`, counted from 1, or backwards from the last one if negative. A line continues after a
 * backslash at its end. Everything else is passed over; of vt and vn only the numbers are checked.
 */
#ifndef novelview_ObjFile_h
#define novelview_ObjFile_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <string_view>

namespace novelview
{
/**
 * The mesh in the bytes of an OBJ file: points as they are there, rounded to float, and polygons.
 *
 * Throws Error, with `file` and the line, when a number is malformed, a coordinate is not finite, a
 * face has fewer than three corners or one that does not exist, and when there is no face.
 */
vtkSmartPointer<vtkPolyData> ParseObj(std::string_view bytes, const std::string& file);
}

#endif
