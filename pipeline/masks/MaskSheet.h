// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MaskSheet_h
#define novelview_MaskSheet_h

#include "core/ImageRef.h"

#include <cstdint>
#include <string>
#include <vector>

namespace novelview
{
/** A photograph with its mask, small. */
struct MaskThumbnail
{
  std::string Name;
  double Coverage = 0; ///< of the frame by the object, 0 to 1
  Image<std::uint8_t> Picture;
};

/**
 * The photograph, at most 320 x 240, with the mask's outline in it and all that is not object
 * darkened. `photo` has 3 channels, RGB; the mask is of its size.
 */
MaskThumbnail MakeMaskThumbnail(const std::string& name, const ImageRef<const std::uint8_t>& photo,
  const ImageRef<const std::uint8_t>& mask);

/** All of them in rows, each with its name and coverage below; RGB. */
Image<std::uint8_t> MaskContactSheet(const std::vector<MaskThumbnail>& thumbnails);
}

#endif
