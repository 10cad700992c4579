// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TextureMapping_h
#define novelview_TextureMapping_h

#include "core/Execution.h"
#include "geometry/Rasteriser.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "texture/TextureOptions.h"

#include <cstdint>
#include <vector>

namespace novelview
{
/** The novel picture and what is known about each of its pixels; rows from the top. */
struct TexturedView
{
  /** RGB, black where Mask is 0 (but see SoftBoundary); multiplied by the coverage at the boundary. */
  Image<std::uint8_t> Color;
  Image<std::uint8_t> Mask; ///< 255 = object
  Image<float> Depth;       ///< z of the surface point, 0 where Mask is 0
  Image<int> CellId;        ///< triangle of the mesh, -1 where Mask is 0
  Image<std::uint8_t> Seen; ///< 1 = a reference sees the point, 0 = filled from the surroundings
};

/** Whether the model decides what a photograph sees, of some photograph at least. */
bool NeedsModel(const std::vector<View>& views, const TextureOptions& options);

/**
 * View-dependent image synthesis (Chia et al. 2013, section 3). The mesh lookup table gives every
 * pixel of `camera` its surface point V; its colour is
 *
 *     sum W_c^m I_c(project(V)) / sum W_c^m
 *
 * over the nearest references that see V, W_c being the cosine between the novel and the reference
 * viewing ray. Visible means: not deeper than the depth of `mesh` and `occluders` rasterised into
 * the reference. Pixels no reference sees take the mean of their filled neighbours, layer by layer.
 *
 * @param occluders what else stands between the references and the mesh; may be null, and is not
 *        looked at unless NeedsModel().
 */
TexturedView TextureView(const TriangleMesh& mesh, const TriangleMesh* occluders,
  const std::vector<View>& views, const Camera& camera, const TextureOptions& options = {},
  const Execution& execution = {});
}

#endif
