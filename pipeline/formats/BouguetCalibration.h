// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Calib_Results.m of Bouguet's Camera Calibration Toolbox for MATLAB: assignments, of which these
 * are read:
 *
 *     fc, cc, alpha_c, kc   focal lengths and principal point, px; skew = alpha_c * fc(1); lens
 *                           k1 k2 p1 p2 k3
 *     nx, ny                size, px
 *     omc_N, Tc_N           rotation vector and translation, world (checkerboard) to camera; images
 *                           with NaN were not used and are left out
 *     calib_name, format_image    photographs are NAMEn.FORMAT, with or without leading zeros
 *     image_name_N          the photograph's name; not the toolbox's, which ignores it
 *
 * Without names the photographs are those in the folder, in natural order. Pixel (0,0) is the centre
 * of the top-left pixel, x right, y down, z forward. All photographs share camera and size.
 *
 * Errors are novelview::Error, naming file and line.
 */
#ifndef novelview_BouguetCalibration_h
#define novelview_BouguetCalibration_h

#include "formats/DatasetFormats.h"

namespace novelview
{
DatasetFormat BouguetFormat();
}

#endif
