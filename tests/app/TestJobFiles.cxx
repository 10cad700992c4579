// SPDX-License-Identifier: GPL-3.0-or-later
// The job files of data/jobs: each is one the program takes.
#include "commands/RunOptions.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

using namespace novelview;
namespace fs = std::filesystem;

namespace
{
const fs::path Project = NOVELVIEW_SOURCE_DIR;

TEST(JobFiles, AreAllRead)
{
  int count = 0;
  for (const auto& entry : fs::directory_iterator(Project / "data" / "jobs"))
  {
    SCOPED_TRACE(entry.path());
    const RunOptions job = MakeRunOptions(entry.path(), {});
    EXPECT_NE(job.View.What, ViewSpec::Kind::None);
    // They are distinguished from their own folder: nothing is written outside the project's out/.
    EXPECT_EQ(job.Out.parent_path(), Project / "out");
    EXPECT_TRUE(job.Input.Dataset.is_absolute());
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST(JobFiles, BunnyIsTheDemosRun)
{
  const RunOptions job = MakeRunOptions(Project / "data" / "jobs" / "bunny.json", {});
  EXPECT_EQ(job.Input.Dataset, Project / "out" / "bunny");
  EXPECT_EQ(job.View.ParFile, Project / "out" / "bunny" / "test" / "test_par.txt");
  EXPECT_EQ(job.View.Name, "test0000.png");
}

TEST(JobFiles, DinosaurTakesEveryFourthOf48AndOneBetween)
{
  const RunOptions job = MakeRunOptions(Project / "data" / "jobs" / "dino.json", {});
  std::vector<std::string> inputs;
  for (int i = 1; i <= 48; ++i)
  {
    char name[32];
    std::snprintf(name, sizeof(name), "dinoR%04d.png", i);
    const auto& left = job.Input.Exclude;
    if (name != job.View.Name && std::find(left.begin(), left.end(), name) == left.end())
    {
      inputs.push_back(name);
    }
  }
  EXPECT_THAT(inputs,
    testing::ElementsAre("dinoR0001.png", "dinoR0005.png", "dinoR0009.png", "dinoR0013.png",
      "dinoR0017.png", "dinoR0021.png", "dinoR0025.png", "dinoR0029.png", "dinoR0033.png",
      "dinoR0037.png", "dinoR0041.png", "dinoR0045.png"));
  EXPECT_EQ(job.View.What, ViewSpec::Kind::Like);
  EXPECT_EQ(job.View.Name, "dinoR0003.png");
}
}
