// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Synthesis_h
#define novelview_Synthesis_h

#include "Camera.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace novelview
{
struct ViewIndependent;

/** How far the geometry is refined before it is textured. */
enum class Stage
{
  Hull,
  Outline,
  Full
};

/** Every knob of the method. Lengths in pixels are pixels of the photographs or the novel view. */
struct SynthesisOptions
{
  /** "best" or "paper": which defaults the other members start from, see PresetOptions(). */
  std::string Preset = "best";

  /** Folder that keeps what does not depend on the novel camera (StageCache); empty = none. */
  std::filesystem::path Cache;

  // ---- silhouettes
  bool ReconcileSilhouettes = false; ///< enlarge those that are too small for all the others

  // ---- hull
  double HullSpacingPx = 2.0;                   ///< sample spacing, input pixels
  std::optional<std::array<double, 6>> HullBox; ///< x0 y0 z0 x1 y1 z1; found when not given
  bool HullKeepAll = false;                     ///< keep every component, not only the largest

  // ---- visibility culler
  double LongestEdgePx = 0; ///< cut longer edges of what the camera sees at their middle; 0 = none

  // ---- outline deformer
  int OutlineIterations = 10;
  double OutlineAlpha = 0.3; ///< weight of the contour energy
  double OutlineBeta = 0.3;  ///< weight of the smoothness energy
  double OutlineSearchPx = 4.0;

  // ---- non-outline deformer
  int NonOutlineIterations = 10;
  double NonOutlineAlpha = 0.3; ///< weight of the smoothness energy

  // ---- depth maps of the photographs
  bool UseDepthMaps = false;      ///< estimate them, and let deformers and mapper use them
  double SilhouettePrior = 0;     ///< weight of "object" when they decide the outline; 0 = found
  double DepthNoise = 0;          ///< by how much they are off, pixel footprints; 0 = measured
  bool ContourPrediction = false; ///< refine the outline by the photographs' contours

  // ---- texture mapper
  int References = 3;           ///< photographs blended per pixel
  double Power = 8.0;           ///< m of the weight W^m
  double FeatherPx = 2.0;       ///< a photograph's weight grows over this from its contour inwards
  double OcclusionSoftness = 0; ///< pixel footprints; 0 = hard
  bool ExposureGains = false;   ///< bring the photographs to one exposure; needs depth maps
  int RimSamples = 1;           ///< sub-rays per pixel side at the rim; 1 = no antialiasing
  bool SoftRim = false;         ///< also draw pixels of which less than half is covered; for films
};

/** The defaults of a preset; throws Error on an unknown name. */
SynthesisOptions PresetOptions(const std::string& preset);

/** One line of the RMS tables: state of the refinement after one iteration. */
struct IterationState
{
  Stage Step = Stage::Outline; ///< which deformer (Outline or Full for the non-outline one)
  int Iteration = 0;           ///< 0 = before the first move
  double MeanEnergy = 0;       ///< over the points the deformer moves
  double MeanPhoto = 0;        ///< photo-consistency term
  double MeanContour = 0;      ///< contour term (outline) or hull term (non-outline)
  double MeanSmooth = 0;       ///< smoothness term
  long PointsMoved = 0;
  vtkPolyData* Mesh = nullptr;   ///< borrowed; point arrays as the deformers document them
  vtkImageData* Image = nullptr; ///< borrowed; the novel view textured with this mesh
};

/** A finished novel view. */
struct NovelView
{
  vtkSmartPointer<vtkImageData> Image; ///< point arrays Color, Mask, Depth, CellId, Seen
  vtkSmartPointer<vtkPolyData> Mesh;   ///< the refined mesh
};

/** What a run tells while it works. All members may be left empty. */
struct SynthesisListener
{
  /** A stage begins or goes on; fraction 0 to 1. Returns false to ask for a stop. */
  std::function<bool(const std::string& stage, double fraction)> Progress;
  /** A stage has ended after so many seconds. */
  std::function<void(const std::string& stage, double seconds)> StageDone;
  /** Two stages ran at the same time, and took so many seconds less than the sum of both. */
  std::function<void(double seconds)> StagesOverlapped;
  /** Something the user should read. */
  std::function<void(const std::string& text)> Warn;
  /** After every iteration of a deformer; costs one texturing each when set. */
  std::function<void(const IterationState&)> Iteration;
};

/**
 * The six stages on one data set. What does not depend on the novel camera (hull, crust) is made
 * once, at the first need, and kept. A failing filter becomes an Error with the stage's name.
 */
class Synthesis
{
public:
  Synthesis(
    vtkMultiBlockDataSet* views, const SynthesisOptions& options, SynthesisListener listener = {});
  /** From what another one has Prepared(), in this process or another. It knows no hull. */
  Synthesis(const ViewIndependent& prepared, const SynthesisOptions& options,
    SynthesisListener listener = {});
  ~Synthesis();

  /** Runs every stage that does not depend on the novel camera, and gives what they made. */
  ViewIndependent Prepared();

  vtkPolyData* Hull();  ///< points with normals
  vtkPolyData* Crust(); ///< closed mesh on the hull's points
  vtkPolyData* MedialBalls();
  /** The photographs as the mapper has them: silhouettes reconciled, with depth maps if wanted. */
  vtkMultiBlockDataSet* Photographs();

  /** The picture the camera would take, with the geometry refined up to `upTo`. */
  NovelView Render(const Camera& camera, Stage upTo);

  /** The same with the picture after each stage on the way: hull, outline, full. */
  std::vector<NovelView> RenderStages(const Camera& camera, Stage upTo);

  /** The texture mapper alone on any mesh: the oracle, when it is the true one. */
  vtkSmartPointer<vtkImageData> Texture(vtkPolyData* mesh, const Camera& camera);

private:
  class Internals;
  std::unique_ptr<Internals> Own;
};
}

#endif
