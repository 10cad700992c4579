// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/DatasetCheck.h"

#include "base/NumberText.h"
#include "base/Parallel.h"
#include "cameras/PhotographFiles.h"
#include "check/CheckCameras.h"
#include "check/CheckViews.h"
#include "core/Quantile.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/** A word of a shell's command line. */
std::string ShellWord(const std::string& word)
{
  const bool plain = !word.empty() &&
    word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                           "_-+=./,:@%") == std::string::npos;
  if (plain)
  {
    return word;
  }
  std::string quoted = "'";
  for (const char c : word)
  {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quoted + "'";
}

/** Examines one data set, step by step; each step adds to the report. */
class DatasetChecker
{
public:
  DatasetChecker(const DatasetInput& input, const Execution& execution)
    : Input(input)
    , Quiet(execution)
    , Progress(execution)
  {
    this->Quiet.Progress = [](double) { return true; };
  }

  CheckReport Examine()
  {
    this->ReadPhotographs();
    this->FindConvention();
    this->Progress.Report(0.6);
    this->ReportPhotographs();
    this->ReportMasks();
    this->ReportOutliers();
    this->ReportCameras();
    this->CompareSilhouettes();
    this->Progress.Report(0.9);
    this->ComparePixelCentre();
    std::stable_sort(this->Report.Findings.begin(), this->Report.Findings.end(),
      [](const CheckFinding& a, const CheckFinding& b) { return a.Severity > b.Severity; });
    this->Progress.Report(1);
    return std::move(this->Report);
  }

private:
  void Add(CheckSeverity severity, const std::string& kind, const std::string& view,
    const std::string& text)
  {
    this->Report.Findings.push_back({ severity, kind, view, text, {}, {} });
  }

  /** The photographs as they are with the masks' polarity as `source` says. */
  void Inspect(const std::vector<Photograph>& cameras)
  {
    this->Report.Photographs.assign(cameras.size(), {});
    ParallelForEach(cameras.size(),
      [&](std::size_t i)
      {
        this->Report.Photographs[i] =
          InspectPhotograph(cameras[i], this->Input.ForceSilhouettes, this->Input.Silhouette);
      });
  }

  /** Files without a size in the calibration have that of the photograph. */
  void TakeCameras(const DatasetIndex& index)
  {
    this->Report.Cameras = WithoutExcluded(index, this->Input.Exclude);
    for (std::size_t i = 0; i < this->Report.Cameras.size(); ++i)
    {
      Camera& camera = this->Report.Cameras[i].Cam;
      const CheckedPhotograph& photograph = this->Report.Photographs[i];
      camera.Width = photograph.Width > 0 ? photograph.Width : std::max(camera.Width, 1);
      camera.Height = photograph.Height > 0 ? photograph.Height : std::max(camera.Height, 1);
      if (photograph.Width > 0)
      {
        ValidateCamera(camera, this->Report.Cameras[i].Where);
      }
    }
  }

  void ReadPhotographs()
  {
    this->Index = ReadDatasetIndex(this->Input.Dataset, this->Input.Source);
    this->Report.Folder = this->Index.Folder;
    this->Report.Calibration = this->Index.Calibration;
    this->Report.Format = this->Index.Format;
    this->Progress.Report(0);
    this->Inspect(WithoutExcluded(this->Index, this->Input.Exclude));
    this->TakeCameras(this->Index);
    for (const CheckedPhotograph& photograph : this->Report.Photographs)
    {
      this->Masks.push_back(photograph.Mask);
    }
    this->Progress.Report(0.2);
  }

  //----------------------------------------------------------------------------
  /** Whether most silhouettes are what surrounds an object. */
  bool LooksInverted(bool invert) const
  {
    const CheckedSilhouettes silhouettes(this->Report.Cameras, this->Masks, invert, 160);
    std::vector<double> shares;
    for (const int id : silhouettes.Ids())
    {
      shares.push_back(silhouettes.BorderShareOf(id));
    }
    return Quantile(shares, 0.5) > 0.5;
  }

