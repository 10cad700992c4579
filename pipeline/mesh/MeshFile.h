// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MeshFile_h
#define novelview_MeshFile_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace novelview
{
/**
 * Reads a person's mesh file: .obj, .ply, .stl or .vtp, by its extension in any case. For files as
 * they should be the result has the points, faces and their order that VTK's readers give, and no
 * arrays. (Of an OBJ file whose corners differ in texture coordinates or normals those repeat
 * points; here each `v` is one point.)
 *
 * Whatever the file contains, the result is a mesh with at least one face, whose coordinates are
 * finite and whose faces have three to ten thousand corners (strips: any number) that exist; or an
 * Error with the file and, where it makes sense, the line or byte. Counts in the file are compared
 * with its size before memory is taken.
 */
vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::filesystem::path& file);

/** The same from the bytes of a file; `extension` is ".obj", ..., `file` the name for messages. */
vtkSmartPointer<vtkPolyData> ParseMesh(
  std::string_view bytes, const std::string& extension, const std::string& file);
}

#endif
