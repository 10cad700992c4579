// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_UsageError_h
#define novelview_UsageError_h

#include "core/Error.h"

namespace novelview
{
/** The user gave an unknown option or an invalid value. */
class UsageError : public Error
{
public:
  using Error::Error;
  explicit UsageError(const Error& error)
    : Error(error)
  {
  }
};
}

#endif
