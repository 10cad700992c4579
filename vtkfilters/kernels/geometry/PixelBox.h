// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PixelBox_h
#define novelview_PixelBox_h

namespace novelview
{
/** The pixels [XBegin, XEnd) x [YBegin, YEnd) of a frame. */
struct PixelBox
{
  int XBegin = 0, XEnd = 0, YBegin = 0, YEnd = 0;

  int Width() const { return this->XEnd - this->XBegin; }
  int Height() const { return this->YEnd - this->YBegin; }
  bool Empty() const { return this->XBegin >= this->XEnd || this->YBegin >= this->YEnd; }
};
}

#endif
