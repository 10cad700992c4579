// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis/SynthesisOptions.h"

#include "core/Error.h"

namespace novelview
{
std::string StageName(Stage stage)
{
  switch (stage)
  {
    case Stage::Hull:
      return "hull";
    case Stage::Outline:
      return "outline";
    case Stage::Full:
      break;
  }
  return "full";
}

std::optional<Stage> StageOfName(const std::string& name)
{
  for (const Stage stage : { Stage::Hull, Stage::Outline, Stage::Full })
  {
    if (name == StageName(stage))
    {
      return stage;
    }
  }
  return {};
}

Option StageOption(Stage& upTo)
{
  WordTarget target{ "STAGE", "hull, outline, full", {}, {} };
  target.Set = [&upTo, range = target.Range](
                 const std::string& word, const std::string& where, const PathMap&)
  {
    const std::optional<Stage> stage = StageOfName(word);
    if (!stage)
    {
      throw UsageError(where, "is not a stage", "'" + word + "'", range);
    }
    upTo = *stage;
  };
  target.Get = [&upTo](const PathMap&) { return StageName(upTo); };
  return { "stage", "how far the geometry is refined", "", "Method", target };
}

SynthesisOptions PresetOptions(const std::string& preset)
{
  SynthesisOptions options;
  options.Preset = preset;
  if (preset == "paper")
  {
    return options;
  }
  if (preset == "best")
  {
    options.RefineCameras = true;
    options.ReconcileSilhouettes = true;
    options.RepairSilhouettes = true;
    options.UseDepthMaps = true;
    options.Culler.LongestEdgePx = 2;
    options.DepthMaps.UsePrediction = true;
    options.Texture.References = 2;
    options.Texture.Power = 16;
    options.Texture.FeatherPx = 20;
    options.Texture.OcclusionPx = 1.5;
    options.Texture.UseGains = true;
    options.Texture.FarDeg = 20;
    options.Texture.BoundarySamples = 3;
    return options;
  }
  throw Error("preset", "unknown", preset, "best or paper");
}

namespace
{
/** An option that went by another key in earlier versions. */
Option Formerly(const std::string& key, Option option)
{
  option.FormerKeys.push_back(key);
  return option;
}

/** An option that matters only once there is a novel camera. */
Option OfView(Option option)
{
  option.OfScene = false;
  return option;
}
}

OptionTable OptionsOf(SynthesisOptions& options)
{
  const char* const hull = "Visual hull";
  const char* const outline = "Outline deformer";
  const char* const nonOutline = "Non-outline deformer";
  const char* const depth = "Depth maps";
  const char* const texture = "Texture mapper";
  return {
    OfView({ "preset", "defaults of all stage options: the paper's, or those with the best images",
      "", "Method", &options.Preset, -Unlimited, Unlimited, { "best", "paper" } }),
    OfView({ "cache",
      "folder that keeps hull, crust and depth maps for further runs on the same photographs", "",
      "Method", &options.Cache }),
    { "refineCameras",
      "correct the cameras' poses where photographs that take no part then agree better; needs the "
      "depth maps",
      "", "Cameras", &options.RefineCameras },
    { "reconcileSilhouettes", "enlarge silhouettes that are too small for all the others", "", hull,
      &options.ReconcileSilhouettes },
    { "repairSilhouettes", "add to silhouettes the parts that only they lack", "", hull,
      &options.RepairSilhouettes },
    ParameterOption("hullSpacing", "distance between surface samples, in the photographs", hull,
      &options.Hull.SpacingPx, VisualHullOptions::SpacingPxParameter),
    { "hullBox",
      "box x0,y0,z0,x1,y1,z1 that bounds the hull; computed from the silhouettes if not given",
      "world units", hull, &options.Hull.Box },
    { "hullKeepAll", "keep every component, not only the largest", "", hull,
      &options.Hull.KeepAllComponents },
    OfView(ParameterOption("longestEdge",
      "split longer edges of what the novel camera sees at their midpoints, once; 0 = none",
      "Visibility culler", &options.Culler.LongestEdgePx,
      VisibilityOptions::LongestEdgePxParameter)),
    OfView(ParameterOption("outlineIterations", "maximum number of iterations", outline,
      &options.Outline.Iterations, IterationsParameter)),
    OfView(ParameterOption("outlineAlpha", "weight of the contour energy", outline,
      &options.Outline.Alpha, OutlineOptions::AlphaParameter)),
    OfView(ParameterOption("outlineBeta", "weight of the smoothness energy", outline,
      &options.Outline.Beta, OutlineOptions::BetaParameter)),
    OfView(ParameterOption("outlineSearch", "search range of a point, to either side", outline,
      &options.Outline.SearchPx, OutlineOptions::SearchPxParameter)),
    OfView(ParameterOption("nonOutlineIterations", "maximum number of iterations", nonOutline,
      &options.NonOutline.Iterations, IterationsParameter)),
    OfView(ParameterOption("nonOutlineAlpha", "weight of the smoothness energy", nonOutline,
      &options.NonOutline.Alpha, NonOutlineOptions::AlphaParameter)),
    { "depthMaps",
      "locate the surface by a depth map for every photograph, not by the paper's energies", "",
      depth, &options.UseDepthMaps },
    OfView(ParameterOption("silhouettePrior",
      "weight of 'object' against the depth maps' votes at the outline; 0 = estimated from the "
      "data",
      depth, &options.DepthMaps.SilhouettePrior, DepthMapOptions::SilhouettePriorParameter)),
    OfView(ParameterOption("depthNoise",
      "error of the depth maps, which determines how closely they are followed; 0 = measured",
      depth, &options.DepthMaps.DepthNoise, DepthMapOptions::DepthNoiseParameter)),
    OfView({ "contourPrediction",
      "refine the outline by the contour interpolated from the photographs' contours", "", depth,
      &options.DepthMaps.UsePrediction }),
    OfView(ParameterOption("references", "photographs blended per pixel", texture,
      &options.Texture.References, TextureOptions::ReferencesParameter)),
    OfView(ParameterOption("power", "m of the blending weight cos(angle)^m; of meshes at most 4",
      texture, &options.Texture.Power, TextureOptions::PowerParameter)),
    OfView(ParameterOption("feather",
      "a photograph's weight grows over this from its silhouette's border inwards", texture,
      &options.Texture.FeatherPx, TextureOptions::FeatherPxParameter)),
    OfView(ParameterOption("occlusionSoftness", "softness of the occlusion test; 0 = hard", texture,
      &options.Texture.OcclusionPx, TextureOptions::OcclusionPxParameter)),
    OfView(ParameterOption("farAngle",
      "pixels seen only from further aside than the second nearest photograph by this take their "
      "level from the surroundings; 0 = none",
      texture, &options.Texture.FarDeg, TextureOptions::FarDegParameter)),
    OfView({ "exposureGains", "bring the photographs to one exposure; needs the depth maps", "",
      texture, &options.Texture.UseGains }),
    Formerly("rimSamples",
      OfView(ParameterOption("boundarySamples",
        "subsamples per pixel side at the silhouette boundary; even numbers are raised by one; 1 = "
        "no antialiasing",
        texture, &options.Texture.BoundarySamples, TextureOptions::BoundarySamplesParameter))),
    Formerly("softRim",
      OfView({ "softBoundary", "draw also pixels of which less than half is covered; for videos",
        "", texture, &options.Texture.SoftBoundary })),
  };
}
}
