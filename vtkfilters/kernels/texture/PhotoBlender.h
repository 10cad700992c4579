// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PhotoBlender_h
#define novelview_PhotoBlender_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "texture/TextureOptions.h"

#include <utility>
#include <vector>

namespace novelview
{
/** A reference photograph and what it sees of the model. */
struct BlendReference
{
  const View* Photo;
  Eigen::Vector3d Centre;
  Eigen::Matrix<double, 3, 4> P; ///< K [R | T]: its last row gives the depth
  double FocalLength;
  Image<float> ModelDepth;     ///< empty when the photograph's own depth map is used
  ImageRef<const float> Depth; ///< 0 or infinity = nothing there
};

/**
 * The views as references, but for those that look more than a right angle away from `axis` (null =
 * all). The views must outlive the references.
 */
std::vector<BlendReference> MakeBlendReferences(const TriangleMesh& scene,
  const std::vector<View>& views, const Eigen::Vector3d* axis, const TextureOptions& options,
  const Execution& execution);

/**
 * How well a reference sees a point, 0 to 1: not at all behind its camera, outside its frame or its
 * silhouette, or behind the model; and at which pixel.
 */
double BlendShare(const BlendReference& reference, const Eigen::Vector3d& point,
  const TextureOptions& options, Eigen::Vector2d& pixel);

/** Everything the colour of one point needs; one per thread, so that no point allocates. */
class PhotoBlender
{
public:
  PhotoBlender(const std::vector<BlendReference>& references, const TextureOptions& options)
    : Options(options)
  {
    for (const BlendReference& reference : references)
    {
      this->Nearest.emplace_back(0, &reference);
    }
  }

  /**
   * Blends the colour of a surface point as it looks along the unit vector `ray`; false, and black,
   * when no reference sees it. References that look along the ray with a cosine above `maxCosine`
   * are left out.
   */
  bool Blend(
    const Eigen::Vector3d& point, const Eigen::Vector3d& ray, double rgb[3], double maxCosine = 1);

  /** Of the point blended last: the weighted mean of the references' cosines. */
  double MeanCosine() const { return this->Cosine; }

private:
  void SortByAngle(const Eigen::Vector3d& point, const Eigen::Vector3d& ray);

  const TextureOptions& Options;
  /** All references with the cosine to the ray, the nearest first. */
  std::vector<std::pair<double, const BlendReference*>> Nearest;
  double Cosine = 0;
};
}

#endif
