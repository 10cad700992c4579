// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/DelaunayComplex.h"
#include "support/CrustShapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace novelview;
using Eigen::Vector3d;

TEST(DelaunayComplex, SpheresAreEmptyAndNeighborsMutual)
{
  const shapes::Points points = shapes::Torus(300, 1, 0.4);
  const DelaunayComplex complex = BuildDelaunayComplex(points, Execution());
  double volume = 0;
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    volume += complex.Volume(tet);
    EXPECT_GT(complex.Volume(tet), 0);
    for (const Vector3d& p : points)
    {
      // Rounding of the circumcentre, relative to the sphere.
      EXPECT_GT((p - complex.Centres[tet]).norm(), complex.Radii[tet] * (1 - 1e-6));
    }
    for (int k = 0; k < 4; ++k)
    {
      const int other = complex.Neighbors[tet][k];
      if (other >= 0)
      {
        EXPECT_THAT(complex.Neighbors[other], testing::Contains(tet));
      }
    }
  }
  const double edge = complex.Points.back().x() - complex.Points[complex.Points.size() - 8].x();
  EXPECT_NEAR(volume / (edge * edge * edge), 1, 1e-9); // they fill the far corners' cube
}
