// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Atomic writing of VTK's meshes (AtomicFile.h). VTK's own writers to files
 * do not report a full disk. Every function throws Error, naming the file.
 */
#ifndef novelview_PolyDataFile_h
#define novelview_PolyDataFile_h

#include <filesystem>
#include <string>

class vtkPolyData;

namespace novelview
{
enum class VtpCompressor
{
  Zlib, ///< smaller
  Lz4   ///< several times faster
};

/** VTK's XML format, with binary arrays in their places: some readers fail on appended ones. */
void WriteVtp(const std::filesystem::path& file, vtkPolyData* mesh, VtpCompressor compressor);

/**
 * The polygons as a binary PLY file of floats; with the normals of the points and the array Color
 * (3 x uint8) where the mesh has them.
 */
void WritePly(const std::filesystem::path& file, vtkPolyData* mesh);

/** The triangles as a binary STL file, each with the normal of its plane. */
void WriteStl(const std::filesystem::path& file, vtkPolyData* mesh);

/**
 * The bytes of a Wavefront OBJ file: points, texture coordinates and normals, which share their
 * numbers. `head` comes before them.
 */
std::string ObjText(vtkPolyData* mesh, const std::string& head);
}

#endif
