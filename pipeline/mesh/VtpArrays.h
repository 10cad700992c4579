// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_VtpArrays_h
#define novelview_VtpArrays_h

#include "mesh/VtpBytes.h"
#include "mesh/VtpDocument.h"

#include <cstdint>
#include <vector>

namespace novelview
{
/**
 * Reads the arrays of a VTP file, however they are written: as text, or as bytes in base64 or raw,
 * whole or in compressed blocks. Never takes more memory than a small multiple of the file's size, or,
 * for compressed arrays, than the best compression allows.
 */
class VtpArrays
{
public:
  /** The document must outlive the object. Throws Error when the file's attributes are unknown. */
  explicit VtpArrays(const VtpDocument& document);

  /** The numbers of an element DataArray, of any type. Throws Error when they are not as many. */
  std::vector<double> ReadNumbers(
    const pugi::xml_node& array, std::uint64_t tuples, std::uint64_t components) const;

  /** The same for an array of a type of integers, one after the other. */
  std::vector<std::int64_t> ReadIntegers(const pugi::xml_node& array, std::uint64_t count) const;

private:
  template <class T>
  std::vector<T> Read(
    const pugi::xml_node& array, std::uint64_t tuples, std::uint64_t components) const;

  const VtpDocument& Document;
  const VtpBytes Bytes;
};
}

#endif
