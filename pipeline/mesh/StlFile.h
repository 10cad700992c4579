// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * STL files, binary and ascii. A file is binary if it has the size given by its count of triangles,
 * and one that does not begin with "solid".
 */
#ifndef novelview_StlFile_h
#define novelview_StlFile_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <string_view>

namespace novelview
{
/**
 * The mesh in the bytes of an STL file. Equal points are one; triangles with two equal corners are
 * left out. Normals are not read.
 *
 * Throws Error, with `file` and the line or byte, when the file is malformed, shorter or longer
 * than its count states, when a coordinate is not finite, and when there is no triangle.
 */
vtkSmartPointer<vtkPolyData> ParseStl(std::string_view bytes, const std::string& file);
}

#endif
