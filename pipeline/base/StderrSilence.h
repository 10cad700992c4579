// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_StderrSilence_h
#define novelview_StderrSilence_h

namespace novelview
{
/**
 * While an object of this class exists, the standard error of the process is discarded. For
 * libraries that print about bad files on their own (libpng and libjpeg below OpenCV do, and this
 * cannot be switched off); the caller reports the error. May be used by several threads at the same
 * time.
 */
class StderrSilence
{
public:
  StderrSilence();
  ~StderrSilence();
  StderrSilence(const StderrSilence&) = delete;
  StderrSilence& operator=(const StderrSilence&) = delete;
};

/** Where errors can be written all the same, for the last words of a process: a file descriptor. */
int LoudStderr();
}

#endif
