// SPDX-License-Identifier: GPL-3.0-or-later
/** What a run of the program does: all that `novelview run`, `render`, `orbit` .. can be told. */
#ifndef novelview_Job_h
#define novelview_Job_h

#include "Dataset.h"
#include "Generator.h"
#include "Options.h"
#include "Silhouette.h"
#include "Synthesis.h"
#include "ViewSpec.h"

#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

namespace novelview
{
/** The photographs and how they are read. */
struct JobInput
{
  std::filesystem::path Dataset;    ///< folder
  DatasetSource Source;             ///< its calibration
  std::vector<std::string> Exclude; ///< photographs to leave out
  bool ForceSilhouettes = false;    ///< extract silhouettes although there are masks
  SilhouetteOptions Silhouette;
};

/** One novel view with everything that is reported about it: `novelview run`. */
struct Job
{
  JobInput Input;
  ViewSpec View;
  std::filesystem::path Out;
  std::filesystem::path Truth;     ///< picture to compare with; empty = what the view implies
  std::filesystem::path TruthMask; ///< its silhouette; empty = what lies in mask/ beside it
  std::filesystem::path TrueMesh;  ///< for the oracle; empty = none
  Stage UpTo = Stage::Full;
  bool WriteIterations = true;                ///< novel view, mesh and scores of every iteration
  bool Screenshots = true;                    ///< and a picture of the scene
  bool Page = true;                           ///< report.html and the picture of the rig
  std::vector<std::filesystem::path> MeshOut; ///< files of the view's mesh, see ModelFile.h
  int TextureSizePx = 4096;                   ///< of the mesh's texture, at most
  int Threads = 0;                            ///< 0 = one per core
  SynthesisOptions Synthesis;
};

/** Many novel views from one hull and crust: `novelview render`. */
struct RenderOptions
{
  JobInput Input;
  std::filesystem::path Cameras; ///< calibration file of the views to make
  std::filesystem::path Out;     ///< gets NAME and mask/NAME of each
  Stage UpTo = Stage::Full;
  int Threads = 0;
  int RankTimeoutSeconds = 300; ///< of several processes; 0 = never
  SynthesisOptions Synthesis;
};

/** A film of the object from a moving camera: `novelview orbit`. */
struct OrbitOptions
{
  JobInput Input;
  std::filesystem::path Out;  ///< a video, or a folder for the frames
  std::filesystem::path Path; ///< key cameras, see FramePlan.h; empty = round the cameras' ring
  int Frames = 0;             ///< 0 = what the path says, else 72
  double Fps = 24;            ///< frames per second
  std::filesystem::path FramesDir; ///< also gets the frames as pictures; empty = none
  Stage UpTo = Stage::Full;
  int Threads = 0;
  int RankTimeoutSeconds = 300; ///< of several processes; 0 = never
  SynthesisOptions Synthesis;
};

/** The whole object as a mesh with the photographs' colours: `novelview mesh`. */
struct MeshOptions
{
  JobInput Input;
  std::vector<std::filesystem::path> Out; ///< files, see ModelFile.h
  Stage UpTo = Stage::Full;               ///< Hull: the power crust; else refined by depth maps
  int TextureSizePx = 4096;               ///< of the texture, at most
  int Threads = 0;
  SynthesisOptions Synthesis;
};

/**
 * Novel views against photographs that no stage saw: `novelview evaluate`. At most one of the three
 * ways to hold photographs out is chosen; with none the data set's own test views are predicted or,
 * when it has none, each photograph in turn.
 */
struct EvaluateOptions
{
  JobInput Input;
  std::filesystem::path Out;        ///< gets the scores, the chart and the pictures
  std::vector<std::string> HoldOut; ///< photographs left out and predicted, all at once
  int Every = 0;                    ///< the same for photographs 0, K, 2K ..; 0 = not
  bool LeaveOneOut = false;         ///< each photograph is predicted from all others
  std::filesystem::path TrueMesh;   ///< for the oracle; empty = the test views' truth.ply, if any
  bool Pictures = true;             ///< write the views' pictures and the overview
  bool Page = true;                 ///< write report.html
  Stage UpTo = Stage::Full;
  int Threads = 0;
  int RankTimeoutSeconds = 300; ///< of several processes; 0 = never
  SynthesisOptions Synthesis;
};

/** A data set in another format: `novelview convert`. */
struct ConvertOptions
{
  std::filesystem::path Dataset;    ///< folder
  DatasetSource Source;             ///< its calibration
  std::filesystem::path Out;        ///< another folder
  std::string Format;               ///< a name of DatasetFormats.h
  std::vector<std::string> Exclude; ///< photographs to leave out
  bool Undistort = false;           ///< also where the format could hold the distortion
  int Threads = 0;
};

/** What is wrong with a data set: `novelview check`. */
struct CheckOptions
{
  JobInput Input;
  std::filesystem::path Out; ///< gets check.json and the picture of the cameras; empty = neither
  int Threads = 0;
};

/** Silhouettes for the photographs of a folder: `novelview mask`. */
struct MaskOptions
{
  std::filesystem::path Dataset;    ///< folder; without a calibration all its photographs are meant
  DatasetSource Source;             ///< its calibration
  std::vector<std::string> Exclude; ///< photographs to leave out
  std::filesystem::path Out;        ///< gets mask/ and the contact sheet; empty with InPlace
  bool InPlace = false;             ///< write into the data set's own mask/
  bool Overwrite = false;           ///< replace masks that are there
  std::string Method = "auto";      ///< auto, alpha, plain, dark, chroma or grabcut
  std::vector<double> Key;          ///< chroma: the background's RGB, 0 to 255; empty = found
  std::vector<double> Box;          ///< grabcut: x0 y0 x1 y1 around the object, px; empty = central
  double BoxMargin = 0.1;           ///< of the central box to every side, part of the frame
  int GrabCutRounds = 5;            ///< of GrabCut
  SilhouetteOptions Silhouette;
  int Threads = 0;
};

/**
 * The stage options that a command starts from: a preset's. A film's are softer at the rim, where
 * else the contour would jump from pixel to pixel.
 */
template <class Options>
SynthesisOptions DefaultsOf(const std::string& preset)
{
  SynthesisOptions options = PresetOptions(preset);
  if constexpr (std::is_same_v<Options, OrbitOptions>)
  {
    options.SoftRim = true;
    options.RimSamples = 5;
  }
  return options;
}

/** The tables: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(SynthesisOptions& options);
OptionTable OptionsOf(Job& job);
OptionTable OptionsOf(RenderOptions& options);
OptionTable OptionsOf(MeshOptions& options);
OptionTable OptionsOf(EvaluateOptions& options);
OptionTable OptionsOf(OrbitOptions& options);
OptionTable OptionsOf(GeneratorOptions& options);
OptionTable OptionsOf(ConvertOptions& options);
OptionTable OptionsOf(CheckOptions& options);
OptionTable OptionsOf(MaskOptions& options);

/** Words of a command line by the key of their option, in the order given. */
using GivenOptions = std::vector<std::pair<std::string, std::vector<std::string>>>;

/**
 * A job from what was given: `dataset` is a folder, or a JSON file that holds any of the options
 * ("dataset" among them). What the command line says goes over what the file says, which goes over
 * the preset. A preset on the command line replaces all stage options of the file.
 * Throws UsageError, also when data set, view or out folder are missing, or options contradict each
 * other; and Error when the job.json of the results could not hold a name, which must be UTF-8.
 */
Job MakeJob(const std::filesystem::path& dataset, const GivenOptions& given);
RenderOptions MakeRenderOptions(const std::filesystem::path& dataset, const GivenOptions& given);
OrbitOptions MakeOrbitOptions(const std::filesystem::path& dataset, const GivenOptions& given);
MeshOptions MakeMeshOptions(const std::filesystem::path& dataset, const GivenOptions& given);
EvaluateOptions MakeEvaluateOptions(
  const std::filesystem::path& dataset, const GivenOptions& given);

/** The options of a conversion; they come from the command line alone. Throws UsageError. */
ConvertOptions MakeConvertOptions(const std::filesystem::path& dataset,
  const std::filesystem::path& out, const GivenOptions& given);

/** The same for a check. */
CheckOptions MakeCheckOptions(const std::filesystem::path& dataset, const GivenOptions& given);

/** The same for masks; also throws UsageError when options contradict each other. */
MaskOptions MakeMaskOptions(const std::filesystem::path& dataset, const GivenOptions& given);

/**
 * A job file in the job's out folder: every option that can change the result, so that running the
 * file does the same again. out is ".", the folder of the file; other paths are absolute.
 */
std::string JobText(const Job& job);
}

#endif
