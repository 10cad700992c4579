// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PlyValues_h
#define novelview_PlyValues_h

#include "mesh/PlyHeader.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace novelview
{
/** The numbers behind the header of a PLY file, one after the other. All throw Error at the end. */
class PlyValues
{
public:
  virtual ~PlyValues() = default;

  /** Before the first and behind the last number of an instance: in ascii files, a line. */
  virtual void BeginInstance() = 0;
  virtual void EndInstance() = 0;

  virtual double Take(const PlyType& type) = 0;

  /** Passes over the numbers of a list. */
  virtual void Skip(std::int64_t count, const PlyType& type) = 0;

  /** Throws Error when what is left of the file cannot contain all instances of the element. */
  virtual void CheckLength(const PlyElement& element) const = 0;

  /** Throws Error when there is more than blanks. */
  virtual void Finish() = 0;

  /** File, and line or byte. */
  virtual std::string Where() const = 0;
};

/** `lines` stands behind the header of the file with these bytes; both must outlive the result. */
std::unique_ptr<PlyValues> MakePlyValues(
  PlyEncoding encoding, std::string_view bytes, TextLines& lines);
}

#endif
