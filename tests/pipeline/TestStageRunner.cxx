// SPDX-License-Identifier: GPL-3.0-or-later
#include "StageRunner.h"

#include "Parallel.h"
#include "TestSupport.h"
#include "support/Stop.h"
#include "support/VtkScene.h"
#include "vtkVisualHullSource.h"

#include <vtkNew.h>

#include <atomic>

using namespace novelview;
using namespace support;

TEST(StageRunner, AStopFlagEndsAStageAsInterrupted)
{
  Stop stop;
  vtkNew<vtkVisualHullSource> hull;
  hull->SetInputData(ToBlocks(BoxPhotos()));
  double heard = -1;
  const auto progress = [&](const std::string&, double fraction)
  {
    heard = fraction;
    stop.Flag = true; // as a signal handler would; the listener itself does not object
    return true;
  };
  EXPECT_THROW(RunStage("visual hull", hull, progress), Interrupted);
  EXPECT_GE(heard, 0);
  EXPECT_EQ(hull->GetOutput()->GetNumberOfPoints(), 0);
  stop.Flag = false;
  RunStage("visual hull", hull);
  EXPECT_GT(hull->GetOutput()->GetNumberOfPoints(), 0) << "and the filter can be run again";
}

TEST(StageRunner, AStopFlagEndsLoopsOverPhotographs)
{
  Stop stop;
  std::atomic<int> calls = 0;
  const auto body = [&](std::size_t)
  {
    ++calls;
    stop.Flag = true;
  };
  EXPECT_THROW(ParallelForEach(1000, body), Interrupted);
  EXPECT_LE(calls, 64) << "at most one per thread";
}
