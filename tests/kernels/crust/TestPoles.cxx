// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/Poles.h"

#include <gtest/gtest.h>

using namespace novelview;
using Eigen::Vector3d;

TEST(Poles, AgreementOfBalls)
{
  const Vector3d x(1, 0, 0);
  EXPECT_DOUBLE_EQ(BallAgreement(x, 2, x, 2), 1);                     // the same
  EXPECT_DOUBLE_EQ(BallAgreement(Vector3d::Zero(), 1, 2 * x, 1), -1); // touching from outside
  EXPECT_DOUBLE_EQ(BallAgreement(Vector3d::Zero(), 3, 5 * x, 4), 0);  // at a right angle
  EXPECT_DOUBLE_EQ(BallAgreement(Vector3d::Zero(), 1, 9 * x, 1), -1); // apart
}
