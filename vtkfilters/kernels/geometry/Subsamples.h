// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Subsamples_h
#define novelview_Subsamples_h

#include "core/ImageRef.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace novelview
{
/** An evenly spaced grid of rays through a pixel, PerSide x PerSide. */
struct SubsampleGrid
{
  int PerSide;
  int Stride; ///< PerSide up to a multiple of four; the rays beyond hit nothing
  /** Where ray i of a row, or row i, lies from the pixel's centre, pixels; Stride of them. */
  std::vector<double> Offset;

  explicit SubsampleGrid(int perSide);
};

/** What a grid of rays through each of some pixels hits. */
struct Subsamples
{
  SubsampleGrid Grid;
  int Pixels = 0;   ///< how many have subsamples
  Image<int> Index; ///< which of them a pixel is, -1 = none
  /** From First() on, PerSide rows of Stride: front triangle (-1 = background) and its depth. */
  std::vector<int> CellId;
  std::vector<float> Depth;

  /** Subsamples through the pixels that are not 0 in `chosen`; they hit nothing yet. */
  Subsamples(const Image<std::uint8_t>& chosen, int perSide);

  /** The first subsample of a pixel that has some. */
  std::size_t First(int x, int y) const
  {
    return static_cast<std::size_t>(this->Index(x, y)) * this->Grid.PerSide * this->Grid.Stride;
  }
};
}

#endif
