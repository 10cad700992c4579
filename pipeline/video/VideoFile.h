// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_VideoFile_h
#define novelview_VideoFile_h

#include "core/ImageRef.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace novelview
{
/**
 * Whether a path names a video by its extension: .mp4, .mov, .mkv (H.264, else MPEG-4 Part 2) or
 * .avi (Motion JPEG).
 */
bool IsVideoName(const std::filesystem::path& path);

/** The extensions of videos, for messages. */
std::string VideoExtensions();

/**
 * A video that is being written, through OpenCV. Images of odd size get a black row or column,
 * since most codecs want even ones. The same images give the same file, however many processors
 * there are, except for .mkv files, which contain a random identity.
 */
class VideoFile
{
public:
  /** Throws Error when none of the format's codecs is there, or the file cannot be made. */
  VideoFile(const std::filesystem::path& path, int width, int height, double fps);
  ~VideoFile();

  /** RGB, of the size given. Throws Error when it is of another. */
  void Add(const ImageRef<const std::uint8_t>& frame);

  /** Ends the file, and reads back whether all is in it. */
  bool Close();

private:
  class Internals;
  std::unique_ptr<Internals> Impl;
};
}

#endif
