// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/SceneGeometry.h"

#include "ViewAccess.h"
#include "base/ByteStream.h"
#include "base/Parallel.h"
#include "core/Error.h"
#include "synthesis/DataBytes.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>

namespace novelview
{
namespace
{
/** The meshes of a scene and the sections they go to. */
using MeshMember = vtkSmartPointer<vtkPolyData> SceneGeometry::*;
constexpr std::array<std::pair<const char*, MeshMember>, 3> Meshes{ {
  { "crust", &SceneGeometry::Crust },
  { "hull", &SceneGeometry::Hull },
  { "medial balls", &SceneGeometry::MedialBalls },
} };
constexpr const char* NotesSection = "notes";

/** A view's section. */
std::string ViewSection(std::size_t viewId)
{
  return "view " + std::to_string(viewId);
}

/** The arrays and numbers of `made` that `given`, which may be null, has not. */
vtkSmartPointer<vtkImageData> NewParts(vtkImageData* made, vtkImageData* given)
{
  const auto isNew = [](vtkFieldData* data, vtkAbstractArray* array)
  { return !data || data->GetAbstractArray(array->GetName()) != array; };
  auto parts = vtkSmartPointer<vtkImageData>::New();
  parts->CopyStructure(made);
  for (int i = 0; i < made->GetPointData()->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = made->GetPointData()->GetAbstractArray(i);
    if (isNew(given ? given->GetPointData() : nullptr, array))
    {
      parts->GetPointData()->AddArray(array);
    }
  }
  for (int i = 0; i < made->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = made->GetFieldData()->GetAbstractArray(i);
    if (isNew(given ? given->GetFieldData() : nullptr, array))
    {
      parts->GetFieldData()->AddArray(array);
    }
  }
  return parts;
}

/** A view with the kept parts on top of what is given. */
vtkSmartPointer<vtkImageData> Completed(vtkImageData* given, vtkImageData* parts)
{
  int size[3];
  int keptSize[3];
  given->GetDimensions(size);
  parts->GetDimensions(keptSize);
  if (!std::equal(size, size + 3, keptSize))
  {
    throw Error("a kept view", "is not of the photograph's size");
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->ShallowCopy(given);
  for (int i = 0; i < parts->GetPointData()->GetNumberOfArrays(); ++i)
  {
    image->GetPointData()->AddArray(parts->GetPointData()->GetArray(i));
  }
  for (int i = 0; i < parts->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    image->GetFieldData()->AddArray(parts->GetFieldData()->GetAbstractArray(i));
  }
  return image;
}

/** The names of the views, the tables of all of them together, and the warnings. */
std::string PackNotes(const SceneGeometry& scene)
{
  ByteWriter writer;
  const unsigned int count = scene.Views->GetNumberOfBlocks();
  writer.Add<std::uint64_t>(count);
  for (unsigned int viewId = 0; viewId < count; ++viewId)
  {
    writer.AddText(ViewName(scene.Views, viewId));
  }
  vtkFieldData* numbers = scene.Views->GetFieldData();
  writer.Add<std::uint64_t>(numbers->GetNumberOfArrays());
  for (int i = 0; i < numbers->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = numbers->GetAbstractArray(i);
    const int columns = array->GetNumberOfComponents();
    const std::vector<double> values = AttachedTable(scene.Views, array->GetName(), columns);
    writer.AddText(array->GetName());
    writer.Add<std::uint64_t>(columns);
    writer.Add<std::uint64_t>(values.size());
    for (const double value : values)
    {
      writer.Add<double>(value);
    }
  }
  writer.Add<std::uint64_t>(scene.Warnings.size());
  for (const std::string& warning : scene.Warnings)
  {
    writer.AddText(warning);
  }
  return std::move(writer.Written);
}

/** Reads the notes into a scene and returns the names of its views. */
std::vector<std::string> UnpackNotes(
  std::string_view bytes, const std::string& where, SceneGeometry& scene)
{
  ByteReader reader(bytes, where);
  std::vector<std::string> names;
  for (auto count = reader.Take<std::uint64_t>(); count > 0; --count)
  {
    names.push_back(reader.TakeText());
  }
  for (auto count = reader.Take<std::uint64_t>(); count > 0; --count)
  {
    const std::string name = reader.TakeText();
    const auto columns = reader.Take<std::uint64_t>();
    std::vector<double> values;
    for (auto left = reader.Take<std::uint64_t>(); left > 0; --left)
    {
      values.push_back(reader.Take<double>());
    }
    if (columns < 1 || columns > 16 || values.size() % columns != 0)
    {
      throw Error(where, "table " + name + " is damaged",
        std::to_string(values.size()) + " numbers in " + std::to_string(columns) + " columns",
        "whole rows of 1 to 16");
    }
    AttachTable(scene.Views, name.c_str(), values, static_cast<int>(columns));
  }
  for (auto count = reader.Take<std::uint64_t>(); count > 0; --count)
  {
    scene.Warnings.push_back(reader.TakeText());
  }
  reader.RequireEnd();
  return names;
}

/** Reads meshes and views, spread over the threads. */
std::vector<vtkSmartPointer<vtkImageData>> UnpackParts(
  const SceneSource& source, std::size_t views, SceneGeometry& scene)
{
  std::vector<vtkSmartPointer<vtkImageData>> parts(views);
  ParallelForEach(Meshes.size() + views,
    [&](std::size_t i)
    {
      if (i >= Meshes.size())
      {
        const std::string name = ViewSection(i - Meshes.size());
        parts[i - Meshes.size()] = UnpackedImage(source.Read(name), source.Where(name));
        return;
      }
      const auto& [name, member] = Meshes[i];
      if (std::find(source.Names.begin(), source.Names.end(), name) != source.Names.end())
      {
        scene.*member = UnpackedMesh(source.Read(name), source.Where(name));
      }
    });
  return parts;
}
}

std::vector<SceneSection> PackScene(const SceneGeometry& scene, vtkMultiBlockDataSet* given)
{
  std::vector<SceneSection> sections{ { NotesSection, PackNotes(scene) } };
  for (const auto& [name, member] : Meshes)
  {
    if (scene.*member)
    {
      sections.push_back({ name, PackedMesh(scene.*member) });
    }
  }
  for (unsigned int viewId = 0; viewId < scene.Views->GetNumberOfBlocks(); ++viewId)
  {
    const auto parts =
      NewParts(ViewImage(scene.Views, viewId), given ? ViewImage(given, viewId) : nullptr);
    sections.push_back({ ViewSection(viewId), PackedImage(parts) });
  }
  return sections;
}

SceneGeometry UnpackScene(const SceneSource& source, vtkMultiBlockDataSet* given)
{
  SceneGeometry scene;
  scene.Views = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  const std::string where = source.Where(NotesSection);
  const std::vector<std::string> names = UnpackNotes(source.Read(NotesSection), where, scene);
  if (given && names.size() != given->GetNumberOfBlocks())
  {
    throw Error(where, "the views are not as many as the photographs", std::to_string(names.size()),
      std::to_string(given->GetNumberOfBlocks()));
  }
  const auto parts = UnpackParts(source, names.size(), scene);
  for (unsigned int viewId = 0; viewId < parts.size(); ++viewId)
  {
    vtkImageData* before = given ? ViewImage(given, viewId) : nullptr;
    const auto image = before ? Completed(before, parts[viewId]) : parts[viewId];
    AppendView(scene.Views, names[viewId], image, AttachedCamera(image, names[viewId]));
  }
  // Whatever the stages would stumble over.
  if (!names.empty())
  {
    ReadViews(scene.Views, {});
  }
  if (scene.Crust)
  {
    ToTriangleMesh(scene.Crust, source.Where(Meshes.front().first));
  }
  return scene;
}
}
