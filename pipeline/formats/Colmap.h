// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * COLMAP's sparse models, text or binary: cameras and images (points are ignored). The model
 * lies in the data set's folder, in sparse/ or in sparse/0/, the photographs in images/ or in the
 * folder itself. Where both encodings are there the binary one is read, as COLMAP does.
 *
 * Cameras are x right, y down, z forward, poses world-to-camera, and the centre of the top-left
 * pixel is (0.5, 0.5). Photographs come in the order of their ids. Of COLMAP's camera models those
 * that OpenCV can undistort are read: all but FOV, THIN_PRISM_FISHEYE and the later ones.
 *
 * Written are PINHOLE cameras, or OPENCV, FULL_OPENCV or OPENCV_FISHEYE where there is distortion,
 * one for all photographs that share it.
 *
 * Errors are novelview::Error, naming file and line or byte.
 */
#ifndef novelview_Colmap_h
#define novelview_Colmap_h

#include "formats/DatasetFormats.h"

namespace novelview
{
DatasetFormat ColmapTextFormat();   ///< "colmap": reads both encodings, writes text
DatasetFormat ColmapBinaryFormat(); ///< "colmap-binary": reads and writes the binary one
}

#endif
