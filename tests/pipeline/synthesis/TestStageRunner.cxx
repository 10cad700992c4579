// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/StageRunner.h"

#include "base/Parallel.h"
#include "support/Stop.h"
#include "support/TestSupport.h"
#include "support/VtkScene.h"
#include "vtkVisualHullSource.h"

#include <vtkNew.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>

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

TEST(StageRunner, TwoStagesTogetherMakeWhatEachMakesAlone)
{
  const auto views = ToBlocks(BoxPhotos());
  const auto hullOf = [&views](double spacing)
  {
    auto hull = vtkSmartPointer<vtkVisualHullSource>::New();
    auto ownViews = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    ownViews->ShallowCopy(views);
    hull->SetInputData(ownViews);
    hull->SetSampleSpacing(spacing);
    return hull;
  };
  const auto alone = hullOf(2);
  RunStage("alone", alone);
  for (const int threads : { 1, 2, 0 })
  {
    LimitThreads(threads);
    const auto fine = hullOf(2);
    const auto coarse = hullOf(4);
    std::vector<std::string> told;
    std::set<std::string> progress;
    const double saved = RunStagesTogether(
      { "fine", fine }, { "coarse", coarse },
      [&](const std::string& stage, double)
      {
        progress.insert(stage);
        return true;
      },
      [&](const std::string& stage, double seconds)
      {
        told.push_back(stage);
        EXPECT_GT(seconds, 0);
      });
    EXPECT_THAT(told, testing::UnorderedElementsAre("coarse", "fine"));
    EXPECT_THAT(progress, testing::ElementsAre("coarse", "fine"));
    EXPECT_GE(saved, 0);
    EXPECT_LT(coarse->GetOutput()->GetNumberOfPoints(), fine->GetOutput()->GetNumberOfPoints());
    ASSERT_EQ(fine->GetOutput()->GetNumberOfPoints(), alone->GetOutput()->GetNumberOfPoints());
    for (vtkIdType i = 0; i < alone->GetOutput()->GetNumberOfPoints(); ++i)
    {
      double a[3];
      double b[3];
      fine->GetOutput()->GetPoint(i, a);
      alone->GetOutput()->GetPoint(i, b);
      ASSERT_TRUE(std::equal(a, a + 3, b)) << i;
    }
    told.clear();
    RunStagesTogether({ "fine", fine }, { "coarse", coarse }, {},
      [&](const std::string& stage, double) { told.push_back(stage); });
    EXPECT_TRUE(told.empty()) << "both were up to date";
  }
  LimitThreads(0);
}

TEST(StageRunner, OfTwoStagesTogetherTheOneThatFailsIsNamed)
{
  vtkNew<vtkVisualHullSource> good;
  good->SetInputData(ToBlocks(BoxPhotos()));
  vtkNew<vtkVisualHullSource> bad;
  bad->SetInputData(vtkSmartPointer<vtkMultiBlockDataSet>::New());
  LimitThreads(2); // with one they run one after the other, and the first error is the end
  ExpectError([&] { RunStagesTogether({ "good", good }, { "bad", bad }); }, "bad: ");
  EXPECT_GT(good->GetOutput()->GetNumberOfPoints(), 0) << "the other one is not lost";
  ExpectError([&] { RunStagesTogether({ "bad", bad }, { "good", good }); }, "bad: ");
  LimitThreads(0);
}

TEST(StageRunner, AListenerStopsTheSecondStageWhenOnlyThatIsLeft)
{
  vtkNew<vtkVisualHullSource> first;
  first->SetInputData(ToBlocks(BoxPhotos()));
  RunStage("first", first); // up to date, and so says nothing
  vtkNew<vtkVisualHullSource> second;
  second->SetInputData(ToBlocks(BoxPhotos()));
  second->SetSampleSpacing(0.25);
  EXPECT_THROW(RunStagesTogether({ "first", first }, { "second", second },
                 [](const std::string& stage, double)
                 {
                   EXPECT_EQ(stage, "second");
                   return false;
                 }),
    Interrupted);
  EXPECT_GT(first->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(second->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(StageRunner, AListenerStopsBothOfTwoStages)
{
  vtkNew<vtkVisualHullSource> first;
  first->SetInputData(ToBlocks(BoxPhotos()));
  vtkNew<vtkVisualHullSource> second;
  second->SetInputData(ToBlocks(BoxPhotos()));
  second->SetSampleSpacing(0.25); // takes so much longer that it is still at work
  EXPECT_THROW(RunStagesTogether({ "first", first }, { "second", second },
                 [](const std::string&, double) { return false; }),
    Interrupted);
  EXPECT_EQ(first->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(second->GetOutput()->GetNumberOfPoints(), 0);
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

TEST(ParallelForEach, TellsEveryFractionOnce)
{
  std::mutex mutex;
  std::multiset<double> told;
  ParallelForEach(
    4, [](std::size_t) {},
    [&](double fraction)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      told.insert(fraction);
    });
  EXPECT_EQ(told, (std::multiset<double>{ 0.25, 0.5, 0.75, 1 }));
}
