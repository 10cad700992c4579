// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/EvaluateCommand.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/JsonFile.h"
#include "cameras/PhotographFiles.h"
#include "commands/CommandSupport.h"
#include "core/Error.h"
#include "evaluate/EvaluationPage.h"
#include "evaluate/EvaluationPictures.h"
#include "evaluate/EvaluationPlan.h"
#include "evaluate/EvaluationScores.h"
#include "images/ImageFile.h"
#include "mesh/ObjectMesh.h"
#include "processes/WorkDistributor.h"
#include "report/RunReport.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
const char* const Protocol =
  "Every view is predicted from the references alone, which do not include its photograph, and "
  "compared with that photograph. Foreground = union of the two masks (above 127); both pictures "
  "are "
  "black outside their own mask. RMS over the foreground and the three channels, grey levels 0 to "
  "255; PSNR from it, dB; SSIM of the luma, Gaussian window of 11 pixels with sigma 1.5, mean over "
  "the foreground; IoU of the masks; missing and excess pixels as parts of the true mask. Means "
  "are "
  "arithmetic, over the views. Oracle = the same texture mapping on the true mesh; gap closure = "
  "(hull - full) / (hull - oracle) of the means.";

/** Every number of Scores, so that they can be sent. */
constexpr std::array ScoreNumbers = { &Scores::Rms, &Scores::Psnr, &Scores::Ssim, &Scores::Iou,
  &Scores::Missing, &Scores::Excess };

/** The views without those of these names; blocks are shared. */
vtkSmartPointer<vtkMultiBlockDataSet> Without(
  vtkMultiBlockDataSet* views, const std::vector<std::string>& names)
{
  auto kept = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    const std::string name = ViewName(views, viewId);
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
      vtkImageData* image = ViewImage(views, viewId);
      AppendView(kept, name, image, AttachedCamera(image, name));
    }
  }
  return kept;
}

/** The image as it is compared: black outside its mask. */
vtkSmartPointer<vtkImageData> Blackened(vtkImageData* picture)
{
  const auto color = TopDownArray<const std::uint8_t>(picture, arrays::Color, 3, "truth", true);
  const auto mask = TopDownArray<const std::uint8_t>(picture, arrays::Mask, 1, "truth", true);
  Image<std::uint8_t> black(color.Width, color.Height, 3);
  for (int y = 0; y < color.Height; ++y)
  {
    for (int x = 0; x < color.Width; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        black(x, y, c) = mask(x, y) > 127 ? color(x, y, c) : 0;
      }
    }
  }
  auto result = NewImage(color.Width, color.Height);
  SetPixels(result, arrays::Color, black.Ref());
  SetPixels(result, arrays::Mask, mask);
  return result;
}

/** The image of a view after a stage, in the out folder. */
fs::path PictureOf(const std::string& view, const std::string& stage)
{
  return fs::path(PictureNameOf(view)).replace_extension("." + stage + ".png");
}

/** With images of more views a page would be larger than browsers like. */
constexpr std::size_t MaxShots = 24;

/** One evaluation: what is made of the plan, and what is left in the folder. */
class Evaluation
{
public:
  Evaluation(const EvaluateOptions& options, const DatasetIndex& index, Console& console,
    ProcessGroup& processes)
    : Options(options)
    , Index(index)
    , Con(console)
    , Work(console, processes, options.Threads)
    , Plan(MakeEvaluationPlan(options, index, options.Input.Exclude))
    , Title(fs::absolute(index.Folder).lexically_normal().filename().string() + ", " +
        this->Plan.Mode + ", preset " + options.Synthesis.Preset)
  {
    for (const std::string& warning : this->Plan.Warnings)
    {
      console.Warn(warning);
    }
  }

  /** Whether this process writes the files. */
  bool Writes() const { return this->Work.Writes(); }

  /** Every file that may be written, in the out folder. */
  std::vector<fs::path> Files() const
  {
    std::vector<fs::path> files{ "scores.csv", "scores.json", "chart.png" };
    if (this->Options.Page)
    {
      files.emplace_back("report.html");
    }
    if (!this->Options.Pictures)
    {
      return files;
    }
    files.emplace_back("overview.png");
    for (const PlannedSet& set : this->Plan.Sets)
    {
      for (const PlannedView& view : set.Views)
      {
        for (const std::string& stage : PictureStages(this->Options.UpTo))
        {
          files.push_back(PictureOf(view.Name, stage));
        }
      }
    }
    return files;
  }

