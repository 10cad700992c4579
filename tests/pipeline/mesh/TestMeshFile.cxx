// SPDX-License-Identifier: GPL-3.0-or-later
// People's mesh files: good ones give what VTK's readers give, wrong ones an Error that says why.
#include "mesh/MeshFile.h"
#include "mesh/ObjectMesh.h"
#include "support/MeshFiles.h"
#include "support/MessageOf.h"
#include "support/TestSupport.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkCubeSource.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkOBJWriter.h>
#include <vtkPLYReader.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSTLWriter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cstring>

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
template <class Reader>
vtkSmartPointer<vtkPolyData> ReadWithVtk(const fs::path& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

void ExpectSameFaces(vtkCellArray* ours, vtkCellArray* theirs)
{
  ASSERT_EQ(ours->GetNumberOfCells(), theirs->GetNumberOfCells());
  vtkNew<vtkIdList> a;
  vtkNew<vtkIdList> b;
  for (vtkIdType cellId = 0; cellId < ours->GetNumberOfCells(); ++cellId)
  {
    ours->GetCellAtId(cellId, a);
    theirs->GetCellAtId(cellId, b);
    ASSERT_EQ(a->GetNumberOfIds(), b->GetNumberOfIds()) << "face " << cellId;
    ASSERT_TRUE(std::equal(a->begin(), a->end(), b->begin())) << "face " << cellId;
  }
}

/** Bit-identical points and the same faces in the same order. */
void ExpectSameMesh(vtkPolyData* ours, vtkPolyData* theirs)
{
  ASSERT_GT(theirs->GetNumberOfPoints(), 0);
  ASSERT_EQ(ours->GetNumberOfPoints(), theirs->GetNumberOfPoints());
  ASSERT_EQ(ours->GetPoints()->GetDataType(), theirs->GetPoints()->GetDataType());
  for (vtkIdType ptId = 0; ptId < ours->GetNumberOfPoints(); ++ptId)
  {
    double a[3];
    double b[3];
    ours->GetPoint(ptId, a);
    theirs->GetPoint(ptId, b);
    ASSERT_EQ(std::memcmp(a, b, sizeof(a)), 0) << "point " << ptId << ": " << a[0] << " " << b[0];
  }
  ExpectSameFaces(ours->GetPolys(), theirs->GetPolys());
  ExpectSameFaces(ours->GetStrips(), theirs->GetStrips());
}

/** What was made of a mesh by VTK's filters before there were readers of our own. */
vtkSmartPointer<vtkPolyData> CleanedByVtk(vtkPolyData* mesh)
{
  vtkNew<vtkPolyData> bare;
  bare->SetPoints(mesh->GetPoints());
  bare->SetPolys(mesh->GetPolys());
  bare->SetStrips(mesh->GetStrips());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(bare);
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  clean->SetTolerance(0);
  clean->ConvertPolysToLinesOff();
  clean->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  clean->Update();
  return clean->GetOutput();
}

/** With points in single precision; newer versions of VTK read OBJ files in double precision. */
vtkSmartPointer<vtkPolyData> InSinglePrecision(vtkPolyData* mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  points->DeepCopy(mesh->GetPoints());
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->ShallowCopy(mesh);
  result->SetPoints(points);
  return result;
}

class MeshFile : public testing::Test
{
protected:
  template <class Reader>
  void ExpectAsVtk(const std::string& name)
  {
    SCOPED_TRACE(name);
    ExpectSameMesh(ReadMeshFile(this->Folder / name), ReadWithVtk<Reader>(this->Folder / name));
  }

  /** The message of the Error for a file with this text; empty without one. */
  static std::string Message(const std::string& extension, const std::string& text)
  {
    return MessageOf([&] { ParseMesh(text, extension, "file"); });
  }

  TemporaryFolder Folder;
};

std::string PlyText(const std::string& vertexCount, const std::string& body,
  const std::string& face = "element face 1\nproperty list uchar int vertex_indices\n")
{
  return "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex " + vertexCount +
    "\nproperty float x\nproperty float y\nproperty float z\n" + face + "end_header\n" + body;
}

const std::string Corners = "0 0 0\n1 0 0\n0 1 0\n";

const std::string GoodStl = "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\nendsolid t\n";

/** A file with one triangle. */
std::string VtpText(const std::string& points, const std::string& connectivity,
  const std::string& offsets, const std::string& attributes = "")
{
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece NumberOfPoints=\"3\" "
         "NumberOfPolys=\"1\">\n<Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" "
         "format=\"ascii\"" +
    attributes + ">\n" + points +
    "\n</DataArray>\n</Points>\n<Polys>\n<DataArray type=\"Int32\" Name=\"connectivity\" "
    "format=\"ascii\">" +
    connectivity + "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" +
    offsets + "</DataArray>\n</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}
}

// ---- Good files, against VTK's readers ------------------------------------------------------------
TEST_F(MeshFile, PlyFilesAreReadAsByVtk)
{
  for (const auto& mesh : { Ball(), Tin() })
  {
    Write<vtkPLYWriter>(
      mesh, this->Folder / "a.ply", [](vtkPLYWriter* w) { w->SetFileTypeToASCII(); });
    this->ExpectAsVtk<vtkPLYReader>("a.ply");
    Write<vtkPLYWriter>(
      mesh, this->Folder / "b.ply", [](vtkPLYWriter* w) { w->SetDataByteOrderToLittleEndian(); });
    this->ExpectAsVtk<vtkPLYReader>("b.ply");
    Write<vtkPLYWriter>(
      mesh, this->Folder / "c.ply", [](vtkPLYWriter* w) { w->SetDataByteOrderToBigEndian(); });
    this->ExpectAsVtk<vtkPLYReader>("c.ply");
  }
}

TEST_F(MeshFile, PlyPropertiesComeInAnyOrderAndType)
{
  WriteText(this->Folder / "a.ply",
    "ply\r\nformat ascii 1.0\r\nobj_info any\r\nelement vertex 4\r\nproperty uchar red\r\n"
    "property double z\r\nproperty list uchar float weights\r\nproperty short y\r\n"
    "property float x\r\nelement material 1\r\nproperty int kind\r\nelement face 2\r\n"
    "property list ushort float uv\r\nproperty list uint uint vertex_indices\r\n"
    "property uchar flags\r\nend_header\r\n"
    "1 0.1 2 5 6 7 0.7\r\n2 0.2 0 -8 1.1\r\n3 1e-3 1 0 9 16777217\r\n4 1 0 2 3\r\n77\r\n"
    "2 0.5 0.5 3 0 1 2 0\r\n0 4 0 1 2 3 1\r\n");
  const vtkSmartPointer<vtkPolyData> mesh = ReadMeshFile(this->Folder / "a.ply");
  ASSERT_EQ(mesh->GetNumberOfPoints(), 4);
  EXPECT_EQ(mesh->GetPoint(0)[0], 0.7f);
  EXPECT_EQ(mesh->GetPoint(0)[1], 7);
  EXPECT_EQ(mesh->GetPoint(0)[2], 0.1f);
  EXPECT_EQ(mesh->GetPoint(2)[0], 16777216) << "rounded to float";
  ASSERT_EQ(mesh->GetNumberOfPolys(), 2);
  EXPECT_EQ(mesh->GetCell(1)->GetNumberOfPoints(), 4);
  EXPECT_EQ(mesh->GetCell(1)->GetPointId(3), 3);
}

TEST_F(MeshFile, StlFilesAreReadAsByVtk)
{
  for (const auto& mesh : { Triangulated(Ball()), Triangulated(Tin()) })
  {
    Write<vtkSTLWriter>(
      mesh, this->Folder / "a.stl", [](vtkSTLWriter* w) { w->SetFileTypeToASCII(); });
    this->ExpectAsVtk<vtkSTLReader>("a.stl");
    Write<vtkSTLWriter>(
      mesh, this->Folder / "b.stl", [](vtkSTLWriter* w) { w->SetFileTypeToBinary(); });
    this->ExpectAsVtk<vtkSTLReader>("b.stl");
  }
  // Two solids, a triangle whose corners fall together, a zero with either sign, odd case and blanks.
  WriteText(this->Folder / "c.stl",
    GoodStl +
      "\nSOLID\n color 1 1 1\n  Facet Normal nan 0 0\n\tOuter Loop\n Vertex -0 0 0\r\n"
      "vertex 0.1 0 0\nvertex 0.1 0 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
      "vertex 1 0 0\nvertex 5e-1 1.25E+1 -3\nvertex -0.0 0 0\nendloop\nendfacet\nendsolid\n");
  this->ExpectAsVtk<vtkSTLReader>("c.stl");
}

TEST_F(MeshFile, ObjFilesAreReadAsByVtk)
{
  WriteText(this->Folder / "a.obj",
    "# a comment\nmtllib a.mtl\no thing\ng part\nv 0.1 0.2 0.3\nv 1e-7 16777217 33554435.1\n"
    "v 0.333333333333333333 1.00000005960464478 1\n v  3 4\t5 1.0\nv 7 8 9\r\nusemtl m\ns off\n"
    "f 1 2 3\nf 1 2 3 4\nf -1 -2 -5\nf 2 \\\n 3 4 \\\n 5\nl 1 2\n");
  ExpectSameMesh(ReadMeshFile(this->Folder / "a.obj"),
    InSinglePrecision(ReadWithVtk<vtkOBJReader>(this->Folder / "a.obj")));
}

TEST_F(MeshFile, ObjCornersMayNameTextureAndNormal)
{
  const auto ids = [](const std::string& faces)
  {
    const vtkSmartPointer<vtkPolyData> mesh =
      ParseMesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n" + faces, ".obj", "file");
    EXPECT_EQ(mesh->GetNumberOfPoints(), 3);
    vtkIdList* corners = mesh->GetCell(0)->GetPointIds();
    return std::vector<vtkIdType>(corners->begin(), corners->end());
  };
  const std::vector<vtkIdType> expected{ 2, 0, 1 };
  EXPECT_EQ(ids("f 3 1 2 # end\n"), expected);
  EXPECT_EQ(ids("f 3/1 1/1 2/1\n"), expected);
  EXPECT_EQ(ids("f 3//1 1//1 2//1"), expected);
  EXPECT_EQ(ids("f 3/1/1 1/1/1 2/1/1\n"), expected);
  EXPECT_EQ(ids("f -1/-1/-1 -3/-1/-1 -2/-1/-1\n"), expected);
}

TEST_F(MeshFile, VtpFilesAreReadAsByVtk)
{
  const std::vector<std::pair<std::string, vtkSmartPointer<vtkPolyData>>> meshes = {
    { "ball", Ball() }, { "double", Ball(vtkAlgorithm::DOUBLE_PRECISION) }, { "strips", Strips() }
  };
  using Kind = vtkXMLWriterBase;
  for (const auto& [name, mesh] : meshes)
  {
    for (const int mode : { Kind::Ascii, Kind::Binary, Kind::Appended })
    {
      for (const int compressor : { Kind::NONE, Kind::ZLIB, Kind::LZ4, Kind::LZMA })
      {
        for (int variant = 0; variant < 8; ++variant)
        {
          SCOPED_TRACE(name + ", mode " + std::to_string(mode) + ", compressor " +
            std::to_string(compressor) + ", variant " + std::to_string(variant));
          const auto configure = [&](vtkXMLPolyDataWriter* writer)
          {
            writer->SetDataMode(mode);
            writer->SetCompressorType(compressor);
            writer->SetEncodeAppendedData((variant & 1) != 0);
            writer->SetHeaderType((variant & 2) != 0 ? Kind::UInt32 : Kind::UInt64);
            writer->SetByteOrder((variant & 4) != 0 ? Kind::BigEndian : Kind::LittleEndian);
            writer->SetBlockSize(360); // several blocks
          };
          Write<vtkXMLPolyDataWriter>(mesh, this->Folder / "a.vtp", configure);
          this->ExpectAsVtk<vtkXMLPolyDataReader>("a.vtp");
        }
      }
    }
  }
}

TEST_F(MeshFile, VtpFilesMayHavePieces)
{
  const auto configure = [](vtkXMLPolyDataWriter* writer) { writer->SetNumberOfPieces(3); };
  Write<vtkXMLPolyDataWriter>(Ball(), this->Folder / "a.vtp", configure);
  this->ExpectAsVtk<vtkXMLPolyDataReader>("a.vtp");
}

TEST_F(MeshFile, ObjectsAreWhatVtkMadeOfThem)
{
  // Normals and texture coordinates make VTK's reader repeat points, which are then merged again.
  Write<vtkOBJWriter>(Triangulated(Tin()), this->Folder / "tin.obj");
  EXPECT_THAT(ReadText(this->Folder / "tin.obj"), HasSubstr("f 1/1/1 2/2/2 3/3/3"));
  Write<vtkXMLPolyDataWriter>(Strips(), this->Folder / "strips.vtp");
  Write<vtkPLYWriter>(Tin(), this->Folder / "tin.ply");
  const auto expectSame = [this](const std::string& name, vtkPolyData* read)
  {
    SCOPED_TRACE(name);
    const vtkSmartPointer<vtkPolyData> object = LoadObject((this->Folder / name).string());
    const vtkSmartPointer<vtkPolyData> theirs = CleanedByVtk(read);
    ASSERT_EQ(object->GetNumberOfPoints(), theirs->GetNumberOfPoints());
    EXPECT_EQ(object->GetNumberOfPolys(), theirs->GetNumberOfPolys());
    for (vtkIdType ptId = 0; ptId < object->GetNumberOfPoints(); ++ptId)
    {
      EXPECT_EQ(object->GetPoint(ptId)[0], theirs->GetPoint(ptId)[0]) << ptId;
    }
  };
  expectSame("tin.obj", ReadWithVtk<vtkOBJReader>(this->Folder / "tin.obj"));
  expectSame("strips.vtp", ReadWithVtk<vtkXMLPolyDataReader>(this->Folder / "strips.vtp"));
  expectSame("tin.ply", ReadWithVtk<vtkPLYReader>(this->Folder / "tin.ply"));
}

// ---- Spoilt files ---------------------------------------------------------------------------------
TEST_F(MeshFile, SaysWhatIsWrongWithAPlyFile)
{
  const auto message = [](const std::string& text) { return Message(".ply", text); };
  EXPECT_EQ(message(PlyText("3", Corners + "3 0 1 2\n")), "");
  EXPECT_THAT(message(""), HasSubstr("file, line 1: is not a PLY file"));
  EXPECT_THAT(message("ply\nformat ascii 1.0\nelement vertex 3\n"), HasSubstr("no end_header"));
  EXPECT_THAT(message(PlyText("4294967295", Corners + "3 0 1 2\n")),
    HasSubstr("file, line 4: the file is too short for the element \"vertex\" 4294967295 (got 27 "
              "bytes, expected at least 6 for each of 4294967295)"));
  EXPECT_THAT(
    message(PlyText("-3", Corners)), HasSubstr("without a number of instances (got \"-3\""));
  EXPECT_THAT(message(PlyText("3", "0 0 0\n1 0\n0 1 0\n3 0 1 2\n")),
    HasSubstr("file, line 12: line has fewer numbers than the header"));
  EXPECT_THAT(message(PlyText("3", "0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n")),
    HasSubstr("file, line 12: is not a number (got \"zero\""));
  EXPECT_THAT(message(PlyText("3", Corners + "3 0 1 2 5\n")), HasSubstr("line has more numbers"));
  EXPECT_THAT(message(PlyText("3", Corners + "3 0 1 2\n3 0 1 2\n")), HasSubstr("continues after"));
  EXPECT_THAT(message(PlyText("3", Corners + "3 0 1 3\n")),
    HasSubstr("file, line 14: face names a point that does not exist (got 3, expected 0 to 2)"));
  EXPECT_THAT(message(PlyText("3", Corners + "2 0 1\n")), HasSubstr("number of corners (got 2"));
  EXPECT_THAT(
    message(PlyText("3", Corners + "-1 0 1\n")), HasSubstr("length of a list is negative"));
  EXPECT_THAT(message(PlyText("3", Corners + "3 0 1 1.5\n")), HasSubstr("is not an integer"));
  EXPECT_THAT(message(PlyText("3", "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")),
    HasSubstr("file, line 12: coordinate of a point is not finite or too large (got nan"));
  EXPECT_THAT(message(PlyText("3", "0 0 0\n1e300 0 0\n0 1 0\n3 0 1 2\n")), HasSubstr("got 1e+300"));
  const std::string face = "element face 1\nproperty list uchar int ";
  EXPECT_THAT(message(PlyText("3", Corners + "3 0 1 2\n", face + "corners\n")),
    HasSubstr("has no list of integers \"vertex_indices\""));
  EXPECT_THAT(message(PlyText("3", Corners, "")), HasSubstr("without the element \"face\""));
  EXPECT_THAT(
    message(PlyText("3", Corners, "element face 0\nproperty list uchar int vertex_index\n")),
    HasSubstr("contains no faces"));
  EXPECT_THAT(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\n"),
    HasSubstr("file, line 4: unknown type of a property (got \"quad\""));
  EXPECT_THAT(message("ply\nformat ascii 1.0\nelement vertex 1\nproperty int a\nproperty int a\n"),
    HasSubstr("file, line 5: property \"a\" is there twice"));
}

TEST_F(MeshFile, SaysWhereABinaryFileIsCut)
{
  Write<vtkPLYWriter>(Ball(), this->Folder / "a.ply");
  const std::string ply = ReadText(this->Folder / "a.ply");
  EXPECT_EQ(Message(".ply", ply), "");
  EXPECT_THAT(Message(".ply", ply.substr(0, ply.size() - 5)), HasSubstr("file ends too early"));
  EXPECT_THAT(Message(".ply", ply.substr(0, ply.size() - 5)), HasSubstr("file, byte "));
  EXPECT_THAT(Message(".ply", ply + "more"), HasSubstr("continues after its end"));
  Write<vtkSTLWriter>(Triangulated(Ball()), this->Folder / "a.stl",
    [](vtkSTLWriter* writer) { writer->SetFileTypeToBinary(); });
  const std::string stl = ReadText(this->Folder / "a.stl");
  EXPECT_EQ(Message(".stl", stl), "");
  EXPECT_THAT(Message(".stl", stl.substr(0, stl.size() - 5)), HasSubstr("has the wrong size"));
}

TEST_F(MeshFile, SaysWhatIsWrongWithAnObjFile)
{
  const auto message = [](const std::string& text) { return Message(".obj", text); };
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(message(corners + "f 1 2 3\n"), "");
  EXPECT_THAT(message(""), HasSubstr("file: contains no faces"));
  EXPECT_THAT(message(corners + "f 1 2 4\n"),
    HasSubstr("file, line 4: face names a point that does not exist (got 4, expected 1 to 3"));
  EXPECT_THAT(message(corners + "f 1 2 0\n"), HasSubstr("(got 0, expected 1 to 3 or -3 to -1)"));
  EXPECT_THAT(message(corners + "f 1 2 -4\n"), HasSubstr("(got -4"));
  EXPECT_THAT(message(corners + "f 1 2 9223372036854775808\n"), HasSubstr("malformed corner"));
  EXPECT_THAT(message(corners + "f 1 2 -9223372036854775808\n"), HasSubstr("does not exist"));
  EXPECT_THAT(
    message(corners + "f 1 2 3/x\n"), HasSubstr("malformed corner of a face (got \"3/x\""));
  EXPECT_THAT(message(corners + "vn 0 0 1\nf 1//1 2//1 3//2147483647\n"),
    HasSubstr("file, line 5: face names a normal that does not exist (got 2147483647"));
  EXPECT_THAT(message(corners + "f 1/1 2/1 3/1\n"), HasSubstr("names a texture coordinate"));
  EXPECT_THAT(message(corners + "f 1 2\n"), HasSubstr("number of corners (got 2"));
  EXPECT_THAT(message("v 0 0\n"), HasSubstr("file, line 1: vertex without three coordinates"));
  EXPECT_THAT(message("v 0 inf 0\n"), HasSubstr("not finite or too large (got inf"));
}

TEST_F(MeshFile, SaysWhatIsWrongWithAnStlFile)
{
  const auto message = [](const std::string& text) { return Message(".stl", text); };
  EXPECT_EQ(message(GoodStl), "");
  EXPECT_THAT(message(""), HasSubstr("file: binary STL file has the wrong size (got 0 bytes"));
  EXPECT_THAT(message("solid\nendsolid\n"), HasSubstr("file: contains no faces"));
  EXPECT_THAT(message("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0\n"),
    HasSubstr("file, line 5: vertex without three coordinates"));
  EXPECT_THAT(message("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\n"),
    HasSubstr("file, line 5: unexpected word (got \"endloop\", expected \"vertex\")"));
  EXPECT_THAT(
    message(GoodStl.substr(0, GoodStl.find("endsolid"))), HasSubstr("file ends too early"));
  EXPECT_THAT(message("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n"),
    HasSubstr("file, line 4: coordinate of a point is not finite"));
}

TEST_F(MeshFile, SaysWhatIsWrongWithAVtpFile)
{
  const auto message = [](const std::string& text) { return Message(".vtp", text); };
  const std::string points = "0 0 0 1 0 0 0 1 0";
  EXPECT_EQ(message(VtpText(points, "0 1 2", "3")), "");
  EXPECT_THAT(message(""), HasSubstr("file, line 1: is not well-formed XML"));
  EXPECT_THAT(message("<a>\n<b>\n</a>"), HasSubstr("line 3: is not well-formed XML"));
  EXPECT_THAT(message("<VTKFile type=\"ImageData\"/>"), HasSubstr("(got the type \"ImageData\""));
  EXPECT_THAT(message(VtpText("0 0 0 1 0 0 0 1", "0 1 2", "3")),
    HasSubstr("file, line 6: array has the wrong number of values (got 8, expected 9)"));
  EXPECT_THAT(message(VtpText("0 0 0 1 0 x 0 1 0", "0 1 2", "3")), HasSubstr("(got \"x\""));
  EXPECT_THAT(message(VtpText("0 0 0 1 0 nan 0 1 0", "0 1 2", "3")), HasSubstr("not finite"));
  EXPECT_THAT(message(VtpText(points, "0 1 3", "3")),
    HasSubstr("file, line 11: face names a point that does not exist (got 3, expected 0 to 2)"));
  EXPECT_THAT(
    message(VtpText(points, "0 1 2", "-3")), HasSubstr("offsets of the faces do not rise"));
  EXPECT_THAT(message(VtpText(points, "0 1 2", "9223372036854775807")), HasSubstr("too short"));
  EXPECT_THAT(message(VtpText(points, "0 1", "2")), HasSubstr("number of corners (got 2"));
}

TEST_F(MeshFile, HugeNumberOfComponentsIsAnErrorAndNoHang)
{
  std::string text = VtpText("0 0 0 1 0 0 0 1 0", "0 1 2", "3");
  const std::string normals = "<PointData><DataArray type=\"Float32\" Name=\"Normals\" "
                              "NumberOfComponents=\"999999999999999999999999\"/></PointData>\n";
  text.insert(text.find("<Points>"), normals);
  EXPECT_THAT(Message(".vtp", text), HasSubstr("malformed NumberOfComponents"));
}

TEST_F(MeshFile, RefusesWhatIsNoFile)
{
  ExpectError([&] { ReadMeshFile(this->Folder / "absent.ply"); }, "absent.ply", "no such file");
  fs::create_directory(this->Folder / "folder.ply");
  ExpectError([&] { ReadMeshFile(this->Folder / "folder.ply"); }, "is not a regular file");
  ExpectError([&] { ReadMeshFile(this->Folder / "notes.txt"); }, "unknown kind of mesh file");
}

TEST_F(MeshFile, ManyLargePolygonsAreAnErrorAndNoHang)
{
  const auto text = [](int corners, int faces)
  {
    std::string face = "f";
    for (int i = 0; i < corners; ++i)
    {
      face += " " + std::to_string(1 + i % 3);
    }
    std::string all = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < faces; ++i)
    {
      all += face + "\n";
    }
    return all;
  };
  EXPECT_EQ(Message(".obj", text(10000, 1)), "");
  EXPECT_THAT(Message(".obj", text(10001, 1)), HasSubstr("(got 10001, expected 3 to 10000)"));
  EXPECT_THAT(Message(".obj", text(10000, 40)),
    HasSubstr("file, line 24: too many faces with this many corners"));
}

/** Points far away used to make the search for equal points compare each with each. */
TEST_F(MeshFile, OnePointFarAwayCostsNoTime)
{
  constexpr int size = 400;
  std::string text = "v 1e30 0 0\n";
  for (int i = 0; i < size * size; ++i)
  {
    text += "v " + std::to_string(i % size) + " " + std::to_string(i / size) + " 0\n";
  }
  for (int i = 2; i <= size * (size - 1); ++i)
  {
    text += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " +
      std::to_string(i + size) + "\n";
  }
  text += "f 1 2 3\n";
  WriteText(this->Folder / "far.obj", text);
  EXPECT_GT(LoadObject((this->Folder / "far.obj").string())->GetNumberOfPolys(), size * size / 2);
}
