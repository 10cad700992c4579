// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PlyHeader_h
#define novelview_PlyHeader_h

#include "base/TextLines.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace novelview
{
/** How a PLY file writes its numbers. */
enum class PlyEncoding
{
  Ascii,
  LittleEndian,
  BigEndian
};

/** A type of numbers in a PLY file. */
struct PlyType
{
  int Size = 0; ///< bytes; 0 = no type
  enum
  {
    Signed,
    Unsigned,
    Float
  } Kind = Signed;

  bool IsInteger() const { return this->Kind != Float; }
};

/** A number, or a list of numbers, that each instance of an element has. */
struct PlyProperty
{
  std::string Name;
  PlyType Type;
  PlyType CountType; ///< of a list; Size 0 = no list

  bool IsList() const { return this->CountType.Size > 0; }
};

/** Things of one kind, such as the vertices. */
struct PlyElement
{
  std::string Name;
  std::string Where; ///< the line that announces it
  std::uint64_t Count = 0;
  std::vector<PlyProperty> Properties;
};

/** What a PLY file states about itself. */
struct PlyHeader
{
  PlyEncoding Encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> Elements; ///< in the order of their data
};

/** Reads a header and stops behind its last line. Throws Error, with the line. */
PlyHeader ReadPlyHeader(TextLines& lines);
}

#endif
