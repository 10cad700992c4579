// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * NeRF's transforms.json, as instant-ngp and nerfstudio read and write it. Looked for as
 * transforms.json or else transforms_train.json in the data set's folder.
 *
 *     frames[]        file_path (the extension may be missing), transform_matrix (4x4 or 3x4),
 *                     mask_path, and any of the following, which go over those of the whole file
 *     fl_x, fl_y      focal lengths, px; fl_y as fl_x when not given. Or camera_angle_x,
 *                     camera_angle_y: full field of view, radians
 *     cx, cy          principal point, px; the image's centre when not given
 *     w, h            size, px; that of the photograph when not given
 *     camera_model    PINHOLE, SIMPLE_PINHOLE, OPENCV, OPENCV_FISHEYE .. (or is_fisheye: true)
 *     k1, k2, p1, p2, k3 (perspective); k1, k2, k3, k4 (fisheye)
 *
 * Cameras are x right, y up, z backward; poses camera-to-world. Both programs put the centre of the
 * top-left pixel at (0.5, 0.5). A k4 of a perspective lens is another one than OpenCV's and
 * refused.
 *
 * Of a split, transforms_test.json or else transforms_val.json hold the views that evaluate predicts;
 * the others are not used, which a note says.
 *
 * Written are numbers common to all frames once, others per frame.
 *
 * Errors are novelview::Error, naming file and frame.
 */
#ifndef novelview_NerfTransforms_h
#define novelview_NerfTransforms_h

#include "formats/DatasetFormats.h"

#include <filesystem>

namespace novelview
{
DatasetFormat NerfFormat();

/** The file beside a calibration whose views are to be predicted; empty when there is none. */
std::filesystem::path NerfTestSplit(const std::filesystem::path& calibration);
}

#endif
