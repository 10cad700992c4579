// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/StlFile.h"

#include "base/NumberText.h"
#include "base/TextLines.h"
#include "core/Error.h"
#include "core/PrintableText.h"
#include "mesh/MeshAssembly.h"

#include <array>
#include <bit>
#include <cstring>

namespace novelview
{
static_assert(std::endian::native == std::endian::little, "numbers of STL files are little-endian");

namespace
{
using Point = std::array<float, 3>;

// Of a binary file: a header with any text, the number of triangles, and for each its normal, three
// corners and two bytes of anything.
constexpr std::size_t HeaderSize = 80;
constexpr std::size_t TrianglesAt = HeaderSize + sizeof(std::uint32_t);
constexpr std::size_t TriangleSize = 4 * sizeof(Point) + 2;

/** Triangles whose equal corners are one point. */
class TriangleSoup
{
public:
  void Add(const std::array<Point, 3>& corners)
  {
    std::array<vtkIdType, 3> ids{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      ids[i] = this->Points.Insert(corners[i][0], corners[i][1], corners[i][2]);
    }
    if (ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0])
    {
      this->Triangles->InsertNextCell(3, ids.data());
    }
  }

  vtkSmartPointer<vtkPolyData> Finish(const std::string& file) const
  {
    if (this->Triangles->GetNumberOfCells() == 0)
    {
      throw Error(file, "contains no faces");
    }
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(this->Points.GetPoints());
    mesh->SetPolys(this->Triangles);
    return mesh;
  }

private:
  PointMerger Points;
  vtkSmartPointer<vtkCellArray> Triangles = vtkSmartPointer<vtkCellArray>::New();
};

void CheckCorner(double x, double y, double z, const auto& where)
{
  if (!IsCoordinate(x) || !IsCoordinate(y) || !IsCoordinate(z))
  {
    CheckPoint(x, y, z, where());
  }
}

std::uint32_t TriangleCount(std::string_view bytes)
{
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + HeaderSize, sizeof(count));
  return count;
}

bool HasBinarySize(std::string_view bytes)
{
  return bytes.size() >= TrianglesAt &&
    bytes.size() == TrianglesAt + std::uint64_t{ TriangleCount(bytes) } * TriangleSize;
}

vtkSmartPointer<vtkPolyData> ParseBinary(std::string_view bytes, const std::string& file)
{
  if (!HasBinarySize(bytes))
  {
    const std::string expected = bytes.size() < TrianglesAt
      ? "at least " + std::to_string(TrianglesAt) + ", or the word \"solid\" at the beginning"
      : std::to_string(TrianglesAt + std::uint64_t{ TriangleCount(bytes) } * TriangleSize) +
        " for its count of " + std::to_string(TriangleCount(bytes)) + " triangles";
    throw Error(file, "binary STL file has the wrong size", std::to_string(bytes.size()) + " bytes",
      expected);
  }
  TriangleSoup triangles;
  for (std::size_t at = TrianglesAt; at < bytes.size(); at += TriangleSize)
  {
    std::array<Point, 3> corners;
    static_assert(sizeof(corners) == 36);
    std::memcpy(corners.data(), bytes.data() + at + sizeof(Point), sizeof(corners));
    for (const Point& corner : corners)
    {
      CheckCorner(
        corner[0], corner[1], corner[2], [&] { return file + ", byte " + std::to_string(at); });
    }
    triangles.Add(corners);
  }
  return triangles.Finish(file);
}

/** Goes to the next line, whose first word, in any case, must be `expected`. */
void Expect(TextLines& lines, const std::string& expected)
{
  const bool hasLine = lines.NextWithWords();
  const std::string_view word = hasLine ? lines.Word() : std::string_view();
  if (LowerCase(std::string(word)) != expected)
  {
    throw Error(lines.Where(), hasLine ? "unexpected word" : "file ends too early",
      hasLine ? Quoted(word) : "nothing", "\"" + expected + "\"");
  }
}

Point ReadVertex(TextLines& lines)
{
  Expect(lines, "vertex");
  std::array<double, 3> point{};
  for (double& number : point)
  {
    const std::string_view word = lines.Word();
    if (!ParseNumber(word, number))
    {
      throw Error(lines.Where(), "vertex without three coordinates", Quoted(word), "a number");
    }
  }
  CheckCorner(point[0], point[1], point[2], [&] { return lines.Where(); });
  return { static_cast<float>(point[0]), static_cast<float>(point[1]),
    static_cast<float>(point[2]) };
}

/** What follows the line of a facet. */
std::array<Point, 3> ReadFacet(TextLines& lines)
{
  Expect(lines, "outer");
  std::array<Point, 3> corners;
  for (Point& corner : corners)
  {
    corner = ReadVertex(lines);
  }
  Expect(lines, "endloop");
  Expect(lines, "endfacet");
  return corners;
}

vtkSmartPointer<vtkPolyData> ParseAscii(std::string_view bytes, const std::string& file)
{
  TextLines lines(bytes, file);
  TriangleSoup triangles;
  bool inSolid = false;
  while (lines.NextWithWords())
  {
    const std::string_view text = lines.Word();
    const std::string word = LowerCase(std::string(text.substr(0, 16)));
    if (inSolid && word == "facet")
    {
      triangles.Add(ReadFacet(lines));
    }
    else if (word == (inSolid ? "endsolid" : "solid"))
    {
      inSolid = !inSolid;
    }
    else if (!inSolid || word != "color")
    {
      throw Error(lines.Where(), "unexpected word", Quoted(text),
        inSolid ? "\"facet\" or \"endsolid\"" : "\"solid\"");
    }
  }
  if (inSolid)
  {
    throw Error(lines.Where(), "file ends too early", "nothing", "\"facet\" or \"endsolid\"");
  }
  return triangles.Finish(file);
}
}

vtkSmartPointer<vtkPolyData> ParseStl(std::string_view bytes, const std::string& file)
{
  TextLines lines(bytes, file);
  const bool ascii = !HasBinarySize(bytes) && lines.NextWithWords() &&
    LowerCase(std::string(lines.Word().substr(0, 16))) == "solid";
  return ascii ? ParseAscii(bytes, file) : ParseBinary(bytes, file);
}
}
