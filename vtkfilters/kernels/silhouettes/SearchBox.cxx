// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/SearchBox.h"

#include "core/Error.h"

#include <CGAL/MP_Float.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

#include <optional>
#include <string>

namespace novelview
{
namespace
{
using Plane = Eigen::Vector4d; ///< n.x + d >= 0 inside

/** The box of the certain sides is taken unless it is so many times larger than that of all. */
constexpr double MaxLoose = 2;

struct Rectangle
{
  int X0, Y0, X1, Y1;
};

std::optional<Rectangle> MaskRectangle(const View& view)
{
  Rectangle r{ view.Mask.Width, view.Mask.Height, -1, -1 };
  for (int y = 0; y < view.Mask.Height; ++y)
  {
    for (int x = 0; x < view.Mask.Width; ++x)
    {
      if (view.IsObject(x, y))
      {
        r.X0 = std::min(r.X0, x);
        r.X1 = std::max(r.X1, x);
        r.Y0 = std::min(r.Y0, y);
        r.Y1 = std::max(r.Y1, y);
      }
    }
  }
  return r.X1 < 0 ? std::nullopt : std::optional<Rectangle>(r);
}

/** Which sides of a view's rectangle bound the object. */
enum class Sides
{
  Certain, ///< that reach no border, and whose neighbours do not
  Likely   ///< that reach no border
};

/** Appends the half-spaces of one view's pyramid. */
void AppendPyramid(const View& view, Sides sides, std::vector<Plane>& planes)
{
  const std::optional<Rectangle> found = MaskRectangle(view);
  if (!found)
  {
    throw Error("view " + view.Name, "the mask is empty, so it carves everything away");
  }
  const Rectangle& r = *found;
  Eigen::Matrix<double, 3, 4> projection;
  projection.leftCols<3>() = view.Cam.K * view.Cam.R;
  projection.col(3) = view.Cam.K * view.Cam.T;
  const Plane rowX = projection.row(0);
  const Plane rowY = projection.row(1);
  const Plane rowZ = projection.row(2);
  planes.push_back(rowZ);
  const bool left = r.X0 == 0;
  const bool right = r.X1 == view.Mask.Width - 1;
  const bool top = r.Y0 == 0;
  const bool bottom = r.Y1 == view.Mask.Height - 1;
  const bool columnsBound = sides == Sides::Likely || !(top || bottom);
  const bool rowsBound = sides == Sides::Likely || !(left || right);
  if (!left && columnsBound)
  {
    planes.push_back(rowX - (r.X0 - 1) * rowZ);
  }
  if (!right && columnsBound)
  {
    planes.push_back((r.X1 + 1) * rowZ - rowX);
  }
  if (!top && rowsBound)
  {
    planes.push_back(rowY - (r.Y0 - 1) * rowZ);
  }
  if (!bottom && rowsBound)
  {
    planes.push_back((r.Y1 + 1) * rowZ - rowY);
  }
}

enum class Outcome
{
  Bounded,
  Unbounded,
  Infeasible
};

/** Minimises direction.x over the intersection of half-spaces. */
Outcome Minimise(const std::vector<Plane>& planes, const Eigen::Vector3d& direction, double& least)
{
  CGAL::Quadratic_program<double> program(CGAL::LARGER, false, 0, false, 0);
  for (std::size_t row = 0; row < planes.size(); ++row)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      program.set_a(axis, static_cast<int>(row), planes[row][axis]);
    }
    program.set_b(static_cast<int>(row), -planes[row][3]);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    program.set_c(axis, direction[axis]);
  }
  const auto solution = CGAL::solve_linear_program(program, CGAL::MP_Float());
  if (solution.is_infeasible())
  {
    return Outcome::Infeasible;
  }
  if (solution.is_unbounded())
  {
    return Outcome::Unbounded;
  }
  least = CGAL::to_double(solution.objective_value());
  return Outcome::Bounded;
}