  void Run()
  {
    if (!this->Plan.TrueMesh.empty())
    {
      this->TrueMesh = LoadObject(this->Plan.TrueMesh.string());
    }
    for (const PlannedSet& set : this->Plan.Sets)
    {
      for (const PlannedView& view : set.Views)
      {
        this->Items.push_back({ &set, &view });
      }
    }
    if (this->Options.Pictures && this->Writes())
    {
      const Camera& first = this->Plan.Sets.front().Views.front().View.Cam;
      this->Sheet.emplace(this->Title, StageName(this->Options.UpTo), this->Items.size(),
        static_cast<double>(first.Width) / first.Height);
    }
    const auto photographs = this->ReadViews();
    this->Work.ForEach(
      this->Items.size(), [this](std::size_t item) { return this->Predict(this->Items[item]); },
      [this](std::size_t item, const WorkResult& result)
      { this->Keep(this->Items[item], result); });
    if (this->Writes())
    {
      this->Finish(photographs);
    }
  }

private:
  /** A view to predict and the set it is of. */
  struct Item
  {
    const PlannedSet* Set;
    const PlannedView* View;
  };

  /** Reads the photographs in the first process, which returns them, and hands them out. */
  vtkSmartPointer<vtkMultiBlockDataSet> ReadViews()
  {
    // With one set its held-out photographs are not read; several sets share what is read once.
    const bool alone = this->Plan.Sets.size() == 1;
    Dataset dataset;
    if (this->Writes())
    {
      dataset = ReadInput(this->Options.Input, this->Index,
        alone ? this->Plan.Sets.front().HeldOut : std::vector<std::string>(), this->Con);
    }
    if (!alone)
    {
      this->References = this->Work.Share(dataset.Views);
      return dataset.Views;
    }
    const PlannedSet& set = this->Plan.Sets.front();
    this->Current = &set;
    const auto references = this->Writes() ? Without(dataset.Views, set.HeldOut) : nullptr;
    this->Made = this->Work.Prepare(references, this->Options.Synthesis);
    return dataset.Views;
  }

  /** The synthesis of a set of references, with its own hull; the last one's is kept. */
  Synthesis& MadeFrom(const PlannedSet& set)
  {
    if (this->Current != &set)
    {
      this->Current = &set;
      this->Made.reset();
      this->Made = std::make_unique<Synthesis>(
        Without(this->References, set.HeldOut), this->Options.Synthesis, this->Work.Listener());
    }
    return *this->Made;
  }

  /**
   * Predicts and scores a view; errors name it. Numbers are the scores of every stage (ScoreNumbers
   * each); images are those of the stages and, last, the truth, where they are needed.
   */
  WorkResult Predict(const Item& item)
  {
    this->Con.Info("view " + item.View->Name);
    try
    {
      const ResolvedView& view = item.View->View;
      ValidateCamera(view.Cam, "novel camera");
      const auto truth = ReadTruth(view.Truth, this->Options.Input.Silhouette, view.Cam);
      Synthesis& synthesis = this->MadeFrom(*item.Set);
      std::vector<vtkSmartPointer<vtkImageData>> images;
      for (const NovelView& stage : synthesis.RenderStages(view.Cam, this->Options.UpTo))
      {
        images.push_back(stage.Image);
      }
      if (this->TrueMesh)
      {
        images.push_back(synthesis.Texture(this->TrueMesh, view.Cam));
      }
      WorkResult result;
      for (vtkImageData* image : images)
      {
        const Scores scores =
          Compare(MaskedPictureOf(image, "novel view"), MaskedPictureOf(truth, "truth"));
        for (double Scores::*number : ScoreNumbers)
        {
          result.Numbers.push_back(scores.*number);
        }
        if (this->Options.Pictures)
        {
          result.Images.push_back(PictureOnly(image));
        }
      }
      if (this->Options.Pictures)
      {
        result.Images.push_back(Blackened(truth));
      }
      return result;
    }
    catch (const Interrupted&)
    {
      throw;
    }
    catch (const Error& error)
    {
      throw Error("view " + item.View->Name, error.what());
    }
  }

