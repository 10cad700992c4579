// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/SparseTsdf.h"

#include "geometry/MeshTopology.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <random>

using namespace novelview;
using namespace support;

namespace
{
constexpr double Footprint = 0.01;

/** A ball whose depth maps have noise of some pixels, which are not sure. */
struct NoisyBall
{
  explicit NoisyBall(double noisePx)
    : Photos(TakeAll(Sphere(Vector3d::Zero(), 0.5), Plain(200, 200, 200), Ring(8, 45)))
    , Weights(160, 120, 1, 0.3f)
    , Views(ViewsOf(Photos))
  {
    std::mt19937 random(1);
    for (std::size_t i = 0; i < this->Views.size(); ++i)
    {
      for (float& depth : this->Photos[i].TrueDepth.Values)
      {
        const double error = static_cast<double>(random()) / std::mt19937::max() - 0.5;
        depth += static_cast<float>(depth > 0 ? 2 * noisePx * Footprint * error : 0);
      }
      this->Views[i].DepthMap = std::as_const(this->Photos[i].TrueDepth).Ref();
      this->Views[i].Confidence = std::as_const(this->Weights).Ref();
    }
  }
  std::vector<Photo> Photos;
  Image<float> Weights;
  std::vector<View> Views;
};

const Eigen::AlignedBox3d Bounds(Vector3d::Constant(-0.6), Vector3d::Constant(0.6));
const std::vector<Vector3d> Seeds = SphereMesh(Vector3d::Zero(), 0.5, 4).Points;

/** Mean distance of a mesh's points from the ball, away from its poles. */
double MeanError(const TriangleMesh& mesh)
{
  double sum = 0;
  int count = 0;
  for (const Vector3d& point : mesh.Points)
  {
    if (std::abs(point.y()) < 0.3)
    {
      sum += std::abs(point.norm() - 0.5);
      ++count;
    }
  }
  return sum / count;
}
}

TEST(SparseTsdf, SurfaceIsClosedAndCutsEdgesWhereTheFieldIsZero)
{
  const NoisyBall ball(0);
  const TsdfField field(ball.Views, { 3, 0.01, 0.12 }, Footprint);
  const SparseTsdf lattice(field, Bounds, Seeds, Footprint, {});
  const TriangleMesh mesh = lattice.Surface({});
  EXPECT_TRUE(ExamineTopology(mesh).IsClosedAndOriented());
  EXPECT_GT(SignedVolume(mesh), 0);
  EXPECT_LT(MeanError(mesh), 0.3 * Footprint);
}

TEST(SparseTsdf, OneSeedLeadsToTheWholeSurface)
{
  const NoisyBall ball(0);
  const TsdfField field(ball.Views, { 3, 0.05, 0.12 }, Footprint);
  const TriangleMesh mesh =
    SparseTsdf(field, Bounds, { Vector3d(0, 0, 0.5) }, Footprint, {}).Surface({});
  EXPECT_TRUE(ExamineTopology(mesh).IsClosedAndOriented());
  EXPECT_LT(mesh.Points.front().z() * mesh.Points.back().z(), 0) << "both sides";
}

TEST(SparseTsdf, NoiseLeavesAManifoldAfterMakeManifold)
{
  const NoisyBall ball(6);
  const TsdfField field(ball.Views, { 3, 0.05, 0.12 }, Footprint);
  SparseTsdf lattice(field, Bounds, Seeds, Footprint, {});
  EXPECT_FALSE(ExamineTopology(lattice.Surface({})).IsManifold()) << "no test without";
  lattice.MakeManifold({});
  const MeshTopology topology = ExamineTopology(lattice.Surface({}));
  EXPECT_TRUE(topology.IsManifold());
  EXPECT_TRUE(topology.IsClosedAndOriented());
}

TEST(SparseTsdf, SmoothingTakesNoiseAwayAndStaysInTheSilhouettes)
{
  const NoisyBall ball(3);
  const TsdfField field(ball.Views, { 3, 0.05, 0.12 }, Footprint);
  SparseTsdf lattice(field, Bounds, Seeds, Footprint, {});
  const double before = MeanError(lattice.Surface({}));
  lattice.Smooth(0.3, 40, {});
  const TriangleMesh mesh = lattice.Surface({});
  EXPECT_LT(MeanError(mesh), 0.8 * before);
  for (const Vector3d& point : mesh.Points)
  {
    for (const View& view : ball.Views)
    {
      const Vector2d pixel = view.Cam.Project(point);
      // The point is the mean of up to twelve crossings of a cell.
      EXPECT_GT(SampleBilinear(view.ContourDistance, pixel.x(), pixel.y()), -0.5);
    }
  }
}

TEST(SparseTsdf, NoSeedsNoSurface)
{
  const NoisyBall ball(0);
  const TsdfField field(ball.Views, { 3, 0.05, 0.12 }, Footprint);
  EXPECT_EQ(SparseTsdf(field, Bounds, {}, Footprint, {}).NumberOfBlocks(), 0);
}