  void FindConvention()
  {
    const CameraConvention own = OwnConvention(this->Input.Dataset, this->Input.Source);
    const CameraConvention now = Override(own, this->Input.Source.Convention);
    this->Invert = now.InvertMasks;
    const auto tried = [&](bool invert)
    {
      return TryConventions(this->Input.Dataset, this->Input.Source, this->Input.Exclude,
        this->Masks, invert, this->Quiet);
    };
    const bool given = std::any_of(this->Masks.begin(), this->Masks.end(),
      [](const FoundMask& mask) { return mask.Source != MaskSource::Extracted; });
    if (given && this->LooksInverted(this->Invert))
    {
      auto trials = tried(!this->Invert);
      const std::size_t best = ChooseTrial(trials);
      if (trials[best].Iou >= Convincing)
      {
        this->Report.MasksInverted = true;
        this->Invert = !this->Invert;
        this->Report.Trials = std::move(trials);
        this->Report.ChosenTrial = static_cast<int>(best);
      }
    }
    if (!this->Report.MasksInverted)
    {
      this->Report.Trials = tried(this->Invert);
      const std::size_t best = ChooseTrial(this->Report.Trials);
      const bool convincing =
        ClearlyBetter(this->Report.Trials[best].Iou, this->Report.Trials[0].Iou);
      this->Report.ChosenTrial = convincing ? static_cast<int>(best) : 0;
    }
    this->ApplyConvention(own);
  }

  /** Reads the data set in the convention that was found, and says so when it is another one. */
  void ApplyConvention(const CameraConvention& own)
  {
    const ConventionTrial& chosen = this->Report.Trials[this->Report.ChosenTrial];
    this->Convention = chosen.Convention;
    this->Convention.InvertMasks = this->Invert;
    if (this->Report.ChosenTrial == 0 && !this->Report.MasksInverted)
    {
      return;
    }
    const DatasetSource source = SourceReadAs(this->Input.Source, own, this->Convention);
    this->Index = ReadDatasetIndex(this->Input.Dataset, source);
    if (this->Report.MasksInverted)
    {
      this->Inspect(WithoutExcluded(this->Index, this->Input.Exclude));
    }
    this->TakeCameras(this->Index);
    this->ReportConvention(own, chosen);
  }

  void ReportConvention(const CameraConvention& own, const ConventionTrial& chosen)
  {
    CheckFinding finding;
    finding.Severity = CheckSeverity::Error;
    finding.Kind = this->Report.ChosenTrial == 0 ? "mask-polarity" : "convention";
    finding.Options = ConventionOptions(own, this->Convention);
    std::vector<std::string> changes = chosen.Changes;
    if (this->Report.MasksInverted)
    {
      changes.push_back("mask polarity");
    }
    const std::string way = finding.Options.empty() ? "without the options that say how it is read"
                                                    : "with " + Joined(finding.Options, " ");
    finding.Text = "the silhouettes agree only when read " + way + " (" + Joined(changes, " and ") +
      "): hull IoU " +
      (this->Report.MasksInverted && this->Report.ChosenTrial == 0
          ? std::string("")
          : Formatted("%.2f instead of ", chosen.Iou) +
            Formatted("%.2f", this->Report.Trials.front().Iou));
    if (this->Report.MasksInverted && this->Report.ChosenTrial == 0)
    {
      finding.Text += Formatted("%.2f; as read, the object is what surrounds it", chosen.Iou);
    }
    finding.Command = this->ConvertCommand(finding.Options);
    this->Report.Findings.push_back(finding);
  }

  /** A command with the options that find the calibration. */
  std::string Command(const std::string& name, const std::vector<std::string>& words,
    const std::string& formatFlag) const
  {
    std::string command = "novelview " + name + " " + ShellWord(this->Input.Dataset.string());
    for (const std::string& word : words)
    {
      command += " " + ShellWord(word);
    }
    if (!this->Input.Source.Calibration.empty())
    {
      command += " --calibration " + ShellWord(this->Input.Source.Calibration.string());
    }
    if (this->Input.Source.Format != "auto")
    {
      command += " " + formatFlag + " " + this->Input.Source.Format;
    }
    return command;
  }

