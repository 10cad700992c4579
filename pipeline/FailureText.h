// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_FailureText_h
#define novelview_FailureText_h

#include <exception>
#include <string>

namespace novelview
{
/** What an exception says, and for lack of memory or threads, our words and no library's. */
std::string FailureText(const std::exception& error);
}

#endif
