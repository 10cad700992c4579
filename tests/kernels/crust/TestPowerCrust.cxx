// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/PowerCrust.h"
#include "geometry/MeshTopology.h"
#include "support/CrustShapes.h"
#include "support/Expect.h"

#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <thread>

using namespace novelview;
using Eigen::Vector3d;
using support::ExpectError;

namespace
{
PowerCrustResult Crust(
  const shapes::Points& points, CrustOutput output = CrustOutput::DelaunayCrust)
{
  PowerCrustOptions options;
  options.Output = output;
  return ComputePowerCrust(points, nullptr, options, Execution());
}

/** Expects a closed, outward, 2-manifold with this many components and handles. */
void ExpectSurface(const TriangleMesh& mesh, int components, int genus)
{
  const MeshTopology topology = ExamineTopology(mesh);
  EXPECT_TRUE(topology.IsClosedAndOriented());
  EXPECT_TRUE(topology.IsManifold());
  EXPECT_EQ(topology.Components, components);
  EXPECT_EQ(topology.Genus(), genus);
  EXPECT_EQ(topology.UnusedPoints, 0);
  EXPECT_GT(SignedVolume(mesh), 0);
}

/** The farthest any point, edge middle or triangle centre is from the true surface. */
double Deviation(const TriangleMesh& mesh, const std::function<double(const Vector3d&)>& distance)
{
  double worst = 0;
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const Vector3d& a = mesh.Points[t[0]];
    const Vector3d& b = mesh.Points[t[1]];
    const Vector3d& c = mesh.Points[t[2]];
    const Vector3d probes[] = { a, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3 };
    for (const Vector3d& probe : probes)
    {
      worst = std::max(worst, std::abs(distance(probe)));
    }
  }
  return worst;
}

double SphereDistance(const Vector3d& p)
{
  return p.norm() - 1;
}

double TorusDistance(const Vector3d& p)
{
  return std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - 0.4;
}

/** Signed distance-like function of the three cylinders' common part (exact near faces). */
double CylindersDistance(const Vector3d& p)
{
  return std::max(
           { std::hypot(p.x(), p.y()), std::hypot(p.y(), p.z()), std::hypot(p.z(), p.x()) }) -
    1;
}
}

TEST(PowerCrust, SphereIsASphere)
{
  const int count = 3000;
  const shapes::Points points = shapes::Sphere(count, Vector3d::Zero(), 1, 0);
  const double spacing = shapes::SphereSpacing(count, 1);
  const PowerCrustResult result = Crust(points);
  ExpectSurface(result.Mesh, 1, 0);
  EXPECT_EQ(result.UnusedPoints, 0);
  // A chord of length s sags s^2 / 8 under a unit sphere; triangles here have edges up to 2 s.
  EXPECT_LT(Deviation(result.Mesh, SphereDistance), spacing * spacing / 2);
  // A closed triangle mesh over all n points has 2 n - 4 triangles.
  EXPECT_EQ(result.Mesh.Triangles.size(), 2u * count - 4);
}

TEST(PowerCrust, PowerOutputOfASphere)
{
  const int count = 3000;
  const PowerCrustResult result =
    Crust(shapes::Sphere(count, Vector3d::Zero(), 1, 0), CrustOutput::PowerCrust);
  ExpectSurface(result.Mesh, 1, 0);
  EXPECT_TRUE(result.PointSources.empty());
  // Faces lie between the polar balls, within the sagitta of the sampling.
  const double spacing = shapes::SphereSpacing(count, 1);
  EXPECT_LT(Deviation(result.Mesh, SphereDistance), spacing * spacing);
}

TEST(PowerCrust, TorusHasOneHandle)
{
  const shapes::Points points = shapes::Torus(6000, 1, 0.4);
  const PowerCrustResult result = Crust(points);
  ExpectSurface(result.Mesh, 1, 1);
  EXPECT_EQ(result.UnusedPoints, 0);
  // Random samples of area 15.8 leave gaps of radius sqrt(ln(n) area / (pi n)) = 0.085 with high
  // probability; a cap of that radius sags 0.085^2 / (2 * 0.4) = 0.009.
  EXPECT_LT(Deviation(result.Mesh, TorusDistance), 0.018);
}

