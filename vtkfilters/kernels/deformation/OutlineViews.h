// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OutlineViews_h
#define novelview_OutlineViews_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "deformation/OutlineDeformation.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
/**
 * The views of the contour energy: the nearest to the novel one, at most NearViews, none further from
 * it than NearAngleDeg.
 */
std::vector<int> ContourViews(
  const std::vector<View>& views, const Camera& novel, const OutlineOptions& options);

/** The photographs that the photo-consistency of an outline point compares. */
struct OutlineViews
{
  int Key = -1; ///< -1 = no two photographs tell of the point
  std::vector<int> Secondaries;
};

/**
 * Chooses photographs that can tell where an outline point belongs: those that lie on its moving side
 * (MinFacing) and see it past the mesh (BehindPx). The key is the one of them nearest the novel view,
 * the secondaries are its neighbours among them (MaxApartDeg). Points whose key is flat there
 * (MinVariance), or has no neighbour, have none.
 */
class OutlineViewSelector
{
public:
  /** Rasterises what every view sees of the mesh. Views and options are borrowed. */
  OutlineViewSelector(const TriangleMesh& mesh, const std::vector<View>& views, const Camera& novel,
    const OutlineOptions& options, const Execution& execution = {});

  /** @param step world vector of one novel pixel along the moving direction. */
  OutlineViews Select(const Eigen::Vector3d& point, const Eigen::Vector3d& step) const;

private:
  bool Tells(int viewId, const Eigen::Vector3d& point, const Eigen::Vector3d& step) const;
  bool IsFlat(int key, const Eigen::Vector3d& point, const Eigen::Vector3d& step) const;

  const std::vector<View>& Views;
  const OutlineOptions& Options;
  const std::vector<int> Order; ///< the view nearest to the novel one first
  const std::vector<std::vector<int>> Neighbours;
  std::vector<Image<float>> Depths; ///< per view
};
}

#endif