  /** In the first process: keeps the scores of a view and writes its images. */
  void Keep(const Item& item, const WorkResult& result)
  {
    EvaluatedView& view = this->Views.emplace_back();
    view.Name = item.View->Name;
    view.References = item.Set->References;
    const std::size_t novel = static_cast<std::size_t>(this->Options.UpTo) + 1;
    for (std::size_t i = 0; i < result.Numbers.size() / ScoreNumbers.size(); ++i)
    {
      const std::string stage = i < novel ? StageName(static_cast<Stage>(i)) : "oracle";
      Scores scores;
      for (std::size_t n = 0; n < ScoreNumbers.size(); ++n)
      {
        scores.*ScoreNumbers[n] = result.Numbers[i * ScoreNumbers.size() + n];
      }
      view.Stages.emplace_back(stage, scores);
      if (this->Options.Pictures)
      {
        WriteArray(
          this->Options.Out / PictureOf(view.Name, stage), result.Images[i], arrays::Color);
      }
    }
    if (this->Options.Page && this->Options.Pictures && this->Shots.size() < MaxShots)
    {
      std::vector<std::pair<std::string, vtkImageData*>> shown;
      for (std::size_t i = 0; i < view.Stages.size(); ++i)
      {
        shown.emplace_back(view.Stages[i].first, result.Images[i]);
      }
      this->Shots.push_back(ShotsOf(view.Name, shown, result.Images.back()));
    }
    if (this->Sheet)
    {
      this->Sheet->AddRow(
        { view.Name, result.Images.back(), result.Images.front(), result.Images[novel - 1],
          view.Stages.front().second.Rms, view.Stages[novel - 1].second.Rms });
    }
  }

  void Finish(vtkMultiBlockDataSet* photographs)
  {
    const fs::path& out = this->Options.Out;
    DrawEvaluationChart(this->Title, this->Views, out / "chart.png");
    if (this->Sheet)
    {
      this->Sheet->Write(out / "overview.png");
    }
    WriteTextAtomically(out / "scores.csv", ScoresCsv(this->Views));
    const nlohmann::ordered_json summary = this->Summary();
    if (this->Options.Page)
    {
      const EvaluationPageInput input{ this->Title, summary,
        nlohmann::ordered_json::parse(this->Con.TimingsText()) };
      WriteTextAtomically(
        out / "report.html", EvaluationPageHtml(input, this->Views, this->Shots, photographs));
    }
    WriteTextAtomically(out / "scores.json", DumpJson(summary) + "\n");
    for (const std::string& line : ScoreTable(this->Views))
    {
      this->Con.Info(line);
    }
    std::string worse;
    for (const std::string& name : WorseThanHull(this->Views))
    {
      worse += (worse.empty() ? "" : ", ") + name;
    }
    if (!worse.empty())
    {
      this->Con.Warn("the full stage's RMS is above the hull's: " + worse);
    }
    this->Con.Info("scores: " + (out / "scores.json").string());
    this->Con.Summary();
  }

  nlohmann::ordered_json Summary() const
  {
    nlohmann::ordered_json summary;
    summary["protocol"] = Protocol;
    summary["mode"] = this->Plan.Mode;
    summary.update(EvaluationJson(this->Views));
    EvaluateOptions used = this->Options;
    used.TrueMesh = this->Plan.TrueMesh;
    summary["options"] = ToJson(OptionsOf(used), used.Out);
    summary["versions"] = VersionsJson();
    return summary;
  }

  const EvaluateOptions& Options;
  const DatasetIndex& Index;
  Console& Con;
  WorkDistributor Work;
  const EvaluationPlan Plan;
  const std::string Title;
  vtkSmartPointer<vtkPolyData> TrueMesh;
  std::optional<Overview> Sheet;
  std::vector<EvaluatedView> Views;
  std::vector<Item> Items;
  vtkSmartPointer<vtkMultiBlockDataSet> References; ///< of several sets, all photographs
  const PlannedSet* Current = nullptr;              ///< the set of Made
  std::unique_ptr<Synthesis> Made;
  std::vector<EvaluationShots> Shots;
};
}

void EvaluateDataset(const EvaluateOptions& options, Console& console, ProcessGroup& processes)
{
  const DatasetIndex index = FindInput(options.Input);
  Evaluation evaluation(options, index, console, processes);
  if (evaluation.Writes())
  {
    PrepareFolder(options.Out, evaluation.Files());
  }
  evaluation.Run();
}
}
