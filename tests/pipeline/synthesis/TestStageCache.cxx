// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CacheScene.h"
#include "support/CalibrationScene.h"
#include "support/ChangedOption.h"
#include "support/Stop.h"

#include <vtkPointData.h>

#include <sys/stat.h>
#include <unistd.h>

using namespace novelview;
using namespace novelview::testing_support;
using support::Stop;
using testing::HasSubstr;
namespace fs = std::filesystem;

namespace
{
class StageCacheTest : public CacheTest
{
protected:
  /** Expects the right picture with one warning of the cache, the first of all. */
  void ExpectOneWarning(const Outcome& outcome, const Outcome& right, const std::string& part)
  {
    EXPECT_EQ(outcome.Color, right.Color);
    ASSERT_EQ(outcome.Warnings.size(), right.Warnings.size() + 1);
    EXPECT_EQ(std::count_if(outcome.Warnings.begin(), outcome.Warnings.end(),
                [](const std::string& warning) { return warning.starts_with("cache: "); }),
      1);
    EXPECT_THAT(outcome.Warnings,
      testing::Contains(testing::AllOf(
        testing::StartsWith("cache: "), HasSubstr(part), testing::Not(HasSubstr("\n")))));
  }
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
  this->Options.Hull.SpacingPx = 3;
  EXPECT_TRUE(add(this->Views));
  this->Options.UseDepthMaps = false;
  EXPECT_TRUE(add(this->Views));
  this->Options.ReconcileSilhouettes = false;
  EXPECT_TRUE(add(this->Views));
  this->Options.Hull.Box = { 0, 0, 0, 1, 1, 1 };
  EXPECT_TRUE(add(this->Views));
  this->Options.Texture.Power = 3; // of the texture mapper
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

TEST_F(StageCacheTest, EveryOptionOfTheSceneIsInTheKeyAndNoOther)
{
  const auto entry = [this](const SynthesisOptions& options)
  { return StageCache("c", this->Views, options).Entry(); };
  SynthesisOptions options = PresetOptions("best");
  const fs::path plain = entry(options);
  const OptionTable table = OptionsOf(options);
  EXPECT_GT(table.size(), 20u);
  int ofScene = 0;
  for (const Option& option : table)
  {
    const SynthesisOptions before = options;
    support::ChangeValue(option);
    EXPECT_EQ(entry(options) != plain, option.OfScene) << option.Key;
    ofScene += option.OfScene;
    options = before;
  }
  EXPECT_EQ(ofScene, 7);
}

TEST_F(StageCacheTest, CacheManifestUncheckedIsNoMore)
{
  // The numbers and the warnings have a checksum as everything has.
  const Outcome right = Synthesise(this->Options, this->Views);
  const fs::path entry = this->OnlyEntry();
  const std::string good = ReadText(entry);
  const vtkSmartPointer<vtkMultiBlockDataSet> kept =
    StageCache(this->Options.Cache, this->Views, this->Options).Load()->Views;
  const double noise = AttachedNumber(kept, arrays::DepthNoise, -1);
  ASSERT_GT(noise, 0);
  std::string changed = good;
  const std::size_t at =
    changed.find(std::string(reinterpret_cast<const char*>(&noise), sizeof(noise)));
  ASSERT_NE(at, std::string::npos);
  const double other = 3.5;
  changed.replace(at, sizeof(other), reinterpret_cast<const char*>(&other), sizeof(other));
  WriteText(entry, changed);
  this->ExpectOneWarning(
    Synthesise(this->Options, this->Views), right, "the checksum of its notes is wrong");
  EXPECT_TRUE(ReadText(entry) == good) << "a good entry took the bad one's place";
}

TEST_F(StageCacheTest, CacheStaleWarningIsNotRepeated)
{
  const Outcome right = Synthesise(this->Options, this->Views);
  fs::resize_file(this->OnlyEntry(), fs::file_size(this->OnlyEntry()) - 1);
  this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, "too short");
  const Outcome again = Synthesise(this->Options, this->Views);
  EXPECT_EQ(again.Warnings, right.Warnings);
  EXPECT_FALSE(again.Stages.count("power crust"));
}

TEST_F(StageCacheTest, WhateverStandsInTheEntrysPlaceIsOneWarning)
{
  const Outcome right = Synthesise(this->Options, this->Views);
  const fs::path entry = this->OnlyEntry();
  const std::string good = ReadText(entry);
  const auto replaced = [&](const std::string& part)
  {
    this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, part);
    EXPECT_TRUE(ReadText(entry) == good) << part;
  };
  WriteText(entry, "");
  replaced("too short");
  WriteText(entry, std::string(1000, 'x'));
  replaced("not a cache file");
  WriteText(entry, good + "x");
  replaced("too long");
  fs::create_hard_link(entry, this->Folder / "kept");
  WriteText(entry, "");
  replaced("too short");
  EXPECT_EQ(ReadText(this->Folder / "kept"), "") << "a new file, not new bytes in the old one";
  // What is not a regular file is none of ours, and stays.
  fs::remove(entry);
  ASSERT_EQ(::mkfifo(entry.c_str(), 0600), 0);
  this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, "not a regular file");
  EXPECT_TRUE(fs::is_fifo(entry));
  fs::remove(entry);
  fs::create_directories(entry / "of the user");
  this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, "not a regular file");
  EXPECT_TRUE(fs::exists(entry / "of the user"));
  fs::remove_all(entry);
  fs::create_symlink(entry.filename(), entry); // to itself
  this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, "cannot be read");
}

