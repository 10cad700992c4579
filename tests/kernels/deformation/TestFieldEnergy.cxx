// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/FieldEnergy.h"
#include "deformation/RayRelaxation.h"
#include "support/Expect.h"
#include "support/Scene.h"

#include <gtest/gtest.h>

using namespace novelview;
using namespace support;

namespace
{
const Vector3d Ahead(0, 0, 1);

/** A triangle in front of a camera at the origin; every point is a neighbour of the other two. */
struct TriangleCase
{
  Camera Novel{ SmallPictureK(100), Eigen::Matrix3d::Identity(), Vector3d::Zero() };
  TriangleMesh Mesh{ { Vector3d(0, 0, 10), Vector3d(1, 0, 10), Vector3d(0, 1, 10) },
    { Eigen::Vector3i(0, 1, 2) } };
  MeshNeighbours Neighbours{ Mesh };
  std::vector<double> Surface{ 10, 10, 19 };
  std::vector<std::uint8_t> Active{ 1, 1, 1 };
  double Alpha = 0.25; ///< q = 1, so that M = 2 and a step is 2/3 of half the gradient
  double Footprint = 1;

  RayRelaxation Relaxation() const
  {
    return { Neighbours, Novel, Mesh.Points, Surface, Active, Alpha, Footprint };
  }
};

std::vector<double> DepthsOf(const RayRelaxation& relaxation)
{
  std::vector<Vector3d> points;
  std::vector<PointEnergy> energies;
  relaxation.Measure(points, energies);
  return { points[0].z(), points[1].z(), points[2].z() };
}

double EnergyOf(const RayRelaxation& relaxation)
{
  std::vector<Vector3d> points;
  std::vector<PointEnergy> energies;
  relaxation.Measure(points, energies);
  return energies[0].Total + energies[1].Total + energies[2].Total;
}

void ExpectNear(const std::vector<double>& values, const std::vector<double>& expected, double tol)
{
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_NEAR(values[i], expected[i], tol) << "value " << i;
  }
}
}

TEST(FieldEnergy, OfAnOutlinePointIsTheSquareOfHowFarItIsOutside)
{
  Image<float> distance(8, 4);
  for (int y = 0; y < 4; ++y)
  {
    for (int x = 0; x < 8; ++x)
    {
      distance(x, y) = static_cast<float>(x - 3);
    }
  }
  const PointEnergy outside = FieldOutlineEnergy(distance, Vector2d(1.5, 2));
  EXPECT_NEAR(outside.Photo, 2.25, 1e-6);
  EXPECT_EQ(outside.Total, outside.Photo);
  EXPECT_EQ(outside.Contour, 0);
  EXPECT_EQ(outside.Smooth, 0);
  EXPECT_EQ(FieldOutlineEnergy(distance, Vector2d(3, 2)).Total, 0) << "on the contour";
  EXPECT_EQ(FieldOutlineEnergy(distance, Vector2d(5, 2)).Total, 0) << "inside";
}

TEST(FieldEnergy, TermsOfAPointOnItsRay)
{
  // Neighbours 1 and 5 behind it: 3 in the mean, 1.5 footprints.
  const std::vector<Vector3d> neighbours{ Vector3d(1, 0, 13), Vector3d(-1, 0, 17) };
  RayPoint point{ Vector3d(0, 0, 12), 12, 10, 18 };
  const PointEnergy known = FieldRayEnergy(point, Ahead, neighbours, 0.4, 2);
  EXPECT_DOUBLE_EQ(known.Photo, 9);
  EXPECT_DOUBLE_EQ(known.Contour, 1);
  EXPECT_DOUBLE_EQ(known.Smooth, 2.25);
  EXPECT_DOUBLE_EQ(known.Total, 9 + 0.4 * 2.25) << "beta is 1";
  point.Surface.reset();
  const PointEnergy unknown = FieldRayEnergy(point, Ahead, neighbours, 0.4, 2);
  EXPECT_EQ(unknown.Photo, 0);
  EXPECT_DOUBLE_EQ(unknown.Total, 1 + 0.4 * 2.25) << "beta is 0: the hull holds it";
}

