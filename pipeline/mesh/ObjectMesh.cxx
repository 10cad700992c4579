// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/ObjectMesh.h"

#include "core/Error.h"
#include "geometry/MeshTopology.h"
#include "mesh/BuiltinShapes.h"
#include "mesh/MeshAssembly.h"
#include "mesh/MeshFile.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>
#include <vtkTriangleFilter.h>

#include <filesystem>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr const char* BunnyFile = "/usr/share/glmark2/models/bunny.obj";

vtkSmartPointer<vtkPolyData> ReadNamedFile(const std::string& file)
{
  std::error_code failure;
  if (!fs::exists(file, failure))
  {
    std::string builtin;
    for (const std::string& name : BuiltinObjects())
    {
      builtin += (builtin.empty() ? "" : ", ") + name;
    }
    throw Error(file, "mesh file does not exist (built-in objects: " + builtin + ")");
  }
  return ReadMeshFile(file);
}

vtkSmartPointer<vtkPolyData> ReadBunny()
{
  std::error_code failure;
  if (!fs::is_regular_file(BunnyFile, failure))
  {
    throw Error(BunnyFile, "the bunny is missing: install the package glmark2-data");
  }
  return ReadMeshFile(BunnyFile);
}

/** Whether two triangles meet at every edge. */
bool IsClosed(vtkPolyData* mesh)
{
  TriangleMesh triangles;
  triangles.Points.resize(static_cast<std::size_t>(mesh->GetNumberOfPoints()));
  vtkNew<vtkIdList> ids;
  for (vtkIdType cellId = 0; cellId < mesh->GetNumberOfPolys(); ++cellId)
  {
    mesh->GetPolys()->GetCellAtId(cellId, ids);
    triangles.Triangles.emplace_back(static_cast<int>(ids->GetId(0)),
      static_cast<int>(ids->GetId(1)), static_cast<int>(ids->GetId(2)));
  }
  const MeshTopology topology = ExamineTopology(triangles);
  return topology.BorderEdges == 0 && topology.NonManifoldEdges == 0;
}

/** Triangles instead of polygons and strips, whose equal points, rounded to float, are one. */
vtkSmartPointer<vtkPolyData> Triangulated(vtkPolyData* mesh)
{
  vtkNew<vtkTriangleFilter> filter;
  filter->SetInputData(mesh);
  filter->PassLinesOff();
  filter->PassVertsOff();
  filter->Update();
  vtkPolyData* triangles = filter->GetOutput();
  PointMerger points;
  vtkNew<vtkCellArray> faces;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cellId = 0; cellId < triangles->GetNumberOfPolys(); ++cellId)
  {
    triangles->GetPolys()->GetCellAtId(cellId, ids);
    vtkIdType corners[3];
    for (int corner = 0; corner < 3; ++corner)
    {
      double point[3];
      triangles->GetPoint(ids->GetId(corner), point);
      corners[corner] = points.Insert(
        static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]));
    }
    // A face whose corners fall together is dropped.
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
    {
      faces->InsertNextCell(3, corners);
    }
  }
  auto merged = vtkSmartPointer<vtkPolyData>::New();
  merged->SetPoints(points.GetPoints());
  merged->SetPolys(faces);
  return merged;
}

/** Points and faces of `mesh` alone. */
vtkSmartPointer<vtkPolyData> Bare(vtkPolyData* mesh)
{
  auto bare = vtkSmartPointer<vtkPolyData>::New();
  bare->SetPoints(mesh->GetPoints());
  bare->SetPolys(mesh->GetPolys());
  bare->SetStrips(mesh->GetStrips());
  return bare;
}
}

//------------------------------------------------------------------------------
const std::vector<std::string>& BuiltinObjects()
{
  static const std::vector<std::string> names = { "bunny", "part", "stool", "lattice", "bust",
    "torus" };
  return names;
}

//------------------------------------------------------------------------------
std::string ObjectName(const std::string& mesh)
{
  return mesh.empty() ? "bunny" : fs::path(mesh).stem().string();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeObject(vtkPolyData* raw, const std::string& where)
{
  vtkSmartPointer<vtkPolyData> clean = Triangulated(Bare(raw));
  if (clean->GetNumberOfPolys() == 0)
  {
    throw Error(where, "mesh contains no triangles");
  }
  vtkNew<vtkPolyDataNormals> orient;
  orient->SetInputData(clean);
  orient->SplittingOff();
  orient->ConsistencyOn();
  orient->SetAutoOrientNormals(IsClosed(clean));
  orient->Update();
  return Bare(orient->GetOutput());
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> LoadObject(const std::string& mesh)
{
  if (mesh.empty() || mesh == "bunny")
  {
    return MakeObject(ReadBunny(), "bunny");
  }
  const vtkSmartPointer<vtkPolyData> builtin = MakeBuiltinShape(mesh);
  return MakeObject(builtin ? builtin : ReadNamedFile(mesh), mesh);
}
}
