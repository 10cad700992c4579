// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Images that show a scene, as a desktop program would: the rig of a data set, the state of the
 * refinement after an iteration, the curves of a whole run. Rendered by VTK through OSMesa, written
 * as PNG files atomically. Errors are novelview::Error.
 */
#ifndef novelview_ScenePictures_h
#define novelview_ScenePictures_h

#include "drawing/SolidTexture.h"
#include "geometry/Camera.h"
#include "synthesis/Synthesis.h"

#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace novelview
{
class OffscreenWindow;

/** A rig and the object it photographs. */
struct RigPicture
{
  std::string Title;           ///< e.g. "bunny, wood, 12 views"
  vtkPolyData* Mesh = nullptr; ///< not owned
  SurfaceLook Look;
  std::vector<Camera> Views; ///< drawn with their numbers, from 0
  /** The photographs (array Color, any size), shown in the cameras' frusta; may be empty. */
  std::vector<vtkSmartPointer<vtkImageData>> Photographs;
  std::vector<Camera> HeldOut;               ///< drawn highlighted
  std::vector<std::string> HeldOutLabels;    ///< one each, e.g. "15 deg"
  std::string HeldOutName = "held-out view"; ///< what they are called; more than one get an s
};

/** The rig overview, 1600 x 900: textured object, numbered cameras, held-out cameras, axes. */
void DrawRig(const RigPicture& rig, const std::filesystem::path& path);

/** The score after one iteration of a deformer. */
struct HistoryRow
{
  Stage Step = Stage::Outline; ///< Outline or Full (= non-outline deformer)
  int Iteration = 0;
  double Rms = 0; ///< against the truth, 0 to 255
  double Ssim = std::numeric_limits<double>::quiet_NaN();
};

/** Everything a screenshot of the refinement shows; the pointers are not owned. */
struct Dashboard
{
  std::string Title; ///< of the window: what is being run
  Stage Step = Stage::Outline;
  int Iteration = 0;
  /**
   * The current mesh. Point arrays OutlineFlag (uint8, not 0 = outline point) and Displacement (3
   * doubles, world units) are shown when present.
   */
  vtkPolyData* Mesh = nullptr;
  vtkMultiBlockDataSet* Views = nullptr; ///< for their cameras
  Camera Novel;
  vtkImageData* NovelImage = nullptr; ///< arrays Color and Mask
  vtkImageData* TruthImage = nullptr; ///< the same of the truth, same size; may be null
  std::vector<HistoryRow> History;    ///< all rows so far
  double DisplacementRangePx = 4;     ///< end of the displacement's colour scale, novel-view pixels
  double ErrorRange = 80;             ///< end of the error's colour scale, grey levels
  /** Made by the first screenshot; in it those that follow find OpenGL's programs compiled. */
  std::shared_ptr<OffscreenWindow> Window;
};

/** A desktop-style screenshot, 1600 x 900. */
void DrawDesktop(Dashboard& state, const std::filesystem::path& path);

/** RMS and, where there are any, SSIM of all iterations as line charts, 1600 x 700. */
void DrawCharts(const std::string& title, const std::vector<HistoryRow>& history,
  const std::filesystem::path& path);
}

#endif
