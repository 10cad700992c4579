// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/PowerCrust.h"

#include "core/Error.h"
#include "crust/CrustSurface.h"
#include "crust/LabelPropagation.h"
#include "crust/ManifoldRepair.h"
#include "crust/PoleLabelling.h"
#include "crust/Poles.h"
#include "crust/PowerCrustSurface.h"
#include "crust/SampleRecovery.h"
#include "crust/SmallComponents.h"

#include <algorithm>
#include <string>
#include <utility>

namespace novelview
{
namespace
{
constexpr const char* Where = "power crust";

/** Each pole takes the side of its tetrahedron, so hidden poles get one too. */
std::vector<Side> LabelsOfPoles(const Poles& poles, const std::vector<Side>& tetLabels)
{
  std::vector<Side> labels;
  labels.reserve(poles.Tets.size());
  for (int tet : poles.Tets)
  {
    labels.push_back(tetLabels[tet]);
  }
  return labels;
}

/** Balls through a far corner are no medial balls of the shape and are left out. */
MedialBalls CollectBalls(const Poles& poles, const std::vector<Side>& labels)
{
  MedialBalls balls;
  for (std::size_t i = 0; i < poles.Tets.size(); ++i)
  {
    if (!poles.Certain[i])
    {
      balls.Centres.push_back(poles.Balls.Centres[i]);
      balls.Radii.push_back(poles.Balls.Radii[i]);
      balls.Inner.push_back(labels[i] == Side::Inside);
    }
  }
  return balls;
}

void MakeDelaunayCrust(const DelaunayComplex& complex, const PowerCrustOptions& options,
  std::vector<Side>& labels, const Execution& execution, PowerCrustResult& result)
{
  result.RemovedComponents =
    RemoveSmallComponents(complex, options.MinimumComponentSamples, labels);
  MakeManifold(complex, labels, execution);
  execution.Report(0.9);
  if (options.RecoverSamples)
  {
    RecoverSamples(complex, labels);
  }
  // The repair itself can cut off small components.
  result.RemovedComponents +=
    RemoveSmallComponents(complex, options.MinimumComponentSamples, labels);
  CrustSurface surface = ExtractDelaunayCrust(complex, labels, execution);
  result.Mesh = std::move(surface.Mesh);
  result.PointSources = std::move(surface.PointSources);
  result.SplitPoints = surface.SplitPoints;
  result.MidPoints = surface.MidPoints;

  std::vector<char> used(static_cast<std::size_t>(complex.NumberOfSamples), 0);
  for (int source : result.PointSources)
  {
    used[source] = 1;
  }
  result.UnusedPoints = static_cast<int>(std::count(used.begin(), used.end(), 0));
}
}

void PowerCrustOptions::Check() const
{
  if (!MinimumComponentSamplesParameter.Contains(this->MinimumComponentSamples))
  {
    throw Error(Where, "MinimumComponentSamples is out of range",
      std::to_string(this->MinimumComponentSamples), "0 or more");
  }
}

PowerCrustResult ComputePowerCrust(const std::vector<Eigen::Vector3d>& points,
  const std::vector<Eigen::Vector3d>* normals, const PowerCrustOptions& options,
  const Execution& execution)
{
  options.Check();
  if (normals && normals->size() != points.size())
  {
    throw Error(Where, "wrong number of normals", std::to_string(normals->size()),
      std::to_string(points.size()));
  }
  const DelaunayComplex complex = BuildDelaunayComplex(points, execution);
  const Poles poles = FindPoles(complex, options.Output == CrustOutput::PowerCrust, execution);
  std::vector<Side> tetLabels = LabelPoles(complex, poles.OfSample, normals, execution);
  PropagateLabels(complex, tetLabels, execution);
  execution.Report(0.8);

  PowerCrustResult result;
  result.DuplicatePoints = complex.NumberOfDuplicates;
  std::vector<Side> ballLabels = LabelsOfPoles(poles, tetLabels);
  result.Balls = CollectBalls(poles, ballLabels);
  if (options.Output == CrustOutput::PowerCrust)
  {
    const PowerDiagram diagram = BuildPowerDiagram(poles.Balls, execution);
    for (std::size_t i = 0; i < ballLabels.size(); ++i)
    {
      ballLabels[i] = diagram.Unbounded[i] ? Side::Outside : ballLabels[i];
    }
    result.Mesh = ExtractPowerCrust(diagram, poles.Balls, ballLabels, execution);
  }
  else
  {
    MakeDelaunayCrust(complex, options, tetLabels, execution, result);
  }
  if (result.Mesh.Triangles.empty())
  {
    throw Error(Where, "the " + std::to_string(points.size()) + " points enclose nothing");
  }
  execution.Report(1);
  return result;
}
}
