// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/DataBytes.h"

#include "base/ByteStream.h"
#include "base/QuietCompressor.h"
#include "core/Error.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr std::size_t BlockBytes = 1 << 20;
constexpr std::uint64_t LargestExpansion = 255; ///< of LZ4
constexpr int LargestComponents = 64;

/** Appends the bytes in blocks: the stored length and the stored bytes of each. */
void Compress(const char* bytes, std::size_t count, ByteWriter& writer)
{
  QuietCompressor lz4(vtkSmartPointer<vtkLZ4DataCompressor>::New());
  for (std::size_t done = 0; done < count; done += BlockBytes)
  {
    const std::string_view block(bytes + done, std::min(BlockBytes, count - done));
    const std::string stored = lz4.Compress(block);
    const bool smaller = !stored.empty() && stored.size() < block.size();
    writer.AddText(smaller ? std::string_view(stored) : block);
  }
}

/** Takes them again. */
void Uncompress(ByteReader& reader, char* bytes, std::size_t count, const std::string& where)
{
  QuietCompressor lz4(vtkSmartPointer<vtkLZ4DataCompressor>::New());
  for (std::size_t done = 0; done < count; done += BlockBytes)
  {
    const std::size_t length = std::min(BlockBytes, count - done);
    const std::string_view stored = reader.TakeBytes(reader.Take<std::uint64_t>());
    if (stored.size() == length)
    {
      std::copy(stored.begin(), stored.end(), bytes + done);
    }
    else if (stored.size() > length || !lz4.Uncompress(stored, bytes + done, length))
    {
      throw Error(where, "its compressed bytes are damaged");
    }
  }
}

bool IsKept(int type)
{
  switch (type)
  {
    case VTK_SIGNED_CHAR:
    case VTK_UNSIGNED_CHAR:
    case VTK_INT:
    case VTK_LONG:
    case VTK_LONG_LONG:
    case VTK_ID_TYPE:
    case VTK_FLOAT:
    case VTK_DOUBLE:
      return true;
    default:
      return false;
  }
}

void AddArray(ByteWriter& writer, vtkDataArray* array)
{
  if (!array || !IsKept(array->GetDataType()))
  {
    throw Error("cache", "an array is of a kind that is not kept",
      array ? array->GetDataTypeAsString() : "no numbers", "numbers");
  }
  writer.Add<std::int32_t>(array->GetDataType());
  writer.Add<std::int32_t>(array->GetNumberOfComponents());
  writer.Add<std::int64_t>(array->GetNumberOfTuples());
  writer.AddText(array->GetName() ? array->GetName() : "");
  Compress(static_cast<const char*>(array->GetVoidPointer(0)),
    static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize(), writer);
}

vtkSmartPointer<vtkDataArray> TakeArray(ByteReader& reader, const std::string& where)
{
  const auto type = reader.Take<std::int32_t>();
  const auto components = reader.Take<std::int32_t>();
  const auto tuples = reader.Take<std::int64_t>();
  const std::string name = reader.TakeText();
  // So many bytes cannot be in what is left, which also keeps the products small.
  const std::uint64_t most = reader.Left() * LargestExpansion;
  if (!IsKept(type) || components < 1 || components > LargestComponents || tuples < 0 ||
    static_cast<std::uint64_t>(tuples) > most)
  {
    throw Error(where, "an array's type or length is damaged");
  }
  auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  const std::uint64_t bytes =
    static_cast<std::uint64_t>(tuples) * components * array->GetDataTypeSize();
  if (bytes > most)
  {
    throw Error(where, "an array's length is damaged");
  }
  array->SetName(name.empty() ? nullptr : name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  Uncompress(reader, static_cast<char*>(array->GetVoidPointer(0)), bytes, where);
  return array;
}

void AddArrays(ByteWriter& writer, vtkFieldData* arrays)
{
  writer.Add<std::int32_t>(arrays->GetNumberOfArrays());
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    AddArray(writer, arrays->GetArray(i));
  }
}

/** @param tuples that each array must have; below 0 = any number. */
void TakeArrays(
  ByteReader& reader, vtkFieldData* arrays, vtkIdType tuples, const std::string& where)
{
  const auto count = reader.Take<std::int32_t>();
  for (std::int32_t i = 0; i < count; ++i)
  {
    const auto array = TakeArray(reader, where);
    if (!array->GetName() || (tuples >= 0 && array->GetNumberOfTuples() != tuples))
    {
      throw Error(where, "an array's name or length is damaged");
    }
    arrays->AddArray(array);
  }
}

