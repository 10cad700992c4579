// SPDX-License-Identifier: GPL-3.0-or-later
// Private to MpiProcessGroup. Compiled only where there is MPI.
#ifndef novelview_MpiMessages_h
#define novelview_MpiMessages_h

#include "processes/ProcessGroup.h"

#include <string>
#include <string_view>

namespace novelview
{
/** A result as bytes, for a message. */
std::string Packed(const WorkResult& result);

/** The result of Packed(). Throws Error when the bytes are too few. */
WorkResult Unpacked(std::string_view bytes);
}

#endif
