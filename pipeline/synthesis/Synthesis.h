// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Synthesis_h
#define novelview_Synthesis_h

#include "geometry/Camera.h"
#include "synthesis/SynthesisOptions.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace novelview
{
struct SceneGeometry;

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
  vtkPolyData* Mesh = nullptr;   ///< not owned; point arrays as the deformers document them
  vtkImageData* Image = nullptr; ///< not owned; the novel view textured with this mesh
};

/** A finished novel view. */
struct NovelView
{
  vtkSmartPointer<vtkImageData> Image; ///< point arrays Color, Mask, Depth, CellId, Seen
  vtkSmartPointer<vtkPolyData> Mesh;   ///< the refined mesh
};

/** Callbacks of a run. All members may be left empty. */
struct SynthesisListener
{
  /** A stage begins or goes on; fraction 0 to 1. Returns false to request a stop. */
  std::function<bool(const std::string& stage, double fraction)> Progress;
  /** A stage has ended after this many seconds. */
  std::function<void(const std::string& stage, double seconds)> StageDone;
  /** Two stages ran at the same time, and took this many seconds less than the sum of both. */
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
  /** From the Prepared() results of another one, in this process or another. It has no hull. */
  Synthesis(const SceneGeometry& prepared, const SynthesisOptions& options,
    SynthesisListener listener = {});
  ~Synthesis();

  /** Runs every stage that does not depend on the novel camera, and gives what they made. */
  SceneGeometry Prepared();

  vtkPolyData* Hull();  ///< points with normals
  vtkPolyData* Crust(); ///< closed mesh on the hull's points
  vtkPolyData* MedialBalls();
  /** The photographs as the mapper has them: silhouettes reconciled, with depth maps if wanted. */
  vtkMultiBlockDataSet* Photographs();

  /**
   * The whole object, for no camera in particular: with depth maps and `upTo` beyond the hull, the
   * surface on which they agree (vtkDepthMapFuser); else the crust.
   */
  vtkPolyData* WholeObject(Stage upTo);

  /** The image of the camera, with the geometry refined up to `upTo`. */
  NovelView Render(const Camera& camera, Stage upTo);

  /** The same with the image after each stage on the way: hull, outline, full. */
  std::vector<NovelView> RenderStages(const Camera& camera, Stage upTo);

  /** The texture mapper alone on any mesh: the oracle, when it is the true one. */
  vtkSmartPointer<vtkImageData> Texture(vtkPolyData* mesh, const Camera& camera);

private:
  class Internals;
  std::unique_ptr<Internals> Impl;
};
}

#endif
