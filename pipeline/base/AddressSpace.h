// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_AddressSpace_h
#define novelview_AddressSpace_h

#include <cstddef>
#include <string>

namespace novelview
{
/**
 * Throws Error ("out of memory") unless this process can have so many more bytes of address space.
 * Libraries that draw or start threads crash or hang where they get none, so they are asked for here
 * before, and given back at once. Costs nothing: no memory is touched.
 */
void RequireAddressSpace(const std::string& where, std::size_t bytes);

/** What the stacks of so many new threads take. */
std::size_t StackBytesOf(int threads);
}

#endif