TEST(PowerCrust, PowerOutputOfATorusHasOneHandle)
{
  const PowerCrustResult result = Crust(shapes::Torus(2500, 1, 0.4), CrustOutput::PowerCrust);
  ExpectSurface(result.Mesh, 1, 1);
  // 2 pi^2 R r^2 = 3.158; the sampling takes away less than 2 %.
  EXPECT_NEAR(SignedVolume(result.Mesh), 2 * EIGEN_PI * EIGEN_PI * 0.16, 0.06);
}

TEST(PowerCrust, MedialBallsOfATorusLieOnItsCoreCircle)
{
  const PowerCrustResult result = Crust(shapes::Torus(6000, 1, 0.4));
  const MedialBalls& balls = result.Balls;
  ASSERT_EQ(balls.Centres.size(), balls.Radii.size());
  ASSERT_EQ(balls.Centres.size(), balls.Inner.size());
  int inner = 0;
  int outer = 0;
  for (std::size_t i = 0; i < balls.Centres.size(); ++i)
  {
    const Vector3d& c = balls.Centres[i];
    const double toCore = std::hypot(std::hypot(c.x(), c.y()) - 1, c.z());
    EXPECT_EQ(balls.Inner[i] == 1, toCore < 0.4) << "ball " << i;
    if (balls.Inner[i])
    {
      ++inner;
      // An empty ball inside touches the tube, up to the sagitta of the sampling (above).
      EXPECT_NEAR(balls.Radii[i] + toCore, 0.4, 0.02);
    }
    outer += !balls.Inner[i];
  }
  EXPECT_GT(inner, 100);
  EXPECT_GT(outer, 100); // the hole's
}

TEST(PowerCrust, TwoSpheresSideBySide)
{
  shapes::Points points = shapes::Sphere(2000, Vector3d(0, 0, 0), 1, 0);
  const shapes::Points second = shapes::Sphere(2000, Vector3d(2.2, 0, 0), 1, 0);
  points.insert(points.end(), second.begin(), second.end());
  for (CrustOutput output : { CrustOutput::DelaunayCrust, CrustOutput::PowerCrust })
  {
    const PowerCrustResult result = Crust(points, output);
    ExpectSurface(result.Mesh, 2, 0);
    // Twice 4/3 pi, less the sagitta.
    EXPECT_NEAR(SignedVolume(result.Mesh), 8 * EIGEN_PI / 3, 0.06);
  }
}

TEST(PowerCrust, SphereInASphereIsACavity)
{
  shapes::Points points = shapes::Sphere(3000, Vector3d::Zero(), 1, 0);
  const shapes::Points cavity = shapes::Sphere(1000, Vector3d::Zero(), 0.6, 0);
  points.insert(points.end(), cavity.begin(), cavity.end());
  const PowerCrustResult result = Crust(points);
  ExpectSurface(result.Mesh, 2, 0);
  EXPECT_NEAR(SignedVolume(result.Mesh), 4 * EIGEN_PI / 3 * (1 - 0.216), 0.04);
}

TEST(PowerCrust, SharpCreasesOfAHullStayClean)
{
  const double spacing = 0.04;
  const shapes::Points points = shapes::ThreeCylinders(spacing);
  const PowerCrustResult result = Crust(points);
  ExpectSurface(result.Mesh, 1, 0);
  // Every sample is on the surface, so all of it can be moved later.
  EXPECT_EQ(result.UnusedPoints, 0);
  EXPECT_EQ(result.SplitPoints, 0);
  // A crease is cut at most between the samples nearest to it, one jittered spacing off.
  EXPECT_LT(Deviation(result.Mesh, CylindersDistance), spacing);
  ExpectSurface(Crust(points, CrustOutput::PowerCrust).Mesh, 1, 0);
}

