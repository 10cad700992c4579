// SPDX-License-Identifier: GPL-3.0-or-later
#include "Job.h"

#include "DatasetFormats.h"
#include "JsonFile.h"
#include "ModelFile.h"
#include "PrintableText.h"
#include "UsageError.h"

#include <algorithm>
#include <limits>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr double NoLimit = std::numeric_limits<double>::infinity();
constexpr double ByteMost = 255;

void Append(OptionTable& table, OptionTable more)
{
  table.insert(table.end(), more.begin(), more.end());
}

/** The calibration's options; `formatKey` is what its format goes by in this command. */
OptionTable OptionsOf(DatasetSource& source, const char* formatKey)
{
  const char* const group = "Calibration";
  CameraConvention& convention = source.Convention;
  std::vector<std::string> formats = DatasetFormatNames();
  formats.insert(formats.begin(), "auto");
  return {
    { "calibration", "calibration file (COLMAP: also its folder); found when there is just one", "",
      group, &source.Calibration },
    { formatKey, "format of the calibration; auto = found", "", group, &source.Format, -NoLimit,
      NoLimit, formats },
    { "axes", "camera's axes: x right, y down, z forward, or x right, y up, z backward", "", group,
      &convention.Axes, -NoLimit, NoLimit, { "format", "opencv", "opengl" } },
    { "poses", "what the poses map", "", group, &convention.Poses, -NoLimit, NoLimit,
      { "format", "world-to-camera", "camera-to-world" } },
    { "rotationOrder", "how rotations are written: row by row, or transposed", "", group,
      &convention.RotationOrder, -NoLimit, NoLimit, { "format", "row", "column" } },
    { "pixelCentre", "coordinate of the centre of the top-left pixel; the format's when not given",
      "px", group, &convention.PixelCentre, 0, 0.5 },
    { "flipY", "y of cameras and pixels points up; a left-handed world is mirrored", "", group,
      &convention.FlipY },
    { "invertMasks", "the object is black in the masks", "", group, &convention.InvertMasks },
  };
}

/** How silhouettes are taken from photographs. */
OptionTable OptionsOf(SilhouetteOptions& silhouette)
{
  const char* const group = "Photographs";
  return {
    { "silhouetteLevel",
      "difference from the background that is object; chosen from the photograph when not given",
      "levels", group, &silhouette.Level, 0, ByteMost },
    { "silhouetteClosing", "gaps of up to twice this are closed", "px", group,
      &silhouette.ClosingPx, 0, 100 },
    { "silhouetteSmallHole", "smaller holes are filled", "part of the object", group,
      &silhouette.SmallHole, 0, 1 },
    { "silhouetteIgnoreShadows", "leave out shadows cast on a coloured background", "", group,
      &silhouette.IgnoreShadows },
  };
}

OptionTable OptionsOf(JobInput& input)
{
  const char* const group = "Photographs";
  OptionTable table = {
    { "dataset", "folder of the photographs", "", group, &input.Dataset },
    { "exclude", "photographs to leave out", "", group, &input.Exclude },
    { "forceSilhouettes", "extract silhouettes although there are masks", "", group,
      &input.ForceSilhouettes },
  };
  Append(table, OptionsOf(input.Silhouette));
  Append(table, OptionsOf(input.Source, "format"));
  return table;
}

Option ThreadsOption(int& threads)
{
  // The result is the same with any number, so a written job does not hold it.
  return { "threads", "threads to use; 0 = one per core", "", "Program", &threads, 0, 1024, {},
    false };
}

Option RankTimeoutOption(int& seconds)
{
  return { "rankTimeout",
    "end the run of several processes (mpirun) when one of them is silent for so long; 0 = never",
    "s", "Program", &seconds, 0, 86400, {}, false };
}

Option TextureSizeOption(int& size, const char* group)
{
  return { "textureSize", "largest side of a mesh's texture", "px", group, &size, 64, 16384 };
}

Option StageOption(Stage& upTo)
{
  return { "stage", "how far the geometry is refined", "", "Method", &upTo };
}

