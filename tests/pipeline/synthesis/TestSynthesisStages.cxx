// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/SynthesisStages.h"

#include "support/ChangedOption.h"
#include "vtkNonOutlineDeformer.h"
#include "vtkOutlineDeformer.h"
#include "vtkTsdfNonOutlineDeformer.h"
#include "vtkTsdfOutlineDeformer.h"

#include <vtkMultiBlockDataSet.h>

#include <gmock/gmock.h>

#include <set>
#include <sstream>

using namespace novelview;

namespace
{
/** The settings and connections of a filter, without what differs between instances. */
std::string StateOf(vtkAlgorithm* filter)
{
  std::ostringstream printed;
  filter->Print(printed);
  std::istringstream lines(printed.str());
  std::string state;
  for (std::string line; std::getline(lines, line);)
  {
    const bool isOwn = line.find("0x") == std::string::npos &&
      line.find("Modified Time") == std::string::npos &&
      line.find("Reference Count") == std::string::npos;
    if (isOwn)
    {
      state += line + "\n";
    }
  }
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    if (filter->GetNumberOfInputConnections(port) > 0)
    {
      state += std::string("from ") + filter->GetInputAlgorithm(port, 0)->GetClassName() + "\n";
    }
  }
  return filter->GetClassName() + state;
}

/** The part of StateOf() that its own class prints: no executive, no connections. */
std::string SettingsOf(vtkAlgorithm* filter)
{
  const std::string state = StateOf(filter);
  const std::string last = "Progress Text: (None)\n"; // of vtkAlgorithm
  const std::size_t begin = state.find(last) + last.size();
  return state.substr(begin, state.find("\n\n", begin) - begin);
}

std::string StateOf(const SynthesisOptions& options)
{
  const vtkNew<vtkMultiBlockDataSet> views;
  const SynthesisStages stages(views, options);
  std::string state;
  for (vtkAlgorithm* filter :
    std::initializer_list<vtkAlgorithm*>{ stages.Reconciler, stages.HullSource, stages.Mesher,
      stages.DepthEstimator, stages.CameraRefiner, stages.Repairer, stages.Culler, stages.Outline,
      stages.NonOutline, stages.Mapper, stages.Fuser })
  {
    state += StateOf(filter);
  }
  return state;
}
}

TEST(SynthesisStages, EveryOptionReachesAFilter)
{
  std::set<std::string> all;
  std::set<std::string> used;
  // Some are read with depth maps only, and some without.
  for (const char* const preset : { "best", "paper" })
  {
    SynthesisOptions options = PresetOptions(preset);
    const std::string plain = StateOf(options);
    EXPECT_EQ(StateOf(options), plain);
    for (const Option& option : OptionsOf(options))
    {
      const SynthesisOptions before = options;
      support::ChangeValue(option);
      all.insert(option.Key);
      if (StateOf(options) != plain)
      {
        used.insert(option.Key);
      }
      options = before;
    }
  }
  used.insert({ "cache", "preset" }); // which are of no stage
  EXPECT_EQ(used, all);
}

TEST(SynthesisStages, WithoutAPresetFiltersHaveTheirOwnDefaults)
{
  SynthesisOptions options;
  const vtkNew<vtkMultiBlockDataSet> views;
  const SynthesisStages stages(views, options);
  const auto expectNew = [](vtkAlgorithm* filter, vtkAlgorithm* fresh)
  {
    EXPECT_EQ(SettingsOf(filter), SettingsOf(fresh));
    EXPECT_FALSE(SettingsOf(fresh).empty());
  };
  expectNew(stages.HullSource, vtkNew<vtkVisualHullSource>());
  expectNew(stages.Outline, vtkNew<vtkOutlineDeformer>());
  expectNew(stages.NonOutline, vtkNew<vtkNonOutlineDeformer>());
  expectNew(stages.Mapper, vtkNew<vtkViewDependentTextureMapper>());
  expectNew(stages.Culler, vtkNew<vtkVisibilityCuller>());
  options.UseDepthMaps = true;
  const SynthesisStages tsdf(views, options);
  expectNew(tsdf.Outline, vtkNew<vtkTsdfOutlineDeformer>());
  expectNew(tsdf.NonOutline, vtkNew<vtkTsdfNonOutlineDeformer>());
}
