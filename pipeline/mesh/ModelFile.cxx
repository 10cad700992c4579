// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/ModelFile.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/NumberText.h"
#include "base/UsageError.h"
#include "core/Error.h"
#include "images/ImageFile.h"
#include "mesh/GltfFile.h"
#include "mesh/PolyDataFile.h"

#include <algorithm>
#include <array>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
std::string KindOf(const fs::path& file)
{
  return LowerCase(file.extension().string());
}

/** The pixels of the texture. */
ImageRef<const std::uint8_t> PixelsOf(const TexturedModel& model)
{
  return TopDownArray<const std::uint8_t>(model.Texture, arrays::Color, 3, "texture", true);
}

/** The texture first and the mesh that names it last. */
void WriteObj(const TexturedModel& model, const fs::path& file)
{
  const fs::path texture = fs::path(file).replace_extension(".jpg");
  const fs::path material = fs::path(file).replace_extension(".mtl");
  WriteImageFile(texture, PixelsOf(model));
  // The photographs' light is in the colours: ambient light shows them as they are.
  WriteTextAtomically(material,
    "newmtl photographs\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Ka " +
      texture.filename().string() + "\nmap_Kd " + texture.filename().string() + "\n");
  WriteTextAtomically(file,
    ObjText(model.Atlas, "mtllib " + material.filename().string() + "\nusemtl photographs\n"));
}
}

std::string ModelFileKinds()
{
  return ".glb, .obj, .ply, .vtp or .stl";
}

void CheckModelFiles(const std::vector<fs::path>& files, const std::string& option)
{
  static constexpr std::array<const char*, 5> kinds{ ".glb", ".obj", ".ply", ".vtp", ".stl" };
  for (const fs::path& file : files)
  {
    if (std::find(kinds.begin(), kinds.end(), KindOf(file)) == kinds.end())
    {
      throw UsageError(option, "is not a mesh file", file.string(), ModelFileKinds());
    }
    if (std::count(files.begin(), files.end(), file) > 1)
    {
      throw UsageError(option, "names a file twice: " + file.string());
    }
  }
}

void WriteModelFile(const TexturedModel& model, const fs::path& file)
{
  const std::string kind = KindOf(file);
  if (kind == ".glb")
  {
    WriteTextAtomically(file, GlbOf(model));
  }
  else if (kind == ".obj")
  {
    WriteObj(model, file);
  }
  else if (kind == ".ply")
  {
    WritePly(file, model.Mesh);
  }
  else if (kind == ".vtp")
  {
    WriteVtp(file, model.Mesh, VtpCompressor::Zlib);
  }
  else
  {
    WriteStl(file, model.Mesh);
  }
}

std::vector<fs::path> FilesOfModel(const fs::path& file)
{
  if (KindOf(file) != ".obj")
  {
    return { file };
  }
  return { fs::path(file).replace_extension(".jpg"), fs::path(file).replace_extension(".mtl"),
    file };
}
}