/** A command's own options, and those of every command that makes novel views of a data set. */
template <class Options>
OptionTable WithMethod(OptionTable table, Options& options)
{
  table.push_back(StageOption(options.UpTo));
  Append(table, OptionsOf(options.Synthesis));
  Append(table, OptionsOf(options.Input));
  table.push_back(ThreadsOption(options.Threads));
  if constexpr (requires { options.RankTimeoutSeconds; }) // of what processes can share
  {
    table.push_back(RankTimeoutOption(options.RankTimeoutSeconds));
  }
  return table;
}

const Option& Find(const OptionTable& table, const std::string& key)
{
  const auto found = std::find_if(
    table.begin(), table.end(), [&key](const Option& option) { return option.Key == key; });
  if (found == table.end())
  {
    throw UsageError(FlagOf(key), "is no option of this command");
  }
  return *found;
}

/** Sets the stage options to a preset's, if there is a preset of this name. */
template <class Options>
void ApplyPreset(Options& options, const std::string& preset)
{
  SetFromText(Find(OptionsOf(options.Synthesis), "preset"), { preset });
  options.Synthesis = DefaultsOf<Options>(preset);
}

/** Layers preset, job file and command line; see MakeJob(). */
template <class Options>
Options Layered(const fs::path& dataset, const GivenOptions& given)
{
  Options options;
  const OptionTable table = OptionsOf(options);
  ApplyPreset(options, std::string(options.Synthesis.Preset));
  std::error_code failure;
  if (fs::is_regular_file(dataset, failure))
  {
    const nlohmann::ordered_json object = ReadJsonObject(dataset);
    if (object.contains("preset"))
    {
      const OptionTable preset{ Find(table, "preset") };
      SetFromJson(preset, { { "preset", object["preset"] } }, {}, dataset.string());
      ApplyPreset(options, std::string(options.Synthesis.Preset));
    }
    SetFromJson(table, object, fs::absolute(dataset).parent_path(), dataset.string());
  }
  else
  {
    options.Input.Dataset = dataset;
  }
  for (const auto& [key, words] : given)
  {
    if (key == "preset" && words.size() == 1)
    {
      ApplyPreset(options, words.front());
    }
  }
  for (const auto& [key, words] : given)
  {
    SetFromText(Find(table, key), words);
  }
  if (options.Input.Dataset.empty())
  {
    throw UsageError(dataset.empty() ? "data set" : dataset.string(), "no data set given");
  }
  if (options.Out.empty())
  {
    throw UsageError("--out", "no place for the results given");
  }
  return options;
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
    { "preset", "defaults of all stage options: the paper's, or what gives the best pictures", "",
      "Method", &options.Preset, -NoLimit, NoLimit, { "best", "paper" } },
    { "cache",
      "folder that keeps hull, crust and depth maps for further runs on the same photographs", "",
      "Method", &options.Cache },
    { "reconcileSilhouettes", "enlarge silhouettes that are too small for all the others", "", hull,
      &options.ReconcileSilhouettes },
    { "hullSpacing", "distance between surface samples, in the photographs", "px", hull,
      &options.HullSpacingPx, 0.25, 64 },
    { "hullBox", "search box x0,y0,z0,x1,y1,z1; found from the silhouettes when not given",
      "world units", hull, &options.HullBox },
    { "hullKeepAll", "keep every component, not only the largest", "", hull, &options.HullKeepAll },
    { "longestEdge",
      "cut longer edges of what the novel camera sees at their middle, once; 0 = leave all whole",
      "px", "Visibility culler", &options.LongestEdgePx, 0, 1000 },
    { "outlineIterations", "most rounds of moves", "", outline, &options.OutlineIterations, 0,
      1000 },
    { "outlineAlpha", "weight of the contour energy", "", outline, &options.OutlineAlpha, 0, 100 },
    { "outlineBeta", "weight of the smoothness energy", "", outline, &options.OutlineBeta, 0, 100 },
    { "outlineSearch", "how far to either side a point may look", "px", outline,
      &options.OutlineSearchPx, 0.25, 50 },
    { "nonOutlineIterations", "most rounds of moves", "", nonOutline, &options.NonOutlineIterations,
      0, 1000 },
    { "nonOutlineAlpha", "weight of the smoothness energy", "", nonOutline,
      &options.NonOutlineAlpha, 0, 100 },
    { "depthMaps",
      "find the surface by a depth map in every photograph, not by the paper's energies", "", depth,
      &options.UseDepthMaps },
    { "silhouettePrior",
      "weight of 'object' against the depth maps' votes at the outline; 0 = found from the data",
      "", depth, &options.SilhouettePrior, 0, 10 },
    { "depthNoise",
      "by how much the depth maps are off: how finely they are followed; 0 = measured",
      "pixel footprints", depth, &options.DepthNoise, 0, 10 },
    { "contourPrediction",
      "refine the outline by the contour interpolated from the photographs' contours", "", depth,
      &options.ContourPrediction },
    { "references", "photographs blended per pixel", "", texture, &options.References, 1, 64 },
    { "power", "m of the blending weight cos(angle)^m", "", texture, &options.Power, 0, 64 },
    { "feather", "a photograph's weight grows over this from its silhouette's border inwards", "px",
      texture, &options.FeatherPx, 0.01, 100 },
    { "occlusionSoftness", "softness of the occlusion test; 0 = hard", "pixel footprints", texture,
      &options.OcclusionSoftness, 0, 100 },
    { "exposureGains", "bring the photographs to one exposure; needs the depth maps", "", texture,
      &options.ExposureGains },
    { "rimSamples", "sub-rays per pixel side at the rim, odd; 1 = no antialiasing", "", texture,
      &options.RimSamples, 1, 9 },
    { "softRim", "draw also pixels of which less than half is covered; for films", "", texture,
      &options.SoftRim },
  };
}

