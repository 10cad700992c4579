// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_evaluation_EnergyScene_h
#define novelview_evaluation_EnergyScene_h

#include "dataset/Dataset.h"
#include "evaluation/Landscape.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview::evaluation
{
/** A generated object: its photographs, its true mesh, and the mesh that the deformers start from. */
struct EnergyScene
{
  /** Reads a folder of `novelview generate`. */
  explicit EnergyScene(const std::filesystem::path& folder);

  Dataset Photographs;
  std::vector<View> Views; ///< of them, without copies
  TriangleMesh Truth;
  TriangleMesh Hull;
  std::vector<Camera> Novel; ///< the test views
};

/**
 * The energies [1] to [5] of the outline points of the true mesh, each along its own moving direction,
 * positive = outwards. Their neighbours are where they belong.
 */
std::vector<Landscape> OutlineLandscapes(const EnergyScene& scene);

/**
 * The energies [6] to [10] of visible other vertices of the true mesh, each along its novel ray, positive
 * = away from the camera. What they are matched with is looked for from the hull, as in the first
 * iteration, or from the truth, as in the last. Their neighbours are where they belong.
 *
 * @param stride every so many vertices.
 */
std::vector<Landscape> NonOutlineLandscapes(const EnergyScene& scene, int stride);
}

#endif
