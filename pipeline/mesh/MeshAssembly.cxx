// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/MeshAssembly.h"

#include "base/NumberText.h"
#include "core/Error.h"

#include <bit>

namespace novelview
{
namespace
{
constexpr std::size_t MaxCorners = 10000;
constexpr std::uint64_t MaxSquares = 2000000000;
}

bool FaceCheck::Accept(const std::vector<vtkIdType>& corners, vtkIdType pointCount)
{
  const std::uint64_t squares = this->Squares + std::uint64_t{ corners.size() } * corners.size();
  bool good = corners.size() >= 3 && corners.size() <= MaxCorners && squares <= MaxSquares;
  for (const vtkIdType corner : corners)
  {
    good &= corner >= 0 && corner < pointCount;
  }
  // Triangles and quadrangles cost nothing.
  this->Squares = good && corners.size() > 4 ? squares : this->Squares;
  return good;
}

void FaceCheck::CheckPolygon(
  const std::vector<vtkIdType>& corners, vtkIdType pointCount, const std::string& where)
{
  if (this->Accept(corners, pointCount))
  {
    return;
  }
  if (corners.size() > MaxCorners)
  {
    throw Error(where, "face has an unusable number of corners", std::to_string(corners.size()),
      "3 to " + std::to_string(MaxCorners));
  }
  CheckStrip(corners, pointCount, where);
  throw Error(where, "too many faces with this many corners; write the mesh as triangles");
}

void FaceCheck::CheckStrip(
  const std::vector<vtkIdType>& corners, vtkIdType pointCount, const std::string& where)
{
  if (corners.size() < 3)
  {
    throw Error(where, "face has an unusable number of corners", std::to_string(corners.size()),
      "at least 3");
  }
  for (const vtkIdType corner : corners)
  {
    if (corner < 0 || corner >= pointCount)
    {
      throw Error(where, "face names a point that does not exist", std::to_string(corner),
        pointCount > 0 ? "0 to " + std::to_string(pointCount - 1) : "no face without points");
    }
  }
}

void CheckPoint(double x, double y, double z, const std::string& where)
{
  for (const double number : { x, y, z })
  {
    if (!IsCoordinate(number))
    {
      throw Error(where, "coordinate of a point is not finite or too large", NumberText(number),
        "a finite number of single precision");
    }
  }
}

vtkSmartPointer<vtkPolyData> MeshAssembly::Finish(const std::string& file) const
{
  if (this->Faces->GetNumberOfCells() == 0)
  {
    throw Error(file, "contains no faces");
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(this->Points);
  mesh->SetPolys(this->Faces);
  return mesh;
}

vtkIdType PointMerger::Insert(float x, float y, float z)
{
  // Adding zero makes -0 the same bits as 0, which it equals.
  const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number + 0.0f); };
  const auto [entry, isNew] =
    this->Ids.try_emplace({ bits(x), bits(y), bits(z) }, this->Points->GetNumberOfPoints());
  if (isNew)
  {
    this->Points->InsertNextPoint(x, y, z);
  }
  return entry->second;
}

std::size_t PointMerger::KeyHash::operator()(const Key& key) const
{
  std::uint64_t hash = 0;
  for (const std::uint32_t number : key)
  {
    hash = (hash ^ number) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}
}
