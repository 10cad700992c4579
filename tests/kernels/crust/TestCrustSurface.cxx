// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/CrustSurface.h"
#include "crust/ManifoldRepair.h"
#include "geometry/MeshTopology.h"
#include "support/CrustShapes.h"

#include <gtest/gtest.h>

#include <random>

using namespace novelview;

TEST(CrustSurface, AnyLabelsGiveAManifold)
{
  // Labels thrown like dice: every kind of pinched point and shared edge occurs.
  int splits = 0;
  int midPoints = 0;
  for (unsigned int seed = 1; seed <= 30; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    shapes::Points points;
    for (int i = 0; i < 60; ++i)
    {
      points.emplace_back(uniform(random), uniform(random), uniform(random));
    }
    const DelaunayComplex complex = BuildDelaunayComplex(points, Execution());
    std::vector<Side> labels;
    double volume = 0;
    for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
    {
      const bool inside = !complex.TouchesCorner(tet) && uniform(random) < 0.5;
      labels.push_back(inside ? Side::Inside : Side::Outside);
      volume += inside ? complex.Volume(tet) : 0;
    }
    const CrustSurface raw = ExtractDelaunayCrust(complex, labels);
    const MeshTopology topology = ExamineTopology(raw.Mesh);
    EXPECT_TRUE(topology.IsClosedAndOriented()) << "seed " << seed;
    EXPECT_TRUE(topology.IsManifold()) << "seed " << seed;
    // Splitting moves nothing: the volume is that of the tetrahedra, to rounding.
    EXPECT_NEAR(SignedVolume(raw.Mesh), volume, 1e-12);
    splits += raw.SplitPoints;
    midPoints += raw.MidPoints;

    MakeManifold(complex, labels);
    const CrustSurface repaired = ExtractDelaunayCrust(complex, labels);
    EXPECT_LT(repaired.SplitPoints, raw.SplitPoints) << "seed " << seed;
  }
  EXPECT_GT(splits, 0);
  EXPECT_GT(midPoints, 0); // or the case is not tested at all
}
