// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the images.
#ifndef novelview_DecodedPicture_h
#define novelview_DecodedPicture_h

#include <opencv2/core.hpp>

#include <filesystem>

namespace novelview
{
/** The pixels of a file, with the flags of cv::imread(). Throws Error when it is no whole picture. */
cv::Mat DecodePicture(const std::filesystem::path& path, int flags);

/** A picture turned as an orientation tag says, see ExifOrientation.h. */
cv::Mat TurnedPicture(cv::Mat mat, int orientation);
}

#endif
