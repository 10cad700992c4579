// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Calibrations in OpenCV's YAML or XML files (cv::FileStorage), in two forms. A file of the data
 * set's folder is taken for one when it ends in .yml, .yaml or .xml and holds "camera_matrix".
 *
 *  1. One node per photograph:
 *
 *         views:
 *            - image: "a.png"                       path from the file's folder
 *              mask: "masks/a.png"                  may be left out
 *              camera_matrix: !!opencv-matrix ..    3x3
 *              distortion_coefficients: ..          4, 5, 8, 12 or 14 (fisheye: 4); may be left out
 *              distortion_model: "fisheye"          else "perspective"
 *              R: ..  or  rvec: ..                  3x3, or 3 numbers
 *              tvec: ..                             3 numbers
 *              image_width: 640, image_height: 480  may be left out
 *
 *     camera_matrix, distortion_coefficients, distortion_model, image_width and image_height may
 *     also stand once outside, for all.
 *
 *  2. What OpenCV's calibration samples write: camera_matrix, distortion_coefficients, image_width,
 *     image_height, fisheye_model and extrinsic_parameters (N x 6: rvec, tvec). Photographs are
 *     those of a node `images`, or else those in the folder, in natural order; N of them.
 *
 * Cameras are in the project's convention, which is OpenCV's. Written is form 1, as YAML, with R.
 *
 * Errors are novelview::Error, naming file and photograph.
 */
#ifndef novelview_OpenCvCalibration_h
#define novelview_OpenCvCalibration_h

#include "formats/DatasetFormats.h"

namespace novelview
{
DatasetFormat OpenCvFormat();
}

#endif
