// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's sources.
#ifndef novelview_VideoContainer_h
#define novelview_VideoContainer_h

#include <filesystem>

namespace novelview
{
/**
 * Whether a video file is as long as the sizes in its own container say: AVI (RIFF), MP4 and MOV
 * (ISO base media), MKV (EBML). Encoders do not report a full disk, and the file that they leave
 * may still be played. False also for a file that is none of these.
 */
bool IsWholeVideo(const std::filesystem::path& file);
}

#endif