OptionTable OptionsOf(Job& job)
{
  const char* const run = "Run";
  OptionTable table = {
    { "view", "novel view: between:A,B[,FRACTION], like:IMAGE or file:PAR.txt#NAME", "", run,
      &job.View },
    { "out", "folder for the results", "", run, &job.Out },
    { "truth", "true picture of the novel view, to compare with", "", run, &job.Truth },
    { "truthMask", "silhouette of the true picture", "", run, &job.TruthMask },
    { "trueMesh", "true mesh, to tell how good the picture could be", "", run, &job.TrueMesh },
    { "iterations", "write picture, mesh and scores of every iteration", "", run,
      &job.WriteIterations },
    { "screenshots", "write a picture of the scene for every iteration, too", "", run,
      &job.Screenshots },
    { "report", "write report.html, a page with everything about the run, and rig.png", "", run,
      &job.Page },
    { "meshOut", "also write the view's mesh with its texture: " + ModelFileKinds(), "", run,
      &job.MeshOut },
    TextureSizeOption(job.TextureSizePx, run),
  };
  return WithMethod(std::move(table), job);
}

OptionTable OptionsOf(RenderOptions& options)
{
  OptionTable table = {
    { "cameras", "calibration file of the views to make", "", "Render", &options.Cameras },
    { "out", "folder for the pictures NAME and mask/NAME", "", "Render", &options.Out },
  };
  return WithMethod(std::move(table), options);
}

OptionTable OptionsOf(OrbitOptions& options)
{
  const char* const orbit = "Orbit";
  OptionTable table = {
    { "out", "video (mp4, mov, mkv, avi), or folder for the frames as pictures", "", orbit,
      &options.Out },
    { "path", "JSON file of key cameras to go through; else once round the cameras' ring", "",
      orbit, &options.Path },
    { "frames", "frames; 0 = as many as the path's frame numbers or times say, else 72", "", orbit,
      &options.Frames, 0, 1000000 },
    { "fps", "frames per second", "1/s", orbit, &options.Fps, 0.1, 1000 },
    { "framesDir", "folder that gets the frames as pictures, too, with their cameras", "", orbit,
      &options.FramesDir },
  };
  return WithMethod(std::move(table), options);
}

