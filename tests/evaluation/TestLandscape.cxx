// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/Landscape.h"

#include <gtest/gtest.h>

using namespace novelview::evaluation;

namespace
{
constexpr Offsets Five{ 2, 1 }; ///< -2 -1 0 1 2
}

TEST(Landscape, OffsetsAreSymmetricAboutTheTruth)
{
  EXPECT_EQ(Five.Count(), 5);
  EXPECT_EQ(Five[0], -2);
  EXPECT_EQ(Five[2], 0);
  EXPECT_EQ(Five[4], 2);
}

TEST(Landscape, TheLowestOfEqualLeastOnesCounts)
{
  EXPECT_EQ(LeastOffset(Five, { 5, 1, 2, 1, 4 }), -1);
}

TEST(Landscape, AValleyIsAsDeepAsItsLowerSide)
{
  EXPECT_EQ(ValleyDepth(Five, { 5, 1, 2, 3, 4 }, 4), 3) << "4 on the right";
  EXPECT_EQ(ValleyDepth(Five, { 5, 1, 2, 3, 4 }, 1), 1) << "2 beside it";
  EXPECT_EQ(ValleyDepth(Five, { 0, 1, 2, 3, 4 }, 4), 0) << "no left side";
  EXPECT_EQ(ValleyDepth(Five, { 4, 3, 2, 1, 0 }, 4), 0) << "no right side";
  EXPECT_EQ(ValleyDepth(Five, { 1, 1, 1, 1, 1 }, 4), 0) << "flat";
}

TEST(Landscape, SummaryByHand)
{
  Landscape landscape("E", Five);
  landscape.Add({ 5, 4, 0, 4, 5 }); // at 0, valley 5
  landscape.Add({ 3, 1, 2, 5, 6 }); // at -1, valley 2
  landscape.Add({ 9, 9, 9, 1, 2 }); // at 1, valley 1
  landscape.Add({ 9, 9, 9, 5, 3 }); // at 2, no valley
  const LandscapeSummary summary = landscape.Summary();
  EXPECT_EQ(summary.Points, 4);
  EXPECT_EQ(summary.NearShare, 0.75);
  EXPECT_EQ(summary.MedianOffset, 1) << "the upper one of -1, 0, 1, 2";
  EXPECT_EQ(summary.MedianDistance, 1);
  EXPECT_EQ(summary.MedianValley, 2);
  EXPECT_EQ(landscape.Mean(), (std::vector<double>{ 6.5, 5.75, 5, 3.75, 4 }));
}

TEST(Landscape, OfNoPointsIsEmpty)
{
  const Landscape landscape("E", Five);
  EXPECT_EQ(landscape.Summary().Points, 0);
  EXPECT_EQ(landscape.Summary().NearShare, 0);
}
