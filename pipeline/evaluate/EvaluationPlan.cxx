// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/EvaluationPlan.h"

#include "base/UsageError.h"
#include "formats/Middlebury.h"
#include "formats/NerfTransforms.h"

#include <algorithm>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
bool Contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/** The names of the photographs that are not excluded. */
std::vector<std::string> PhotographsOf(
  const DatasetIndex& dataset, const std::vector<std::string>& exclude)
{
  std::vector<std::string> names;
  for (const NamedCamera& camera : dataset.Cameras)
  {
    if (!Contains(exclude, camera.Name))
    {
      names.push_back(camera.Name);
    }
  }
  return names;
}

/** The data set's own photographs of these names, predicted all at once. */
PlannedSet HoldOut(const std::vector<std::string>& names, const DatasetIndex& dataset)
{
  PlannedSet set;
  for (const std::string& name : names)
  {
    ViewSpec spec;
    spec.What = ViewSpec::Kind::Like;
    spec.Name = name;
    set.Views.push_back({ name, ResolveViewSpec(spec, dataset) });
    set.HeldOut.push_back(name);
  }
  return set;
}

/** The views that come with the data set; without any when it has none. */
PlannedSet TestViews(const DatasetIndex& dataset, std::vector<std::string>& warnings)
{
  PlannedSet set;
  const fs::path folder = dataset.Folder / "test";
  const fs::path split = dataset.Format == "nerf" ? NerfTestSplit(dataset.Calibration) : fs::path();
  std::error_code failure;
  const bool own = fs::is_directory(folder, failure) && !ParFilesIn(folder).empty();
  if (!own && (split.empty() || split == dataset.Calibration))
  {
    return set;
  }
  // Of the same origin as the photographs, so with the same conventions where the format is the same.
  DatasetSource source = dataset.Source;
  source.Calibration = own ? fs::path() : split;
  source.Format = own ? "middlebury" : "auto";
  if (own && dataset.Format != "middlebury")
  {
    source.Convention = {};
  }
  const DatasetIndex tests = ReadDatasetIndex(own ? folder : dataset.Folder, source);
  std::string missing;
  for (const Photograph& camera : tests.Cameras)
  {
    PlannedView view{ camera.Name, ResolveCamera(camera, dataset) };
    if (view.View.Truth.File.empty())
    {
      missing += (missing.empty() ? "" : ", ") + camera.Name;
      continue;
    }
    if (!view.View.HeldOut.empty() && !Contains(set.HeldOut, view.View.HeldOut))
    {
      set.HeldOut.push_back(view.View.HeldOut);
    }
    set.Views.push_back(view);
  }
  if (!missing.empty())
  {
    warnings.push_back("test views without a photograph are left out: " + missing);
  }
  return set;
}

/** Photographs 0, K, 2K .. of those that are not excluded. */
std::vector<std::string> EveryOf(const std::vector<std::string>& photographs, int step)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; i < photographs.size(); i += static_cast<std::size_t>(step))
  {
    names.push_back(photographs[i]);
  }
  return names;
}

void CheckNames(const std::vector<std::string>& names, const DatasetIndex& dataset)
{
  for (const std::string& name : names)
  {
    if (std::none_of(dataset.Cameras.begin(), dataset.Cameras.end(),
          [&name](const NamedCamera& camera) { return camera.Name == name; }))
    {
      throw UsageError("--hold-out",
        dataset.Calibration.string() + " has no photograph of this name", "'" + name + "'",
        "a name like " + (dataset.Cameras.empty() ? "none" : dataset.Cameras.front().Name));
    }
  }
}

void AddLeaveOneOut(
  const std::vector<std::string>& photographs, const DatasetIndex& dataset, EvaluationPlan& plan)
{
  plan.Mode = "leave one out";
  for (const std::string& name : photographs)
  {
    plan.Sets.push_back(HoldOut({ name }, dataset));
  }
}
}

EvaluationPlan MakeEvaluationPlan(const HoldOutOptions& options, const DatasetIndex& dataset,
  const std::vector<std::string>& exclude)
{
  const std::vector<std::string> photographs = PhotographsOf(dataset, exclude);
  EvaluationPlan plan;
  plan.TrueMesh = options.TrueMesh;
  if (!options.HoldOut.empty())
  {
    CheckNames(options.HoldOut, dataset);
    plan.Mode = "hold out";
    plan.Sets = { HoldOut(options.HoldOut, dataset) };
  }
  else if (options.Every > 0)
  {
    plan.Mode = "one photograph of every " + std::to_string(options.Every);
    plan.Sets = { HoldOut(EveryOf(photographs, options.Every), dataset) };
  }
  else if (options.LeaveOneOut)
  {
    AddLeaveOneOut(photographs, dataset, plan);
  }
  else if (PlannedSet tests = TestViews(dataset, plan.Warnings); !tests.Views.empty())
  {
    plan.Mode = "test views";
    plan.Sets = { tests };
    std::error_code failure;
    if (const fs::path mesh = dataset.Folder / "truth.ply";
        plan.TrueMesh.empty() && fs::exists(mesh, failure))
    {
      plan.TrueMesh = mesh;
    }
  }
  else
  {
    AddLeaveOneOut(photographs, dataset, plan);
  }
  for (PlannedSet& set : plan.Sets)
  {
    set.References = static_cast<std::size_t>(std::count_if(photographs.begin(), photographs.end(),
      [&set](const std::string& name) { return !Contains(set.HeldOut, name); }));
    if (set.References == 0)
    {
      throw UsageError(dataset.Calibration.string(), "no photograph left to predict from");
    }
  }
  return plan;
}
}