TEST(PowerCrust, NoisySphereKeepsItsShape)
{
  const int count = 3000;
  const double spacing = shapes::SphereSpacing(count, 1);
  for (double part : { 0.1, 0.25, 0.5 })
  {
    const double noise = part * spacing;
    const shapes::Points points = shapes::Sphere(count, Vector3d::Zero(), 1, noise);
    const PowerCrustResult result = Crust(points);
    ExpectSurface(result.Mesh, 1, 0);
    // All samples are within 4 standard deviations, and the surface spans samples.
    EXPECT_LT(Deviation(result.Mesh, SphereDistance), 4.5 * noise + spacing * spacing);
    // Nine samples in ten stay on the surface.
    EXPECT_LT(result.UnusedPoints, count / 10) << "noise " << part;
  }
}

TEST(PowerCrust, BunnyFromItsOwnVertices)
{
  const shapes::Points points = shapes::Bunny();
  if (points.empty())
  {
    GTEST_SKIP() << "bunny.obj of glmark2-data is not installed";
  }
  const PowerCrustResult result = Crust(points);
  ExpectSurface(result.Mesh, 1, 0);
  // The true mesh goes through all of them.
  EXPECT_LE(result.UnusedPoints, static_cast<int>(points.size()) / 1000);
  // The volume of the mesh in the file is 1.600; a percent is far below what one wrong region costs.
  EXPECT_NEAR(SignedVolume(result.Mesh), 1.600, 0.016);
}

TEST(PowerCrust, GridsOnACubeGiveTheCube)
{
  for (CrustOutput output : { CrustOutput::DelaunayCrust, CrustOutput::PowerCrust })
  {
    for (int n : { 1, 2, 10 })
    {
      const PowerCrustResult result = Crust(shapes::CubeGrid(n), output);
      ExpectSurface(result.Mesh, 1, 0);
      // PowerCrust rounds edges where the smallest balls fit, 1 / n wide.
      EXPECT_NEAR(SignedVolume(result.Mesh), 1, output == CrustOutput::PowerCrust ? 0.01 : 1e-9);
    }
  }
}

