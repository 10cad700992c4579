// SPDX-License-Identifier: GPL-3.0-or-later
// Writes small good files for the fuzzers to start from. usage: MakeSeeds FOLDER; each fuzzer's are in
// FOLDER/NAME
#include "FuzzSupport.h"
#include "formats/DatasetFormats.h"

#include <vtkCylinderSource.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPLYWriter.h>
#include <vtkSTLWriter.h>
#include <vtkStripper.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataWriter.h>

#include <functional>
#include <iterator>

namespace
{
namespace fs = std::filesystem;

template <class Writer>
void Write(
  const fs::path& file, vtkPolyData* mesh, const std::function<void(Writer*)>& configure = {})
{
  fs::create_directories(file.parent_path());
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(mesh);
  if (configure)
  {
    configure(writer);
  }
  if (writer->Write() != 1)
  {
    fuzz::Fail("cannot write " + file.string());
  }
}

void WriteVtpFiles(const fs::path& folder, vtkPolyData* mesh)
{
  using Kind = vtkXMLWriterBase;
  for (const int mode : { Kind::Ascii, Kind::Binary, Kind::Appended })
  {
    for (const int compressor : { Kind::NONE, Kind::ZLIB, Kind::LZ4, Kind::LZMA })
    {
      for (const bool raw : { false, true })
      {
        const std::string name =
          std::to_string(mode) + std::to_string(compressor) + (raw ? "r" : "");
        Write<vtkXMLPolyDataWriter>(folder / (name + ".vtp"), mesh,
          [&](vtkXMLPolyDataWriter* writer)
          {
            writer->SetDataMode(mode);
            writer->SetCompressorType(compressor);
            writer->SetEncodeAppendedData(!raw);
            writer->SetHeaderType(raw ? Kind::UInt32 : Kind::UInt64);
            writer->SetBlockSize(360);
          });
      }
    }
  }
}

void WriteMeshes(const fs::path& folder)
{
  vtkNew<vtkCylinderSource> tin;
  tin->SetResolution(5);
  tin->Update();
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(tin->GetOutputPort());
  triangles->Update();
  vtkNew<vtkStripper> strips;
  strips->SetInputConnection(triangles->GetOutputPort());
  strips->Update();
  Write<vtkPLYWriter>(folder / "FuzzMeshPly/a.ply", tin->GetOutput(),
    [](vtkPLYWriter* writer) { writer->SetFileTypeToASCII(); });
  Write<vtkPLYWriter>(folder / "FuzzMeshPly/b.ply", tin->GetOutput());
  Write<vtkPLYWriter>(folder / "FuzzMeshPly/c.ply", tin->GetOutput(),
    [](vtkPLYWriter* writer) { writer->SetDataByteOrderToBigEndian(); });
  Write<vtkOBJWriter>(folder / "FuzzMeshObj/a.obj", tin->GetOutput());
  Write<vtkSTLWriter>(folder / "FuzzMeshStl/a.stl", triangles->GetOutput(),
    [](vtkSTLWriter* writer) { writer->SetFileTypeToASCII(); });
  Write<vtkSTLWriter>(folder / "FuzzMeshStl/b.stl", triangles->GetOutput(),
    [](vtkSTLWriter* writer) { writer->SetFileTypeToBinary(); });
  WriteVtpFiles(folder / "FuzzMeshVtp", strips->GetOutput());
}

std::vector<novelview::Photograph> ThreePhotographs(bool withLens)
{
  std::vector<novelview::Photograph> photographs;
  for (int i = 0; i < 3; ++i)
  {
    novelview::Photograph photograph;
    photograph.Name = std::string(1, static_cast<char>('a' + i)) + ".png";
    photograph.File = photograph.Name;
    Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
    K.diagonal() << 50, 50, 1;
    K(0, 2) = 32;
    K(1, 2) = 24;
    photograph.Cam = novelview::LookAt(
      Eigen::Vector3d(3, i - 1, 0.5), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), K, 64, 48);
    if (withLens)
    {
      photograph.Distortion.Coefficients = { 0.1, -0.01, 0.001, 0.002 };
    }
    photographs.push_back(photograph);
  }
  return photographs;
}

