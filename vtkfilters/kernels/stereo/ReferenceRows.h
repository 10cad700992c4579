// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ReferenceRows_h
#define novelview_ReferenceRows_h

#include "core/ImageRef.h"
#include "geometry/Camera.h"
#include "geometry/PixelBox.h"
#include "stereo/MatchImage.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace novelview
{
/**
 * A box of the reference photograph with a margin of the window's radius all around, channel by channel.
 * Column i, row y of it is the frame's pixel (XBegin - Radius + i, YBegin + y), y from -Radius.
 */
class ReferenceRows
{
public:
  ReferenceRows(const MatchImage& reference, const Image<float>& base, const Image<float>& last,
    const PixelBox& box, int radius);

  /** The columns between the first and the last pixel with a base, end excluded. */
  struct Span
  {
    int Begin = 0, End = 0;
    float Last = 0; ///< largest offset that makes sense anywhere in the row
    bool Empty() const { return this->Begin >= this->End; }
  };
  const Span& SpanOf(int y) const { return this->Spans[y + this->Radius]; }

  /** Of column 0 of a row. */
  template <class T>
  const T* Row(const std::vector<T>& values, int y) const
  {
    return values.data() + static_cast<std::size_t>(y + this->Radius) * this->Width;
  }

  const Camera Cam;
  const PixelBox Box;
  const int Radius;
  const int Width; ///< with the margins
  std::vector<float> Base, Last;
  std::vector<std::uint8_t> Red, Green, Blue, Luma;

private:
  void ReadRow(
    const MatchImage& reference, const Image<float>& base, const Image<float>& last, int y);

  std::vector<Span> Spans;
};
}

#endif