TEST(PowerCrust, LatitudesAndLongitudesAreCospherical)
{
  shapes::Points points;
  for (int i = 0; i <= 24; ++i)
  {
    for (int j = 0; j < 48; ++j)
    {
      const double theta = EIGEN_PI * i / 24;
      const double phi = 2 * EIGEN_PI * j / 48;
      points.emplace_back(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  }
  for (CrustOutput output : { CrustOutput::DelaunayCrust, CrustOutput::PowerCrust })
  {
    const PowerCrustResult result = Crust(points, output);
    ExpectSurface(result.Mesh, 1, 0);
    // 48 points at each end are one up to rounding.
    EXPECT_EQ(result.DuplicatePoints, 2 * 47);
  }
}

TEST(PowerCrust, SmallestSolids)
{
  const shapes::Points tet = { Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0),
    Vector3d(0, 0, 1) };
  const PowerCrustResult result = Crust(tet);
  ExpectSurface(result.Mesh, 1, 0);
  EXPECT_EQ(result.Mesh.Triangles.size(), 4u);
  EXPECT_NEAR(SignedVolume(result.Mesh), 1.0 / 6, 1e-12);
}

TEST(PowerCrust, DuplicatesCountOnce)
{
  shapes::Points points = shapes::Sphere(500, Vector3d::Zero(), 1, 0);
  const PowerCrustResult once = Crust(points);
  const shapes::Points copy = points;
  points.insert(points.end(), copy.begin(), copy.end());
  const PowerCrustResult twice = Crust(points);
  EXPECT_EQ(twice.DuplicatePoints, 500);
  EXPECT_EQ(twice.UnusedPoints, 500);
  EXPECT_EQ(twice.PointSources, once.PointSources); // the first of each pair
  EXPECT_EQ(twice.Mesh.Triangles, once.Mesh.Triangles);
}

TEST(PowerCrust, ResultDoesNotDependOnSizeOrPlace)
{
  const shapes::Points points = shapes::Torus(2000, 1, 0.4);
  shapes::Points moved;
  for (const Vector3d& p : points)
  {
    moved.push_back(4096 * p); // a power of two: the same bits, scaled
  }
  EXPECT_EQ(Crust(points).Mesh.Triangles, Crust(moved).Mesh.Triangles);
}

TEST(PowerCrust, SameBitsWithTwoThreads)
{
  const shapes::Points points = shapes::Torus(2000, 1, 0.4);
  Execution twoThreads;
  twoThreads.ParallelFor = [](std::int64_t count, const Execution::RangeBody& body)
  {
    std::thread other([&] { body(count / 2, count); });
    body(0, count / 2);
    other.join();
  };
  for (CrustOutput output : { CrustOutput::DelaunayCrust, CrustOutput::PowerCrust })
  {
    PowerCrustOptions options;
    options.Output = output;
    const PowerCrustResult one = ComputePowerCrust(points, nullptr, options, Execution());
    const PowerCrustResult two = ComputePowerCrust(points, nullptr, options, twoThreads);
    EXPECT_EQ(one.Mesh.Points, two.Mesh.Points);
    EXPECT_EQ(one.Mesh.Triangles, two.Mesh.Triangles);
    EXPECT_EQ(one.Balls.Centres, two.Balls.Centres);
    EXPECT_EQ(one.Balls.Inner, two.Balls.Inner);
  }
}

TEST(PowerCrust, NormalsOfASphereAgreeWithoutChange)
{
  const shapes::Points points = shapes::Sphere(1000, Vector3d::Zero(), 1, 0);
  const PowerCrustResult result =
    ComputePowerCrust(points, &points, PowerCrustOptions(), Execution());
  EXPECT_EQ(result.Mesh.Triangles, Crust(points).Mesh.Triangles);
}

TEST(PowerCrust, RandomPointsGiveAManifoldOrAnError)
{
  for (unsigned int seed = 1; seed <= 20; ++seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    shapes::Points points;
    for (unsigned int i = 0; i < 10 * seed; ++i)
    {
      points.emplace_back(uniform(random), uniform(random), uniform(random));
    }
    for (CrustOutput output : { CrustOutput::DelaunayCrust, CrustOutput::PowerCrust })
    {
      try
      {
        const MeshTopology topology = ExamineTopology(Crust(points, output).Mesh);
        EXPECT_TRUE(topology.IsClosedAndOriented()) << "seed " << seed;
        EXPECT_TRUE(topology.IsManifold()) << "seed " << seed;
      }
      catch (const Error& error)
      {
        EXPECT_THAT(error.what(), testing::HasSubstr("enclose nothing"));
      }
    }
  }
}

TEST(PowerCrust, BadInputIsAnError)
{
  const shapes::Points good = shapes::Sphere(100, Vector3d::Zero(), 1, 0);
  ExpectError([] { Crust({}); }, "too few points (got 0, expected at least 4)");
  ExpectError([&] { Crust({ good[0], good[1], good[2] }); }, "too few points (got 3");
  ExpectError([&] { Crust({ good[0], good[0], good[0], good[0], good[0] }); }, "lie in one plane");
  shapes::Points bad = good;
  bad[7].y() = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { Crust(bad); }, "point 7 is not finite");
  bad[7].y() = std::numeric_limits<double>::infinity();
  ExpectError([&] { Crust(bad); }, "point 7 is not finite");
  bad[7].y() = 1e200;
  ExpectError([&] { Crust(bad); }, "too far apart");

  shapes::Points plane;
  for (int i = 0; i < 100; ++i)
  {
    plane.emplace_back(i % 10, i / 10, 0.3 * (i % 10) + 0.7 * (i / 10)); // rounded off the plane
  }
  ExpectError([&] { Crust(plane); }, "all 100 points lie in one plane");

  const shapes::Points tooFew(50, Vector3d::UnitX());
  ExpectError([&] { ComputePowerCrust(good, &tooFew, PowerCrustOptions(), Execution()); },
    "wrong number of normals (got 50, expected 100)");
  PowerCrustOptions options;
  options.MinimumComponentSamples = -1;
  ExpectError([&] { ComputePowerCrust(good, nullptr, options, Execution()); },
    "MinimumComponentSamples is out of range (got -1");
}

TEST(PowerCrust, StopsWhenAsked)
{
  Execution execution;
  execution.Progress = [](double) { return false; };
  EXPECT_THROW(ComputePowerCrust(shapes::Sphere(100, Vector3d::Zero(), 1, 0), nullptr,
                 PowerCrustOptions(), execution),
    Interrupted);
}
