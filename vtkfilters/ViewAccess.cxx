// SPDX-License-Identifier: GPL-3.0-or-later
#include "ViewAccess.h"

#include "Threads.h"
#include "core/Error.h"
#include "vtkPinholeCamera.h"

#include <vtkAOSDataArrayTemplate.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeTraits.h>

#include <algorithm>
#include <atomic>

namespace novelview
{
namespace
{
using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

template <class T>
ImageRef<T> TopDown(vtkImageData* image, T* values, int channels)
{
  int size[3];
  image->GetDimensions(size);
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(size[0]) * channels;
  return { values + stride * (size[1] - 1), size[0], size[1], channels, -stride };
}

void AddField(vtkImageData* image, const char* name, const double* values, int count)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(count);
  array->InsertNextTypedTuple(values);
  image->GetFieldData()->AddArray(array);
}

void ReadField(
  vtkImageData* image, const char* name, double* values, int count, const std::string& where)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(name);
  if (!array || array->GetNumberOfValues() != count)
  {
    throw Error(where, std::string("field array ") + name + " is missing or has the wrong length",
      array ? std::to_string(array->GetNumberOfValues()) : "none", std::to_string(count));
  }
  for (int i = 0; i < count; ++i)
  {
    const int components = array->GetNumberOfComponents();
    values[i] = array->GetComponent(i / components, i % components);
  }
}
}

vtkSmartPointer<vtkImageData> NewImage(int width, int height)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  return image;
}

template <class T>
ImageRef<T> AddTopDownArray(vtkImageData* image, const char* name, int channels)
{
  // Of the named class (vtkUnsignedCharArray, ...), which callers' SafeDownCasts look for.
  const auto array =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(vtkTypeTraits<T>::VTKTypeID()));
  array->SetName(name);
  array->SetNumberOfComponents(channels);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
  return TopDown(image, static_cast<T*>(array->GetVoidPointer(0)), channels);
}

template <class T>
ImageRef<T> TopDownArray(
  vtkImageData* image, const char* name, int channels, const std::string& where, bool required)
{
  vtkDataArray* any = image->GetPointData()->GetArray(name);
  if (!any)
  {
    if (required)
    {
      throw Error(where, std::string("point array ") + name + " is missing");
    }
    return {};
  }
  auto* array = vtkAOSDataArrayTemplate<std::remove_const_t<T>>::FastDownCast(any);
  if (!array || array->GetNumberOfComponents() != channels)
  {
    throw Error(where, std::string("point array ") + name + " has the wrong type",
      std::string(any->GetDataTypeAsString()) + " x " +
        std::to_string(any->GetNumberOfComponents()),
      std::to_string(sizeof(T)) + "-byte values x " + std::to_string(channels));
  }
  if (array->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw Error(where, std::string("point array ") + name + " has the wrong length",
      std::to_string(array->GetNumberOfTuples()), std::to_string(image->GetNumberOfPoints()));
  }
  return TopDown<T>(image, array->GetPointer(0), channels);
}

template <class T>
void CopyToArray(const Image<T>& from, const char* name, vtkImageData* to)
{
  const ImageRef<T> rows = AddTopDownArray<T>(to, name, from.Channels);
  const std::size_t rowLength = static_cast<std::size_t>(from.Width) * from.Channels;
  ParallelFor(from.Height,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t y = begin; y < end; ++y)
      {
        std::copy_n(from.Values.data() + y * rowLength, rowLength, rows.Row(static_cast<int>(y)));
      }
    });
}

#define NOVELVIEW_INSTANTIATE(T)                                                                   \
  template VTKNOVELVIEWFILTERS_EXPORT void CopyToArray<T>(                                         \
    const Image<T>&, const char*, vtkImageData*);                                                  \
  template VTKNOVELVIEWFILTERS_EXPORT ImageRef<T> AddTopDownArray<T>(                              \
    vtkImageData*, const char*, int);                                                              \
  template VTKNOVELVIEWFILTERS_EXPORT ImageRef<T> TopDownArray<T>(                                 \
    vtkImageData*, const char*, int, const std::string&, bool);                                    \
  template VTKNOVELVIEWFILTERS_EXPORT ImageRef<const T> TopDownArray<const T>(                     \
    vtkImageData*, const char*, int, const std::string&, bool)
NOVELVIEW_INSTANTIATE(unsigned char);
NOVELVIEW_INSTANTIATE(float);
NOVELVIEW_INSTANTIATE(int);
#undef NOVELVIEW_INSTANTIATE

void AttachCamera(vtkImageData* image, const Camera& camera)
{
  const RowMajor3 k = camera.K;
  const RowMajor3 r = camera.R;
  AddField(image, arrays::CameraMatrix, k.data(), 9);
  AddField(image, arrays::Rotation, r.data(), 9);
  AddField(image, arrays::Translation, camera.T.data(), 3);
}

