// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MaskedMedian_h
#define novelview_MaskedMedian_h

#include "core/ImageRef.h"

namespace novelview
{
/** Median over the (2 radius + 1)^2 window's values above 0; 0 stays 0. */
Image<float> MaskedMedian(const Image<float>& image, int radius);
}

#endif
