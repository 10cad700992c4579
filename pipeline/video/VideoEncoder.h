// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_VideoEncoder_h
#define novelview_VideoEncoder_h

#include <opencv2/core.hpp>

#include <string>

namespace novelview
{
/**
 * What VideoFile needs of OpenCV's videoio. That takes some hundred libraries with it, as long to
 * load as all others together; so it is in a separate library, NovelViewVideo, which VideoFile
 * loads for the first video.
 */
class VideoEncoder
{
public:
  virtual ~VideoEncoder() = default;

  /** Begins a file with a codec of four letters. False when that cannot be had. */
  virtual bool Open(
    const std::string& path, const std::string& codec, double fps, const cv::Size& size) = 0;

  /** BGR, of the size given. */
  virtual void Write(const cv::Mat& picture) = 0;

  /** Ends the file and returns how many frames can be read back from it. */
  virtual long Close() = 0;
};
}

extern "C"
{
  /** A new encoder, the caller's to delete. */
  novelview::VideoEncoder* NovelViewNewVideoEncoder();
}

#endif
