// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/Subsamples.h"

#include "geometry/DepthImage.h"

#include <limits>

namespace novelview
{
SubsampleGrid::SubsampleGrid(int perSide)
  : PerSide(perSide)
  , Stride((perSide + 3) / 4 * 4)
  , Offset(this->Stride, std::numeric_limits<double>::quiet_NaN())
{
  for (int i = 0; i < perSide; ++i)
  {
    this->Offset[i] = (i + 0.5) / perSide - 0.5;
  }
}

Subsamples::Subsamples(const Image<std::uint8_t>& chosen, int perSide)
  : Grid(perSide)
  , Index(chosen.Width, chosen.Height, 1, -1)
{
  for (std::size_t i = 0; i < chosen.Values.size(); ++i)
  {
    if (chosen.Values[i])
    {
      this->Index.Values[i] = this->Pixels++;
    }
  }
  const std::size_t size = static_cast<std::size_t>(this->Pixels) * perSide * this->Grid.Stride;
  this->CellId.assign(size, -1);
  this->Depth.assign(size, NoDepth);
}
}
