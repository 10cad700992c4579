// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_tests_MessageOf_h
#define novelview_tests_MessageOf_h

#include "core/Error.h"

#include <string>

namespace novelview
{
/** The message of the Error that `body` throws; empty when it throws none. */
template <class Body>
std::string MessageOf(const Body& body)
{
  try
  {
    body();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return {};
}
}

#endif
