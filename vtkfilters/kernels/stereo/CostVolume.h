// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CostVolume_h
#define novelview_CostVolume_h

#include "geometry/PixelBox.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace novelview
{
/** The offsets from the base surface, world units of depth, that are tried at every pixel. */
struct DepthHypotheses
{
  double First = 0;
  double Step = 1;
  int Count = 0;
  double Offset(double label) const { return this->First + this->Step * label; }
};

/** Costs of every offset at every pixel of a box: ((y * Labels + label) * Width + x). */
struct CostVolume
{
  static constexpr int Unit = 1024; ///< stands for a cost of 1

  PixelBox Box;
  DepthHypotheses Labels;
  std::vector<std::int16_t> Costs;

  std::int16_t* Row(int y, int label) { return this->Costs.data() + this->RowOffset(y, label); }
  const std::int16_t* Row(int y, int label) const
  {
    return this->Costs.data() + this->RowOffset(y, label);
  }
  std::size_t RowOffset(int y, int label) const
  {
    return (static_cast<std::size_t>(y) * this->Labels.Count + label) * this->Box.Width();
  }
};
}

#endif
