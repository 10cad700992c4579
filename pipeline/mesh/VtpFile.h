// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * VTK's XML files of polygon meshes, as vtkXMLPolyDataWriter writes them: arrays in ascii, binary, or
 * appended in base64 or raw; whole or compressed (zlib, LZ4, LZMA); either byte order; any number of
 * pieces. Points, polygons and triangle strips are read, everything else is passed over.
 */
#ifndef novelview_VtpFile_h
#define novelview_VtpFile_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>
#include <string_view>

namespace novelview
{
/**
 * The mesh in the bytes of a VTP file: points as they are there, float or double, polygons and
 * strips.
 *
 * Throws Error, with `file` and the line, when the file is malformed, an array is shorter than its
 * counts state, a coordinate is not finite, a face has fewer than three corners or one that does
 * not exist, and when there is no face.
 */
vtkSmartPointer<vtkPolyData> ParseVtp(std::string_view bytes, const std::string& file);
}

#endif
