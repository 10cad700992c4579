// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SilhouetteRepair_h
#define novelview_SilhouetteRepair_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"

#include <cstdint>
#include <vector>

namespace novelview
{
struct SilhouetteRepairOptions
{
  int SlackPx = 2;          ///< so far the hull may miss a silhouette's edge without being wrong
  int MinAreaPx = 40;       ///< smaller parts that the hull misses are left alone
  int MaxDissenters = 3;    ///< silhouettes that may lack the same part
  int MinWitnesses = 3;     ///< views that must show it
  int MinMajority = 2;      ///< so many more witnesses than dissenters
  double MarginShare = 0.2; ///< how far beyond the hull is searched, share of its size
};

/** Per view: 255 where a silhouette lacks a part that others show; an empty image = nowhere. */
using MissingParts = std::vector<Image<std::uint8_t>>;

/**
 * Finds the parts of the object that a few wrong silhouettes lack and that therefore are not in the
 * visual hull, although the other silhouettes show them: a mask made by a threshold loses what lies
 * in shadow.
 *
 * A connected part of a silhouette that the projected hull leaves uncovered, and whose colours are
 * nearer to those of the object than of the background, is a witness that some other silhouette is
 * wrong. A point of its rays is a missing part of the object when it projects to uncovered parts of
 * MinWitnesses views, and of MinMajority more than there are silhouettes outside which it lies (a
 * view in whose frame it is not says nothing). Of those on one ray, the points that the fewest
 * silhouettes lack are added to these.
 *
 * Where silhouettes agree, nothing is uncovered and nothing found.
 *
 * Views need Color and ContourDistance; `hull` is the surface of the visual hull of exactly these views.
 */
MissingParts FindMissingParts(const std::vector<View>& views, const TriangleMesh& hull,
  const SilhouetteRepairOptions& options = {}, const Execution& execution = {});
}

#endif
