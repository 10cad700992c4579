// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/PolyDataFile.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/ByteStream.h"
#include "core/Error.h"

#include <Eigen/Dense>

#include <spdlog/fmt/fmt.h>

#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <iterator>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
static_assert(std::endian::native == std::endian::little, "the formats' numbers are");

void AddTuple(ByteWriter& file, vtkDataArray* array, vtkIdType tuple)
{
  double values[3];
  array->GetTuple(tuple, values);
  for (const double value : values)
  {
    file.Add(static_cast<float>(value));
  }
}

using CellVisitor = std::function<void(vtkIdType count, const vtkIdType* ptIds)>;

void ForEachPolygon(vtkPolyData* mesh, const CellVisitor& visit)
{
  auto cell = vtkSmartPointer<vtkCellArrayIterator>::Take(mesh->GetPolys()->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* ptIds = nullptr;
    cell->GetCurrentCell(count, ptIds);
    visit(count, ptIds);
  }
}

/** The texts of VTK's writer, whose files these are like. */
std::string PlyHead(vtkPolyData* mesh, bool normals, bool colours)
{
  std::string head = "ply\nformat binary_little_endian 1.0\ncomment VTK generated PLY File\n"
                     "obj_info vtkPolyData points and polygons: vtk4.0\n";
  head += fmt::format("element vertex {}\n", mesh->GetNumberOfPoints());
  head += "property float x\nproperty float y\nproperty float z\n";
  head += normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "";
  head += colours ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "";
  head += fmt::format("element face {}\n", mesh->GetPolys()->GetNumberOfCells());
  return head + "property list uchar int vertex_indices\nend_header\n";
}
}

void WriteVtp(const fs::path& file, vtkPolyData* mesh, VtpCompressor compressor)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(mesh);
  writer->SetDataModeToBinary();
  if (compressor == VtpCompressor::Lz4)
  {
    writer->SetCompressorTypeToLZ4();
  }
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1)
  {
    throw Error(file.string(), "cannot be written as VTK's XML");
  }
  WriteTextAtomically(file, writer->GetOutputString());
}

void WritePly(const fs::path& file, vtkPolyData* mesh)
{
  vtkDataArray* const points = mesh->GetPoints()->GetData();
  vtkDataArray* const normals = mesh->GetPointData()->GetNormals();
  auto* const colours =
    vtkUnsignedCharArray::SafeDownCast(mesh->GetPointData()->GetArray(arrays::Color));
  ByteWriter bytes{ PlyHead(mesh, normals, colours) };
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    AddTuple(bytes, points, ptId);
    if (normals)
    {
      AddTuple(bytes, normals, ptId);
    }
    for (int c = 0; colours && c < 3; ++c)
    {
      bytes.Add(colours->GetTypedComponent(ptId, c));
    }
  }
  ForEachPolygon(mesh,
    [&bytes](vtkIdType count, const vtkIdType* ptIds)
    {
      bytes.Add(static_cast<std::uint8_t>(count));
      for (vtkIdType i = 0; i < count; ++i)
      {
        bytes.Add(static_cast<std::int32_t>(ptIds[i]));
      }
    });
  WriteTextAtomically(file, bytes.Written);
}

void WriteStl(const fs::path& file, vtkPolyData* mesh)
{
  constexpr std::size_t headSize = 80;
  ByteWriter bytes{ "Visualization Toolkit generated SLA File" };
  bytes.Written.resize(headSize);
  bytes.Add(static_cast<std::uint32_t>(mesh->GetPolys()->GetNumberOfCells()));
  ForEachPolygon(mesh,
    [&](vtkIdType count, const vtkIdType* ptIds)
    {
      if (count != 3)
      {
        throw Error(file.string(), "only triangles can be written");
      }
      Eigen::Vector3d at[3];
      for (int corner = 0; corner < 3; ++corner)
      {
        mesh->GetPoint(ptIds[corner], at[corner].data());
      }
      const Eigen::Vector3d normal = (at[1] - at[0]).cross(at[2] - at[0]).normalized();
      for (const Eigen::Vector3d& vector : { normal, at[0], at[1], at[2] })
      {
        for (int c = 0; c < 3; ++c)
        {
          bytes.Add(static_cast<float>(vector[c]));
        }
      }
      bytes.Add(std::uint16_t(0));
    });
  WriteTextAtomically(file, bytes.Written);
}

std::string ObjText(vtkPolyData* mesh, const std::string& head)
{
  std::string text = head;
  const auto append = [&text](const char* kind, vtkDataArray* array)
  {
    for (vtkIdType tuple = 0; tuple < array->GetNumberOfTuples(); ++tuple)
    {
      text += kind;
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        // The shortest text that reads back as the same float.
        fmt::format_to(
          std::back_inserter(text), " {}", static_cast<float>(array->GetComponent(tuple, c)));
      }
      text += '\n';
    }
  };
  append("v", mesh->GetPoints()->GetData());
  append("vt", mesh->GetPointData()->GetTCoords());
  append("vn", mesh->GetPointData()->GetNormals());
  ForEachPolygon(mesh,
    [&text](vtkIdType count, const vtkIdType* ptIds)
    {
      text += 'f';
      for (vtkIdType i = 0; i < count; ++i)
      {
        fmt::format_to(std::back_inserter(text), " {0}/{0}/{0}", ptIds[i] + 1);
      }
      text += '\n';
    });
  return text;
}
}
