// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/VideoFile.h"

#include "base/AddressSpace.h"
#include "base/StderrSilence.h"
#include "core/Error.h"
#include "video/VideoContainer.h"
#include "video/VideoEncoder.h"

#include <dlfcn.h>
#include <malloc.h>

#include <map>
#include <sched.h>
#include <vector>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
/** The codecs that are tried for a file of each kind, the best known by players first. */
const std::map<std::string, std::vector<std::string>>& CodecsByExtension()
{
  static const std::map<std::string, std::vector<std::string>> codecs = {
    { ".avi", { "MJPG" } },
    { ".mkv", { "H264", "mp4v" } },
    { ".mov", { "avc1", "mp4v" } },
    { ".mp4", { "avc1", "mp4v" } },
  };
  return codecs;
}

/**
 * New memory is zero while it lives. The encoders' images have rows up to a multiple of sixteen;
 * those past the video's height are not filled, and they would appear in the file.
 */
class ZeroedMemory
{
public:
  ZeroedMemory() { FillWith(0xff); }
  ~ZeroedMemory() { FillWith(0); }
  ZeroedMemory(const ZeroedMemory&) = delete;
  ZeroedMemory& operator=(const ZeroedMemory&) = delete;

private:
  /** New memory contains the complement of this; 0 leaves it unset. */
  static void FillWith([[maybe_unused]] int complement)
  {
#ifdef M_PERTURB
    mallopt(M_PERTURB, complement);
#endif
  }
};

/**
 * While an object of this class exists, the thread and those it starts use one processor. An
 * encoder asks how many there are when it is opened, and writes another file with every number.
 */
class OneProcessor
{
public:
  OneProcessor()
  {
    this->Known = ::sched_getaffinity(0, sizeof(this->Before), &this->Before) == 0;
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0; this->Known && cpu < CPU_SETSIZE; ++cpu)
    {
      if (CPU_ISSET(cpu, &this->Before))
      {
        CPU_SET(cpu, &one);
        ::sched_setaffinity(0, sizeof(one), &one);
        break;
      }
    }
  }
  ~OneProcessor()
  {
    if (this->Known)
    {
      ::sched_setaffinity(0, sizeof(this->Before), &this->Before);
    }
  }
  OneProcessor(const OneProcessor&) = delete;
  OneProcessor& operator=(const OneProcessor&) = delete;

private:
  cpu_set_t Before{};
  bool Known = false;
};

using EncoderFactory = decltype(&NovelViewNewVideoEncoder);

#ifdef NOVELVIEW_VIDEO_LIBRARY
/** Loads the library of videos, which is looked for where those are that this one is linked to. */
EncoderFactory LoadEncoderFactory()
{
  const char* const name = NOVELVIEW_VIDEO_LIBRARY;
  RequireAddressSpace(name, std::size_t(192) << 20); // for ffmpeg, what it loads, and an encoder
  void* const library = ::dlopen(name, RTLD_NOW | RTLD_LOCAL);
  void* const factory = library ? ::dlsym(library, "NovelViewNewVideoEncoder") : nullptr;
  if (!factory)
  {
    const char* const reason = ::dlerror();
    throw Error(name, "the library that writes videos cannot be loaded",
      reason ? reason : "no reason given",
      "it and OpenCV's videoio, or a folder for single pictures");
  }
  return reinterpret_cast<EncoderFactory>(factory);
}
#else
EncoderFactory LoadEncoderFactory()
{
  return &NovelViewNewVideoEncoder;
}
#endif

std::unique_ptr<VideoEncoder> NewEncoder()
{
  static const EncoderFactory factory = LoadEncoderFactory(); // once; tried again after an Error
  return std::unique_ptr<VideoEncoder>(factory());
}
}

class VideoFile::Internals
{
public:
  fs::path Path;
  cv::Size Size;
  std::unique_ptr<VideoEncoder> Encoder;
  cv::Mat Padded;
  long Frames = 0;
};

bool IsVideoName(const fs::path& path)
{
  return CodecsByExtension().count(path.extension().string()) > 0;
}

std::string VideoExtensions()
{
  std::string text;
  for (const auto& [extension, codecs] : CodecsByExtension())
  {
    text += (text.empty() ? "" : ", ") + extension;
  }
  return text;
}

VideoFile::VideoFile(const fs::path& path, int width, int height, double fps)
  : Impl(std::make_unique<Internals>())
{
  this->Impl->Path = path;
  this->Impl->Size = cv::Size(width, height);
  this->Impl->Padded = cv::Mat::zeros(height + height % 2, width + width % 2, CV_8UC3);
  // Before the rest: libraries may count processors or start threads when they are loaded.
  this->Impl->Encoder = NewEncoder();
  const StderrSilence silence; // of libraries that tell which codecs they have not
  const OneProcessor one;
  const ZeroedMemory zeroed;
  std::string tried;
  const auto codecs = CodecsByExtension().find(path.extension().string());
  for (const std::string& codec :
    codecs == CodecsByExtension().end() ? std::vector<std::string>() : codecs->second)
  {
    tried += (tried.empty() ? "" : ", ") + codec;
    if (this->Impl->Encoder->Open(path.string(), codec, fps, this->Impl->Padded.size()))
    {
      return;
    }
  }
  throw Error(path.filename().string(), "no such video can be written: OpenCV has no codec for it",
    tried.empty() ? "none to try" : "tried " + tried,
    "another of " + VideoExtensions() + ", or a folder for single pictures");
}

VideoFile::~VideoFile() = default;

void VideoFile::Add(const ImageRef<const std::uint8_t>& frame)
{
  if (cv::Size(frame.Width, frame.Height) != this->Impl->Size || frame.Channels != 3)
  {
    throw Error("frame " + std::to_string(this->Impl->Frames), "is not of the video's size");
  }
  for (int y = 0; y < frame.Height; ++y)
  {
    auto* row = this->Impl->Padded.ptr<std::uint8_t>(y);
    for (int x = 0; x < frame.Width; ++x)
    {
      for (int channel = 0; channel < 3; ++channel)
      {
        row[3 * x + channel] = frame(x, y, 2 - channel);
      }
    }
  }
  const ZeroedMemory zeroed;
  this->Impl->Encoder->Write(this->Impl->Padded);
  ++this->Impl->Frames;
}

bool VideoFile::Close()
{
  const StderrSilence silence;
  // OpenCV does not say when it could not write, e.g. on a full disk.
  return this->Impl->Encoder->Close() == this->Impl->Frames && IsWholeVideo(this->Impl->Path);
}
}