  std::string ConvertCommand(const std::vector<std::string>& options) const
  {
    fs::path folder = this->Input.Dataset.lexically_normal();
    folder = folder.has_filename() ? folder : folder.parent_path();
    std::vector<std::string> words = { folder.string() + "-mended", "--format",
      this->Report.Format };
    words.insert(words.end(), options.begin(), options.end());
    return this->Command("convert", words, "--from");
  }

  //----------------------------------------------------------------------------
  void ReportPhotographs()
  {
    for (const CheckedPhotograph& photograph : this->Report.Photographs)
    {
      for (const std::string& problem : photograph.Problems)
      {
        this->Add(CheckSeverity::Error, "file", photograph.Name, problem);
      }
      const Coverage& covered = photograph.Covered;
      if (photograph.Mask.Pixels.Values.empty() || !photograph.Problems.empty())
      {
        continue;
      }
      if (covered.Fraction == 0 || covered.Fraction == 1)
      {
        this->Add(CheckSeverity::Error, "empty-mask", photograph.Name,
          covered.Fraction == 0 ? "silhouette is empty" : "silhouette fills the whole frame");
        continue;
      }
      for (const std::string& warning : CheckCoverage(covered, "view"))
      {
        const bool border = warning.find("leaves the frame") != std::string::npos;
        this->Add(CheckSeverity::Warning, border ? "border" : "coverage", photograph.Name,
          warning.substr(std::string("view: ").size()));
      }
    }
    if (this->Report.Photographs.size() < 3)
    {
      this->Add(CheckSeverity::Warning, "views", "",
        std::to_string(this->Report.Photographs.size()) +
          " photographs; a hull needs three at the very least, better twelve");
    }
  }

  /** Pictures in the folders of masks that belong to no photograph. */
  std::vector<std::string> StrayMasks() const
  {
    std::vector<std::string> stray;
    for (const char* folder : { "mask", "masks", "silhouettes" })
    {
      for (const std::string& name : PhotographsIn(this->Index.Folder / folder))
      {
        const fs::path file = this->Index.Folder / folder / name;
        const bool used = std::any_of(this->Index.Cameras.begin(), this->Index.Cameras.end(),
          [&](const Photograph& each) { return each.Mask == file; });
        if (!used)
        {
          stray.push_back((fs::path(folder) / name).string());
        }
      }
    }
    return stray;
  }

  void ReportMasks()
  {
    std::vector<std::string> without;
    std::size_t given = 0;
    for (const CheckedPhotograph& photograph : this->Report.Photographs)
    {
      const bool extracted = photograph.Mask.Source == MaskSource::Extracted;
      given += !extracted;
      if (extracted && photograph.Problems.empty())
      {
        without.push_back(photograph.Name);
      }
    }
    if (without.empty() || this->Input.ForceSilhouettes)
    {
      return;
    }
    std::vector<std::string> stray = this->StrayMasks();
    const bool more = stray.size() > 3;
    stray.resize(std::min<std::size_t>(stray.size(), 3));
    const std::string unmatched = stray.empty()
      ? ""
      : "; masks that belong to no photograph: " + Joined(stray) + (more ? " .." : "");
    if (given == 0)
    {
      this->Add(stray.empty() ? CheckSeverity::Note : CheckSeverity::Warning, "mask-missing", "",
        "no masks: silhouettes are taken from the photographs" + unmatched);
      return;
    }
    for (const std::string& name : without)
    {
      this->Add(CheckSeverity::Warning, "mask-missing", name,
        "has no mask, others have; its silhouette is taken from the photograph" + unmatched);
    }
  }

