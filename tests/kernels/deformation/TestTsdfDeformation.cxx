// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/TsdfDeformation.h"
#include "geometry/NovelProjection.h"
#include "geometry/ViewSelection.h"
#include "geometry/Visibility.h"
#include "support/DentCase.h"
#include "support/Expect.h"
#include "support/Scene.h"

using namespace novelview;
using namespace support;

TEST(TsdfDeformation, WithTrueDepthMapsTheDentIsFound)
{
  const DentCase& dent = TheDent();
  const auto result = DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel);
  double off = 0;
  double offBefore = 0;
  int count = 0;
  for (std::size_t ptId = 0; ptId < dent.Mesh.Points.size(); ++ptId)
  {
    if (dent.Visible[ptId] && (dent.Mesh.Points[ptId] - Bite).norm() < 0.25)
    {
      off += std::abs(dent.Truth(result.Mesh.Points[ptId]));
      offBefore += std::abs(dent.Truth(dent.Mesh.Points[ptId]));
      ++count;
    }
  }
  ASSERT_GT(count, 20);
  // The truncation of five footprints and the prior leave a bias of about one, smoothing another.
  EXPECT_LT(off / count, 2.5 * MedianFootprint(dent.Views, Vector3d::Zero()));
  EXPECT_LT(off, 0.35 * offBefore);
}

TEST(TsdfDeformation, OtherPointsStayOnTheirRays)
{
  const DentCase& dent = TheDent();
  const auto result = DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel);
  const Vector3d centre = dent.Novel.Centre();
  const double millionth = 1e-6 * BoundingDiagonal(dent.Mesh.Points);
  for (std::size_t ptId = 0; ptId < dent.Mesh.Points.size(); ++ptId)
  {
    const Vector3d& before = dent.Mesh.Points[ptId];
    const Vector3d& after = result.Mesh.Points[ptId];
    EXPECT_LT((before - centre).normalized().cross(after - centre).norm(), millionth);
    EXPECT_TRUE(dent.Visible[ptId] || before == after);
  }
}

TEST(TsdfDeformation, OutlinePointsKeepTheirDepthAndNoTriangleFlips)
{
  const DentCase& dent = TheDent();
  const auto result = DeformOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel);
  const double millionth = 1e-6 * BoundingDiagonal(dent.Mesh.Points);
  int moved = 0;
  for (std::size_t ptId = 0; ptId < dent.Mesh.Points.size(); ++ptId)
  {
    moved += result.Mesh.Points[ptId] != dent.Mesh.Points[ptId];
    EXPECT_NEAR(dent.Novel.Depth(result.Mesh.Points[ptId]),
      dent.Novel.Depth(dent.Mesh.Points[ptId]), millionth);
  }
  EXPECT_GT(moved, 20);
  ASSERT_GT(result.Mesh.Triangles.size(), 100u);
  for (const Eigen::Vector3i& t : result.Mesh.Triangles)
  {
    // Square pixels; rounding of accumulated moves.
    EXPECT_LT(
      ProjectedArea(dent.Novel.Project(result.Mesh.Points[t[0]]),
        dent.Novel.Project(result.Mesh.Points[t[1]]), dent.Novel.Project(result.Mesh.Points[t[2]])),
      1e-9);
  }
}