Camera AttachedCamera(vtkImageData* image, const std::string& where)
{
  RowMajor3 k;
  RowMajor3 r;
  Camera camera;
  ReadField(image, arrays::CameraMatrix, k.data(), 9, where);
  ReadField(image, arrays::Rotation, r.data(), 9, where);
  ReadField(image, arrays::Translation, camera.T.data(), 3, where);
  int size[3];
  image->GetDimensions(size);
  camera.K = k;
  camera.R = r;
  camera.Width = size[0];
  camera.Height = size[1];
  ValidateCamera(camera, where);
  return camera;
}

void AppendView(
  vtkMultiBlockDataSet* views, const std::string& name, vtkImageData* image, const Camera& camera)
{
  AttachCamera(image, camera);
  const unsigned int viewId = views->GetNumberOfBlocks();
  views->SetBlock(viewId, image);
  views->GetMetaData(viewId)->Set(vtkCompositeDataSet::NAME(), name.c_str());
}

std::string ViewName(vtkMultiBlockDataSet* views, unsigned int viewId)
{
  const char* name = views->HasMetaData(viewId)
    ? views->GetMetaData(viewId)->Get(vtkCompositeDataSet::NAME())
    : nullptr;
  return name ? name : "view" + std::to_string(viewId);
}

vtkImageData* ViewImage(vtkMultiBlockDataSet* views, unsigned int viewId)
{
  auto* image = vtkImageData::SafeDownCast(views->GetBlock(viewId));
  if (!image)
  {
    throw Error("view " + std::to_string(viewId) + " (" + ViewName(views, viewId) + ")",
      "block is not a vtkImageData");
  }
  return image;
}

std::vector<View> ReadViews(
  vtkMultiBlockDataSet* views, const ViewNeeds& needs, std::size_t atLeast)
{
  const unsigned int count = views ? views->GetNumberOfBlocks() : 0;
  if (count < atLeast)
  {
    throw Error("views", "too few", std::to_string(count), "at least " + std::to_string(atLeast));
  }
  std::vector<View> result;
  result.reserve(count);
  for (unsigned int viewId = 0; viewId < count; ++viewId)
  {
    View view;
    view.Name = ViewName(views, viewId);
    const std::string where = "view " + std::to_string(viewId) + " (" + view.Name + ")";
    vtkImageData* image = ViewImage(views, viewId);
    view.Cam = AttachedCamera(image, where);
    view.Color = TopDownArray<const unsigned char>(image, arrays::Color, 3, where, needs.Color);
    view.Mask = TopDownArray<const unsigned char>(image, arrays::Mask, 1, where, needs.Mask);
    view.ContourDistance =
      TopDownArray<const float>(image, arrays::ContourDistance, 1, where, needs.ContourDistance);
    view.DepthMap = TopDownArray<const float>(image, arrays::Depth, 1, where, false);
    view.Confidence = TopDownArray<const float>(image, arrays::Confidence, 1, where, false);
    view.Gain = AttachedNumber(image, arrays::ExposureGain, 1);
    if (!(view.Gain > 0))
    {
      throw Error(where, "ExposureGain is out of range", std::to_string(view.Gain), "more than 0");
    }
    result.push_back(view);
  }
  return result;
}

void AttachTable(
  vtkDataObject* to, const char* name, const std::vector<double>& values, int columns)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(columns);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / columns);
  std::copy_n(values.begin(), array->GetNumberOfValues(), array->GetPointer(0));
  to->GetFieldData()->AddArray(array);
}

std::vector<double> AttachedTable(vtkDataObject* to, const char* name, int columns)
{
  vtkDataArray* found = to ? to->GetFieldData()->GetArray(name) : nullptr;
  if (found && found->GetNumberOfComponents() != columns)
  {
    throw Error("views", std::string("field array ") + name + " has the wrong number of columns",
      std::to_string(found->GetNumberOfComponents()), std::to_string(columns));
  }
  std::vector<double> values;
  for (vtkIdType row = 0; found && row < found->GetNumberOfTuples(); ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      values.push_back(found->GetComponent(row, column));
    }
  }
  return values;
}

void AttachSupport(vtkDataObject* views, const std::vector<SupportPoint>& points)
{
  std::vector<double> table;
  for (const SupportPoint& point : points)
  {
    table.insert(table.end(), point.Position.data(), point.Position.data() + 3);
    table.push_back(point.InsidePx);
  }
  AttachTable(views, arrays::SilhouetteSupport, table, 4);
}

std::vector<SupportPoint> AttachedSupport(vtkDataObject* views)
{
  const std::vector<double> table = AttachedTable(views, arrays::SilhouetteSupport, 4);
  std::vector<SupportPoint> points;
  for (std::size_t i = 0; i < table.size(); i += 4)
  {
    points.push_back({ { table[i], table[i + 1], table[i + 2] }, table[i + 3] });
  }
  return points;
}

void AttachNumber(vtkDataObject* to, const char* name, double value)
{
  AttachTable(to, name, { value }, 1);
}

double AttachedNumber(vtkDataObject* to, const char* name, double otherwise)
{
  vtkDataArray* found = to ? to->GetFieldData()->GetArray(name) : nullptr;
  return found && found->GetNumberOfTuples() > 0 ? found->GetComponent(0, 0) : otherwise;
}

