// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/PlyFile.h"

#include "base/TextLines.h"
#include "core/Error.h"
#include "mesh/MeshAssembly.h"
#include "mesh/PlyHeader.h"
#include "mesh/PlyValues.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace novelview
{
namespace
{
const PlyElement* ElementNamed(const PlyHeader& header, const std::string& name)
{
  const auto element = std::find_if(header.Elements.begin(), header.Elements.end(),
    [&](const PlyElement& candidate) { return candidate.Name == name; });
  return element == header.Elements.end() ? nullptr : &*element;
}

std::size_t IndexOf(const PlyElement& element, const std::string& name)
{
  const auto property = std::find_if(element.Properties.begin(), element.Properties.end(),
    [&](const PlyProperty& candidate) { return candidate.Name == name; });
  return static_cast<std::size_t>(property - element.Properties.begin());
}

/** Where x, y and z are among the properties of a vertex. */
std::array<std::size_t, 3> FindCoordinates(const PlyElement& vertex)
{
  std::array<std::size_t, 3> indices{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name(1, "xyz"[axis]);
    indices[axis] = IndexOf(vertex, name);
    if (indices[axis] == vertex.Properties.size() || vertex.Properties[indices[axis]].IsList())
    {
      throw Error(vertex.Where, "element \"vertex\" has no number \"" + name + "\"");
    }
  }
  return indices;
}

/** Where the list of corners is among the properties of a face. */
std::size_t FindCorners(const PlyElement& face)
{
  std::size_t index = IndexOf(face, "vertex_indices");
  index = index < face.Properties.size() ? index : IndexOf(face, "vertex_index");
  if (index == face.Properties.size() || !face.Properties[index].IsList() ||
    !face.Properties[index].Type.IsInteger())
  {
    throw Error(face.Where,
      "element \"face\" has no list of integers \"vertex_indices\" or \"vertex_index\"");
  }
  return index;
}

std::int64_t TakeInteger(PlyValues& values, const PlyType& type, const char* what)
{
  const double number = values.Take(type);
  // An ascii file may contain any number; those of the types end at 2^32.
  if (!(std::abs(number) <= 4294967295.0) || number != std::floor(number))
  {
    throw Error(values.Where(), std::string(what) + " is not an integer");
  }
  return static_cast<std::int64_t>(number);
}

/** The length of a list. */
std::int64_t TakeCount(PlyValues& values, const PlyProperty& list)
{
  const std::int64_t count = TakeInteger(values, list.CountType, "length of a list");
  if (count < 0)
  {
    throw Error(values.Where(), "length of a list is negative", std::to_string(count), "0 or more");
  }
  return count;
}

void SkipProperty(PlyValues& values, const PlyProperty& property)
{
  if (property.IsList())
  {
    values.Skip(TakeCount(values, property), property.Type);
  }
  else
  {
    values.Take(property.Type);
  }
}

void ReadVertices(PlyValues& values, const PlyElement& vertex, MeshAssembly& mesh)
{
  const std::array<std::size_t, 3> coordinates = FindCoordinates(vertex);
  std::array<double, 3> point{};
  for (std::uint64_t instance = 0; instance < vertex.Count; ++instance)
  {
    values.BeginInstance();
    for (std::size_t index = 0; index < vertex.Properties.size(); ++index)
    {
      const auto axis = std::find(coordinates.begin(), coordinates.end(), index);
      if (axis == coordinates.end())
      {
        SkipProperty(values, vertex.Properties[index]);
      }
      else
      {
        point[static_cast<std::size_t>(axis - coordinates.begin())] =
          values.Take(vertex.Properties[index].Type);
      }
    }
    values.EndInstance();
    mesh.AddPoint(point[0], point[1], point[2], values);
  }
}

void ReadFaces(PlyValues& values, const PlyElement& face, MeshAssembly& mesh)
{
  const std::size_t list = FindCorners(face);
  std::vector<vtkIdType> corners;
  for (std::uint64_t instance = 0; instance < face.Count; ++instance)
  {
    values.BeginInstance();
    for (std::size_t index = 0; index < face.Properties.size(); ++index)
    {
      const PlyProperty& property = face.Properties[index];
      if (index != list)
      {
        SkipProperty(values, property);
        continue;
      }
      corners.clear();
      const std::int64_t count = TakeCount(values, property);
      for (std::int64_t i = 0; i < count; ++i)
      {
        corners.push_back(TakeInteger(values, property.Type, "corner of a face"));
      }
    }
    values.EndInstance();
    mesh.AddFace(corners, values);
  }
}

void SkipElement(PlyValues& values, const PlyElement& element)
{
  for (std::uint64_t instance = 0; instance < element.Count; ++instance)
  {
    values.BeginInstance();
    for (const PlyProperty& property : element.Properties)
    {
      SkipProperty(values, property);
    }
    values.EndInstance();
  }
}
}

vtkSmartPointer<vtkPolyData> ParsePly(std::string_view bytes, const std::string& file)
{
  TextLines lines(bytes, file);
  const PlyHeader header = ReadPlyHeader(lines);
  const PlyElement* vertex = ElementNamed(header, "vertex");
  const PlyElement* face = ElementNamed(header, "face");
  if (!vertex || !face)
  {
    throw Error(
      file, std::string("PLY file without the element \"") + (vertex ? "face" : "vertex") + "\"");
  }
  FindCoordinates(*vertex);
  FindCorners(*face);
  const std::unique_ptr<PlyValues> values = MakePlyValues(header.Encoding, bytes, lines);
  values->CheckLength(*vertex);
  MeshAssembly mesh(static_cast<vtkIdType>(vertex->Count));
  for (const PlyElement& element : header.Elements)
  {
    values->CheckLength(element);
    if (&element == vertex)
    {
      ReadVertices(*values, element, mesh);
    }
    else if (&element == face)
    {
      ReadFaces(*values, element, mesh);
    }
    else
    {
      SkipElement(*values, element);
    }
  }
  values->Finish();
  return mesh.Finish(file);
}
}
