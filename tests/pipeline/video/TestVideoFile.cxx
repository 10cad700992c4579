// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/TestSupport.h"
#include "video/VideoContainer.h"
#include "video/VideoFile.h"

#include <opencv2/videoio.hpp>

#include <sched.h>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** A square of one colour that moves with the frame. */
Image<std::uint8_t> Frame(int width, int height, int number)
{
  Image<std::uint8_t> frame(width, height, 3);
  for (int y = 10; y < 30; ++y)
  {
    for (int x = 10 + 2 * number; x < 30 + 2 * number; ++x)
    {
      frame(x, y, 0) = 200;
      frame(x, y, 2) = 40;
    }
  }
  return frame;
}

void Write(const std::filesystem::path& path, int width, int height)
{
  VideoFile video(path, width, height, 12);
  for (int i = 0; i < 6; ++i)
  {
    video.Add(Frame(width, height, i).Ref());
  }
  EXPECT_TRUE(video.Close());
}
}

TEST(VideoFile, ReadsBackAsItWasWritten)
{
  const TemporaryFolder folder;
  for (const char* name : { "a.mp4", "a.mov", "a.mkv", "a.avi" })
  {
    EXPECT_TRUE(IsVideoName(name));
    const std::filesystem::path path = folder / name;
    Write(path, 79, 61); // odd sizes get a black border
    cv::VideoCapture video(path.string());
    ASSERT_TRUE(video.isOpened()) << name;
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_WIDTH), 80);
    EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_HEIGHT), 62);
    EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 12, 1e-6);
    cv::Mat frame;
    for (int i = 0; i < 6; ++i)
    {
      ASSERT_TRUE(video.read(frame)) << name << " " << i;
      // The square's middle, in OpenCV's order BGR. Codecs with half the colour resolution change
      // plain areas by a few levels.
      const auto middle = frame.at<cv::Vec3b>(20, 20 + 2 * i);
      EXPECT_NEAR(middle[2], 200, 12) << name;
      EXPECT_NEAR(middle[1], 0, 12) << name;
      EXPECT_NEAR(middle[0], 40, 12) << name;
      EXPECT_NEAR(frame.at<cv::Vec3b>(50, 60)[2], 0, 12) << name;
    }
    EXPECT_FALSE(video.read(frame)) << name;
  }
}

TEST(VideoFile, IsTheSameOnOneProcessorAsOnAll)
{
  const TemporaryFolder folder;
  cpu_set_t all;
  ASSERT_EQ(::sched_getaffinity(0, sizeof(all), &all), 0);
  Write(folder / "all.mp4", 80, 60);
  cpu_set_t after;
  ::sched_getaffinity(0, sizeof(after), &after);
  EXPECT_TRUE(CPU_EQUAL(&all, &after)); // the caller's processors are given back
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(::sched_getcpu(), &one);
  ::sched_setaffinity(0, sizeof(one), &one);
  Write(folder / "one.mp4", 80, 60);
  ::sched_setaffinity(0, sizeof(all), &all);
  EXPECT_TRUE(ReadText(folder / "all.mp4") == ReadText(folder / "one.mp4"));
}

TEST(VideoFile, WhatCannotBeWrittenIsSaid)
{
  const TemporaryFolder folder;
  EXPECT_FALSE(IsVideoName("a.gif"));
  EXPECT_FALSE(IsVideoName("folder"));
  ExpectError([&] { VideoFile(folder / "a.gif", 80, 60, 12); }, "a.gif: no such video", ".mp4");
  ExpectError(
    [&] { VideoFile(folder / "no/a.mp4", 80, 60, 12); }, "no such video", "tried avc1, mp4v");
  VideoFile video(folder / "a.mp4", 80, 60, 12);
  ExpectError([&] { video.Add(Frame(90, 60, 0).Ref()); }, "frame 0: is not of the video's size");
}

TEST(VideoFile, ACutFileIsTold)
{
  const TemporaryFolder folder;
  for (const char* name : { "a.mp4", "a.mov", "a.mkv", "a.avi" })
  {
    const std::filesystem::path path = folder / name;
    Write(path, 64, 48);
    const std::string whole = ReadText(path);
    EXPECT_TRUE(IsWholeVideo(path)) << name;
    for (const std::size_t size :
      { std::size_t(0), std::size_t(9), whole.size() / 2, whole.size() - 1 })
    {
      WriteText(path, whole.substr(0, size));
      EXPECT_FALSE(IsWholeVideo(path)) << name << " of " << size << " bytes";
    }
  }
}
