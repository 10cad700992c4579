// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/Console.h"
#include "support/TestSupport.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <poll.h>
#include <pty.h>
#include <thread>
#include <unistd.h>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
/** What a console wrote to its two streams. */
struct Written
{
  std::string Out;
  std::string Err;
};

template <class Body>
Written DispatchLoop(Verbosity verbosity, const Body& body)
{
  const TemporaryFolder folder;
  std::FILE* out = std::fopen((folder / "out").c_str(), "w");
  std::FILE* err = std::fopen((folder / "err").c_str(), "w");
  {
    Console console(verbosity, out, err);
    body(console);
  }
  std::fclose(out);
  std::fclose(err);
  return { ReadText(folder / "out"), ReadText(folder / "err") };
}

void SayEverything(Console& console)
{
  console.Progress("hull", 0.5);
  console.StageDone("hull", 1.25);
  console.Info("an info");
  console.Detail("a detail");
  console.Warn("a warning {}");
  console.Error("an error");
}
}

TEST(Console, WritesWholeLinesWhereThereIsNoTerminal)
{
  const Written normal = DispatchLoop(Verbosity::Normal, SayEverything);
  EXPECT_EQ(normal.Out, "hull done in 1.25 s\nan info\n");
  EXPECT_EQ(normal.Err, "novelview: warning: a warning {}\nnovelview: error: an error\n");
}

TEST(Console, EveryLineIsOnePrintableLine)
{
  const Written written = DispatchLoop(Verbosity::Verbose,
    [](Console& console)
    {
      console.Warn(std::string(10000000, 'a') + "\n\x1B[31m");
      console.Error("caf\xE9\nb");
      console.Info("caf\xE9\nb");
    });
  EXPECT_EQ(written.Out, "caf\\xE9 b\n");
  EXPECT_LT(written.Err.size(), 400u);
  EXPECT_THAT(written.Err, testing::HasSubstr("aaa...aaa"));
  EXPECT_THAT(written.Err, testing::EndsWith("a \\x1B[31m\nnovelview: error: caf\\xE9 b\n"));
}

TEST(Console, OnATerminalTheBarsTimeGoesOnByItself)
{
  int here = -1;
  int there = -1;
  if (openpty(&here, &there, nullptr, nullptr, nullptr) != 0)
  {
    GTEST_SKIP() << "no pseudo-terminal here (is /dev/pts mounted?)";
  }
  std::FILE* terminal = ::fdopen(there, "w");
  {
    Console console(Verbosity::Normal, terminal, terminal);
    console.Progress("hull", 0.5);
    std::string drawn;
    const auto bars = [&drawn]
    {
      std::size_t count = 0;
      for (std::size_t at = 0; (at = drawn.find(" 50 % hull, ", at)) != std::string::npos; ++at)
      {
        ++count;
      }
      return count;
    };
    while (bars() < 3)
    {
      pollfd more{ here, POLLIN, 0 };
      ASSERT_EQ(::poll(&more, 1, 10000), 1) << "it stands still";
      char text[256];
      const ssize_t length = ::read(here, text, sizeof(text));
      ASSERT_GT(length, 0);
      drawn.append(text, length);
    }
    console.Info("done");
    char text[256];
    EXPECT_GT(::read(here, text, sizeof(text)), 0);
  }
  std::fclose(terminal);
  ::close(here);
}

TEST(Console, QuietKeepsWarningsAndErrors)
{
  const Written quiet = DispatchLoop(Verbosity::Quiet, SayEverything);
  EXPECT_EQ(quiet.Out, "");
  EXPECT_EQ(quiet.Err, "novelview: warning: a warning {}\nnovelview: error: an error\n");
}

TEST(Console, VerboseTellsDetails)
{
  EXPECT_EQ(DispatchLoop(Verbosity::Verbose, SayEverything).Out,
    "hull done in 1.25 s\nan info\na detail\n");
}

TEST(Console, TimingsAreStagesWholeThreadsAndMemory)
{
  DispatchLoop(Verbosity::Quiet,
    [](Console& console)
    {
      console.StageDone("visual hull", 1);
      console.StageDone("texture", 2);
      console.StageDone("texture", 0.5);
      console.StagesOverlapped(0.75);
      console.StagesOverlapped(0.5);
      console.RunTimed(
        "report", [] { std::this_thread::sleep_for(std::chrono::milliseconds(20)); });
      EXPECT_THROW(console.RunTimed("broken", [] { throw Error("a", "b"); }), Error);
      const auto timings = nlohmann::ordered_json::parse(console.TimingsText());
      std::vector<std::string> stages;
      for (const auto& [stage, seconds] : timings.at("stages").items())
      {
        stages.push_back(stage);
      }
      EXPECT_THAT(stages, testing::ElementsAre("visual hull", "texture", "report"))
        << "in the order of their ends; what failed is none";
      EXPECT_EQ(timings.at("stages").at("texture"), 2.5);
      EXPECT_EQ(timings.at("overlap"), 1.25);
      // What it slept.
      EXPECT_GE(timings.at("stages").at("report"), 0.02);
      EXPECT_GE(timings.at("whole"), timings.at("stages").at("report"));
      EXPECT_GE(timings.at("threads"), 1);
      EXPECT_GT(timings.at("peakMemoryMiB"), 1);
    });
}

TEST(Console, SummaryAddsUpStagesAndTellsMemory)
{
  const Written written = DispatchLoop(Verbosity::Normal,
    [](Console& console)
    {
      console.StageDone("hull", 1);
      console.StageDone("outline", 2);
      console.StageDone("hull", 0.5);
      ASSERT_EQ(console.StageSeconds().size(), 2u);
      EXPECT_EQ(console.StageSeconds()[0].second, 1.5);
      console.StagesOverlapped(0.25);
      console.Summary();
    });
  EXPECT_THAT(written.Out, testing::HasSubstr("hull                         1.50 s\n"));
  EXPECT_THAT(written.Out, testing::HasSubstr("at the same time            -0.25 s\n"));
  EXPECT_THAT(written.Out, testing::HasSubstr("peak memory"));
  EXPECT_GT(PeakMemoryMiB(), 1); // no process with VTK in it fits into 1 MiB
}
