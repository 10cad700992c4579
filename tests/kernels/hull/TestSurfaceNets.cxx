// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull/SurfaceNets.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

using namespace novelview;
using Eigen::Vector3d;
using Eigen::Vector3i;

namespace
{
/** The samples, in their middles, of the cells around the lattice point `at` when that is inside. */
std::vector<CellSample> CellsAround(const Vector3i& at)
{
  std::vector<CellSample> samples;
  for (int n = 0; n < 8; ++n)
  {
    const Vector3i back(n & 1, (n >> 1) & 1, n >> 2);
    CellSample sample;
    sample.Cell = at - back;
    sample.Point = sample.Cell.cast<double>() + Vector3d::Constant(0.5);
    sample.Normal = (sample.Point - at.cast<double>()).normalized();
    sample.Inside = 1u << n; // corner n of this cell is the point
    samples.push_back(sample);
  }
  return samples;
}

double Volume(const TriangleMesh& mesh)
{
  double volume = 0;
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    volume += mesh.Points[t[0]].dot(mesh.Points[t[1]].cross(mesh.Points[t[2]])) / 6;
  }
  return volume;
}
}

TEST(SurfaceNets, OnePointInsideIsACube)
{
  for (const Vector3i& at : { Vector3i(1, 1, 1), Vector3i(7, 3, 900), Vector3i(40, 0, 0) })
  {
    const std::vector<CellSample> samples = CellsAround(at);
    const TriangleMesh cube = ConnectCells(samples, SortCells(samples));
    EXPECT_EQ(cube.Points.size(), 8u);
    EXPECT_EQ(cube.Triangles.size(), 12u); // two for each of the six edges of the point
    EXPECT_NEAR(Volume(cube), 1, 1e-9) << "closed, and outwards";
  }
}

TEST(SurfaceNets, OnePointOutsideIsACubeInsideOut)
{
  std::vector<CellSample> samples = CellsAround({ 5, 5, 5 });
  for (CellSample& sample : samples)
  {
    sample.Inside ^= 0xff;
  }
  EXPECT_NEAR(Volume(ConnectCells(samples, SortCells(samples))), -1, 1e-9);
}

TEST(SurfaceNets, WithoutACellTheEdgesAroundItHaveNoTriangles)
{
  std::vector<CellSample> samples = CellsAround({ 5, 5, 5 });
  samples.pop_back();
  const TriangleMesh open = ConnectCells(samples, SortCells(samples));
  EXPECT_EQ(open.Points.size(), 7u);
  EXPECT_EQ(open.Triangles.size(), 6u); // three of the six edges belong to the missing cell
}

TEST(SurfaceNets, CellsThatTouchAtACornerAreConnected)
{
  std::vector<CellSample> samples(4);
  samples[0].Cell = { 9, 9, 9 };
  samples[1].Cell = { 10, 8, 10 };
  samples[2].Cell = { 12, 8, 10 }; // two further on in x
  samples[3].Cell = { 9, 11, 9 };  // and in y
  const std::vector<int> components = FindComponents(samples, SortCells(samples));
  EXPECT_EQ(components, (std::vector<int>{ 0, 0, 2, 3 }));
}

TEST(SurfaceNets, OfCloseSamplesWithLikeNormalsTheFirstStays)
{
  std::vector<CellSample> samples(3);
  for (int i = 0; i < 3; ++i)
  {
    samples[i].Cell = { 4 + i, 4, 4 };
    samples[i].Point = Vector3d(0.6 * i, 0, 0); // of a spacing of 1
    samples[i].Normal = Vector3d::UnitZ();
  }
  const auto stays = [&] { return Subsample(samples, SortCells(samples), 1); };
  EXPECT_EQ(stays(), (std::vector<char>{ 1, 0, 1 })) << "the third is far enough from the first";
  samples[1].Normal = -Vector3d::UnitZ();
  EXPECT_EQ(stays(), (std::vector<char>{ 1, 1, 1 })) << "the other side of a sheet";
}
