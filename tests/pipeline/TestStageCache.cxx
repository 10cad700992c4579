// SPDX-License-Identifier: GPL-3.0-or-later
#include "StageCache.h"
#include "Synthesis.h"
#include "TestSupport.h"
#include "support/Stop.h"
#include "support/VtkScene.h"

#include <vtkPointData.h>

#include <set>

using namespace novelview;
using namespace support;
namespace fs = std::filesystem;

namespace
{
/** A box with one silhouette two pixels too small, so that every stage has something to say. */
vtkSmartPointer<vtkMultiBlockDataSet> BoxViews()
{
  std::vector<Photo> photos = BoxPhotos();
  ShrinkSilhouette(photos[5], 2);
  return ToBlocks(photos);
}

/** What one synthesis made, and how. */
struct Outcome
{
  std::vector<std::uint8_t> Color;
  vtkIdType CrustPoints = 0;
  std::set<std::string> Stages;
  std::vector<std::string> Warnings;
};

Outcome Synthesise(const SynthesisOptions& options, vtkMultiBlockDataSet* views)
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

class StageCacheTest : public testing::Test
{
protected:
  StageCacheTest() { this->Options.Cache = this->Folder.Path / "cache"; }

  fs::path OnlyEntry() const
  {
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(this->Options.Cache))
    {
      entries.push_back(entry.path());
    }
    EXPECT_EQ(entries.size(), 1u) << "one entry, and no temporary folder left";
    return entries.front();
  }

  testing_support::TemporaryFolder Folder;
  SynthesisOptions Options = PresetOptions("best");
  vtkSmartPointer<vtkMultiBlockDataSet> Views = BoxViews();
};
}

TEST_F(StageCacheTest, TheSecondRunSkipsWhatIsKeptAndMakesTheSameBits)
{
  SynthesisOptions without = this->Options;
  without.Cache.clear();
  const Outcome plain = Synthesise(without, this->Views);
  const Outcome first = Synthesise(this->Options, this->Views);
  this->OnlyEntry();
  const Outcome second = Synthesise(this->Options, this->Views);
  EXPECT_EQ(first.Color, plain.Color);
  EXPECT_EQ(second.Color, plain.Color);
  EXPECT_EQ(second.CrustPoints, plain.CrustPoints);
  EXPECT_EQ(first.Stages, plain.Stages);
  EXPECT_TRUE(first.Stages.count("depth maps"));
  EXPECT_EQ(
    second.Stages, (std::set<std::string>{ "culling", "outline", "non-outline", "texture" }));
  EXPECT_FALSE(plain.Warnings.empty()) << "the small silhouette";
  EXPECT_EQ(second.Warnings, plain.Warnings) << "what was said then still holds";
}

TEST_F(StageCacheTest, ThePaperNeedsNoDepthMapsAndKeepsTheRest)
{
  this->Options = PresetOptions("paper");
  this->Options.Cache = this->Folder.Path / "cache";
  const Outcome first = Synthesise(this->Options, this->Views);
  const Outcome second = Synthesise(this->Options, this->Views);
  EXPECT_EQ(first.Color, second.Color);
  EXPECT_FALSE(second.Stages.count("visual hull"));
}

TEST_F(StageCacheTest, EverythingTheResultsFollowFromIsInTheKey)
{
  std::set<fs::path> keys;
  const auto add = [&](vtkMultiBlockDataSet* views)
  { return keys.insert(StageCache("c", views, this->Options).Entry()).second; };
  EXPECT_TRUE(add(this->Views));
  EXPECT_FALSE(add(BoxViews())) << "equal photographs are the same photographs";
  this->Options.HullSpacingPx = 3;
  EXPECT_TRUE(add(this->Views));
  this->Options.UseDepthMaps = false;
  EXPECT_TRUE(add(this->Views));
  this->Options.ReconcileSilhouettes = false;
  EXPECT_TRUE(add(this->Views));
  this->Options.HullBox = { 0, 0, 0, 1, 1, 1 };
  EXPECT_TRUE(add(this->Views));
  this->Options.Power = 3; // of the texture mapper
  EXPECT_FALSE(add(this->Views));
  const auto change = [&](const auto& how)
  {
    const auto views = BoxViews();
    how(ViewImage(views, 4));
    return add(views);
  };
  EXPECT_TRUE(change([](vtkImageData* image)
    { image->GetPointData()->GetArray(arrays::Color)->SetComponent(77, 1, 3); }));
  EXPECT_TRUE(change([](vtkImageData* image)
    { image->GetPointData()->GetArray(arrays::Mask)->SetComponent(77, 0, 128); }));
  EXPECT_TRUE(change(
    [](vtkImageData* image)
    {
      Camera camera = AttachedCamera(image, "view");
      camera.T.x() += 1e-12;
      AttachCamera(image, camera);
    }));
}

