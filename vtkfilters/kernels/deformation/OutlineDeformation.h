// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OutlineDeformation_h
#define novelview_OutlineDeformation_h

#include "core/Execution.h"
#include "deformation/Deformation.h"
#include "deformation/DeformationParameters.h"
#include "geometry/Rasteriser.h"
#include "geometry/View.h"

#include <optional>
#include <vector>

namespace novelview
{
struct OutlineOptions
{
  /** Weight of the contour energy. */
  double Alpha = OutlineParameters::Alpha.Default;
  /** Weight of the smoothness energy. */
  double Beta = OutlineParameters::Beta.Default;
  /** At most; 0 only measures. */
  int Iterations = DeformationParameters::Iterations.Default;
  /** How far a point may move in one iteration, novel pixels. */
  double SearchPx = OutlineParameters::SearchPx.Default;
  double StepPx = 0.25;        ///< spacing of the candidates, novel pixels
  double ConvergencePx = 0.05; ///< stop when no point moves further
  /** Of the photo-consistency windows, input pixels. */
  int WindowRadius = OutlineParameters::WindowRadius.Default;
  int Secondaries = 2; ///< the key's neighbours
  /** Sigma of the contour energy, input pixels. */
  double SigmaPx = OutlineParameters::SigmaPx.Default;
  int NearViews = 4;        ///< views of the contour energy, at most
  double NearAngleDeg = 45; ///< and no further from the novel view than this
};

// ---- the terms, one function each --------------------------------------------------------------

/**
 * The moving direction in the picture: from the projection to the centroid of the background pixels
 * of the 5x5 window around it, unit length. Nothing when the window is all model or all background,
 * or the centroid is the centre. Pixels outside the frame are neither.
 */
std::optional<Eigen::Vector2d> OutlineDirection(
  const ItemBuffer& silhouette, const Eigen::Vector2d& projection);

/** Does the projection lie on the contour of the silhouette: model and background within a pixel? */
bool OnContour(const ItemBuffer& silhouette, const Eigen::Vector2d& projection);

/** E_s [2]: mean WindowMatcher::Difference of the key with each secondary; the worst, 1, without any. */
double OutlinePhotoEnergy(const Eigen::Vector3d& point, const std::vector<View>& views, int key,
  const std::vector<int>& secondaries, int windowRadius);

/** E_c [4]: mean over the near views of min(d, sigma) / sigma; 0 when none sees the point. */
double OutlineContourEnergy(const Eigen::Vector3d& point, const std::vector<View>& views,
  const std::vector<int>& nearViews, double sigmaPx);

/**
 * E_r [5]: mean over the neighbours of |direction . unit(neighbour - point)|; 0 on a straight
 * outline, 0 without neighbours. `direction` is a unit vector.
 */
double OutlineSmoothnessEnergy(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
  const std::vector<Eigen::Vector3d>& neighbours);

// ---- the stage -----------------------------------------------------------------------------------

/**
 * Moves the outline points of a mesh: the visible points whose projection lies on the contour of
 * the model's own silhouette in the novel view. Each moves along its direction, in the plane
 * through it parallel to the novel image plane, both ways, to the candidate with the least
 * E = E_s + Alpha E_c + Beta E_r [1], and only if that is less than its energy where it is and no
 * triangle around it flips in the novel view. Repeated until the largest move is under
 * ConvergencePx or the iterations are used up.
 *
 * Triangles that face away from the novel camera are dropped first.
 *
 * @param visible per point, 1 = visible; empty = all.
 */
DeformationResult DeformOutline(const TriangleMesh& mesh, const std::vector<std::uint8_t>& visible,
  const std::vector<View>& views, const Camera& novel, const OutlineOptions& options = {},
  const DeformationListener& listener = {}, const Execution& execution = {});
}

#endif
