// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/AddressSpace.h"

#include "core/Error.h"

#include <sys/mman.h>
#include <sys/resource.h>

namespace novelview
{
namespace
{
constexpr std::size_t MiB = std::size_t(1) << 20;
}

void RequireAddressSpace(const std::string& where, std::size_t bytes)
{
  void* place =
    ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED)
  {
    throw Error(where,
      "out of memory: " + std::to_string(bytes / MiB) +
        " MiB more of address space are needed (ulimit -v)");
  }
  ::munmap(place, bytes);
}

std::size_t StackBytesOf(int threads)
{
  rlimit limit{};
  const bool known = ::getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return static_cast<std::size_t>(threads) * (known ? limit.rlim_cur : 8 * MiB);
}
}
