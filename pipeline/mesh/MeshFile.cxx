// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/MeshFile.h"

#include "base/InputFile.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "core/PrintableText.h"
#include "mesh/ObjFile.h"
#include "mesh/PlyFile.h"
#include "mesh/StlFile.h"
#include "mesh/VtpFile.h"

#include <map>
#include <new>

namespace novelview
{
namespace
{
using MeshParser = vtkSmartPointer<vtkPolyData> (*)(std::string_view, const std::string&);

MeshParser ParserFor(const std::string& extension, const std::string& file)
{
  static const std::map<std::string, MeshParser> parsers = {
    { ".obj", ParseObj },
    { ".ply", ParsePly },
    { ".stl", ParseStl },
    { ".vtp", ParseVtp },
  };
  const auto parser = parsers.find(LowerCase(extension));
  if (parser == parsers.end())
  {
    throw Error(file, "unknown kind of mesh file", Quoted(extension), ".obj, .ply, .stl or .vtp");
  }
  return parser->second;
}
}

vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::filesystem::path& file)
{
  const std::string extension = file.extension().string();
  ParserFor(extension, file.string()); // before the file is read
  return ParseMesh(ReadInputFile(file), extension, file.string());
}

vtkSmartPointer<vtkPolyData> ParseMesh(
  std::string_view bytes, const std::string& extension, const std::string& file)
{
  const MeshParser parse = ParserFor(extension, file);
  try
  {
    return parse(bytes, file);
  }
  catch (const std::bad_alloc&)
  {
    throw Error(file, "mesh is too large for the memory");
  }
}
}
