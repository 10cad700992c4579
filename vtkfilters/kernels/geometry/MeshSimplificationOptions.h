// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of SimplifyMesh(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_MeshSimplificationOptions_h
#define novelview_MeshSimplificationOptions_h

#include "core/Parameter.h"

#include <limits>

namespace novelview
{
struct MeshSimplificationOptions
{
  /** Triangles to leave, at most; 0 = all. */
  static constexpr Parameter<int> TrianglesParameter{ 0, 0, std::numeric_limits<int>::max() };
  int Triangles = TrianglesParameter.Default;
};
}

#endif