OptionTable OptionsOf(MeshOptions& options)
{
  const char* const mesh = "Mesh";
  OptionTable table = {
    { "out", "files for the mesh: " + ModelFileKinds(), "", mesh, &options.Out },
    TextureSizeOption(options.TextureSizePx, mesh),
  };
  return WithMethod(std::move(table), options);
}

OptionTable OptionsOf(EvaluateOptions& options)
{
  const char* const evaluate = "Evaluate";
  OptionTable table = {
    { "out", "folder for scores, chart and pictures", "", evaluate, &options.Out },
    { "holdOut", "photographs to leave out and predict, all at once", "", evaluate,
      &options.HoldOut },
    { "every", "leave out and predict photographs 0, K, 2K .., all at once; 0 = not so", "",
      evaluate, &options.Every, 0, NoLimit },
    { "leaveOneOut", "predict each photograph from all others; else the data set's test views", "",
      evaluate, &options.LeaveOneOut },
    { "trueMesh",
      "true mesh, to tell how good the pictures could be; truth.ply beside test views is found", "",
      evaluate, &options.TrueMesh },
    { "pictures", "write the picture of every view and stage, and an overview", "", evaluate,
      &options.Pictures },
    { "report", "write report.html, a page with everything about the evaluation", "", evaluate,
      &options.Page },
  };
  return WithMethod(std::move(table), options);
}

OptionTable OptionsOf(GeneratorOptions& options)
{
  const char* const object = "Object";
  const char* const rig = "Rig";
  const char* const faults = "Imperfections";
  return {
    { "mesh", "built-in object or a ply, obj, stl or vtp file; the Stanford bunny when not given",
      "", object, &options.Mesh },
    { "texture", "solid texture", "", object, &options.Texture, -NoLimit, NoLimit,
      { "wood", "marble", "checker", "plaster", "grey" } },
    { "lit", "mild light fixed to the world instead of colours alone", "", object, &options.Lit },
    { "seed", "moves the texture and draws the noise", "", object, &options.Seed },
    { "views", "photographs", "", rig, &options.Views, 1, 10000 },
    { "step", "angle between neighbouring cameras", "deg", rig, &options.StepDeg, -360, 360 },
    { "elevation", "cameras above the horizon", "deg", rig, &options.ElevationDeg, -90, 90 },
    { "size", "size of the photographs, WIDTHxHEIGHT", "px", rig,
      SizeTarget{ &options.Width, &options.Height }, 16, 16384 },
    { "fieldOfView", "vertical field of view", "deg", rig, &options.FieldOfViewDeg, 1, 150 },
    { "fill", "share of the frame that the object's larger extent takes", "", rig, &options.Fill,
      0.01, 10 },
    { "supersampling", "samples per pixel and axis", "", rig, &options.Supersampling, 1, 16 },
    { "testAngles", "held-out views on the same circle", "deg", rig, &options.TestAnglesDeg },
    { "gainSpread", "brightness of each photograph is off by up to this share", "", faults,
      &options.GainSpread, 0, 1 },
    { "noise", "sigma of the noise of every pixel and channel", "levels", faults,
      &options.NoiseSigma, 0, ByteMost },
    { "calibrationNoise", "written rotations are off by about this", "px", faults,
      &options.CalibrationNoisePx, 0, 1000 },
    { "maskErode", "masks shrunk by this; negative: grown", "px", faults, &options.MaskErodePx,
      -1000, 1000 },
    { "maskErodeViews", "which masks; all when not given", "", faults, &options.MaskErodeViews, 0,
      NoLimit },
    { "frameShift", "object's centre off the frame's, as a share of its width", "", faults,
      &options.FrameShift, -1, 1 },
    { "frameShiftViews", "in which photographs; every third when not given", "", faults,
      &options.FrameShiftViews, 0, NoLimit },
    { "shadowViews", "photographs in which a shadow lies on the object", "", faults,
      &options.ShadowViews, 0, NoLimit },
    { "shadowDarkness", "share of the light that the shadow takes away", "", faults,
      &options.ShadowDarkness, 0, 1 },
    { "masks", "masks to write", "", faults, &options.Masks, -NoLimit, NoLimit,
      { "exact", "threshold", "none" } },
  };
}

