// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_StderrSilence_h
#define novelview_StderrSilence_h

namespace novelview
{
/**
 * While one of these lives, what the process writes to its standard error is dropped. For libraries
 * that print about bad files on their own (libpng and libjpeg below OpenCV do, and cannot be told
 * not to); the caller says what is wrong. May be used by several threads at once.
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