  std::vector<double> Values(double CheckedPhotograph::*member) const
  {
    std::vector<double> values;
    for (const CheckedPhotograph& photograph : this->Report.Photographs)
    {
      values.push_back(photograph.*member);
    }
    return values;
  }

  void ReportOutliers()
  {
    const std::vector<double> sharpness = this->Values(&CheckedPhotograph::Sharpness);
    for (const std::size_t i : FindOutliers(sharpness, 1.4, { true, false }))
    {
      this->Add(CheckSeverity::Warning, "blurred", this->Report.Photographs[i].Name,
        Formatted("sharpness %.2f", sharpness[i]) +
          Formatted(
            ", the others' median is %.2f: out of focus or moved", Quantile(sharpness, 0.5)));
    }
    const std::vector<double> brightness = this->Values(&CheckedPhotograph::Brightness);
    const double clipped = Quantile(this->Values(&CheckedPhotograph::Clipped), 0.5);
    for (const std::size_t i : FindOutliers(brightness, 1.6, {}))
    {
      const CheckedPhotograph& photograph = this->Report.Photographs[i];
      const bool over = brightness[i] > Quantile(brightness, 0.5);
      this->Add(CheckSeverity::Warning, over ? "overexposed" : "underexposed", photograph.Name,
        Formatted("the object's median is %.0f", brightness[i]) +
          Formatted(" levels, in the others %.0f", Quantile(brightness, 0.5)) +
          Formatted("; %.0f %% of it are clipped", 100 * photograph.Clipped));
    }
    for (const CheckedPhotograph& photograph : this->Report.Photographs)
    {
      if (photograph.Clipped > clipped + 0.1)
      {
        this->Add(CheckSeverity::Warning, "clipped", photograph.Name,
          Formatted("%.0f %% of the object are clipped in some channel", 100 * photograph.Clipped) +
            Formatted(", in the others %.0f %%", 100 * clipped));
      }
    }
  }

  void ReportCameras()
  {
    // Of a photograph that cannot be read the size is not known.
    std::vector<Photograph> sized;
    std::vector<int> ids;
    for (std::size_t i = 0; i < this->Report.Cameras.size(); ++i)
    {
      if (this->Report.Photographs[i].Width > 0)
      {
        sized.push_back(this->Report.Cameras[i]);
        ids.push_back(static_cast<int>(i));
      }
    }
    for (const CameraAnomaly& anomaly : FindCameraAnomalies(sized))
    {
      const int id = ids[anomaly.CameraId];
      const bool harmless = anomaly.Kind == "rotation" ||
        (anomaly.Kind == "same-camera" && this->ShowTheSame(id, ids[anomaly.OtherId]));
      this->Add(harmless ? CheckSeverity::Note : CheckSeverity::Warning, anomaly.Kind,
        sized[anomaly.CameraId].Name, anomaly.Text);
    }
  }

  /** Whether two photographs have the same silhouette, so that one camera for both may be right. */
  bool ShowTheSame(int a, int b) const
  {
    return MaskIou(this->Masks[a].Pixels, this->Masks[b].Pixels) > 0.95;
  }

  //----------------------------------------------------------------------------
  void CompareSilhouettes()
  {
    CheckedSilhouettes silhouettes(this->Report.Cameras, this->Masks, this->Invert);
    OutlierSearch views(
      this->Report.Cameras, silhouettes, this->Masks, this->Input.Silhouette, this->Quiet);
    views.Examine(this->Report.Agreement);
    this->Report.MeanIou = views.MeanIou();
    this->Report.HullPoints = views.HullPoints();
    if (!views.Outliers().empty())
    {
      this->Report.MeanIouAfter = views.MeanIouAfter();
    }
    for (const OutlierView& outlier : views.Outliers())
    {
      // What takes little from the hull can be lived with.
      const bool grave = views.MeanIou() < Agreeing;
      CheckFinding finding{ grave ? CheckSeverity::Error : CheckSeverity::Warning, outlier.Kind,
        this->Report.Cameras[outlier.CameraId].Name, outlier.Text, {}, {} };
      finding.Options = { "--exclude", finding.View };
      finding.Command = this->Command("check", { "--exclude", views.OutlierNames() }, "--format");
      this->Report.Findings.push_back(finding);
    }
    const double mean = views.Outliers().empty() ? views.MeanIou() : views.MeanIouAfter();
    if (silhouettes.Ids().size() >= 2 && mean < Agreeing)
    {
      this->Add(mean < Convincing ? CheckSeverity::Error : CheckSeverity::Warning, "inconsistent",
        "",
        "the silhouettes do not agree (hull IoU " + Formatted("%.2f", mean) +
          "), and neither another convention nor a few single views explain it: cameras or masks "
          "are wrong throughout");
    }
  }

