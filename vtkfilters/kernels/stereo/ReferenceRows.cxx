// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/ReferenceRows.h"

#include <algorithm>

namespace novelview
{
ReferenceRows::ReferenceRows(const MatchImage& reference, const Image<float>& base,
  const Image<float>& last, const PixelBox& box, int radius)
  : Cam(reference.Cam)
  , Box(box)
  , Radius(radius)
  , Width(box.Width() + 2 * radius)
  , Spans(box.Height() + 2 * radius)
{
  const std::size_t size = this->Spans.size() * this->Width;
  this->Base.assign(size, 0.f);
  this->Last.assign(size, 0.f);
  for (auto* channel : { &this->Red, &this->Green, &this->Blue, &this->Luma })
  {
    channel->assign(size, 0);
  }
  for (int y = -radius; y < box.Height() + radius; ++y)
  {
    if (box.YBegin + y >= 0 && box.YBegin + y < base.Height)
    {
      this->ReadRow(reference, base, last, y);
    }
  }
}

void ReferenceRows::ReadRow(
  const MatchImage& reference, const Image<float>& base, const Image<float>& last, int y)
{
  Span& span = this->Spans[y + this->Radius];
  const std::size_t row = static_cast<std::size_t>(y + this->Radius) * this->Width;
  const int frameY = this->Box.YBegin + y;
  for (int i = 0; i < this->Width; ++i)
  {
    const int frameX = this->Box.XBegin - this->Radius + i;
    if (frameX < 0 || frameX >= base.Width || base(frameX, frameY) <= 0)
    {
      continue;
    }
    this->Base[row + i] = base(frameX, frameY);
    this->Last[row + i] = last(frameX, frameY);
    this->Red[row + i] = reference.Pixels(frameX, frameY, 0);
    this->Green[row + i] = reference.Pixels(frameX, frameY, 1);
    this->Blue[row + i] = reference.Pixels(frameX, frameY, 2);
    this->Luma[row + i] = reference.Pixels(frameX, frameY, 3);
    span = { span.Empty() ? i : span.Begin, i + 1, std::max(span.Last, last(frameX, frameY)) };
  }
}
}