TEST(TsdfDeformation, TheFusedSilhouetteIsThatOfTheObject)
{
  const DentCase& dent = TheDent();
  const double footprint = MedianFootprint(dent.Views, Vector3d::Zero());
  const TsdfField field(dent.Views, {}, footprint);
  const auto silhouette = FusedSilhouette(dent.Mesh, dent.Views, field, dent.Novel, footprint);
  const Photo truth = Take(Traced(dent.Truth, 0.6), Plain(1, 1, 1), dent.Novel, "novel");
  int wrong = 0;
  for (int y = 0; y < 120; ++y)
  {
    for (int x = 0; x < 160; ++x)
    {
      // Two pixels either side of the true contour are for the truncation to blur.
      if (std::abs(truth.ContourDistance(x, y)) > 2)
      {
        wrong += (silhouette(x, y) > 0) != (truth.ContourDistance(x, y) > 0);
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(TsdfDeformation, ViewsWithoutMapsAreNamed)
{
  const DentCase& dent = TheDent();
  auto views = dent.Views;
  views[3].DepthMap = {};
  ExpectError([&] { DeformOutlineByField(dent.Mesh, dent.Visible, views, dent.Novel); },
    "view p3: point array Depth or Confidence is missing");
  ExpectError([&] { DeformNonOutlineByField(dent.Mesh, dent.Visible, views, dent.Novel); },
    "view p3: point array Depth or Confidence is missing");
}

TEST(TsdfDeformation, TheListenerHearsEveryIterationOnceAndTheStart)
{
  const DentCase& dent = TheDent();
  TsdfDeformationOptions options;
  options.Iterations = 3;
  std::vector<int> heard;
  const auto listener = [&](const DeformationState& state) { heard.push_back(state.Iteration); };
  DeformOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, options, listener);
  EXPECT_EQ(heard, (std::vector<int>{ 0, 1, 2, 3 }));
  heard.clear();
  DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, options, listener);
  EXPECT_EQ(heard, (std::vector<int>{ 0, 1, 2, 3 }));
}

namespace
{
/** What a listener hears of a deformer. */
struct Heard
{
  std::vector<double> MeanEnergies;
  std::vector<double> LargestMoves;

  DeformationListener Listener()
  {
    return [this](const DeformationState& state)
    {
      double sum = 0;
      int count = 0;
      for (std::size_t ptId = 0; ptId < state.Energies->size(); ++ptId)
      {
        sum += (*state.Energies)[ptId].Total;
        count += (*state.Active)[ptId];
      }
      this->MeanEnergies.push_back(sum / count);
      this->LargestMoves.push_back(state.LargestMovePx);
    };
  }

  void ExpectMinimisation(const DeformationResult& result) const
  {
    EXPECT_TRUE(result.Converged);
    EXPECT_GT(result.Iterations, 3) << "iterations, not one move";
    ASSERT_EQ(this->MeanEnergies.size(), static_cast<std::size_t>(result.Iterations) + 1);
    for (std::size_t i = 1; i < this->MeanEnergies.size(); ++i)
    {
      EXPECT_LT(this->MeanEnergies[i], this->MeanEnergies[i - 1]) << "iteration " << i;
    }
    EXPECT_LT(this->LargestMoves.back(), 0.1) << "stops when nothing moves a tenth of a pixel";
  }
};
}

TEST(TsdfDeformation, EveryIterationOfTheOutlineLowersTheEnergyUntilNothingMoves)
{
  const DentCase& dent = TheDent();
  Heard heard;
  const auto result =
    DeformOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, {}, heard.Listener());
  heard.ExpectMinimisation(result);
  EXPECT_LT(heard.MeanEnergies.back(), 0.01) << "on the contour to a tenth of a pixel";
}

TEST(TsdfDeformation, EveryIterationOfTheOtherPointsLowersTheEnergyUntilNothingMoves)
{
  const DentCase& dent = TheDent();
  Heard heard;
  const auto result =
    DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, {}, heard.Listener());
  heard.ExpectMinimisation(result);
  const std::vector<double>& moves = heard.LargestMoves;
  EXPECT_GE(*std::min_element(moves.begin() + 1, moves.end() - 1), 0.1) << "and not later";
}

TEST(TsdfDeformation, WhoListensChangesNothing)
{
  const DentCase& dent = TheDent();
  Heard heard;
  TsdfDeformationOptions last;
  last.LastOnly = true;
  const auto alone = DeformOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, last);
  const auto told =
    DeformOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, {}, heard.Listener());
  EXPECT_EQ(alone.Mesh.Points, told.Mesh.Points);
  EXPECT_EQ(alone.Mesh.Triangles, told.Mesh.Triangles);
  EXPECT_EQ(
    DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, last).Mesh.Points,
    DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, {}, heard.Listener())
      .Mesh.Points);
}