void AddCells(ByteWriter& writer, vtkCellArray* cells)
{
  // Copies, since VTK keeps short ids in 32 bits.
  vtkNew<vtkTypeInt64Array> offsets;
  vtkNew<vtkTypeInt64Array> connectivity;
  offsets->DeepCopy(cells->GetOffsetsArray());
  connectivity->DeepCopy(cells->GetConnectivityArray());
  AddArray(writer, offsets);
  AddArray(writer, connectivity);
}

vtkSmartPointer<vtkTypeInt64Array> TakeIds(ByteReader& reader, const std::string& where)
{
  const auto array = TakeArray(reader, where);
  if (array->GetDataType() != VTK_TYPE_INT64 || array->GetNumberOfComponents() != 1)
  {
    throw Error(where, "its cells are damaged");
  }
  auto ids = vtkSmartPointer<vtkTypeInt64Array>::New(); // the class that cells want
  ids->ShallowCopy(array);
  return ids;
}

vtkSmartPointer<vtkCellArray> TakeCells(
  ByteReader& reader, vtkIdType points, const std::string& where)
{
  const auto offsets = TakeIds(reader, where);
  const auto connectivity = TakeIds(reader, where);
  const auto* offset = offsets->GetPointer(0);
  const auto* id = connectivity->GetPointer(0);
  const vtkIdType offsetCount = offsets->GetNumberOfTuples();
  const vtkIdType idCount = connectivity->GetNumberOfTuples();
  if (offsetCount < 1 || offset[0] != 0 || offset[offsetCount - 1] != idCount ||
    !std::is_sorted(offset, offset + offsetCount) ||
    std::any_of(id, id + idCount, [points](auto each) { return each < 0 || each >= points; }))
  {
    throw Error(where, "its cells are damaged");
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

vtkSmartPointer<vtkPoints> TakePoints(ByteReader& reader, const std::string& where)
{
  const auto array = TakeArray(reader, where);
  const bool real = array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
  if (!real || array->GetNumberOfComponents() != 3)
  {
    throw Error(where, "its points are damaged");
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(array->GetDataType());
  points->SetData(array);
  return points;
}
}

std::string PackedMesh(vtkPolyData* mesh)
{
  vtkNew<vtkPoints> none;
  ByteWriter writer;
  AddArray(writer, (mesh->GetPoints() ? mesh->GetPoints() : none.Get())->GetData());
  for (vtkCellArray* cells :
    { mesh->GetVerts(), mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() })
  {
    AddCells(writer, cells);
  }
  AddArrays(writer, mesh->GetPointData());
  AddArrays(writer, mesh->GetCellData());
  AddArrays(writer, mesh->GetFieldData());
  vtkDataArray* normals = mesh->GetPointData()->GetNormals();
  writer.AddText(normals ? normals->GetName() : "");
  return std::move(writer.Written);
}

vtkSmartPointer<vtkPolyData> UnpackedMesh(std::string_view bytes, const std::string& where)
{
  ByteReader reader(bytes, where);
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(TakePoints(reader, where));
  const vtkIdType points = mesh->GetNumberOfPoints();
  mesh->SetVerts(TakeCells(reader, points, where));
  mesh->SetLines(TakeCells(reader, points, where));
  mesh->SetPolys(TakeCells(reader, points, where));
  mesh->SetStrips(TakeCells(reader, points, where));
  TakeArrays(reader, mesh->GetPointData(), points, where);
  TakeArrays(reader, mesh->GetCellData(), mesh->GetNumberOfCells(), where);
  TakeArrays(reader, mesh->GetFieldData(), -1, where);
  if (const std::string normals = reader.TakeText(); !normals.empty())
  {
    vtkDataArray* array = mesh->GetPointData()->GetArray(normals.c_str());
    if (!array || array->GetNumberOfComponents() != 3)
    {
      throw Error(where, "its normals are damaged");
    }
    mesh->GetPointData()->SetActiveNormals(normals.c_str());
  }
  reader.RequireEnd();
  return mesh;
}

std::string PackedImage(vtkImageData* image)
{
  ByteWriter writer;
  int size[3];
  image->GetDimensions(size);
  writer.Add<std::int32_t>(size[0]);
  writer.Add<std::int32_t>(size[1]);
  AddArrays(writer, image->GetPointData());
  AddArrays(writer, image->GetFieldData());
  return std::move(writer.Written);
}

vtkSmartPointer<vtkImageData> UnpackedImage(std::string_view bytes, const std::string& where)
{
  ByteReader reader(bytes, where);
  const auto width = reader.Take<std::int32_t>();
  const auto height = reader.Take<std::int32_t>();
  if (width < 1 || height < 1)
  {
    throw Error(where, "its size is damaged");
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  TakeArrays(reader, image->GetPointData(), static_cast<vtkIdType>(width) * height, where);
  TakeArrays(reader, image->GetFieldData(), -1, where);
  reader.RequireEnd();
  return image;
}
}
