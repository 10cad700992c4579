// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/ShadedMesh.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace novelview;
using Eigen::Vector3d;

namespace
{
/** Looks along +z from the origin, y down. */
Camera Straight()
{
  Eigen::Matrix3d k;
  k << 100, 0, 20, 0, 100, 15, 0, 0, 1;
  Camera camera{ k, Eigen::Matrix3d::Identity(), Vector3d::Zero() };
  camera.Width = 41;
  camera.Height = 31;
  return camera;
}

/** A triangle over the picture's middle, seen from outside: counter-clockwise for the camera. */
TriangleMesh Facing()
{
  return { { Vector3d(-1, 1, 10), Vector3d(1, 1, 10), Vector3d(0, -1, 10) },
    { Eigen::Vector3i(0, 1, 2) } };
}
}

TEST(ShadedMesh, OutsidesAreGreyInsidesReddishAndTheRestBlack)
{
  const Image<std::uint8_t> outside = ShadedMesh(Facing(), Straight());
  EXPECT_GT(outside(20, 15, 0), 205);
  EXPECT_NEAR(outside(20, 15, 0), outside(20, 15, 2), 8) << "grey";
  EXPECT_EQ(outside(0, 0, 0), 0);
  TriangleMesh turned = Facing();
  turned.Triangles[0] = Eigen::Vector3i(0, 2, 1);
  const Image<std::uint8_t> inside = ShadedMesh(turned, Straight());
  EXPECT_GT(inside(20, 15, 0), inside(20, 15, 1) + 40);
}

TEST(ShadedMesh, SlantedTrianglesAreDarker)
{
  TriangleMesh slanted = Facing();
  slanted.Points[2].z() = 14;
  EXPECT_LT(
    ShadedMesh(slanted, Straight())(20, 17, 0), ShadedMesh(Facing(), Straight())(20, 17, 0));
}

TEST(ShadedMesh, OfNothingIsBlack)
{
  const Image<std::uint8_t> black = ShadedMesh({}, Straight());
  EXPECT_EQ(black.Width, 41);
  EXPECT_EQ(*std::max_element(black.Values.begin(), black.Values.end()), 0);
}

TEST(ShadedMesh, ATurnedCameraGoesToTheRightAroundThePoint)
{
  const Vector3d about(0, 0, 10);
  const Camera turned = TurnedCamera(Straight(), about, 90);
  EXPECT_LT((turned.Centre() - Vector3d(10, 0, 10)).norm(), 1e-12);
  EXPECT_LT((turned.OpticalAxis() - Vector3d(-1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((turned.Project(about) - Straight().Project(about)).norm(), 1e-9);
}
