// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ModelRefinement_h
#define novelview_ModelRefinement_h

#include "core/Execution.h"
#include "fusion/TsdfField.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"

namespace novelview
{
struct ModelRefinementOptions
{
  FusionOptions Fusion{ 3, 0.05, 0.12 }; ///< how the depth maps vote; see OptionsForNoise()
  double OutsidePx = 2;    ///< the search begins so far outside the mesh, pixel footprints
  double InsidePx = 60;    ///< and ends so far inside
  double StepPx = 0.5;     ///< of the search, pixel footprints
  double OutlierPx = 3;    ///< a way that differs by more from the neighbours' median takes that
  double Smoothing = 0.5;  ///< weight of a point's neighbours against its own way
  int SmoothingSteps = 4;  ///< of the ways, in every round
  int NearRounds = 2;      ///< further rounds along the normals of the mesh by then,
  double NearPx = 4;       ///< no further than this to either side
  int UnfoldingSteps = 10; ///< at most, of points whose triangles have turned over
};

/**
 * The whole surface, for no camera in particular: every point of the hull's mesh moves along its
 * normal to the first zero crossing of TsdfField, balanced with its neighbours, and
 * then a little further along its new ones. Where triangles have turned over, points move to the
 * middle of their neighbours. Where no photograph sees anything, the hull stays. Connectivity stays:
 * a closed mesh stays closed.
 *
 * Views need ContourDistance, DepthMap and Confidence. Throws Error when one is missing, or the mesh
 * lies behind every camera.
 */
TriangleMesh RefineModel(const TriangleMesh& mesh, const std::vector<View>& views,
  const ModelRefinementOptions& options = {}, const Execution& execution = {});
}

#endif
