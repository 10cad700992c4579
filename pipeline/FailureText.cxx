// SPDX-License-Identifier: GPL-3.0-or-later
#include "FailureText.h"

#include <opencv2/core.hpp>

#include <new>
#include <string_view>
#include <system_error>

namespace novelview
{
std::string FailureText(const std::exception& error)
{
  if (dynamic_cast<const std::bad_alloc*>(&error))
  {
    return "out of memory";
  }
  if (const auto* opencv = dynamic_cast<const cv::Exception*>(&error);
      opencv && opencv->code == cv::Error::StsNoMem)
  {
    return "out of memory";
  }
  // A thread that cannot be started, mostly since there is no room for its stack; TBB has no more
  // than a text for that.
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if ((system && system->code() == std::errc::resource_unavailable_try_again) ||
    std::string_view(error.what()).starts_with("pthread_create has failed"))
  {
    return "out of memory, or no more threads are allowed";
  }
  return error.what();
}
}
