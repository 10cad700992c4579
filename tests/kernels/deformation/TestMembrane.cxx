// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/Membrane.h"
#include "support/Expect.h"

using namespace novelview;
using Eigen::Vector2d;

namespace
{
/** A strip of squares, each of two triangles; points 2 i and 2 i + 1 are at x = i. */
TriangleMesh Strip(int squares)
{
  TriangleMesh mesh;
  for (int i = 0; i <= squares; ++i)
  {
    mesh.Points.emplace_back(i, 0, 1);
    mesh.Points.emplace_back(i, 1, 1);
  }
  for (int i = 0; i < 2 * squares; i += 2)
  {
    // Negative area with y pointing down: they face the camera.
    mesh.Triangles.emplace_back(i, i + 1, i + 2);
    mesh.Triangles.emplace_back(i + 1, i + 3, i + 2);
  }
  return mesh;
}

std::vector<Vector2d> PixelsOf(const TriangleMesh& mesh)
{
  std::vector<Vector2d> pixels;
  for (const Eigen::Vector3d& point : mesh.Points)
  {
    pixels.emplace_back(point.head<2>());
  }
  return pixels;
}
}

TEST(Membrane, AFollowerTakesTheDecayedMeanOfItsNeighbours)
{
  const TriangleMesh mesh = Strip(1);
  const MeshNeighbours neighbours(mesh);
  std::vector<Vector2d> moves(4, Vector2d::Zero());
  moves[0] = Vector2d(4, 0);
  SpreadMoves(neighbours, { 1, 0, 0, 0 }, { 1, 0.5 }, moves, {});
  EXPECT_EQ(moves[0], Vector2d(4, 0));
  // Points 1 and 2 have the neighbours 0, the other of the two, and 3; point 3 has 1 and 2.
  EXPECT_LT((moves[1] - Vector2d(0.5 * 4 / 3, 0)).norm(), 1e-12);
  EXPECT_LT((moves[2] - Vector2d(0.5 * 4 / 3, 0)).norm(), 1e-12);
  EXPECT_EQ(moves[3], Vector2d(0, 0)) << "a ring further takes another sweep";
}

TEST(Membrane, FoldingMovesAreShortenedAndOthersAreNot)
{
  const TriangleMesh mesh = Strip(4);
  const std::vector<Vector2d> pixels = PixelsOf(mesh);
  std::vector<Vector2d> moves(pixels.size(), Vector2d::Zero());
  moves[0] = Vector2d(3, 0);    // over its neighbours
  moves[8] = Vector2d(0.25, 0); // away from them
  ShortenFoldingMoves(mesh, pixels, moves);
  EXPECT_EQ(moves[0], Vector2d(0.75, 0)) << "halved until nothing folds";
  EXPECT_EQ(moves[8], Vector2d(0.25, 0));
}

TEST(Membrane, MovesThatFoldHoweverShortAreNone)
{
  const TriangleMesh mesh = Strip(1);
  std::vector<Vector2d> pixels = PixelsOf(mesh);
  pixels[3] = pixels[2]; // a triangle without area, which the move turns over
  std::vector<Vector2d> moves(4, Vector2d::Zero());
  moves[3] = Vector2d(-1, -1);
  ShortenFoldingMoves(mesh, pixels, moves);
  EXPECT_EQ(moves[3], Vector2d(0, 0));
}