TEST_F(StageCacheTest, AnEntryOfOtherPhotographsIsNone)
{
  const Outcome right = Synthesise(this->Options, this->Views);
  const fs::path entry = this->OnlyEntry();
  const auto others = BoxViews();
  ViewImage(others, 4)->GetPointData()->GetArray(arrays::Color)->SetComponent(77, 1, 3);
  Synthesise(this->Options, others);
  fs::copy_file(StageCache(this->Options.Cache, others, this->Options).Entry(), entry,
    fs::copy_options::overwrite_existing);
  this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, "of something else");
}

TEST_F(StageCacheTest, CachePermissionIsOneWarning)
{
  const Outcome right = Synthesise(this->Options, this->Views);
  if (::geteuid() == 0)
  {
    // Root may read everything, but not a name that is too long.
    this->Options.Cache = this->Folder.Path / std::string(300, 'x');
    this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, "cannot be read");
    return;
  }
  fs::permissions(this->Options.Cache, fs::perms::none);
  this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, "cannot be read");
  fs::permissions(this->Options.Cache, fs::perms::owner_all);
}

TEST_F(StageCacheTest, AFolderThatCannotBeWrittenIsAWarning)
{
  const Outcome right = Synthesise(this->Options, this->Views);
  this->Options.Cache = this->Folder.Path / "file";
  WriteText(this->Options.Cache, "of the user");
  this->ExpectOneWarning(Synthesise(this->Options, this->Views), right, "nothing is kept");
  EXPECT_EQ(ReadText(this->Options.Cache), "of the user");
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
  { stop.Flag = stop.Flag || stage == "cameras"; }; // the last one before the novel camera
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

TEST_F(StageCacheTest, RefinedCamerasAreKeptAndSaidAgain)
{
  // The caller's views are given up meanwhile: the cache has to hold what it compares with.
  support::CalibrationScene scene(support::Waves(0.06));
  scene.Disturb(0.75);
  const Outcome first = Synthesise(this->Options, support::ToBlocks(scene.Photos));
  const Outcome second = Synthesise(this->Options, support::ToBlocks(scene.Photos));
  EXPECT_THAT(first.Warnings, testing::Contains(testing::HasSubstr("cameras refined")));
  EXPECT_TRUE(first.Stages.count("cameras"));
  EXPECT_FALSE(second.Stages.count("depth maps"));
  EXPECT_EQ(second.Warnings, first.Warnings);
  EXPECT_EQ(second.Color, first.Color);
}
