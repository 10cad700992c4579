// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/EvaluationScores.h"

#include "report/RunReport.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace novelview
{
namespace
{
constexpr double Scores::*Members[] = { &Scores::Rms, &Scores::Psnr, &Scores::Ssim, &Scores::Iou,
  &Scores::Missing, &Scores::Excess };

/** A cell of a CSV file, in quotes where it needs them. */
std::string Cell(const std::string& text)
{
  if (text.find_first_of(",\"") == std::string::npos)
  {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text)
  {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + "\"";
}

std::string TableLine(
  const std::string& view, int width, const std::string& stage, const Scores& scores)
{
  char numbers[160];
  std::snprintf(numbers, sizeof(numbers), "  %-8s %8.2f %7.2f %8.4f %8.4f %8.4f %8.4f",
    stage.c_str(), scores.Rms, scores.Psnr, scores.Ssim, scores.Iou, scores.Missing, scores.Excess);
  std::string name = view;
  name.resize(std::max(name.size(), static_cast<std::size_t>(width)), ' ');
  return name + numbers;
}

nlohmann::ordered_json StagesJson(const ScoresByStage& stages)
{
  auto object = nlohmann::ordered_json::object();
  for (const auto& [name, scores] : stages)
  {
    object[name] = ScoresJson(scores);
  }
  return object;
}
}

const Scores* FindStage(const ScoresByStage& stages, const std::string& name)
{
  for (const auto& [stage, scores] : stages)
  {
    if (stage == name)
    {
      return &scores;
    }
  }
  return nullptr;
}

ScoresByStage MeanScores(const std::vector<EvaluatedView>& views)
{
  ScoresByStage means;
  if (views.empty())
  {
    return means;
  }
  for (const auto& [stage, first] : views.front().Stages)
  {
    Scores mean{ 0, 0, 0, 0, 0, 0 };
    for (const EvaluatedView& view : views)
    {
      const Scores* scores = FindStage(view.Stages, stage);
      for (const auto member : Members)
      {
        mean.*member += scores->*member / static_cast<double>(views.size());
      }
    }
    means.emplace_back(stage, mean);
  }
  return means;
}

std::optional<GapClosure> ClosureOf(const ScoresByStage& stages)
{
  const Scores* hull = FindStage(stages, "hull");
  const Scores* full = FindStage(stages, "full");
  const Scores* oracle = FindStage(stages, "oracle");
  if (!hull || !full || !oracle)
  {
    return std::nullopt;
  }
  return GapClosure{ (hull->Rms - full->Rms) / (hull->Rms - oracle->Rms),
    (hull->Ssim - full->Ssim) / (hull->Ssim - oracle->Ssim) };
}

std::vector<std::string> WorseThanHull(const std::vector<EvaluatedView>& views)
{
  std::vector<std::string> names;
  for (const EvaluatedView& view : views)
  {
    const Scores* hull = FindStage(view.Stages, "hull");
    const Scores* full = FindStage(view.Stages, "full");
    if (hull && full && full->Rms > hull->Rms)
    {
      names.push_back(view.Name);
    }
  }
  return names;
}

std::vector<std::string> ScoreTable(const std::vector<EvaluatedView>& views)
{
  const std::string mean = "mean of " + std::to_string(views.size());
  std::size_t width = mean.size();
  for (const EvaluatedView& view : views)
  {
    width = std::max(width, view.Name.size());
  }
  const int columns = static_cast<int>(width);
  std::string head = "view";
  head.resize(width, ' ');
  std::vector<std::string> lines{ head +
    "  stage         RMS    PSNR     SSIM      IoU  missing   excess" };
  for (const EvaluatedView& view : views)
  {
    for (const auto& [stage, scores] : view.Stages)
    {
      lines.push_back(TableLine(view.Name, columns, stage, scores));
    }
  }
  const ScoresByStage means = MeanScores(views);
  for (const auto& [stage, scores] : means)
  {
    lines.push_back(TableLine(mean, columns, stage, scores));
  }
  if (const auto closure = ClosureOf(means))
  {
    char text[120];
    std::snprintf(text, sizeof(text), "gap from the hull to the oracle closed: RMS %.3f, SSIM %.3f",
      closure->Rms, closure->Ssim);
    lines.emplace_back(text);
  }
  return lines;
}

std::string ScoresCsv(const std::vector<EvaluatedView>& views)
{
  std::string text = "view,stage,rms,psnr,ssim,iou,missing,excess\n";
  for (const EvaluatedView& view : views)
  {
    for (const auto& [stage, scores] : view.Stages)
    {
      text += Cell(view.Name) + "," + stage;
      for (const auto member : Members)
      {
        text += "," + nlohmann::json(scores.*member).dump();
      }
      text += "\n";
    }
  }
  return text;
}

nlohmann::ordered_json EvaluationJson(const std::vector<EvaluatedView>& views)
{
  nlohmann::ordered_json object;
  object["views"] = nlohmann::ordered_json::array();
  for (const EvaluatedView& view : views)
  {
    object["views"].push_back({ { "view", view.Name }, { "references", view.References },
      { "stages", StagesJson(view.Stages) } });
  }
  const ScoresByStage means = MeanScores(views);
  object["mean"] = StagesJson(means);
  if (const auto closure = ClosureOf(means))
  {
    object["gap_closure"] = { { "rms", closure->Rms }, { "ssim", closure->Ssim } };
  }
  object["worse_than_hull"] = WorseThanHull(views);
  return object;
}
}
