// SPDX-License-Identifier: GPL-3.0-or-later
#include "CommandLine.h"
#include "Threads.h"
#include "base/Parallel.h"
#include "base/UsageError.h"
#include "commands/CheckOptions.h"
#include "commands/ConvertOptions.h"
#include "commands/EvaluateOptions.h"
#include "commands/GenerateCommand.h"
#include "commands/MaskOptions.h"
#include "commands/OrbitOptions.h"
#include "commands/RenderOptions.h"
#include "commands/RunOptions.h"
#include "support/TestSupport.h"

#include <cstdio>
#include <map>
#include <optional>
#include <sys/wait.h>

using namespace novelview;
using namespace novelview::testing_support;
using testing::HasSubstr;

namespace
{
/** The end of a command line: exit code, what was printed, and what the commands were given. */
struct Outcome
{
  int Code = -1;
  std::string Out;
  std::string Err;
  std::optional<GenerateOptions> Generated;
  std::optional<RunOptions> Ran;
  std::optional<RenderOptions> Rendered;
  std::optional<EvaluateOptions> Evaluated;
  std::optional<OrbitOptions> Filmed;
  std::optional<ConvertOptions> Converted;
  std::optional<CheckOptions> Checked;
  std::optional<MaskOptions> Masked;
};

/** Runs a command line in this process, with commands that only note what they were given. */
Outcome Parse(std::vector<const char*> words, const std::function<void()>& inRun = {})
{
  Outcome outcome;
  std::vector<Command> commands = CommandTable();
  const auto replace = [&commands](const std::string& name, auto run)
  {
    std::find_if(commands.begin(), commands.end(),
      [&name](const Command& command) { return command.Name == name; })
      ->Run = [run](const std::filesystem::path& dataset, const ParsedArguments& given,
                CommandContext& context) {
      return run(dataset, given, [&context](const std::string& text) { context.Out.Warn(text); });
    };
  };
  const auto note = [&replace](const std::string& name, auto make, auto& noted)
  {
    replace(name,
      [make, &noted](const std::filesystem::path& dataset, const ParsedArguments& given,
        const OptionWarning& warn)
      {
        noted = make(dataset, given, warn);
        return ExitCode::Ok;
      });
  };
  note("generate", MakeGenerateOptions, outcome.Generated);
  note("render", MakeRenderOptions, outcome.Rendered);
  note("orbit", MakeOrbitOptions, outcome.Filmed);
  note("evaluate", MakeEvaluateOptions, outcome.Evaluated);
  note("convert", MakeConvertOptions, outcome.Converted);
  note("mask", MakeMaskOptions, outcome.Masked);
  replace("run",
    [&](
      const std::filesystem::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
    {
      outcome.Ran = MakeRunOptions(dataset, given, warn);
      LimitThreads(outcome.Ran->Threads);
      if (inRun)
      {
        inRun();
      }
      return ExitCode::Ok;
    });
  replace("check",
    [&](
      const std::filesystem::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
    {
      outcome.Checked = MakeCheckOptions(dataset, given, warn);
      // something that can be either
      return outcome.Checked->Input.Exclude.empty() ? ExitCode::Ok : ExitCode::Problems;
    });
  words.insert(words.begin(), "novelview");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  outcome.Code = RunCommandLine(static_cast<int>(words.size()), words.data(), commands);
  outcome.Out = testing::internal::GetCapturedStdout();
  outcome.Err = testing::internal::GetCapturedStderr();
  return outcome;
}

void ExpectUsageError(const std::vector<const char*>& words, const std::string& part)
{
  const Outcome outcome = Parse(words);
  EXPECT_EQ(outcome.Code, 2);
  EXPECT_THAT(outcome.Err, HasSubstr(part));
  EXPECT_EQ(std::count(outcome.Err.begin(), outcome.Err.end(), '\n'), 1) << outcome.Err;
  EXPECT_FALSE(outcome.Ran || outcome.Rendered || outcome.Evaluated || outcome.Generated);
}

/** Runs the program itself. */
Outcome Execute(const std::string& words)
{
  const TemporaryFolder folder;
  const std::string command = std::string("'" NOVELVIEW_PROGRAM "' ") + words + " >'" +
    (folder / "out").string() + "' 2>'" + (folder / "err").string() + "'";
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.Code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.Out = ReadText(folder / "out");
  outcome.Err = ReadText(folder / "err");
  return outcome;
}
}

TEST(CommandLine, RunIsGivenItsJob)
{
  const Outcome outcome = Parse({ "run", "bunny", "--view", "between:0,1,0.25", "--out", "o",
    "--hull-box", "-1,-2,-3,1,2,3", "--exclude", "a.png,b.png", "--no-iterations",
    "--hull-keep-all", "--silhouette-level=30", "--threads", "1" });
  EXPECT_EQ(outcome.Code, 0) << outcome.Err;
  ASSERT_TRUE(outcome.Ran);
  EXPECT_EQ(outcome.Ran->Input.Dataset, "bunny");
  EXPECT_EQ(outcome.Ran->View.Fraction, 0.25);
  EXPECT_EQ(outcome.Ran->Synthesis.Hull.Box, (std::array<double, 6>{ -1, -2, -3, 1, 2, 3 }));
  EXPECT_EQ(outcome.Ran->Input.Exclude, (std::vector<std::string>{ "a.png", "b.png" }));
  EXPECT_FALSE(outcome.Ran->WriteIterations);
  EXPECT_TRUE(outcome.Ran->Screenshots);
  EXPECT_TRUE(outcome.Ran->Synthesis.Hull.KeepAllComponents);
  EXPECT_EQ(outcome.Ran->Input.Silhouette.Level, 30);
  EXPECT_EQ(outcome.Ran->Threads, 1);
}

TEST(CommandLine, OptionsMayStandBeforeTheDataSet)
{
  const Outcome outcome =
    Parse({ "run", "--exclude", "a.png", "--out", "o", "--view", "like:a.png", "bunny" });
  ASSERT_TRUE(outcome.Ran) << outcome.Err;
  EXPECT_EQ(outcome.Ran->Input.Dataset, "bunny");
  EXPECT_EQ(outcome.Ran->View.Name, "a.png");
}

TEST(CommandLine, RenderIsGivenItsOptions)
{
  const Outcome outcome = Parse({ "render", "bunny", "--cameras", "test/test_par.txt", "--out", "o",
    "--stage", "hull", "--preset", "paper" });
  ASSERT_TRUE(outcome.Rendered) << outcome.Err;
  EXPECT_EQ(outcome.Rendered->Cameras, "test/test_par.txt");
  EXPECT_EQ(outcome.Rendered->UpTo, Stage::Hull);
  EXPECT_EQ(outcome.Rendered->Synthesis.Preset, "paper");
}

TEST(CommandLine, EvaluateIsGivenItsOptions)
{
  const Outcome outcome = Parse({ "evaluate", "bunny", "--hold-out", "a.png,b.png", "--out", "o",
    "--no-pictures", "--true-mesh", "t.ply", "--preset", "paper", "--depth-maps" });
  ASSERT_TRUE(outcome.Evaluated) << outcome.Err;
  EXPECT_EQ(outcome.Evaluated->Input.Dataset, "bunny");
  EXPECT_EQ(outcome.Evaluated->HoldOut, (std::vector<std::string>{ "a.png", "b.png" }));
  EXPECT_EQ(outcome.Evaluated->Every, 0);
  EXPECT_FALSE(outcome.Evaluated->LeaveOneOut);
  EXPECT_FALSE(outcome.Evaluated->Pictures);
  EXPECT_EQ(outcome.Evaluated->TrueMesh, "t.ply");
  EXPECT_EQ(
    outcome.Evaluated->Synthesis.Texture.References, PresetOptions("paper").Texture.References);
  EXPECT_TRUE(outcome.Evaluated->Synthesis.UseDepthMaps);
}

TEST(CommandLine, OrbitStartsFromAFilmsDefaults)
{
  const Outcome outcome = Parse({ "orbit", "bunny", "--out", "film.mp4", "--path", "keys.json",
    "--frames", "30", "--fps", "25", "--frames-dir", "pictures", "--preset", "paper" });
  ASSERT_TRUE(outcome.Filmed) << outcome.Err;
  EXPECT_EQ(outcome.Filmed->Out, "film.mp4");
  EXPECT_EQ(outcome.Filmed->Path, "keys.json");
  EXPECT_EQ(outcome.Filmed->Frames, 30);
  EXPECT_EQ(outcome.Filmed->Fps, 25);
  EXPECT_EQ(outcome.Filmed->FramesDir, "pictures");
  EXPECT_EQ(outcome.Filmed->Synthesis.Texture.Power, PresetOptions("paper").Texture.Power);
  EXPECT_TRUE(outcome.Filmed->Synthesis.Texture.SoftBoundary);
  EXPECT_EQ(outcome.Filmed->Synthesis.Texture.BoundarySamples, 5);
  const Outcome told =
    Parse({ "orbit", "bunny", "--out", "film", "--no-soft-boundary", "--boundary-samples", "1" });
  ASSERT_TRUE(told.Filmed) << told.Err;
  EXPECT_FALSE(told.Filmed->Synthesis.Texture.SoftBoundary);
  EXPECT_EQ(told.Filmed->Synthesis.Texture.BoundarySamples, 1);
  EXPECT_FALSE(
    PresetOptions("best").Texture.SoftBoundary); // a single view's picture stays as it is
}

TEST(CommandLine, FormerNamesOfOptionsWorkWithAWarningEach)
{
  const Outcome outcome =
    Parse({ "orbit", "bunny", "--out", "film", "--no-soft-rim", "--rim-samples", "7", "--quiet" });
  ASSERT_TRUE(outcome.Filmed) << outcome.Err;
  EXPECT_EQ(outcome.Code, 0);
  EXPECT_FALSE(outcome.Filmed->Synthesis.Texture.SoftBoundary);
  EXPECT_EQ(outcome.Filmed->Synthesis.Texture.BoundarySamples, 7);
  EXPECT_THAT(outcome.Err, HasSubstr("warning: --rim-samples is now --boundary-samples\n"));
  EXPECT_THAT(outcome.Err, HasSubstr("warning: --soft-rim is now --soft-boundary\n"));
  EXPECT_EQ(std::count(outcome.Err.begin(), outcome.Err.end(), '\n'), 2) << outcome.Err;
  EXPECT_THAT(Parse({ "orbit", "--help" }).Out,
    testing::Not(testing::AnyOf(HasSubstr("--rim-samples"), HasSubstr("--soft-rim"))));
  ExpectUsageError({ "orbit", "d", "--out", "o", "--rim-samples", "3", "--boundary-samples", "5" },
    "--rim-samples: is now --boundary-samples, which is given, too");
  const Outcome bad = Parse({ "orbit", "d", "--out", "o", "--rim-samples", "x" });
  EXPECT_EQ(bad.Code, 2);
  EXPECT_THAT(bad.Err, HasSubstr("error: --boundary-samples: is not a whole number (got 'x'"));
  EXPECT_EQ(std::count(bad.Err.begin(), bad.Err.end(), '\n'), 2) << "a warning before the error";
  ExpectUsageError({ "orbit", "d", "--out", "o", "--rim-sample", "3" }, "unknown option");
}

TEST(CommandLine, FormerKeysInAJobFileWorkWithAWarning)
{
  const TemporaryFolder folder;
  const std::string job = (folder / "job.json").string();
  WriteText(job, R"({"dataset": "d", "view": "like:a", "out": "o", "rimSamples": 7})");
  const Outcome outcome = Parse({ "run", job.c_str() });
  ASSERT_TRUE(outcome.Ran) << outcome.Err;
  EXPECT_EQ(outcome.Ran->Synthesis.Texture.BoundarySamples, 7);
  EXPECT_THAT(outcome.Err, HasSubstr("job.json, key \"rimSamples\" is now \"boundarySamples\"\n"));
  EXPECT_EQ(std::count(outcome.Err.begin(), outcome.Err.end(), '\n'), 1) << outcome.Err;
  WriteText(job,
    R"({"dataset": "d", "view": "like:a", "out": "o", "rimSamples": 7, "boundarySamples": 3})");
  ExpectUsageError({ "run", job.c_str() }, "is now \"boundarySamples\", which is there, too");
}

TEST(CommandLine, ConvertIsGivenItsOptions)
{
  const Outcome outcome = Parse({ "convert", "in", "out", "--format", "nerf", "--from", "colmap",
    "--calibration", "in/sparse/1", "--axes", "opengl", "--poses", "camera-to-world",
    "--rotation-order", "column", "--pixel-centre", "0.5", "--flip-y", "--invert-masks",
    "--exclude", "a.png", "--undistort", "--threads", "2" });
  ASSERT_TRUE(outcome.Converted) << outcome.Err;
  const ConvertOptions& options = *outcome.Converted;
  EXPECT_EQ(options.Dataset, "in");
  EXPECT_EQ(options.Out, "out");
  EXPECT_EQ(options.Format, "nerf");
  EXPECT_EQ(options.Source.Format, "colmap");
  EXPECT_EQ(options.Source.Calibration, "in/sparse/1");
  EXPECT_EQ(options.Source.Convention.Axes, "opengl");
  EXPECT_EQ(options.Source.Convention.Poses, "camera-to-world");
  EXPECT_EQ(options.Source.Convention.RotationOrder, "column");
  EXPECT_EQ(options.Source.Convention.PixelCentre, 0.5);
  EXPECT_TRUE(options.Source.Convention.FlipY);
  EXPECT_TRUE(options.Source.Convention.InvertMasks);
  EXPECT_EQ(options.Exclude, std::vector<std::string>{ "a.png" });
  EXPECT_TRUE(options.Undistort);
  EXPECT_EQ(options.Threads, 2);
}

TEST(CommandLine, GenerateIsGivenItsOptions)
{
  const Outcome outcome =
    Parse({ "generate", "--out", "o", "--views", "8", "--step", "45", "--size", "320x200",
      "--test-angles", "15,22.5", "--no-lit", "--texture", "marble", "--seed", "-3" });
  ASSERT_TRUE(outcome.Generated) << outcome.Err;
  EXPECT_EQ(outcome.Generated->Out, "o");
  EXPECT_EQ(outcome.Generated->Views, 8);
  EXPECT_EQ(outcome.Generated->StepDeg, 45);
  EXPECT_EQ(outcome.Generated->Width, 320);
  EXPECT_EQ(outcome.Generated->Height, 200);
  EXPECT_EQ(outcome.Generated->TestAnglesDeg, (std::vector<double>{ 15, 22.5 }));
  EXPECT_FALSE(outcome.Generated->Lit);
  EXPECT_EQ(outcome.Generated->Texture, "marble");
  EXPECT_EQ(outcome.Generated->Seed, -3);
}

TEST(CommandLine, BadUsageIsOneLineAndExitCodeTwo)
{
  ExpectUsageError({}, "subcommand is required");
  ExpectUsageError({ "rum", "bunny" }, "unknown command rum, did you mean run?");
  ExpectUsageError({ "run", "bunny", "--out", "o" }, "--view: no novel view");
  ExpectUsageError({ "run", "bunny", "--view", "like:a" }, "--out: no place for the results");
  ExpectUsageError({ "run", "bunny", "--view", "like:a", "--out", "o", "--hull-spaccing", "2" },
    "unknown option --hull-spaccing, did you mean --hull-spacing?");
  ExpectUsageError({ "run", "bunny", "--view", "like:a", "--out", "o", "--hull-spacing", "x" },
    "--hull-spacing: is not a number (got 'x'");
  ExpectUsageError({ "run", "bunny", "--view", "beside:a", "--out", "o" }, "view: is not a view");
  ExpectUsageError({ "run", "bunny", "--quiet", "--verbose" }, "excludes");
  ExpectUsageError({ "evaluate", "bunny" }, "--out: no place for the results");
  ExpectUsageError({ "evaluate", "bunny", "--out", "o", "--every", "2", "--hold-out", "a.png" },
    "--every: cannot be given with --hold-out");
  ExpectUsageError(
    { "generate", "--out", "o", "--size", "640" }, "--size: is not a size (got '640'");
  ExpectUsageError({ "generate", "--out", "o", "--texture", "wod" }, "wood, marble");
  ExpectUsageError({ "generate", "--views", "3" }, "--out");
}

TEST(CommandLine, FailuresHaveTheirExitCodes)
{
  const std::vector<const char*> words{ "run", "bunny", "--view", "like:a", "--out", "o" };
  const Outcome failed = Parse(words, [] { throw Error("hull", "is empty"); });
  EXPECT_EQ(failed.Code, 1);
  EXPECT_EQ(failed.Err, "novelview: error: hull: is empty\n");
  const Outcome interrupted = Parse(words, [] { throw Interrupted(); });
  EXPECT_EQ(interrupted.Code, 130);
  EXPECT_EQ(interrupted.Err, "novelview: error: interrupted\n");
  const Outcome misused = Parse(words, [] { throw UsageError("view", "unknown"); });
  EXPECT_EQ(misused.Code, 2);
}

TEST(CommandLine, TimingsAreWrittenWhenTheCommandHasSucceeded)
{
  const TemporaryFolder folder;
  const std::string file = (folder / "timings.json").string();
  const std::vector<const char*> words{ "run", "bunny", "--view", "like:a", "--out", "o",
    "--threads", "1", "--timings", file.c_str() };
  EXPECT_EQ(Parse(words, [] { throw Error("hull", "is empty"); }).Code, 1);
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_EQ(Parse(words).Code, 0);
  EXPECT_THAT(ReadText(file), HasSubstr("\"threads\": 1"));
  EXPECT_THAT(ReadText(file), HasSubstr("\"stages\""));
}

namespace
{
/** The part of a help that is about an option: from its flag to the next one. */
std::string HelpOf(const std::string& help, const std::string& flag)
{
  for (const char* const after : { " ", "," })
  {
    const std::size_t begin = help.find("\n  " + flag + after);
    if (begin != std::string::npos)
    {
      return help.substr(
        begin, std::min(help.find("\n  -", begin + 1), help.find("\n\n", begin)) - begin);
    }
  }
  return "";
}

/** "unit; range; default: value" as far as there is one. */
std::string FactsOf(const Option& option)
{
  std::string facts = option.Unit;
  for (const std::string& fact : { RangeText(option),
         "default: " + (ValueText(option).empty() ? std::string("none") : ValueText(option)) })
  {
    facts += (facts.empty() || fact.empty() ? "" : "; ") + fact;
  }
  return facts;
}
}

TEST(CommandLine, ThreadsOfEveryCommandLimitTheThreadsOfTheProcess)
{
  // The commands of the program itself, which fail once they work: the data set does not exist.
  const TemporaryFolder folder;
  const std::string missing = (folder / "missing").string();
  const std::string out = (folder / "out").string();
  const std::string cameras = (folder / "cameras_par.txt").string();
  ProcessGroup alone;
  ProcessContext processes;
  processes.Start = [&alone](int) -> ProcessGroup& { return alone; };
  const std::map<std::string, std::vector<std::string>> required{
    { "run", { "--view", "between:0,1", "--out", out } },
    { "render", { "--cameras", cameras, "--out", out } },
    { "orbit", { "--out", out } },
    { "mesh", { "--out", out + ".ply" } },
    { "evaluate", { "--leave-one-out", "--out", out } },
    { "convert", { out, "--format", "nerf" } },
    { "mask", { "--out", out } },
  };
  for (const Command& command : CommandTable())
  {
    if (command.DatasetHelp.empty())
    {
      continue; // generate would not fail
    }
    SCOPED_TRACE(command.Name);
    std::vector<std::string> words{ "novelview", command.Name, missing };
    if (const auto found = required.find(command.Name); found != required.end())
    {
      words.insert(words.end(), found->second.begin(), found->second.end());
    }
    words.insert(words.end(), { "--threads", "1" });
    std::vector<const char*> argv;
    for (const std::string& word : words)
    {
      argv.push_back(word.c_str());
    }
    LimitThreads(2);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    EXPECT_NE(RunCommandLine(static_cast<int>(argv.size()), argv.data(), CommandTable(), processes),
      ExitCode::Usage);
    testing::internal::GetCapturedStdout();
    const std::string error = testing::internal::GetCapturedStderr();
    EXPECT_THAT(error, HasSubstr("missing"));
    EXPECT_EQ(NumberOfThreads(), 1) << error;
  }
  LimitThreads(0);
}

TEST(CommandLine, HelpOfEveryCommandTellsEveryOptionWithUnitRangeAndDefault)
{
  const std::string all = Parse({ "--help" }).Out;
  for (const Command& command : CommandTable())
  {
    EXPECT_THAT(all, HasSubstr("\n  " + command.Name + " "));
    const Outcome help = Parse({ command.Name.c_str(), "--help" });
    EXPECT_EQ(help.Code, 0);
    command.ShowOptions(
      [&](const OptionTable& table)
      {
        for (const Option& option : table)
        {
          SCOPED_TRACE(command.Name + " " + option.Key);
          if (option.Key == "dataset")
          {
            EXPECT_THAT(HelpOf(help.Out, "dataset"), HasSubstr(command.DatasetHelp));
            continue;
          }
          const std::string flag = option.Positional ? option.Key : FlagOf(option.Key);
          EXPECT_THAT(
            HelpOf(help.Out, flag), HasSubstr(option.Help + " (" + FactsOf(option) + ")"));
        }
      });
  }
}

TEST(CommandLine, HelpSaysWhatItSaid)
{
  const Outcome help = Parse({ "run", "--help" });
  EXPECT_THAT(help.Out, HasSubstr("(px; 0.25 to 64; default: "));
  EXPECT_THAT(
    Parse({ "generate", "--help" }).Out, HasSubstr("(px; 16 to 16384; default: 640x480)"));
  EXPECT_THAT(Parse({ "--help" }).Out, HasSubstr("render"));
  EXPECT_THAT(Parse({ "--version" }).Out, testing::StartsWith("novelview 0."));
}

TEST(Program, BadUsageAndFailuresReachTheShell)
{
  EXPECT_EQ(Execute("--version").Code, 0);
  EXPECT_EQ(Execute("generate --views 0 --out x").Code, 2);
  const TemporaryFolder folder;
  const Outcome failed =
    Execute("generate --quiet --mesh nowhere.ply --out '" + (folder / "data").string() + "'");
  EXPECT_EQ(failed.Code, 1);
  EXPECT_THAT(failed.Err, HasSubstr("nowhere.ply"));
  EXPECT_EQ(std::count(failed.Err.begin(), failed.Err.end(), '\n'), 1) << failed.Err;
  EXPECT_FALSE(std::filesystem::exists(folder / "data")) << "a failed run leaves nothing";
}

TEST(Program, InterruptStopsItOrderly)
{
  const TemporaryFolder folder;
  const std::string err = (folder / "err").string();
  const std::string data = "'" + (folder / "data").string() + "'";
  // Enough views that it is still at work when the signal comes; and an end, should it not come.
  // In the foreground timeout passes the signal on once; otherwise twice, which ends it at once.
  const std::string command = "timeout --foreground 100 '" NOVELVIEW_PROGRAM
                              "' generate --quiet --views 2000 --out " +
    data + " 2>'" + err + "' & program=$!; for i in $(seq 600); do [ -e " + data +
    " ] && break; sleep 0.1; done; kill -INT $program; wait $program";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(ReadText(err), "novelview: error: interrupted\n");
}

TEST(CommandLine, CheckSaysProblemsByItsExitCode)
{
  Outcome outcome = Parse({ "check", "d", "--out", "o", "--axes", "opengl" });
  EXPECT_EQ(outcome.Code, 0) << outcome.Err;
  ASSERT_TRUE(outcome.Checked);
  EXPECT_EQ(outcome.Checked->Input.Dataset, "d");
  EXPECT_EQ(outcome.Checked->Out, "o");
  EXPECT_EQ(outcome.Checked->Input.Source.Convention.Axes, "opengl");
  outcome = Parse({ "check", "d", "--exclude", "a.png,b.png" });
  EXPECT_EQ(outcome.Code, 3);
  EXPECT_EQ(outcome.Checked->Input.Exclude, (std::vector<std::string>{ "a.png", "b.png" }));
}

TEST(CommandLine, MaskIsGivenItsOptions)
{
  const Outcome outcome = Parse({ "mask", "d", "--out", "o", "--method", "chroma", "--key",
    "0,200,40", "--silhouette-closing", "3" });
  EXPECT_EQ(outcome.Code, 0) << outcome.Err;
  ASSERT_TRUE(outcome.Masked);
  EXPECT_EQ(outcome.Masked->Method, "chroma");
  EXPECT_EQ(outcome.Masked->Key, (std::vector<double>{ 0, 200, 40 }));
  EXPECT_EQ(outcome.Masked->Silhouette.ClosingPx, 3);
  EXPECT_FALSE(outcome.Masked->InPlace);
}
