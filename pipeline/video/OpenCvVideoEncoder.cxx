// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/VideoEncoder.h"

#include <opencv2/videoio.hpp>

namespace
{
class OpenCvVideoEncoder : public novelview::VideoEncoder
{
public:
  bool Open(
    const std::string& path, const std::string& codec, double fps, const cv::Size& size) override
  {
    this->Path = path;
    const int fourcc = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
    try
    {
      return this->Writer.open(path, fourcc, fps, size);
    }
    catch (const cv::Exception&)
    {
      return false;
    }
  }

  void Write(const cv::Mat& picture) override { this->Writer.write(picture); }

  long Close() override
  {
    this->Writer.release();
    cv::VideoCapture written(this->Path);
    long frames = 0;
    while (written.isOpened() && written.grab())
    {
      ++frames;
    }
    return frames;
  }

private:
  std::string Path;
  cv::VideoWriter Writer;
};
}

novelview::VideoEncoder* NovelViewNewVideoEncoder()
{
  return new OpenCvVideoEncoder;
}