TEST(TsdfDeformation, TheOutlineReachesTheContourHoweverFewIterationsThereAre)
{
  const DentCase& dent = TheDent();
  for (const int iterations : { 1, 2, 4 })
  {
    Heard heard;
    TsdfDeformationOptions options;
    options.Iterations = iterations;
    const auto result = DeformOutlineByField(
      dent.Mesh, dent.Visible, dent.Views, dent.Novel, options, heard.Listener());
    EXPECT_EQ(result.Iterations, iterations);
    EXPECT_LT(heard.MeanEnergies.back(), 0.02) << iterations << " iterations";
  }
}

TEST(TsdfDeformation, WithoutIterationsTheEnergiesAreMeasuredAndNothingMoves)
{
  const DentCase& dent = TheDent();
  TsdfDeformationOptions options;
  options.Iterations = 0;
  const auto outline =
    DeformOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, options);
  EXPECT_EQ(outline.Mesh.Points, dent.Mesh.Points);
  EXPECT_FALSE(outline.Converged);
  const auto others =
    DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, options);
  for (std::size_t ptId = 0; ptId < dent.Mesh.Points.size(); ++ptId)
  {
    EXPECT_LT((others.Mesh.Points[ptId] - dent.Mesh.Points[ptId]).norm(), 1e-12);
  }
  EXPECT_EQ(others.Energies.size(), dent.Mesh.Points.size());
}

TEST(TsdfDeformation, SameBitsWithOneAndMoreThreads)
{
  const DentCase& dent = TheDent();
  const auto one = DeformOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel);
  const auto three =
    DeformOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, {}, {}, InThreads(3));
  EXPECT_EQ(one.Mesh.Points, three.Mesh.Points);
  EXPECT_EQ(one.Mesh.Triangles, three.Mesh.Triangles);
  EXPECT_EQ(DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel).Mesh.Points,
    DeformNonOutlineByField(dent.Mesh, dent.Visible, dent.Views, dent.Novel, {}, {}, InThreads(3))
      .Mesh.Points);
}

namespace
{
/** The numbers of TsdfDeformationOptions that grow with the maps' noise. */
std::vector<double> Growing(double noise)
{
  const TsdfDeformationOptions options = OptionsForNoise(noise);
  return { options.Surface.TruncationPx, options.Surface.SurfacePrior, options.Outline.TruncationPx,
    options.Silhouette.SmoothingPx, options.Smoothing };
}
}

TEST(TsdfDeformation, OptionsGrowWithTheNoiseBetweenTheirLimits)
{
  EXPECT_EQ(Growing(0), (std::vector<double>{ 3, 0.05, 2, 0, 0.15 })) << "as sharp as pixels allow";
  EXPECT_EQ(Growing(100), (std::vector<double>{ 6, 1, 5, 1, 3.15 }));
  std::vector<double> before = Growing(0);
  for (double noise = 0.05; noise < 4.1; noise += 0.05)
  {
    const std::vector<double> now = Growing(noise);
    for (std::size_t i = 0; i < now.size(); ++i)
    {
      EXPECT_GE(now[i], before[i]) << "option " << i << " at noise " << noise;
    }
    before = now;
  }
  EXPECT_EQ(before, Growing(100)) << "all limits are reached";
}

TEST(TsdfDeformation, OptionsForSharpMapsAreTheDefaults)
{
  const TsdfDeformationOptions sharp = OptionsForNoise(0);
  const TsdfDeformationOptions plain;
  EXPECT_EQ(sharp.Surface.TruncationPx, plain.Surface.TruncationPx);
  EXPECT_EQ(sharp.Surface.SurfacePrior, plain.Surface.SurfacePrior);
  EXPECT_EQ(sharp.Outline.TruncationPx, plain.Outline.TruncationPx);
  EXPECT_EQ(sharp.Outline.SilhouettePrior, plain.Outline.SilhouettePrior);
  EXPECT_EQ(sharp.Silhouette.SmoothingPx, plain.Silhouette.SmoothingPx);
  EXPECT_EQ(sharp.Silhouette.UsePrediction, plain.Silhouette.UsePrediction);
  EXPECT_EQ(sharp.Silhouette.PredictionWeight, plain.Silhouette.PredictionWeight);
}
