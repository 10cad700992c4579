// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_AddressSpace_h
#define novelview_AddressSpace_h

#include <cstddef>
#include <string>

namespace novelview
{
/**
 * Throws Error ("out of memory") unless this process can reserve this many more bytes of address
 * space. Libraries that draw or start threads crash or hang without it, so it is reserved here
 * before, and released immediately. Costs nothing: no memory is touched.
 */
void RequireAddressSpace(const std::string& where, std::size_t bytes);

/** Size of the stacks of this many new threads, bytes. */
std::size_t StackBytesOf(int threads);
}

#endif
