// SPDX-License-Identifier: GPL-3.0-or-later
#include "EvaluateCommand.h"

#include "AtomicFile.h"
#include "CommandSupport.h"
#include "Error.h"
#include "EvaluationPage.h"
#include "EvaluationPictures.h"
#include "EvaluationPlan.h"
#include "EvaluationScores.h"
#include "ImageFile.h"
#include "ObjectMesh.h"
#include "RunReport.h"
#include "Threads.h"
#include "ViewAccess.h"

#include <nlohmann/json.hpp>

#include <algorithm>
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

/** The picture as it is compared: black outside its mask. */
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

/** With pictures of more views a page would be larger than browsers like. */
constexpr std::size_t MostShots = 24;

/** One evaluation: what is made of the plan, and what is left in the folder. */
class Evaluation
{
public:
  Evaluation(const EvaluateOptions& options, const DatasetIndex& index, Console& console)
    : Options(options)
    , Index(index)
    , Con(console)
    , Plan(MakeEvaluationPlan(options, index))
    , Title(fs::absolute(index.Folder).lexically_normal().filename().string() + ", " +
        this->Plan.Mode + ", preset " + options.Synthesis.Preset)
  {
    for (const std::string& warning : this->Plan.Warnings)
    {
      console.Warn(warning);
    }
  }

  void Run()
  {
    if (!this->Plan.TrueMesh.empty())
    {
      this->TrueMesh = LoadObject(this->Plan.TrueMesh.string());
    }
    if (this->Options.Pictures)
    {
      std::size_t rows = 0;
      for (const PlannedSet& set : this->Plan.Sets)
      {
        rows += set.Views.size();
      }
      const Camera& first = this->Plan.Sets.front().Views.front().View.Cam;
      this->Sheet.emplace(this->Title, StageName(this->Options.UpTo), rows,
        static_cast<double>(first.Width) / first.Height);
    }
    // With one set what it holds out is not even read; several sets share what is read once.
    const bool alone = this->Plan.Sets.size() == 1;
    const Dataset dataset = ReadInput(this->Options.Input, this->Index,
      alone ? this->Plan.Sets.front().HeldOut : std::vector<std::string>(), this->Con);
    for (const PlannedSet& set : this->Plan.Sets)
    {
      const auto references = Without(dataset.Views, set.HeldOut);
      Synthesis synthesis(references, this->Options.Synthesis, ListenerFor(this->Con));
      for (const PlannedView& view : set.Views)
      {
        this->Predict(view, set.References, synthesis);
      }
    }
    this->Finish(dataset.Views);
  }

private:
  /** Predicts and scores a view; errors name it. */
  void Predict(const PlannedView& planned, std::size_t references, Synthesis& synthesis)
  {
    if (Console::Interrupted())
    {
      throw Interrupted();
    }
    this->Con.Info("view " + planned.Name);
    try
    {
      const ResolvedView& view = planned.View;
      ValidateCamera(view.Cam, "novel camera");
      const auto truth = ReadTruth(view.Truth, this->Options.Input.Silhouette, view.Cam);
      const std::vector<NovelView> stages = synthesis.RenderStages(view.Cam, this->Options.UpTo);
      EvaluatedView& scored = this->Views.emplace_back();
      scored.Name = planned.Name;
      scored.References = references;
      for (std::size_t i = 0; i < stages.size(); ++i)
      {
        this->AddStage(scored, StageName(static_cast<Stage>(i)), stages[i].Image, truth);
      }
      vtkSmartPointer<vtkImageData> oracle;
      if (this->TrueMesh)
      {
        oracle = synthesis.Texture(this->TrueMesh, view.Cam);
        this->AddStage(scored, "oracle", oracle, truth);
      }
      if (this->Options.Page && this->Options.Pictures && this->Shots.size() < MostShots)
      {
        std::vector<std::pair<std::string, vtkImageData*>> shown;
        for (std::size_t i = 0; i < stages.size(); ++i)
        {
          shown.emplace_back(StageName(static_cast<Stage>(i)), stages[i].Image);
        }
        if (oracle)
        {
          shown.emplace_back("oracle", oracle);
        }
        this->Shots.push_back(ShotsOf(planned.Name, shown, truth));
      }
      if (this->Sheet)
      {
        const auto shown = Blackened(truth);
        this->Sheet->AddRow({ planned.Name, shown, stages.front().Image, stages.back().Image,
          scored.Stages.front().second.Rms, scored.Stages[stages.size() - 1].second.Rms });
      }
    }
    catch (const Interrupted&)
    {
      throw;
    }
    catch (const Error& error)
    {
      throw Error("view " + planned.Name, error.what());
    }
  }

  void AddStage(
    EvaluatedView& view, const std::string& stage, vtkImageData* image, vtkImageData* truth) const
  {
    view.Stages.emplace_back(
      stage, Compare(MaskedPictureOf(image, "novel view"), MaskedPictureOf(truth, "truth")));
    if (this->Options.Pictures)
    {
      const fs::path name = fs::path(view.Name).replace_extension("." + stage + ".png");
      WriteArray(this->Options.Out / name, image, arrays::Color);
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
    // File names may hold bytes that are no UTF-8.
    WriteTextAtomically(out / "scores.json",
      summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
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
  const EvaluationPlan Plan;
  const std::string Title;
  vtkSmartPointer<vtkPolyData> TrueMesh;
  std::optional<Overview> Sheet;
  std::vector<EvaluatedView> Views;
  std::vector<EvaluationShots> Shots;
};
}

void EvaluateDataset(const EvaluateOptions& options, Console& console)
{
  SetNumberOfThreads(options.Threads);
  const DatasetIndex index = FindInput(options.Input);
  Evaluation evaluation(options, index, console);
  PrepareFolder(options.Out);
  evaluation.Run();
}
}
