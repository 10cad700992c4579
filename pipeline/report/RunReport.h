// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RunReport_h
#define novelview_RunReport_h

#include "drawing/ScenePictures.h"
#include "images/Metrics.h"
#include "synthesis/Synthesis.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace novelview
{
/** What images may be named after in a run to the stage `upTo`: its stages and the oracle. */
std::vector<std::string> PictureStages(Stage upTo);

/** Scores as every summary has them: rms, psnr, ssim, iou, missing, excess. */
nlohmann::ordered_json ScoresJson(const Scores& scores);

/** Of the programs and libraries that the numbers depend on. */
nlohmann::ordered_json VersionsJson();

/** What the files of an iteration are called: outline_NN or nonoutline_NN. */
std::string IterationName(Stage step, int iteration);

/**
 * The files, in its folder, that a run may leave: all of a run's to the stage `upTo` with so many
 * iterations of both deformers, whether or not there is a truth to compare with.
 */
std::vector<std::filesystem::path> FilesOfRun(
  Stage upTo, int outlineIterations, int nonOutlineIterations);

/** A row of the tables: values of IterationState, with the scores if there is a truth. */
struct TableRow
{
  Stage Step = Stage::Outline;
  int Iteration = 0;
  std::optional<Scores> Score;
  double MeanEnergy = 0;
  double MeanPhoto = 0;
  double MeanContour = 0;
  double MeanSmooth = 0;
  long PointsMoved = 0;
  long Triangles = 0; ///< of the mesh
};

/**
 * The folder a run leaves behind. Every function writes whole files (see WriteAtomically) and
 * nothing in them depends on when or how fast the run was.
 */
class RunReport
{
public:
  /** `truth` (arrays Color and Mask) may be null. */
  RunReport(std::filesystem::path folder, vtkImageData* truth);

  /** stages/NAME.png, stages/NAME_mask.png and stages/NAME_error.png. */
  void AddStage(const std::string& name, vtkImageData* image);

  /** novel.png, novel_mask.png, novel_depth.tiff, novel_unseen.png. */
  void WriteNovel(vtkImageData* image) const;

  /**
   * meshes/NAME.vtp; of a mesh without cells, with a vertex at each point. Another thread may be in
   * another member meanwhile.
   */
  void WriteMesh(const std::string& name, vtkPolyData* mesh) const;

  /**
   * A row of the tables, iterations/STEP_NN.png, meshes/iterations/STEP_NN.vtp and, when `desktop`
   * is given, iterations/STEP_NN_desktop.png.
   */
  void AddIteration(const IterationState& state, Dashboard* desktop);

  /** Takes what was estimated from the photographs for summary.json; see vtkReferenceDepthEstimator. */
  void SetEstimates(vtkMultiBlockDataSet* photographs);

  /** rms_outline.csv, rms_nonoutline.csv, rms.png, meshes/iterations.pvd, summary.json. */
  void Finish(const std::string& title) const;

  /** Scores against the truth; nothing without one. */
  std::optional<Scores> ScoreOf(vtkImageData* image) const;

  const std::vector<std::pair<std::string, std::optional<Scores>>>& Stages() const
  {
    return this->StageScores;
  }
  /** The images of the same, as they came. */
  const std::vector<vtkSmartPointer<vtkImageData>>& StageImages() const { return this->Images; }
  const std::vector<TableRow>& Iterations() const { return this->Rows; }
  vtkImageData* TrueImage() const { return this->Truth; } ///< null when there is none

  /** What summary.json holds. */
  nlohmann::ordered_json Summary() const;

private:
  std::string TableText(Stage step) const;
  std::string SeriesText() const;

  std::filesystem::path Folder;
  vtkSmartPointer<vtkImageData> Truth;
  std::vector<std::pair<std::string, std::optional<Scores>>> StageScores;
  std::vector<vtkSmartPointer<vtkImageData>> Images;
  std::vector<TableRow> Rows;
  std::vector<HistoryRow> History;
  nlohmann::ordered_json Estimates; ///< null when nothing was estimated
};
}

#endif
