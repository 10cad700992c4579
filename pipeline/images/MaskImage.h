// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MaskImage_h
#define novelview_MaskImage_h

#include "core/ImageRef.h"

#include <cstdint>
#include <filesystem>

namespace novelview
{
/**
 * A mask from a file: one channel of 8 bits, 255 = object. Colours count by their largest channel.
 * Where all colours are the same and there is an alpha channel, that is the mask. Sixteen bits and
 * floats up to 1 are brought to eight. When the largest value is 1, every pixel that is not 0 is
 * object. Throws Error when the values tell no object from its background: the largest is below 128
 * (but 0 and 1), or a coloured mask has nothing dark.
 */
Image<std::uint8_t> ReadMaskFile(const std::filesystem::path& path);
}

#endif
