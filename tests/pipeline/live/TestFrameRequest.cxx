// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/FrameRequest.h"
#include "support/MessageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace novelview;
using testing::HasSubstr;

namespace
{
nlohmann::json Valid()
{
  return { { "K", { 300, 0, 79.5, 0, 310, 59.5, 0, 0, 1 } },
    { "R", { 1, 0, 0, 0, 0, 1, 0, -1, 0 } }, { "T", { 0.5, -0.25, 3 } }, { "width", 160 },
    { "height", 120 }, { "stage", "outline" } };
}

std::string Message(const nlohmann::json& request)
{
  return MessageOf([&] { ParseFrameRequest(request.dump()); });
}
}

TEST(FrameRequest, HoldsMatricesRowByRow)
{
  const FrameRequest request = ParseFrameRequest(Valid().dump());
  EXPECT_EQ(request.Cam.K(1, 1), 310);
  EXPECT_EQ(request.Cam.K(1, 2), 59.5);
  EXPECT_EQ(request.Cam.R(1, 2), 1);
  EXPECT_EQ(request.Cam.R(2, 1), -1);
  EXPECT_EQ(request.Cam.T.y(), -0.25);
  EXPECT_EQ(request.Cam.Width, 160);
  EXPECT_EQ(request.Cam.Height, 120);
  EXPECT_EQ(request.UpTo, Stage::Outline);
  EXPECT_EQ(request.Show, FrameRequest::Picture::Colour);
  EXPECT_FALSE(request.Pick);
}

TEST(FrameRequest, WhatIsNoneIsAnErrorThatNamesTheField)
{
  EXPECT_THAT(MessageOf([] { ParseFrameRequest("{"); }), HasSubstr("no JSON object"));
  EXPECT_THAT(MessageOf([] { ParseFrameRequest("[1]"); }), HasSubstr("no JSON object"));
  for (const char* key : { "K", "R", "T", "width", "height", "stage" })
  {
    nlohmann::json request = Valid();
    request.erase(key);
    EXPECT_THAT(Message(request), HasSubstr(key));
    request[key] = "x";
    EXPECT_THAT(Message(request), HasSubstr(key));
  }
  nlohmann::json request = Valid();
  request["R"][0] = nullptr;
  EXPECT_THAT(Message(request), HasSubstr("no number"));
  request = Valid();
  request["width"] = FrameRequest::LargestSidePx + 1;
  EXPECT_THAT(Message(request), HasSubstr("out of range"));
  request = Valid();
  request["R"][0] = 5;
  EXPECT_THAT(Message(request), HasSubstr("rotation"));
}

TEST(FrameRequest, MayWantDepthOrMeshAndAPoint)
{
  nlohmann::json request = Valid();
  request["show"] = "depth";
  request["pick"] = { 159, 0 };
  const FrameRequest parsed = ParseFrameRequest(request.dump());
  EXPECT_EQ(parsed.Show, FrameRequest::Picture::Depth);
  EXPECT_EQ(parsed.Pick, Eigen::Vector2i(159, 0));
  request["show"] = "wireframe";
  EXPECT_THAT(Message(request), HasSubstr("show is unknown"));
  request["show"] = "mesh";
  for (const nlohmann::json& pick : nlohmann::json::parse(R"([[160,0],[-1,0],[1.5,0],[1],"x"])"))
  {
    request["pick"] = pick;
    EXPECT_THAT(Message(request), HasSubstr("pick is no pixel")) << pick;
  }
}
