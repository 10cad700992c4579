// SPDX-License-Identifier: GPL-3.0-or-later
#include "ObjectMesh.h"

#include "BuiltinShapes.h"
#include "Error.h"
#include "NumberText.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkExecutive.h>
#include <vtkFeatureEdges.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPLYReader.h>
#include <vtkPoints.h>
#include <vtkPolyDataNormals.h>
#include <vtkSTLReader.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr const char* BunnyFile = "/usr/share/glmark2/models/bunny.obj";

void KeepFirstMessage(vtkObject*, unsigned long, void* clientData, void* callData)
{
  auto* message = static_cast<std::string*>(clientData);
  if (message->empty() && callData)
  {
    *message = static_cast<const char*>(callData);
  }
}

template <class Reader>
vtkSmartPointer<vtkPolyData> ReadWith(const std::string& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  // An observed error is not printed by VTK; it becomes part of the one Error instead.
  std::string message;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(KeepFirstMessage);
  observer->SetClientData(&message);
  reader->AddObserver("ErrorEvent", observer);
  reader->GetExecutive()->AddObserver("ErrorEvent", observer);
  reader->AddObserver("WarningEvent", observer);
  if constexpr (std::is_same_v<Reader, vtkXMLPolyDataReader>)
  {
    reader->SetParserErrorObserver(observer);
    reader->SetReaderErrorObserver(observer);
  }
  reader->Update();
  vtkSmartPointer<vtkPolyData> mesh = reader->GetOutput();
  if (!mesh || mesh->GetNumberOfCells() == 0)
  {
    throw Error(file,
      "is no readable mesh or holds no faces" +
        (message.empty() ? std::string() : " (" + message + ")"));
  }
  return mesh;
}

/** VTK's reader crashes on a PLY file whose header is cut; so it never sees one. */
void CheckPlyHeader(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  const bool magic = std::getline(stream, line) && line.starts_with("ply");
  while (magic && std::getline(stream, line))
  {
    if (line.starts_with("end_header"))
    {
      return;
    }
  }
  throw Error(file, "is no readable mesh or holds no faces (the header of a PLY file has no end)");
}

vtkSmartPointer<vtkPolyData> ReadMeshFile(const std::string& file)
{
  std::error_code failure;
  if (!fs::is_regular_file(file, failure))
  {
    std::string builtin;
    for (const std::string& name : BuiltinObjects())
    {
      builtin += (builtin.empty() ? "" : ", ") + name;
    }
    throw Error(file, "mesh file does not exist (built-in objects: " + builtin + ")");
  }
  const std::string extension = LowerCase(fs::path(file).extension().string());
  if (extension == ".obj")
  {
    return ReadWith<vtkOBJReader>(file);
  }
  if (extension == ".ply")
  {
    CheckPlyHeader(file);
    return ReadWith<vtkPLYReader>(file);
  }
  if (extension == ".stl")
  {
    return ReadWith<vtkSTLReader>(file);
  }
  if (extension == ".vtp")
  {
    return ReadWith<vtkXMLPolyDataReader>(file);
  }
  throw Error(
    file, "unknown kind of mesh file", "\"" + extension + "\"", ".obj, .ply, .stl or .vtp");
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

bool IsClosed(vtkPolyData* mesh)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(mesh);
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->BoundaryEdgesOn();
  edges->NonManifoldEdgesOn();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells() == 0;
}

vtkSmartPointer<vtkPolyData> Triangulated(vtkPolyData* mesh)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  clean->SetTolerance(0);
  clean->ConvertPolysToLinesOff(); // a face whose corners fall together is dropped
  clean->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  clean->Update();
  return clean->GetOutput();
}

/** Points and triangles of `mesh` alone. */
vtkSmartPointer<vtkPolyData> Bare(vtkPolyData* mesh)
{
  auto bare = vtkSmartPointer<vtkPolyData>::New();
  bare->SetPoints(mesh->GetPoints());
  bare->SetPolys(mesh->GetPolys());
  return bare;
}

void CheckCoordinates(vtkPolyData* mesh, const std::string& where)
{
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    const double* point = mesh->GetPoint(ptId);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
    {
      throw Error(where, "point " + std::to_string(ptId) + " has coordinates that are not finite");
    }
  }
}
}

//------------------------------------------------------------------------------
const std::vector<std::string>& BuiltinObjects()
{
  static const std::vector<std::string> names = { "bunny", "part", "stool", "bust", "torus" };
  return names;
}

//------------------------------------------------------------------------------
std::string ObjectName(const std::string& mesh)
{
  return mesh.empty() ? "bunny" : fs::path(mesh).stem().string();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> LoadObject(const std::string& mesh)
{
  vtkSmartPointer<vtkPolyData> raw;
  if (mesh.empty() || mesh == "bunny")
  {
    raw = ReadBunny();
  }
  else
  {
    raw = MakeBuiltinShape(mesh);
    raw = raw ? raw : ReadMeshFile(mesh);
  }
  const std::string where = mesh.empty() ? "bunny" : mesh;
  CheckCoordinates(raw, where);
  vtkSmartPointer<vtkPolyData> clean = Bare(Triangulated(Bare(raw)));
  if (clean->GetNumberOfPolys() == 0)
  {
    throw Error(where, "mesh holds no triangles");
  }
  vtkNew<vtkPolyDataNormals> orient;
  orient->SetInputData(clean);
  orient->SplittingOff();
  orient->ConsistencyOn();
  orient->SetAutoOrientNormals(IsClosed(clean));
  orient->Update();
  return Bare(orient->GetOutput());
}
}
