// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes in place of a mesh file are a valid mesh or an Error.
#include "mesh/MeshFile.h"
#include "mesh/ObjectMesh.h"
#include "support/MeshFiles.h"
#include "support/MessageOf.h"
#include "support/TestSupport.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPLYWriter.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <functional>
#include <random>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** Changes a file somewhere: a byte, a cut, bytes more, a piece twice, another number. */
std::string Spoil(std::string bytes, std::mt19937& random)
{
  const auto below = [&](std::size_t end)
  { return std::uniform_int_distribution<std::size_t>(0, end > 0 ? end - 1 : 0)(random); };
  static const std::vector<std::string> numbers = { "-1", "0", "1", "255", "256", "65536",
    "2147483647", "2147483648", "4294967295", "-2147483649", "9223372036854775807",
    "18446744073709551615", "1e999", "1e-999", "nan", "-inf", "0x10", "1.5", "" };
  const std::size_t changes = 1 + below(3);
  for (std::size_t change = 0; change < changes && !bytes.empty(); ++change)
  {
    const std::size_t at = below(bytes.size());
    switch (below(6))
    {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.erase(at, 1 + below(16));
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(64)));
        break;
      case 4:
        bytes.insert(at, 1 + below(8), static_cast<char>(below(256)));
        break;
      default:
      {
        const std::size_t number = bytes.find_first_of("0123456789", at);
        if (number != std::string::npos)
        {
          const std::size_t end = bytes.find_first_not_of("0123456789.", number);
          bytes.replace(number, end - number, numbers[below(numbers.size())]);
        }
      }
    }
  }
  return bytes;
}

void ExpectValid(vtkPolyData* mesh)
{
  ASSERT_GT(mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips(), 0);
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    const double* point = mesh->GetPoint(ptId);
    ASSERT_TRUE(std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]));
  }
  for (vtkCellArray* faces : { mesh->GetPolys(), mesh->GetStrips() })
  {
    vtkNew<vtkIdList> ids;
    for (vtkIdType cellId = 0; cellId < faces->GetNumberOfCells(); ++cellId)
    {
      faces->GetCellAtId(cellId, ids);
      ASSERT_GE(ids->GetNumberOfIds(), 3);
      for (const vtkIdType id : *ids)
      {
        ASSERT_TRUE(id >= 0 && id < mesh->GetNumberOfPoints());
      }
    }
  }
}

/** Every spoilt file is a valid mesh or an Error of one line. */
void ExpectMeshOrError(const std::string& extension, const std::vector<std::string>& good)
{
  for (const std::string& bytes : good)
  {
    EXPECT_EQ(MessageOf([&] { ParseMesh(bytes, extension, "file"); }), "");
  }
  std::mt19937 random(7);
  int errors = 0;
  int meshes = 0;
  for (int round = 0; round < 3000; ++round)
  {
    const std::string bytes = Spoil(good[static_cast<std::size_t>(round) % good.size()], random);
    try
    {
      const vtkSmartPointer<vtkPolyData> mesh = ParseMesh(bytes, extension, "file");
      ASSERT_NO_FATAL_FAILURE(ExpectValid(mesh)) << "round " << round;
      ASSERT_NO_FATAL_FAILURE(ExpectValid(MakeObject(mesh, "file"))) << "round " << round;
      ++meshes;
    }
    catch (const Error& error)
    {
      const std::string text = error.what();
      ASSERT_EQ(text.rfind("file", 0), 0u) << text;
      ASSERT_EQ(text.find('\n'), std::string::npos) << text;
      ASSERT_LT(text.size(), 400u) << text;
      ++errors;
    }
  }
  EXPECT_GT(errors, 300) << "the files are spoilt";
  EXPECT_GT(meshes, 30) << "but not always";
}

class SpoiltMeshFile : public testing::Test
{
protected:
  template <class Writer>
  std::string Bytes(vtkPolyData* mesh, const std::function<void(Writer*)>& configure)
  {
    Write<Writer>(mesh, this->Folder / "file.ply", configure); // vtkPLYWriter asks for the name
    return ReadText(this->Folder / "file.ply");
  }

  TemporaryFolder Folder;
};
}

TEST_F(SpoiltMeshFile, PlyIsAMeshOrAnError)
{
  const vtkSmartPointer<vtkPolyData> tin = Tin();
  ExpectMeshOrError(".ply",
    { this->Bytes<vtkPLYWriter>(tin, [](vtkPLYWriter* w) { w->SetFileTypeToASCII(); }),
      this->Bytes<vtkPLYWriter>(tin, [](vtkPLYWriter* w) { w->SetDataByteOrderToLittleEndian(); }),
      this->Bytes<vtkPLYWriter>(tin, [](vtkPLYWriter* w) { w->SetDataByteOrderToBigEndian(); }) });
}

TEST_F(SpoiltMeshFile, ObjIsAMeshOrAnError)
{
  ExpectMeshOrError(
    ".obj", { this->Bytes<vtkOBJWriter>(Triangulated(Tin()), [](vtkOBJWriter*) {}) });
}

TEST_F(SpoiltMeshFile, StlIsAMeshOrAnError)
{
  const vtkSmartPointer<vtkPolyData> tin = Triangulated(Tin());
  ExpectMeshOrError(".stl",
    { this->Bytes<vtkSTLWriter>(tin, [](vtkSTLWriter* w) { w->SetFileTypeToASCII(); }),
      this->Bytes<vtkSTLWriter>(tin, [](vtkSTLWriter* w) { w->SetFileTypeToBinary(); }) });
}

TEST_F(SpoiltMeshFile, VtpIsAMeshOrAnError)
{
  using Kind = vtkXMLWriterBase;
  std::vector<std::string> good;
  for (const int mode : { Kind::Ascii, Kind::Binary, Kind::Appended })
  {
    for (const int compressor : { Kind::NONE, Kind::ZLIB, Kind::LZ4, Kind::LZMA })
    {
      good.push_back(this->Bytes<vtkXMLPolyDataWriter>(Strips(),
        [&](vtkXMLPolyDataWriter* writer)
        {
          writer->SetDataMode(mode);
          writer->SetCompressorType(compressor);
          writer->SetEncodeAppendedData(compressor % 2 == 0);
          writer->SetBlockSize(360);
        }));
    }
  }
  ExpectMeshOrError(".vtp", good);
}
