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

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

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

/** The mesh with a colour and a normal per point. */
vtkSmartPointer<vtkPolyData> ColouredPolyData(const TexturedModel& model)
{
  auto poly = vtkSmartPointer<vtkPolyData>::New();
  FromTriangleMesh(model.Mesh, poly);
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName(arrays::Color);
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(static_cast<vtkIdType>(model.PointColours.size()));
  for (std::size_t ptId = 0; ptId < model.PointColours.size(); ++ptId)
  {
    colours->SetTypedTuple(static_cast<vtkIdType>(ptId), model.PointColours[ptId].data());
  }
  poly->GetPointData()->SetScalars(colours);
  poly->GetPointData()->SetNormals(NewNormals(model.Normals));
  return poly;
}

/** The mesh cut into charts, with texture coordinates; VTK and OBJ count them from the bottom. */
vtkSmartPointer<vtkPolyData> AtlasPolyData(const TexturedModel& model)
{
  auto poly = vtkSmartPointer<vtkPolyData>::New();
  FromTriangleMesh(model.Atlas.Mesh, poly);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetName("TextureCoordinates");
  coordinates->SetNumberOfComponents(2);
  std::vector<Eigen::Vector3d> normals;
  for (std::size_t ptId = 0; ptId < model.Atlas.PointOf.size(); ++ptId)
  {
    const Eigen::Vector2d& at = model.Atlas.TexCoords[ptId];
    coordinates->InsertNextTuple2(at.x(), 1 - at.y());
    normals.push_back(model.Normals[model.Atlas.PointOf[ptId]]);
  }
  poly->GetPointData()->SetTCoords(coordinates);
  poly->GetPointData()->SetNormals(NewNormals(normals));
  return poly;
}

/** The texture first and the mesh that names it last. */
void WriteObj(const TexturedModel& model, const fs::path& file)
{
  const fs::path texture = fs::path(file).replace_extension(".jpg");
  const fs::path material = fs::path(file).replace_extension(".mtl");
  WriteImageFile(texture, model.Atlas.Picture.Ref());
  // The photographs' light is in the colours: ambient light shows them as they are.
  WriteTextAtomically(material,
    "newmtl photographs\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Ka " +
      texture.filename().string() + "\nmap_Kd " + texture.filename().string() + "\n");
  WriteTextAtomically(file,
    ObjText(
      AtlasPolyData(model), "mtllib " + material.filename().string() + "\nusemtl photographs\n"));
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
      throw UsageError(option, "is no file for a mesh", file.string(), ModelFileKinds());
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
    WritePly(file, ColouredPolyData(model));
  }
  else if (kind == ".vtp")
  {
    WriteVtp(file, ColouredPolyData(model), VtpCompressor::Zlib);
  }
  else
  {
    WriteStl(file, ColouredPolyData(model));
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