Outcome BoxOf(const std::vector<Plane>& planes, Eigen::AlignedBox3d& box)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int sign : { 1, -1 })
    {
      double least = 0;
      const Outcome outcome = Minimise(planes, sign * Eigen::Vector3d::Unit(axis), least);
      if (outcome != Outcome::Bounded)
      {
        return outcome;
      }
      (sign > 0 ? box.min() : box.max())[axis] = sign * least;
    }
  }
  return Outcome::Bounded;
}

/** Centred on what the cameras look at and of the rig's size. */
struct Frame
{
  Eigen::Vector3d Origin;
  double Scale;
};

/**
 * Moves the planes to a frame and makes their normals unit: the solver's exact numbers stay short
 * and the problem well scaled.
 */
void Normalise(std::vector<Plane>& planes, const Frame& frame)
{
  for (Plane& plane : planes)
  {
    plane[3] = (plane.head<3>().dot(frame.Origin) + plane[3]) / frame.Scale;
    plane /= plane.head<3>().norm();
    for (int i = 0; i < 4; ++i)
    {
      plane[i] = static_cast<float>(plane[i]);
    }
  }
}

std::vector<Plane> PlanesOf(
  const std::vector<View>& views, const View* without, Sides sides, const Frame& frame)
{
  std::vector<Plane> planes;
  for (const View& view : views)
  {
    if (&view != without)
    {
      AppendPyramid(view, sides, planes);
    }
  }
  Normalise(planes, frame);
  return planes;
}

[[noreturn]] void ThrowEmpty(const std::vector<View>& views, Sides sides, const Frame& frame)
{
  for (const View& view : views)
  {
    double ignored = 0;
    const auto planes = PlanesOf(views, &view, sides, frame);
    if (Minimise(planes, Eigen::Vector3d::UnitX(), ignored) != Outcome::Infeasible)
    {
      throw Error("view " + view.Name,
        "its silhouette and those of the other views have no point in common; without it they "
        "have: its mask or camera is wrong");
    }
  }
  throw Error("views", "the silhouettes have no point in common, and no single view is to blame");
}

Frame FrameOf(const std::vector<View>& views)
{
  std::vector<Camera> cameras;
  cameras.reserve(views.size());
  for (const View& view : views)
  {
    cameras.push_back(view.Cam);
  }
  const Eigen::Vector3d origin = CommonTarget(cameras.data(), cameras.size());
  double scale = 0;
  for (const Camera& camera : cameras)
  {
    scale = std::max(scale, (camera.Centre() - origin).norm());
  }
  return { origin, scale > 0 ? scale : 1 };
}

Eigen::AlignedBox3d InWorld(const Eigen::AlignedBox3d& box, const Frame& frame)
{
  return { frame.Origin + frame.Scale * box.min(), frame.Origin + frame.Scale * box.max() };
}
}

Eigen::AlignedBox3d FindSearchBox(const std::vector<View>& views)
{
  const Frame frame = FrameOf(views);
  Eigen::AlignedBox3d box;
  const std::vector<Plane> likely = PlanesOf(views, nullptr, Sides::Likely, frame);
  const Outcome outcome = BoxOf(likely, box);
  const std::vector<Plane> certain = PlanesOf(views, nullptr, Sides::Certain, frame);
  Eigen::AlignedBox3d loose;
  if (certain.size() < likely.size() && BoxOf(certain, loose) == Outcome::Bounded &&
    (outcome == Outcome::Infeasible || loose.diagonal().norm() <= MaxLoose * box.diagonal().norm()))
  {
    return InWorld(loose, frame);
  }
  switch (outcome)
  {
    case Outcome::Infeasible:
      ThrowEmpty(views, Sides::Likely, frame);
    case Outcome::Unbounded:
      throw Error("views",
        "the silhouettes do not bound the object on every side (the frames cut it); give a box "
        "that does with --hull-box");
    case Outcome::Bounded:
      break;
  }
  return InWorld(box, frame);
}
}
