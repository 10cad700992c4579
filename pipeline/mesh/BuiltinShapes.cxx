// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/BuiltinShapes.h"

#include <Eigen/Core>

#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace novelview
{
namespace
{
using Point = Eigen::Vector3d;
/** Distance-like function of the shape's inside (negative) and outside (positive). */
using Field = std::function<double(const Point&)>;

/** The smaller of two fields, with a fillet about as large as `radius` where they meet. */
double SmoothUnion(double a, double b, double radius)
{
  const double h = std::max(radius - std::abs(a - b), 0.0) / radius;
  return std::min(a, b) - h * h * radius / 4;
}

double SmoothCut(double a, double cutter, double radius)
{
  return -SmoothUnion(-a, cutter, radius);
}

double Ball(const Point& p, const Point& centre, double radius)
{
  return (p - centre).norm() - radius;
}

/** A rod with round ends and a radius that changes from one to the other. */
double Rod(const Point& p, const Point& from, const Point& to, double radiusFrom, double radiusTo)
{
  const Point along = to - from;
  const double t = std::clamp((p - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - from - t * along).norm() - ((1 - t) * radiusFrom + t * radiusTo);
}

/** A disc of half thickness `half` around the y axis, its edge rounded by `edge`. */
double Disc(const Point& p, double height, double radius, double half, double edge)
{
  const double x = std::hypot(p.x(), p.z()) - (radius - edge);
  const double y = std::abs(p.y() - height) - (half - edge);
  return std::min(std::max(x, y), 0.0) + std::hypot(std::max(x, 0.0), std::max(y, 0.0)) - edge;
}

double Ellipsoid(const Point& p, const Point& centre, const Point& radii)
{
  const Point scaled = (p - centre).cwiseQuotient(radii);
  return (scaled.norm() - 1) * radii.minCoeff();
}

/** A rod of the stool and the fillet it is joined with. */
struct StoolRod
{
  Point From;
  Point To;
  double RadiusFrom;
  double RadiusTo;
  double Fillet;
};

std::vector<StoolRod> StoolRods()
{
  std::vector<StoolRod> rods;
  for (int leg = 0; leg < 4; ++leg)
  {
    const double angle = EIGEN_PI / 4 + leg * EIGEN_PI / 2;
    const Point side(std::cos(angle), 0, std::sin(angle));
    rods.push_back(
      { 0.5 * side + Point(0, 0.8, 0), 0.75 * side + Point(0, -0.95, 0), 0.07, 0.045, 0.06 });
    // One rung per leg, at heights that differ so that the stool has no symmetry to confuse.
    const Point next(-side.z(), 0, side.x());
    const double height = -0.45 + 0.12 * leg;
    const double spread = 0.5 + 0.25 * (0.8 - height) / 1.75;
    const Point up(0, height, 0);
    rods.push_back({ spread * side + up, spread * next + up, 0.03, 0.03, 0.03 });
  }
  return rods;
}

double Stool(const Point& p)
{
  static const std::vector<StoolRod> rods = StoolRods();
  double field = Disc(p, 0.85, 0.75, 0.09, 0.05);
  for (const StoolRod& rod : rods)
  {
    field = SmoothUnion(field, Rod(p, rod.From, rod.To, rod.RadiusFrom, rod.RadiusTo), rod.Fillet);
  }
  return field;
}

double Bust(const Point& p)
{
  double field = Ellipsoid(p, Point(0, 0.42, 0), Point(0.46, 0.58, 0.52)); // skull
  field = SmoothUnion(field, Rod(p, Point(0, 0.1, -0.1), Point(0, -0.6, -0.12), 0.24, 0.27), 0.12);
  field = SmoothUnion(field, Ellipsoid(p, Point(0, -0.85, -0.1), Point(0.85, 0.3, 0.42)), 0.25);
  field = SmoothUnion(field, Rod(p, Point(0, 0.5, 0.48), Point(0, 0.28, 0.6), 0.06, 0.11), 0.1);
  field = SmoothUnion(field, Ball(p, Point(0, -0.06, 0.38), 0.13), 0.15); // chin
  for (const double side : { -1.0, 1.0 })
  {
    field = SmoothCut(field, Ball(p, Point(0.2 * side, 0.5, 0.54), 0.14), 0.08); // eyes
    field = SmoothUnion(
      field, Ellipsoid(p, Point(0.48 * side, 0.38, -0.02), Point(0.07, 0.19, 0.13)), 0.05);
    field = SmoothCut(field, Ball(p, Point(0.56 * side, 0.38, 0.05), 0.07), 0.03); // ears
  }
  return SmoothCut(
    field, Rod(p, Point(-0.14, 0.12, 0.53), Point(0.14, 0.12, 0.53), 0.035, 0.035), 0.04);
}

double Torus(const Point& p)
{
  return std::hypot(std::hypot(p.x(), p.y()) - 0.7, p.z()) - 0.28;
}

/** A block of thin struts along all three axes, behind each other in every view. */
double Lattice(const Point& p)
{
  constexpr double radius = 0.05;
  double field = 10;
  for (const double a : { -1.0, 0.0, 1.0 })
  {
    for (const double b : { -1.0, 0.0, 1.0 })
    {
      const double y = 0.75 * a;
      const double z = 0.5 * b;
      const double x = 0.9 * a;
      for (const auto& [from, to] : { std::pair(Point(-0.9, y, z), Point(0.9, y, z)),
             std::pair(Point(x, -0.75, z), Point(x, 0.75, z)),
             std::pair(Point(x, 0.75 * b, -0.5), Point(x, 0.75 * b, 0.5)) })
      {
        field = SmoothUnion(field, Rod(p, from, to, radius, radius), 0.02);
      }
    }
  }
  return field;
}

/** The zero surface of a field in [-1.2, 1.2]^3, on a grid of this many steps. */
vtkSmartPointer<vtkPolyData> Surface(const Field& field, int steps)
{
  const double half = 1.2;
  const double spacing = 2 * half / steps;
  vtkNew<vtkImageData> grid;
  grid->SetDimensions(steps + 1, steps + 1, steps + 1);
  grid->SetOrigin(-half, -half, -half);
  grid->SetSpacing(spacing, spacing, spacing);
  grid->AllocateScalars(VTK_FLOAT, 1);
  float* value = static_cast<float*>(grid->GetScalarPointer());
  for (int z = 0; z <= steps; ++z)
  {
    for (int y = 0; y <= steps; ++y)
    {
      for (int x = 0; x <= steps; ++x)
      {
        *value++ = static_cast<float>(field(Point(x, y, z) * spacing - Point::Constant(half)));
      }
    }
  }
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  return contour->GetOutput();
}

/** A point of the rectangle's outline seen from its centre at an angle. */
Point OnRectangle(double angle, double halfWidth, double halfHeight, double z)
{
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const double scale = 1 / std::max(std::abs(c) / halfWidth, std::abs(s) / halfHeight);
  return Point(scale * c, scale * s, z);
}

/**
 * A block of 2 x 1.4 x 0.8 with a hole of radius 0.4 along z: four rings of points (outer and
 * inner, front and back), each joined to the next by a strip of triangles. The rings have a point
 * at each of the block's corners, so that its edges are sharp.
 */
vtkSmartPointer<vtkPolyData> Part()
{
  constexpr int perSide = 32;
  constexpr int around = 4 * perSide;
  const double corner = std::atan2(0.7, 1.0);
  // EIGEN_PI has more digits than a double, and the sums are rounded once.
  const std::array<double, 5> corners = { -corner, corner, static_cast<double>(EIGEN_PI - corner),
    static_cast<double>(EIGEN_PI + corner), static_cast<double>(2 * EIGEN_PI - corner) };
  vtkNew<vtkPoints> points;
  for (int ring = 0; ring < 4; ++ring)
  {
    const double z = ring == 0 || ring == 3 ? 0.4 : -0.4;
    for (int i = 0; i < around; ++i)
    {
      const double t = static_cast<double>(i % perSide) / perSide;
      const int side = i / perSide;
      const double angle = (1 - t) * corners[side] + t * corners[side + 1];
      const Point p = ring < 2 ? OnRectangle(angle, 1.0, 0.7, z)
                               : Point(0.15 + 0.4 * std::cos(angle), 0.4 * std::sin(angle), z);
      points->InsertNextPoint(p.data());
    }
  }
  vtkNew<vtkCellArray> triangles;
  for (int ring = 0; ring < 4; ++ring)
  {
    const int next = (ring + 1) % 4;
    for (int i = 0; i < around; ++i)
    {
      const int j = (i + 1) % around;
      triangles->InsertNextCell({ ring * around + i, next * around + i, ring * around + j });
      triangles->InsertNextCell({ ring * around + j, next * around + i, next * around + j });
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeBuiltinShape(const std::string& name)
{
  if (name == "part")
  {
    return Part();
  }
  if (name == "stool")
  {
    return Surface(Stool, 160); // a grid step of 0.015 against rungs 0.06 thick
  }
  if (name == "lattice")
  {
    return Surface(Lattice, 160);
  }
  if (name == "bust")
  {
    return Surface(Bust, 128);
  }
  if (name == "torus")
  {
    return Surface(Torus, 96);
  }
  return nullptr;
}
}
