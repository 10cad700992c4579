// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ShadedMesh_h
#define novelview_ShadedMesh_h

#include "core/ImageRef.h"
#include "geometry/Camera.h"
#include "geometry/TriangleMesh.h"

#include <cstdint>

namespace novelview
{
/** The camera turned about a point, around its own vertical axis; to the right for angles above 0. */
Camera TurnedCamera(const Camera& camera, const Eigen::Vector3d& about, double angleDeg);

/**
 * A mesh as the camera sees it, lit from there: grey on black, the insides of its triangles reddish.
 * Drawn without OpenGL, so that any thread may.
 */
Image<std::uint8_t> ShadedMesh(const TriangleMesh& mesh, const Camera& camera);
}

#endif
