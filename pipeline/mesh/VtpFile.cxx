// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/VtpFile.h"

#include "core/Error.h"
#include "mesh/MeshAssembly.h"
#include "mesh/VtpArrays.h"
#include "mesh/VtpDocument.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>

#include <vector>

namespace novelview
{
namespace
{
/** Puts the pieces of a VTP file together. */
class PieceReader
{
public:
  PieceReader(std::string_view bytes, const std::string& file)
    : Document(bytes, file)
    , Arrays(this->Document)
  {
  }

  vtkSmartPointer<vtkPolyData> Read(const std::string& file)
  {
    for (const pugi::xml_node& piece : this->Document.Root().child("PolyData").children("Piece"))
    {
      this->CheckArrays(piece);
      const vtkIdType first = this->Points->GetNumberOfPoints();
      this->ReadPoints(piece);
      this->ReadFaces(piece, "Polys", first, this->Polygons);
      this->ReadFaces(piece, "Strips", first, this->Strips);
    }
    if (this->Polygons->GetNumberOfCells() + this->Strips->GetNumberOfCells() == 0)
    {
      throw Error(file, "contains no faces");
    }
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    mesh->SetPoints(this->Points);
    mesh->SetPolys(this->Polygons);
    mesh->SetStrips(this->Strips);
    return mesh;
  }

private:
  /** Also of arrays that are not read. */
  void CheckArrays(const pugi::xml_node& piece) const
  {
    constexpr std::uint64_t most = 1000000;
    for (const pugi::xml_node& section : piece.children())
    {
      for (const pugi::xml_node& array : section.children("DataArray"))
      {
        const std::uint64_t components = this->Document.Count(array, "NumberOfComponents", 1);
        if (components < 1 || components > most)
        {
          throw Error(this->Document.Where(array), "NumberOfComponents is out of range",
            std::to_string(components), "1 to " + std::to_string(most));
        }
      }
    }
  }

  void ReadPoints(const pugi::xml_node& piece)
  {
    const std::uint64_t count = this->Document.Count(piece, "NumberOfPoints", 0);
    if (count == 0)
    {
      return;
    }
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    const std::string where = this->Document.Where(array ? array : piece);
    if (!array || this->Document.Count(array, "NumberOfComponents", 1) != 3)
    {
      throw Error(where, "piece has no array of points with three components");
    }
    const std::vector<double> numbers = this->Arrays.ReadNumbers(array, count, 3);
    if (this->Points->GetNumberOfPoints() == 0 &&
      std::string_view(array.attribute("type").value()) != "Float32")
    {
      this->Points->SetDataTypeToDouble();
    }
    for (std::size_t i = 0; i < numbers.size(); i += 3)
    {
      if (!IsCoordinate(numbers[i]) || !IsCoordinate(numbers[i + 1]) ||
        !IsCoordinate(numbers[i + 2]))
      {
        CheckPoint(numbers[i], numbers[i + 1], numbers[i + 2], where);
      }
      this->Points->InsertNextPoint(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
  }

  pugi::xml_node ArrayNamed(
    const pugi::xml_node& piece, const pugi::xml_node& section, const char* name) const
  {
    const pugi::xml_node array = section.find_child_by_attribute("DataArray", "Name", name);
    if (!array)
    {
      throw Error(this->Document.Where(section ? section : piece),
        std::string("no array \"") + name + "\" of the faces");
    }
    return array;
  }

  /** `first` is the number of the piece's first point. */
  void ReadFaces(
    const pugi::xml_node& piece, const std::string& kind, vtkIdType first, vtkCellArray* faces)
  {
    const std::uint64_t count = this->Document.Count(piece, ("NumberOf" + kind).c_str(), 0);
    if (count == 0)
    {
      return;
    }
    const pugi::xml_node section = piece.child(kind.c_str());
    const pugi::xml_node connectivity = this->ArrayNamed(piece, section, "connectivity");
    const pugi::xml_node offsets = this->ArrayNamed(piece, section, "offsets");
    const std::vector<std::int64_t> ends = this->Arrays.ReadIntegers(offsets, count);
    std::int64_t begin = 0;
    for (const std::int64_t end : ends)
    {
      if (end < begin)
      {
        throw Error(this->Document.Where(offsets), "offsets of the faces do not rise",
          std::to_string(end), "at least " + std::to_string(begin));
      }
      begin = end;
    }
    const std::vector<std::int64_t> ids =
      this->Arrays.ReadIntegers(connectivity, static_cast<std::uint64_t>(ends.back()));
    const std::string where = this->Document.Where(connectivity);
    const vtkIdType points = this->Points->GetNumberOfPoints() - first;
    std::vector<vtkIdType> corners;
    begin = 0;
    for (const std::int64_t end : ends)
    {
      corners.assign(ids.begin() + begin, ids.begin() + end);
      if (kind == "Strips")
      {
        FaceCheck::CheckStrip(corners, points, where);
      }
      else
      {
        this->Check.CheckPolygon(corners, points, where);
      }
      for (vtkIdType& corner : corners)
      {
        corner += first;
      }
      faces->InsertNextCell(static_cast<vtkIdType>(corners.size()), corners.data());
      begin = end;
    }
  }

  VtpDocument Document;
  VtpArrays Arrays;
  FaceCheck Check;
  vtkSmartPointer<vtkPoints> Points = vtkSmartPointer<vtkPoints>::New();
  vtkSmartPointer<vtkCellArray> Polygons = vtkSmartPointer<vtkCellArray>::New();
  vtkSmartPointer<vtkCellArray> Strips = vtkSmartPointer<vtkCellArray>::New();
};
}

vtkSmartPointer<vtkPolyData> ParseVtp(std::string_view bytes, const std::string& file)
{
  return PieceReader(bytes, file).Read(file);
}
}
