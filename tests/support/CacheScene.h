// SPDX-License-Identifier: GPL-3.0-or-later
// A synthesis of a box with a cache, and what it made.
#ifndef novelview_tests_CacheScene_h
#define novelview_tests_CacheScene_h

#include "support/TestSupport.h"
#include "support/VtkScene.h"
#include "synthesis/StageCache.h"
#include "synthesis/Synthesis.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <cstdint>
#include <set>

namespace novelview::testing_support
{
/** A box with one silhouette two pixels too small, so that every stage has something to say. */
inline vtkSmartPointer<vtkMultiBlockDataSet> BoxViews()
{
  std::vector<support::Photo> photos = support::BoxPhotos();
  support::ShrinkSilhouette(photos[5], 2);
  return support::ToBlocks(photos);
}

/** What one synthesis made, and how. */
struct Outcome
{
  std::vector<std::uint8_t> Color;
  vtkIdType CrustPoints = 0;
  std::set<std::string> Stages;
  std::vector<std::string> Warnings;
};

inline Outcome Synthesise(const SynthesisOptions& options, vtkMultiBlockDataSet* views)
{
  Outcome outcome;
  SynthesisListener listener;
  listener.StageDone = [&](const std::string& stage, double) { outcome.Stages.insert(stage); };
  listener.Warn = [&](const std::string& text) { outcome.Warnings.push_back(text); };
  Synthesis synthesis(views, options, listener);
  const Camera camera = InterpolateOnOrbit(
    AttachedCamera(ViewImage(views, 2), "a"), AttachedCamera(ViewImage(views, 3), "b"), 0.5);
  const NovelView view = synthesis.Render(camera, Stage::Full);
  auto* color = view.Image->GetPointData()->GetArray(arrays::Color);
  const auto* bytes = static_cast<const std::uint8_t*>(color->GetVoidPointer(0));
  outcome.Color.assign(bytes, bytes + color->GetDataSize());
  outcome.CrustPoints = synthesis.Crust()->GetNumberOfPoints();
  EXPECT_EQ(synthesis.Hull()->GetNumberOfPolys(), 0);
  EXPECT_GT(synthesis.MedialBalls()->GetNumberOfPoints(), 0);
  return outcome;
}

/** Box, options and a folder for the cache. */
class CacheTest : public testing::Test
{
protected:
  CacheTest() { this->Options.Cache = this->Folder.Path / "cache"; }

  std::filesystem::path OnlyEntry() const
  {
    std::vector<std::filesystem::path> entries;
    for (const auto& entry : std::filesystem::directory_iterator(this->Options.Cache))
    {
      entries.push_back(entry.path());
    }
    EXPECT_EQ(entries.size(), 1u) << "one entry, and no temporary file left";
    return entries.front();
  }

  TemporaryFolder Folder;
  SynthesisOptions Options = PresetOptions("best");
  vtkSmartPointer<vtkMultiBlockDataSet> Views = BoxViews();
};
}

#endif