OptionTable OptionsOf(ConvertOptions& options)
{
  const char* const convert = "Convert";
  OptionTable table = {
    { "format", "format to write", "", convert, &options.Format, -NoLimit, NoLimit,
      DatasetFormatNames() },
    { "exclude", "photographs to leave out", "", convert, &options.Exclude },
    { "undistort", "undistort photographs also where the format could hold the distortion", "",
      convert, &options.Undistort },
  };
  Append(table, OptionsOf(options.Source, "from"));
  table.push_back(ThreadsOption(options.Threads));
  return table;
}

OptionTable OptionsOf(CheckOptions& options)
{
  OptionTable table = {
    { "out", "folder for check.json and cameras.png; neither is written when not given", "",
      "Check", &options.Out },
  };
  Append(table, OptionsOf(options.Input));
  table.push_back(ThreadsOption(options.Threads));
  return table;
}

CheckOptions MakeCheckOptions(const fs::path& dataset, const GivenOptions& given)
{
  CheckOptions options;
  options.Input.Dataset = dataset;
  const OptionTable table = OptionsOf(options);
  for (const auto& [key, words] : given)
  {
    SetFromText(Find(table, key), words);
  }
  return options;
}

OptionTable OptionsOf(MaskOptions& options)
{
  const char* const mask = "Masks";
  OptionTable table = {
    { "out", "folder for mask/ and the contact sheet", "", mask, &options.Out },
    { "inPlace", "write into the data set's own mask/ instead", "", mask, &options.InPlace },
    { "overwrite", "replace masks that are there", "", mask, &options.Overwrite },
    { "exclude", "photographs to leave out", "", mask, &options.Exclude },
    { "method",
      "alpha channel; plain or dark background; chroma key; GrabCut from a rough box; auto = alpha "
      "channel or, without, plain",
      "", mask, &options.Method, -NoLimit, NoLimit,
      { "auto", "alpha", "plain", "dark", "chroma", "grabcut" } },
    { "key", "background's colour R,G,B for chroma; found at the border when not given", "levels",
      mask, &options.Key, 0, ByteMost },
    { "box", "x0,y0,x1,y1 around the object in every photograph, for grabcut", "px", mask,
      &options.Box, -NoLimit, NoLimit },
    { "boxMargin", "the box leaves out this to every side when not given", "part of the frame",
      mask, &options.BoxMargin, 0.01, 0.45 },
    { "grabCutRounds", "rounds of GrabCut", "", mask, &options.GrabCutRounds, 1, 100 },
  };
  Append(table, OptionsOf(options.Silhouette));
  Append(table, OptionsOf(options.Source, "format"));
  table.push_back(ThreadsOption(options.Threads));
  return table;
}

MaskOptions MakeMaskOptions(const fs::path& dataset, const GivenOptions& given)
{
  MaskOptions options;
  options.Dataset = dataset;
  const OptionTable table = OptionsOf(options);
  for (const auto& [key, words] : given)
  {
    SetFromText(Find(table, key), words);
  }
  if (options.Out.empty() == !options.InPlace)
  {
    throw UsageError(options.InPlace ? "--in-place" : "--out",
      options.InPlace ? "cannot be given with --out" : "no folder for the masks given");
  }
  const auto count = [](const std::vector<double>& values, std::size_t wanted, const char* flag)
  {
    if (!values.empty() && values.size() != wanted)
    {
      throw UsageError(flag, "has the wrong length", std::to_string(values.size()) + " numbers",
        std::to_string(wanted));
    }
  };
  count(options.Key, 3, "--key");
  count(options.Box, 4, "--box");
  if (!options.Key.empty() && options.Method != "chroma")
  {
    throw UsageError("--key", "is of no use without --method chroma");
  }
  if (!options.Box.empty() && options.Method != "grabcut")
  {
    throw UsageError("--box", "is of no use without --method grabcut");
  }
  return options;
}

