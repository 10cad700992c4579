// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/ObjFile.h"

#include "base/NumberText.h"
#include "base/TextLines.h"
#include "core/Error.h"
#include "core/PrintableText.h"
#include "mesh/MeshAssembly.h"

#include <algorithm>
#include <vector>

namespace novelview
{
namespace
{
/** How many of each a face may name. */
struct Counts
{
  std::int64_t Points = 0;
  std::int64_t Textures = 0;
  std::int64_t Normals = 0;

  /** Counts the statement with this keyword. */
  void Add(std::string_view keyword)
  {
    this->Points += keyword == "v";
    this->Textures += keyword == "vt";
    this->Normals += keyword == "vn";
  }
};

Counts CountAll(std::string_view bytes)
{
  Counts counts;
  TextLines lines(bytes, {});
  while (lines.Next())
  {
    counts.Add(lines.Word());
  }
  return counts;
}

/** The next word of the statement, which may go on in the next line; empty at its end. */
std::string_view NextWord(TextLines& lines)
{
  std::string_view word = lines.Word();
  while (word == "\\" && lines.Rest().empty() && lines.Next())
  {
    word = lines.Word();
  }
  return word;
}

void ReadVertex(TextLines& lines, MeshAssembly& mesh)
{
  double point[3] = {};
  for (double& number : point)
  {
    const std::string_view word = NextWord(lines);
    float rounded = 0;
    if (!ParseNumber(word, number))
    {
      throw Error(lines.Where(), "vertex without three coordinates", Quoted(word), "a number");
    }
    // From the text to float at once, not by way of double.
    number = ParseNumber(word, rounded) ? static_cast<double>(rounded) : number;
  }
  mesh.AddPoint(point[0], point[1], point[2], lines);
}

/**
 * What one number of a corner names, from 0, of `count` things in the file and `before` above it.
 */
std::int64_t NamedBy(std::string_view number, std::string_view corner, const char* kind,
  std::int64_t count, std::int64_t before, const TextLines& lines)
{
  std::int64_t index = 0;
  if (!ParseNumber(number, index))
  {
    throw Error(
      lines.Where(), "malformed corner of a face", Quoted(corner), "v, v/vt, v//vn or v/vt/vn");
  }
  const bool exists = index > 0 ? index <= count : index < 0 && index >= -before;
  if (!exists)
  {
    throw Error(lines.Where(), std::string("face names a ") + kind + " that does not exist",
      std::to_string(index),
      "1 to " + std::to_string(count) + " or -" + std::to_string(before) + " to -1");
  }
  return index > 0 ? index - 1 : before + index;
}

/** The number of the point at a corner, from 0. */
vtkIdType CornerPoint(
  std::string_view corner, const Counts& all, const Counts& before, const TextLines& lines)
{
  const std::size_t slash = std::min(corner.find('/'), corner.size());
  const std::string_view rest = corner.substr(std::min(slash + 1, corner.size()));
  const std::size_t second = std::min(rest.find('/'), rest.size());
  const std::string_view texture = rest.substr(0, second);
  const std::string_view normal = rest.substr(std::min(second + 1, rest.size()));
  if (!texture.empty())
  {
    NamedBy(texture, corner, "texture coordinate", all.Textures, before.Textures, lines);
  }
  if (!normal.empty())
  {
    NamedBy(normal, corner, "normal", all.Normals, before.Normals, lines);
  }
  return NamedBy(corner.substr(0, slash), corner, "point", all.Points, before.Points, lines);
}
}

vtkSmartPointer<vtkPolyData> ParseObj(std::string_view bytes, const std::string& file)
{
  const Counts all = CountAll(bytes);
  MeshAssembly mesh(all.Points);
  std::vector<vtkIdType> corners;
  Counts before;
  TextLines lines(bytes, file);
  while (lines.Next())
  {
    const std::string_view keyword = lines.Word();
    before.Add(keyword);
    if (keyword == "v")
    {
      ReadVertex(lines, mesh);
    }
    else if (keyword == "f")
    {
      corners.clear();
      for (std::string_view word = NextWord(lines); !word.empty(); word = NextWord(lines))
      {
        if (word.starts_with('#'))
        {
          break;
        }
        corners.push_back(CornerPoint(word, all, before, lines));
      }
      mesh.AddFace(corners, lines);
    }
  }
  return mesh.Finish(file);
}
}
