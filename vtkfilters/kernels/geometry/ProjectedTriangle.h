// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the rasteriser: a triangle in the picture.
#ifndef novelview_ProjectedTriangle_h
#define novelview_ProjectedTriangle_h

#include "core/Execution.h"
#include "core/ToInt.h"
#include "geometry/Camera.h"
#include "geometry/PixelBox.h"
#include "geometry/TriangleMesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace novelview
{
struct ProjectedPoint
{
  double X, Y;
  double InverseDepth; ///< 0 = at or behind the camera's plane
};

/** The first integer not below `value`, cut to [0, size]. */
inline int FirstPixel(double value, int size)
{
  const double cut = ClampedNumber(value, 0, size);
  const int whole = static_cast<int>(cut);
  return whole + (whole < cut ? 1 : 0);
}

/** The first integer above `value`, cut to [0, size]. */
inline int EndPixel(double value, int size)
{
  return static_cast<int>(ClampedNumber(value + 1, 0, size));
}

/**
 * Twice the signed area of a point with an edge, A x + B y + C. With the edge's ends swapped it is
 * the same with the other sign, to the last bit: no point falls between two triangles that share it.
 */
struct EdgeFunction
{
  double A;
  double B;
  double C;

  EdgeFunction(const ProjectedPoint& from, const ProjectedPoint& to, double sign)
    : A(sign * (from.Y - to.Y))
    , B(sign * (to.X - from.X))
    , C(sign * (from.X * to.Y - to.X * from.Y))
  {
  }
  /** Its part that is the same for a whole row. */
  double Row(double y) const { return this->B * y + this->C; }
};

/** A triangle in the picture. */
struct ProjectedTriangle
{
  ProjectedPoint P[3];
  double Area; ///< twice the signed area

  explicit ProjectedTriangle(
    const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& c)
    : P{ a, b, c }
    , Area((b.X - a.X) * (c.Y - a.Y) - (c.X - a.X) * (b.Y - a.Y))
  {
  }

  /** Whether it has an area, and all of it is in front of the camera. */
  bool Drawn() const
  {
    return this->P[0].InverseDepth > 0 && this->P[1].InverseDepth > 0 &&
      this->P[2].InverseDepth > 0 && this->Area != 0 && std::isfinite(this->Area);
  }

  /** The pixels whose centre is no further than `margin` outside its bounding box. */
  PixelBox Box(double margin, int width, int height) const
  {
    const auto [xMin, xMax] = std::minmax({ this->P[0].X, this->P[1].X, this->P[2].X });
    const auto [yMin, yMax] = std::minmax({ this->P[0].Y, this->P[1].Y, this->P[2].Y });
    return { FirstPixel(xMin - margin, width), EndPixel(xMax + margin, width),
      FirstPixel(yMin - margin, height), EndPixel(yMax + margin, height) };
  }
};

/** The points of a mesh in a camera's frame. */
std::vector<ProjectedPoint> ProjectPoints(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution);
}

#endif
