// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * PLY files: ascii, binary_little_endian and binary_big_endian, version 1.0.
 *
 * Of the element `vertex` the properties x, y, z are read, of `face` the list `vertex_indices` or
 * `vertex_index`; properties may come in any order and of any type. Everything else is passed over.
 */
#ifndef novelview_PlyFile_h
#define novelview_PlyFile_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <string_view>

namespace novelview
{
/**
 * The mesh in the bytes of a PLY file: points as they are there, rounded to float, and polygons.
 *
 * Throws Error, with `file` and the line or byte, when the header is malformed or lacks what is
 * read, when the file is shorter or longer than its counts state, when a coordinate is not finite,
 * and when a face has fewer than three corners or one that does not exist.
 */
vtkSmartPointer<vtkPolyData> ParsePly(std::string_view bytes, const std::string& file);
}

#endif
