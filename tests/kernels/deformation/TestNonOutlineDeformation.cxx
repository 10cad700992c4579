// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/NonOutlineDeformation.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/Visibility.h"
#include "silhouettes/SilhouetteField.h"
#include "support/Expect.h"
#include "support/Scene.h"

using namespace novelview;
using namespace support;

namespace
{
const Vector3d Bite(0.18, 0, 0.67); ///< centre of the ball bitten out, towards the novel camera

/** A sphere with a dent that no silhouette shows, and the sphere around it as its hull. */
struct DentCase
{
  DistanceFunction Truth = DentedSphereDistance(0.5, Bite, 0.3);
  std::vector<Photo> Photos = TakeAll(Traced(Truth, 0.6), Waves(0.16), Ring(12, 30));
  std::vector<View> Views = ViewsOf(Photos);
  TriangleMesh Mesh = SphereMesh(Vector3d::Zero(), 0.5, 4);
  Camera Novel = OnRing(15);
  std::vector<std::uint8_t> Active = VisibleVertices(Mesh, Novel);

  DeformationResult Result; ///< of the deformation with its defaults

  DentCase()
  {
    // Points near the boundary belong to the outline step.
    for (std::size_t ptId = 0; ptId < Mesh.Points.size(); ++ptId)
    {
      Active[ptId] = Active[ptId] && Mesh.Points[ptId].dot(Novel.Centre()) > 0.3 * 0.5 * 4;
    }
    Result = DeformNonOutline(Mesh, Active, Views, Novel);
  }

  /** Mean distance to the true surface over the points above the dent, pixel footprints. */
  double OffTruthPx(const TriangleMesh& mesh) const
  {
    double sum = 0;
    int count = 0;
    for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
    {
      if (this->Active[ptId] && (this->Mesh.Points[ptId] - Bite).norm() < 0.3)
      {
        sum += std::abs(this->Truth(mesh.Points[ptId])) /
          this->Novel.PixelFootprint(this->Novel.Depth(mesh.Points[ptId]));
        ++count;
      }
    }
    EXPECT_GT(count, 20);
    return sum / count;
  }
};

const DentCase& TheCase()
{
  static const DentCase dent;
  return dent;
}
}

TEST(NonOutlineEnergies, SubPointTermsByHand)
{
  const std::vector<SubPoint> subs{ { Vector3d(3, 4, 0), 0.5 }, { Vector3d(0, 0, 2), 1.0 } };
  // (0.5 * 5 + 1 * 2) / (0.1 * 2) and (0.5 + 1) / 2; a third, unmatched secondary counts 0.
  EXPECT_DOUBLE_EQ(SubPointEnergy(Vector3d::Zero(), subs, 2, 0.1), 22.5);
  EXPECT_DOUBLE_EQ(SubPointReliability(subs, 2), 0.75);
  EXPECT_DOUBLE_EQ(SubPointReliability(subs, 3), 0.5);
  EXPECT_DOUBLE_EQ(SubPointEnergy(Vector3d::Zero(), {}, 2, 0.1), 0);
}

TEST(NonOutlineEnergies, SmoothnessIsTheMeanOffsetAlongTheRay)
{
  const Vector3d ray = Vector3d::UnitZ();
  const std::vector<Vector3d> neighbours{ { 1, 0, 0.3 }, { -1, 0, -0.1 } };
  EXPECT_DOUBLE_EQ(RaySmoothnessEnergy(Vector3d::Zero(), ray, neighbours, 0.1), 1);
  EXPECT_NEAR(RaySmoothnessEnergy(Vector3d(5, 5, 0.1), ray, neighbours, 0.1), 0, 1e-12);
  EXPECT_DOUBLE_EQ(RaySmoothnessEnergy(Vector3d::Zero(), ray, {}, 0.1), 0);
}

TEST(NonOutlineDeformation, MatchesFindThePointOnATexturedPlane)
{
  const auto photos =
    TakeAll(Rectangle(0.7, 0.5), Waves(0.16), { OnRing(0), OnRing(30), OnRing(-30) });
  const auto views = ViewsOf(photos);
  const double footprint = views[0].Cam.PixelFootprint(4);
  for (const Vector3d& truth :
    { Vector3d(0, 0, 0), Vector3d(0.15, 0.1, 0), Vector3d(-0.2, -0.15, 0) })
  {
    for (const double offPx : { -8.0, 0.0, 8.0 })
    {
      // On the key's ray, up to four pixels along the epipolar line in the secondaries.
      const Vector3d start =
        truth + offPx * footprint * (truth - views[0].Cam.Centre()).normalized();
      const auto subs = MatchSecondaries(start, views, 0, { 1, 2 }, {});
      ASSERT_EQ(subs.size(), 2u);
      for (const SubPoint& sub : subs)
      {
        EXPECT_GT(sub.Weight, 0.8);
        // Matches are whole pixels from where they started: half a pixel of disparity, twice
        // that along the ray at 30 degrees, and as much again for the foreshortened window.
        EXPECT_LT((sub.Position - truth).norm(), 2 * footprint);
      }
    }
  }
}

TEST(NonOutlineDeformation, NothingMatchesOutsideTheOtherPictures)
{
  auto photos = TakeAll(Rectangle(0.7, 0.5), Waves(0.16), { OnRing(0), OnRing(30) });
  photos[1].Cam.K(0, 2) += 500;
  EXPECT_TRUE(MatchSecondaries(Vector3d::Zero(), ViewsOf(photos), 0, { 1 }, {}).empty());
}