TEST_F(StageCacheTest, ADamagedEntryIsMadeAnew)
{
  const Outcome first = Synthesise(this->Options, this->Views);
  const fs::path entry = this->OnlyEntry();
  const auto damages = std::vector<std::pair<const char*, void (*)(const fs::path&)>>{
    { "crust.vtp", [](const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); } },
    { "view_0003.vti", [](const fs::path& file) { fs::remove(file); } },
    { "hull.vtp",
      [](const fs::path& file)
      {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(-100, std::ios::end);
        stream.put('x').put('y');
      } },
    { "manifest.json", [](const fs::path& file) { std::ofstream(file) << "{ \"files\""; } }
  };
  for (const auto& [file, damage] : damages)
  {
    damage(entry / file);
    const Outcome again = Synthesise(this->Options, this->Views);
    EXPECT_EQ(again.Color, first.Color) << file;
    EXPECT_TRUE(again.Stages.count("power crust")) << file;
    ASSERT_FALSE(again.Warnings.empty());
    EXPECT_THAT(again.Warnings.front(),
      testing::AllOf(testing::StartsWith("cache: "), testing::HasSubstr("made anew")));
    EXPECT_FALSE(Synthesise(this->Options, this->Views).Stages.count("power crust"))
      << "mended: " << file;
  }
}

TEST_F(StageCacheTest, AFolderThatCannotBeWrittenIsAWarning)
{
  std::ofstream(this->Options.Cache) << "a file";
  const Outcome outcome = Synthesise(this->Options, this->Views);
  ASSERT_FALSE(outcome.Warnings.empty());
  EXPECT_THAT(outcome.Warnings.back(), testing::HasSubstr("the cache cannot be written"));
  EXPECT_FALSE(outcome.Color.empty());
}

TEST_F(StageCacheTest, AStopWhileItIsReadIsNoDamage)
{
  Synthesise(this->Options, this->Views);
  Stop stop;
  SynthesisListener listener;
  listener.Progress = [&](const std::string& stage, double)
  {
    stop.Flag = stop.Flag || stage == "cache";
    return true;
  };
  std::vector<std::string> warnings;
  listener.Warn = [&](const std::string& text) { warnings.push_back(text); };
  Synthesis synthesis(this->Views, this->Options, listener);
  EXPECT_THROW(
    synthesis.Render(AttachedCamera(ViewImage(this->Views, 2), "a"), Stage::Hull), Interrupted);
  EXPECT_THAT(warnings, testing::IsEmpty());
}

TEST_F(StageCacheTest, AStopDoesNotLoseWhatIsMade)
{
  Stop stop;
  SynthesisListener listener;
  listener.StageDone = [&](const std::string& stage, double)
  { stop.Flag = stop.Flag || stage == "depth maps"; }; // the crust may end before or after them
  std::vector<std::string> warnings;
  listener.Warn = [&](const std::string& text) { warnings.push_back(text); };
  Synthesis synthesis(this->Views, this->Options, listener);
  EXPECT_THROW(
    synthesis.Render(AttachedCamera(ViewImage(this->Views, 2), "a"), Stage::Hull), Interrupted);
  stop.Flag = false;
  EXPECT_TRUE(fs::exists(this->OnlyEntry()));
  for (const std::string& warning : warnings)
  {
    EXPECT_EQ(warning.find("interrupted"), std::string::npos) << warning;
  }
  EXPECT_FALSE(Synthesise(this->Options, this->Views).Stages.count("depth maps"));
}