double DepthNoiseOf(vtkDataObject* views, double given)
{
  return given > 0 ? given : AttachedNumber(views, arrays::DepthNoise, 0);
}

std::vector<View> ReadColouredViews(vtkMultiBlockDataSet* views, std::size_t atLeast)
{
  return ReadViews(views, { true, true, true }, atLeast);
}

Camera ToCamera(vtkPinholeCamera* camera)
{
  Camera result;
  result.K = Eigen::Map<const RowMajor3>(camera->GetCameraMatrix());
  result.R = Eigen::Map<const RowMajor3>(camera->GetRotation());
  result.T = Eigen::Map<const Eigen::Vector3d>(camera->GetTranslation());
  result.Width = camera->GetImageSize()[0];
  result.Height = camera->GetImageSize()[1];
  return result;
}

void FromCamera(const Camera& camera, vtkPinholeCamera* out)
{
  const RowMajor3 k = camera.K;
  const RowMajor3 r = camera.R;
  out->SetCameraMatrix(k.data());
  out->SetRotation(r.data());
  out->SetTranslation(camera.T.data());
  out->SetImageSize(camera.Width, camera.Height);
}

vtkSmartPointer<vtkPinholeCamera> NewPinholeCamera(const Camera& camera)
{
  auto result = vtkSmartPointer<vtkPinholeCamera>::New();
  FromCamera(camera, result);
  return result;
}

namespace
{
/** Throws unless all cells are triangles. */
void RequireTriangles(vtkPolyData* poly, const std::string& where)
{
  vtkCellArray* cells = poly->GetPolys();
  if (poly->GetNumberOfStrips() > 0)
  {
    throw Error(where, "a cell is not a triangle", "a strip", "triangles (see vtkTriangleFilter)");
  }
  const vtkIdType count = cells->IsHomogeneous() == 3 ? 0 : cells->GetNumberOfCells();
  for (vtkIdType cellId = 0; cellId < count; ++cellId)
  {
    if (const vtkIdType size = cells->GetCellSize(cellId); size != 3)
    {
      throw Error(where, "a cell is not a triangle", std::to_string(size) + " corners", "3");
    }
  }
}

/** Copies the corners of triangles, whichever integers VTK keeps them as. */
struct CopyCorners
{
  template <class State>
  void operator()(State& state, std::vector<Eigen::Vector3i>& triangles) const
  {
    triangles.resize(state.GetNumberOfCells());
    const auto* ids = state.GetConnectivity()->GetPointer(0);
    ParallelFor(state.GetNumberOfCells(),
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          triangles[i] = { static_cast<int>(ids[3 * i]), static_cast<int>(ids[3 * i + 1]),
            static_cast<int>(ids[3 * i + 2]) };
        }
      });
  }
};
}

TriangleMesh ToTriangleMesh(vtkPolyData* poly, const std::string& where)
{
  TriangleMesh mesh;
  mesh.Points.resize(poly->GetNumberOfPoints());
  std::atomic<bool> finite = true;
  ParallelFor(poly->GetNumberOfPoints(),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t ptId = begin; ptId < end; ++ptId)
      {
        poly->GetPoint(ptId, mesh.Points[ptId].data());
        if (!mesh.Points[ptId].allFinite())
        {
          finite = false;
        }
      }
    });
  if (!finite)
  {
    const auto bad = std::find_if(mesh.Points.begin(), mesh.Points.end(),
      [](const Eigen::Vector3d& point) { return !point.allFinite(); });
    throw Error(where, "point " + std::to_string(bad - mesh.Points.begin()) + " is not finite");
  }
  RequireTriangles(poly, where);
  poly->GetPolys()->Visit(CopyCorners(), mesh.Triangles);
  return mesh;
}

void FromTriangleMesh(const TriangleMesh& mesh, vtkPolyData* out)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.Points.size()));
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    points->SetPoint(static_cast<vtkIdType>(ptId), mesh.Points[ptId].data());
  }
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(mesh.Triangles.size()),
    static_cast<vtkIdType>(3 * mesh.Triangles.size()));
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const vtkIdType ids[3] = { t[0], t[1], t[2] };
    cells->InsertNextCell(3, ids);
  }
  out->SetPoints(points);
  out->SetPolys(cells);
}

std::vector<std::uint8_t> PointFlags(vtkPolyData* poly, const char* name, std::uint8_t otherwise)
{
  const vtkIdType count = poly->GetNumberOfPoints();
  std::vector<std::uint8_t> flags(count, otherwise);
  if (vtkDataArray* array = poly->GetPointData()->GetArray(name))
  {
    for (vtkIdType ptId = 0; ptId < count; ++ptId)
    {
      flags[ptId] = array->GetComponent(ptId, 0) != 0;
    }
  }
  return flags;
}

vtkSmartPointer<vtkFloatArray> NewNormals(const std::vector<Eigen::Vector3d>& normals)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(arrays::Normals);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(normals.size()));
  for (std::size_t ptId = 0; ptId < normals.size(); ++ptId)
  {
    array->SetTuple(static_cast<vtkIdType>(ptId), normals[ptId].data());
  }
  return array;
}
}