TEST(NonOutlineDeformation, ADentThatNoSilhouetteShowsOpens)
{
  const DentCase& dent = TheCase();
  const auto& result = dent.Result;
  const double before = dent.OffTruthPx(dent.Mesh);
  EXPECT_GT(before, 5);
  // The distance to the truth must fall clearly, not by chance.
  EXPECT_LT(dent.OffTruthPx(result.Mesh), 0.7 * before);
}

TEST(NonOutlineDeformation, PointsStayOnTheirRays)
{
  const DentCase& dent = TheCase();
  const auto& result = dent.Result;
  const Vector3d centre = dent.Novel.Centre();
  const double millionth = 1e-6 * BoundingDiagonal(dent.Mesh.Points);
  int moved = 0;
  for (std::size_t ptId = 0; ptId < dent.Mesh.Points.size(); ++ptId)
  {
    const Vector3d& before = dent.Mesh.Points[ptId];
    const Vector3d& after = result.Mesh.Points[ptId];
    moved += before != after;
    EXPECT_LT((before - centre).normalized().cross(after - centre).norm(), millionth);
    EXPECT_TRUE(dent.Active[ptId] || before == after);
  }
  EXPECT_GT(moved, 50);
  EXPECT_EQ(result.Mesh.Triangles, dent.Mesh.Triangles);
}

TEST(NonOutlineDeformation, AMoveLowersTheEnergyAmongFrozenNeighbours)
{
  const DentCase& dent = TheCase();
  NonOutlineOptions options;
  options.Iterations = 1;
  std::vector<PointEnergy> before;
  const auto result = DeformNonOutline(dent.Mesh, dent.Active, dent.Views, dent.Novel, options,
    [&](const DeformationState& state)
    {
      if (state.Iteration == 0)
      {
        before = *state.Energies;
      }
    });
  // The same terms put together anew: matches and neighbours as they were before the move.
  const MeshNeighbours neighbours(dent.Mesh);
  const auto normals = VertexNormals(dent.Mesh);
  const SilhouetteField hull(dent.Views);
  int compared = 0;
  for (int ptId = 0; ptId < static_cast<int>(dent.Mesh.Points.size()); ++ptId)
  {
    if (!dent.Active[ptId])
    {
      continue;
    }
    const Vector3d& here = dent.Mesh.Points[ptId];
    const double footprint = dent.Novel.PixelFootprint(dent.Novel.Depth(here));
    // A sphere hides nothing of its front, so the key is the view most in the normal's direction.
    int key = 0;
    for (int viewId = 1; viewId < 12; ++viewId)
    {
      const auto cosine = [&](int id)
      { return normals[ptId].dot((dent.Views[id].Cam.Centre() - here).normalized()); };
      key = cosine(viewId) > cosine(key) ? viewId : key;
    }
    const auto subs =
      MatchSecondaries(here, dent.Views, key, { (key + 1) % 12, (key + 11) % 12 }, options);
    std::vector<Vector3d> around;
    for (const int other : neighbours.Points(ptId))
    {
      around.push_back(dent.Mesh.Points[other]);
    }
    const auto total = [&](const Vector3d& at)
    {
      return SubPointEnergy(at, subs, 2, footprint) +
        (1 - SubPointReliability(subs, 2)) * std::abs(hull.Value(at)) / footprint +
        0.3 * RaySmoothnessEnergy(at, (here - dent.Novel.Centre()).normalized(), around, footprint);
    };
    if (std::abs(total(here) - before[ptId].Total) > 1e-9)
    {
      continue; // the views at equal angles were taken in another order
    }
    ++compared;
    EXPECT_LE(total(result.Mesh.Points[ptId]), before[ptId].Total + 1e-9);
  }
  EXPECT_GT(compared, 100);
}

TEST(NonOutlineDeformation, TheListenerHearsEveryIterationOnceAndTheStart)
{
  const DentCase& dent = TheCase();
  NonOutlineOptions options;
  options.Iterations = 2;
  options.ConvergencePx = 0;
  std::vector<int> heard;
  const auto result = DeformNonOutline(dent.Mesh, dent.Active, dent.Views, dent.Novel, options,
    [&](const DeformationState& state) { heard.push_back(state.Iteration); });
  EXPECT_EQ(heard, (std::vector<int>{ 0, 1, 2 }));
  for (std::size_t ptId = 0; ptId < result.Energies.size(); ++ptId)
  {
    EXPECT_TRUE(std::isfinite(result.Energies[ptId].Total));
    EXPECT_TRUE(result.Active[ptId] || result.Energies[ptId].Total == 0);
  }
}

TEST(NonOutlineDeformation, SameBitsWithOneAndMoreThreads)
{
  const DentCase& dent = TheCase();
  NonOutlineOptions options;
  options.Iterations = 2;
  const auto one = DeformNonOutline(dent.Mesh, dent.Active, dent.Views, dent.Novel, options);
  const auto three =
    DeformNonOutline(dent.Mesh, dent.Active, dent.Views, dent.Novel, options, {}, InThreads(3));
  EXPECT_EQ(one.Mesh.Points, three.Mesh.Points);
}

TEST(NonOutlineDeformation, APointThatNoPhotographSeesKeepsAFiniteEnergy)
{
  const DentCase& dent = TheCase();
  TriangleMesh mesh = dent.Mesh;
  mesh.Points[4] = Vector3d(0, 1.5, 0); // above every frame
  Camera novel = OnRing(15, 0, 4, SmallPictureK(100));
  NonOutlineOptions options;
  options.Iterations = 1;
  std::vector<std::uint8_t> active(mesh.Points.size(), 0);
  active[4] = 1;
  const auto result = DeformNonOutline(mesh, active, dent.Views, novel, options);
  EXPECT_TRUE(std::isfinite(result.Energies[4].Total));
  EXPECT_TRUE(result.Mesh.Points[4].allFinite());
}