TEST(RayRelaxation, TwoIterationsByHand)
{
  const TriangleCase triangle;
  RayRelaxation relaxation = triangle.Relaxation();
  EXPECT_DOUBLE_EQ(EnergyOf(relaxation), 81);
  // Half the gradient is (0, 0, -9).
  const RayRelaxation::Moves moves = relaxation.Step();
  EXPECT_EQ(moves.Moved, 1);
  EXPECT_DOUBLE_EQ(moves.Largest, 6);
  ExpectNear(DepthsOf(relaxation), { 10, 10, 16 }, 1e-12);
  // Means of the neighbours less the points: 3, 3, -6. E = 9/4, 9/4, 9 + 36/4.
  EXPECT_NEAR(EnergyOf(relaxation), 22.5, 1e-12);
  // Of point 0: 1/4 (-3 + 3/2 - 6/2), of point 2: -3 + 1/4 (6 + 3/2 + 3/2).
  EXPECT_EQ(relaxation.Step().Moved, 3);
  ExpectNear(DepthsOf(relaxation), { 10.75, 10.75, 16.5 }, 1e-12);
}

TEST(RayRelaxation, GoesToTheMinimumByHandAndTheEnergyFallsAllTheWay)
{
  const TriangleCase triangle;
  RayRelaxation relaxation = triangle.Relaxation();
  double before = EnergyOf(relaxation);
  int iterations = 0;
  for (; iterations < 30 && relaxation.Step().Largest > 1e-5; ++iterations)
  {
    EXPECT_LT(EnergyOf(relaxation), before);
    before = EnergyOf(relaxation);
  }
  EXPECT_LT(iterations, 15) << "a third of the way is left after each";
  // Differences from the mean, 13, shrink by 1 / (1 + alpha (3/2)^2) = 0.64.
  ExpectNear(DepthsOf(relaxation), { 11.08, 11.08, 16.84 }, 1e-5);
}

TEST(RayRelaxation, WithoutSurfaceTheHullHoldsAPoint)
{
  TriangleCase triangle;
  triangle.Alpha = 0;
  triangle.Surface = { 0, 12, 0 };
  RayRelaxation relaxation = triangle.Relaxation();
  relaxation.Step();
  ExpectNear(DepthsOf(relaxation), { 10, 12, 10 }, 1e-12);
}

TEST(RayRelaxation, PointsThatAreNotActiveStayAndPullTheirNeighbours)
{
  TriangleCase triangle;
  triangle.Mesh.Points[2].z() = 16;
  triangle.Active[2] = 0;
  RayRelaxation relaxation = triangle.Relaxation();
  // 2/3 of 1/4 (3 - 3/2): what pulls point 0, less what its move does to point 1.
  EXPECT_NEAR(relaxation.Step().Largest, 0.25, 1e-12);
  ExpectNear(DepthsOf(relaxation), { 10.25, 10.25, 16 }, 1e-12);
}

TEST(RayRelaxation, LengthsAreInFootprints)
{
  TriangleCase triangle;
  triangle.Footprint = 3;
  RayRelaxation relaxation = triangle.Relaxation();
  EXPECT_DOUBLE_EQ(EnergyOf(relaxation), 9);
  EXPECT_DOUBLE_EQ(relaxation.Step().Largest, 2);
  ExpectNear(DepthsOf(relaxation), { 10, 10, 16 }, 1e-12);
}

TEST(RayRelaxation, PointsStayOnTheirRays)
{
  const TriangleCase triangle;
  RayRelaxation relaxation = triangle.Relaxation();
  relaxation.Step();
  relaxation.Step();
  std::vector<Vector3d> points;
  std::vector<PointEnergy> energies;
  relaxation.Measure(points, energies);
  EXPECT_LT(points[2].normalized().cross(triangle.Mesh.Points[2].normalized()).norm(), 1e-12);
}
