// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef kernels_DentCase_h
#define kernels_DentCase_h

#include "geometry/Visibility.h"
#include "support/Scene.h"

#include <random>

namespace support
{
const Vector3d Bite(0.18, 0, 0.67); ///< centre of the ball bitten out, towards the novel camera

/** A dented sphere with its true depth maps and sharply drawn silhouettes, and a sphere a pixel and a half larger around it. */
struct DentCase
{
  DistanceFunction Truth = DentedSphereDistance(0.5, Bite, 0.3);
  std::vector<Photo> Photos = TakeAll(Traced(Truth, 0.6), Plain(200, 200, 200), Ring(12, 30));
  novelview::Image<float> Confidence{ 160, 120, 1, 1.f };
  std::vector<novelview::View> Views{ Photos.size() };
  novelview::TriangleMesh Mesh = SphereMesh(Vector3d::Zero(), 0.515, 4);
  novelview::Camera Novel = OnRing(15);
  std::vector<std::uint8_t> Visible = novelview::VisibleVertices(Mesh, Novel);

  DentCase()
  {
    for (std::size_t i = 0; i < Views.size(); ++i)
    {
      RefineRim(Photos[i], Traced(Truth, 0.6));
      Views[i] = Photos[i].AsView();
      Views[i].DepthMap = std::as_const(Photos[i].TrueDepth).Ref();
      Views[i].Confidence = std::as_const(Confidence).Ref();
    }
  }
};

inline const DentCase& TheDent()
{
  static const DentCase dent;
  return dent;
}
}

#endif
