// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_NumpyCalibration_h
#define novelview_NumpyCalibration_h

#include "formats/DatasetFormats.h"

namespace novelview
{
/**
 * "neus", cameras_sphere.npz or cameras.npz of NeuS and IDR: world_mat_I (3 x 4 or 4 x 4) is K [R t] of
 * the I-th photograph of image/ in natural order, times any number. scale_mat_I, which brings the
 * object into the unit sphere, is not applied: cameras stay in the world. Masks lie in mask/.
 */
DatasetFormat NeusFormat();

/**
 * "numpy", any other .npz: the arrays K (3 x 3, or N of them), R (N x 3 x 3) and t or T (N x 3), for
 * the photographs in natural order.
 */
DatasetFormat NumpyFormat();

/**
 * "llff", poses_bounds.npy: 17 numbers per photograph in natural order, of which 15 are a matrix
 * [down right back position (height width focal)] of 3 x 5, camera to world. The principal point is
 * the middle of the frame. For photographs of another size of the same shape K is scaled.
 */
DatasetFormat LlffFormat();
}

#endif