ConvertOptions MakeConvertOptions(
  const fs::path& dataset, const fs::path& out, const GivenOptions& given)
{
  ConvertOptions options;
  options.Dataset = dataset;
  options.Out = out;
  const OptionTable table = OptionsOf(options);
  for (const auto& [key, words] : given)
  {
    SetFromText(Find(table, key), words);
  }
  if (options.Format.empty())
  {
    throw UsageError(
      "--format", "no format to write given", "nothing", RangeText(Find(table, "format")));
  }
  return options;
}

namespace
{
/** The job file that is written into the job's out folder. */
nlohmann::ordered_json JsonOf(const Job& job)
{
  Job copy = job;
  copy.Out = (fs::absolute(job.Out) / "job.json").parent_path();
  return ToJson(OptionsOf(copy), copy.Out);
}

/** job.json must name every file exactly, which is found out before the work. */
void CheckNames(const Job& job)
{
  const nlohmann::ordered_json object = JsonOf(job);
  for (const auto& [key, value] : object.items())
  {
    const auto check = [&key = key](const nlohmann::ordered_json& each)
    {
      if (each.is_string() && !IsUtf8(each.get_ref<const std::string&>()))
      {
        throw Error(key, "is no UTF-8, so that the job.json of the results cannot name it",
          each.get_ref<const std::string&>(), "another name");
      }
    };
    check(value);
    for (const nlohmann::ordered_json& each : value.is_array() ? value : nlohmann::ordered_json())
    {
      check(each);
    }
  }
}
}

Job MakeJob(const fs::path& dataset, const GivenOptions& given)
{
  Job job = Layered<Job>(dataset, given);
  if (job.View.What == ViewSpec::Kind::None)
  {
    throw UsageError("--view", "no novel view given");
  }
  if (job.Truth.empty() && !job.TruthMask.empty())
  {
    throw UsageError("--truth-mask", "is of no use without --truth");
  }
  CheckModelFiles(job.MeshOut, "--mesh-out");
  CheckNames(job);
  return job;
}

RenderOptions MakeRenderOptions(const fs::path& dataset, const GivenOptions& given)
{
  RenderOptions options = Layered<RenderOptions>(dataset, given);
  if (options.Cameras.empty())
  {
    throw UsageError("--cameras", "no calibration file of the views given");
  }
  return options;
}

OrbitOptions MakeOrbitOptions(const fs::path& dataset, const GivenOptions& given)
{
  return Layered<OrbitOptions>(dataset, given);
}

MeshOptions MakeMeshOptions(const fs::path& dataset, const GivenOptions& given)
{
  MeshOptions options = Layered<MeshOptions>(dataset, given);
  CheckModelFiles(options.Out, "--out");
  return options;
}

EvaluateOptions MakeEvaluateOptions(const fs::path& dataset, const GivenOptions& given)
{
  EvaluateOptions options = Layered<EvaluateOptions>(dataset, given);
  std::vector<std::string> ways;
  if (!options.HoldOut.empty())
  {
    ways.push_back("--hold-out");
  }
  if (options.Every > 0)
  {
    ways.push_back("--every");
  }
  if (options.LeaveOneOut)
  {
    ways.push_back("--leave-one-out");
  }
  if (ways.size() > 1)
  {
    throw UsageError(ways[1], "cannot be given with " + ways[0]);
  }
  if (options.Every == 1)
  {
    throw UsageError("--every", "leaves no photograph to predict from", "1", "at least 2");
  }
  for (const std::string& name : options.HoldOut)
  {
    if (std::count(options.HoldOut.begin(), options.HoldOut.end(), name) > 1)
    {
      throw UsageError("--hold-out", "names a photograph twice: " + name);
    }
    if (std::count(options.Input.Exclude.begin(), options.Input.Exclude.end(), name) > 0)
    {
      throw UsageError("--hold-out", "names a photograph that --exclude leaves out: " + name);
    }
  }
  return options;
}

std::string JobText(const Job& job)
{
  return DumpJson(JsonOf(job)) + "\n";
}
}