/** The files of a calibration, as FuzzCalibration takes them apart. */
void WriteCalibration(const fs::path& folder, const std::string& format, char number, bool withLens)
{
  const novelview::DatasetFormat& writer = novelview::FormatOf(format);
  std::string bytes(1, number);
  bool first = true;
  for (const novelview::FileContent& file : writer.Compose("a", ThreePhotographs(withLens)))
  {
    if (file.Path.filename().string().starts_with("points3D"))
    {
      continue;
    }
    bytes += (first ? "" : std::string(fuzz::FileMark)) + file.Bytes;
    first = false;
  }
  fuzz::WriteFile(folder / "FuzzCalibration" / (format + (withLens ? "-lens" : "")), bytes);
}

void WriteCalibrations(const fs::path& folder)
{
  WriteCalibration(folder, "middlebury", 0, false);
  WriteCalibration(folder, "neus", 7, false);
  WriteCalibration(folder, "mvsnet", 9, false);
  for (const bool withLens : { false, true })
  {
    WriteCalibration(folder, "colmap", 1, withLens);
    WriteCalibration(folder, "colmap-binary", 2, withLens);
    WriteCalibration(folder, "nerf", 3, withLens);
    WriteCalibration(folder, "opencv", 4, withLens);
    WriteCalibration(folder, "bouguet", 6, withLens);
  }
  fuzz::WriteFile(folder / "FuzzCalibration/opencv-xml",
    "\x05<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>64</image_width>\n"
    "<image_height>48</image_height>\n<camera_matrix type_id=\"opencv-matrix\">\n<rows>3</rows>\n"
    "<cols>3</cols>\n<dt>d</dt>\n<data>\n50. 0. 32. 0. 50. 24. 0. 0. 1.</data></camera_matrix>\n"
    "<distortion_coefficients type_id=\"opencv-matrix\">\n<rows>1</rows>\n<cols>5</cols>\n"
    "<dt>d</dt>\n<data>\n0.1 0. 0. 0. 0.</data></distortion_coefficients>\n"
    "<extrinsic_parameters type_id=\"opencv-matrix\">\n<rows>3</rows>\n<cols>6</cols>\n<dt>d</dt>\n"
    "<data>\n0. 0. 0. 0. 0. 1. 0. 0.1 0. 0. 0. 1. 0. 0.2 0. 0. 0. 1.</data>"
    "</extrinsic_parameters>\n</opencv_storage>\n");
}

void WriteJobs(const fs::path& folder)
{
  const fs::path jobs = folder / "FuzzJob";
  fuzz::WriteFile(jobs / "job",
    "0{\n  \"dataset\": \"photos\",\n  \"view\": \"between:0,1,0.5\",\n  \"out\": \"out\",\n"
    "  \"preset\": \"best\",\n  \"exclude\": [\"a.png\"],\n  \"threads\": 2,\n"
    "  \"outlineIterations\": 3,\n  \"weights\": 0.5\n}\n");
  fuzz::WriteFile(jobs / "like", "0{\"dataset\": \".\", \"view\": \"like:a.png\", \"out\": \"o\"}");
  fuzz::WriteFile(jobs / "path",
    "1{ \"closed\": true, \"size\": \"64x48\", \"keys\": [ { \"camera\": 0, \"frame\": 0 },\n"
    "  { \"position\": [3, 0, 1], \"lookAt\": [0, 0, 0], \"up\": [0, 0, 1], \"fieldOfView\": 40,\n"
    "    \"frame\": 3 } ] }\n");
  fuzz::WriteFile(jobs / "matrices",
    "1{ \"keys\": [ { \"camera\": \"a.png\", \"time\": 0 }, { \"time\": 1.5,\n"
    "  \"K\": [[50, 0, 32], [0, 50, 24], [0, 0, 1]], \"R\": [1, 0, 0, 0, 1, 0, 0, 0, 1],\n"
    "  \"t\": [0, 0, 3] } ] }\n");
}
}

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    fuzz::Fail("usage: MakeSeeds FOLDER");
  }
  const fs::path folder = argv[1];
  WriteMeshes(folder);
  WriteCalibrations(folder);
  WriteJobs(folder);
  return 0;
}