  /** Claimed only when there can be no doubt; see README. */
  void ComparePixelCentre()
  {
    const CheckedSilhouettes silhouettes(this->Report.Cameras, this->Masks, this->Invert);
    if (this->Report.MeanIouAfter || this->Report.MeanIou < Agreeing ||
      silhouettes.Ids().size() < 4)
    {
      return;
    }
    const double now = *this->Convention.PixelCentre;
    const double other = 0.5 - now;
    const double reduction = silhouettes.ReductionOf(silhouettes.Ids().front());
    const double shift = (now - other) / reduction;
    const PixelCentreVerdict verdict =
      ComparePixelCentres(silhouettes.ViewsOf(this->Report.Cameras, silhouettes.Ids()),
        { 0, shift, 2 * shift, -shift }, this->Quiet);
    this->Report.PixelCentre = verdict;
    const std::vector<double>& loss = verdict.LossPx;
    if (loss[1] < 0.5 * loss[0] && loss[1] < 0.5 * loss[2] && loss[0] < loss[3] &&
      verdict.Sigmas > 5)
    {
      const CameraConvention own = OwnConvention(this->Input.Dataset, this->Input.Source);
      CameraConvention wanted = this->Convention;
      wanted.PixelCentre = other;
      CheckFinding finding{ CheckSeverity::Warning, "pixel-centre", "", "", {}, {} };
      finding.Options = ConventionOptions(own, wanted);
      finding.Text = "the contours agree clearly better with the top-left pixel's centre at " +
        NumberText(other) + ": they miss each other by " +
        Formatted("%.3f px instead of ", loss[1] * reduction) +
        Formatted("%.3f px", loss[0] * reduction);
      finding.Command = this->ConvertCommand(finding.Options);
      this->Report.Findings.push_back(finding);
    }
  }

  /** Whether silhouettes that agree so well show that others, which agree as now, are read wrong. */
  static bool ClearlyBetter(double best, double now)
  {
    // Either much is gained, or most of what is missing.
    return best >= Convincing &&
      (best - now >= ClearGain || (best - now >= ClearGain / 3 && 1 - best <= (1 - now) / 4));
  }

  static constexpr double Convincing =
    0.75; ///< hull IoU of silhouettes that surely belong together
  static constexpr double ClearGain = 0.15;
  static constexpr double Agreeing = 0.9;

  const DatasetInput& Input;
  Execution Quiet;
  const Execution& Progress;
  DatasetIndex Index;
  std::vector<FoundMask> Masks;
  CameraConvention Convention; ///< found right, complete
  bool Invert = false;
  CheckReport Report;
};
}

bool CheckReport::HasProblems() const
{
  return std::any_of(this->Findings.begin(), this->Findings.end(),
    [](const CheckFinding& finding) { return finding.Severity != CheckSeverity::Note; });
}

const char* SeverityName(CheckSeverity severity)
{
  return severity == CheckSeverity::Error
    ? "error"
    : (severity == CheckSeverity::Warning ? "warning" : "note");
}

CheckReport CheckDataset(const DatasetInput& input, const Execution& execution)
{
  return DatasetChecker(input, execution).Examine();
}
}
