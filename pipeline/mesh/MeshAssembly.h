// SPDX-License-Identifier: GPL-3.0-or-later
/** What the readers of mesh files share: points and faces are checked as they are added. */
#ifndef novelview_MeshAssembly_h
#define novelview_MeshAssembly_h

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <unordered_map>
#include <vector>

namespace novelview
{
/** Whether a number is finite, also when it is rounded to float. */
inline bool IsCoordinate(double number)
{
  return std::abs(number) <= std::numeric_limits<float>::max();
}

/**
 * Checks the faces of a mesh one after the other: a face has at least three corners, which exist. Since
 * the time to cut a polygon into triangles grows with the square of its corners, it has at most ten
 * thousand, and the squares of all polygons have a limit, too: what takes some twenty seconds.
 */
class FaceCheck
{
public:
  /** Throws Error, with `where`, for corners that are none of `pointCount` points, and so on. */
  void CheckPolygon(
    const std::vector<vtkIdType>& corners, vtkIdType pointCount, const std::string& where);
  /** The same for a strip of triangles, which may have any number of corners. */
  static void CheckStrip(
    const std::vector<vtkIdType>& corners, vtkIdType pointCount, const std::string& where);

  /** Whether CheckPolygon() would throw nothing; then the face is counted. */
  bool Accept(const std::vector<vtkIdType>& corners, vtkIdType pointCount);

private:
  std::uint64_t Squares = 0;
};

/** Throws Error when one of the numbers is no IsCoordinate(). */
void CheckPoint(double x, double y, double z, const std::string& where);

/** Points and polygons. A `place` has a method Where(): file, and line or byte. */
class MeshAssembly
{
public:
  /** `pointCount` points will be added; there is memory for as many. */
  explicit MeshAssembly(vtkIdType pointCount)
    : PointCount(pointCount)
  {
    this->Points->Allocate(pointCount);
  }

  template <class Place>
  void AddPoint(double x, double y, double z, const Place& place)
  {
    if (!IsCoordinate(x) || !IsCoordinate(y) || !IsCoordinate(z))
    {
      CheckPoint(x, y, z, place.Where());
    }
    this->Points->InsertNextPoint(x, y, z);
  }

  template <class Place>
  void AddFace(const std::vector<vtkIdType>& corners, const Place& place)
  {
    if (!this->Check.Accept(corners, this->PointCount))
    {
      this->Check.CheckPolygon(corners, this->PointCount, place.Where());
    }
    this->Faces->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
  }

  /** The mesh. Throws Error when it has no face. */
  vtkSmartPointer<vtkPolyData> Finish(const std::string& file) const;

private:
  vtkIdType PointCount;
  FaceCheck Check;
  vtkSmartPointer<vtkPoints> Points = vtkSmartPointer<vtkPoints>::New();
  vtkSmartPointer<vtkCellArray> Faces = vtkSmartPointer<vtkCellArray>::New();
};

/** Collects points and gives equal ones the same id: that of their first appearance. */
class PointMerger
{
public:
  vtkIdType Insert(float x, float y, float z);

  /** The points, in the order of their ids. */
  vtkPoints* GetPoints() const { return this->Points; }

private:
  using Key = std::array<std::uint32_t, 3>;
  struct KeyHash
  {
    std::size_t operator()(const Key& key) const;
  };

  vtkSmartPointer<vtkPoints> Points = vtkSmartPointer<vtkPoints>::New();
  std::unordered_map<Key, vtkIdType, KeyHash> Ids;
};
}

#endif
