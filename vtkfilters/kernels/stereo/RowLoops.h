// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the plane sweep: its loops over a row, which are plain so that the compiler does several
// pixels at once. They are compiled for several processors, and so are called, not inlined.
#ifndef novelview_RowLoops_h
#define novelview_RowLoops_h

#include <cstdint>

namespace novelview
{
/** Where the rays of a row meet a neighbour; see PlaneSweepCost::Hits. */
struct RayRow
{
  const float* Base; ///< depths; of column 0, as are all others
  const float* Last;
  std::int32_t* First;
  std::int32_t* Nearest;
  std::int32_t* Down;
  float* Right;
};

/** A ray's way through a neighbour: Slope column + Start, times depth, plus End. */
struct RayWay
{
  float Slope[3], Start[3], End[3];
};

/** Projects the pixels [begin, end) of a row, moved by this offset, into a neighbour. */
void ProjectColumns(RayRow row, RayWay way, float offset, std::int32_t width, std::int32_t height,
  int begin, int end);

/** The pixels of a row: those of the reference, those of the neighbour, and what they give. */
struct PairRow
{
  const std::uint8_t* Red;
  const std::uint8_t* Green;
  const std::uint8_t* Blue;
  const std::uint8_t* Luma;
  const float* Picked;         ///< R, G, B, luma of the neighbour, times 128
  const std::int32_t* Nearest; ///< negative where there is none
  std::uint8_t* Count;
  std::uint8_t* KeyLuma;
  std::uint8_t* OtherLuma;
  std::uint8_t* Difference;
};

/** Compares the pixels [begin, end) of a row. */
void CompareColumns(PairRow row, float levelsPerGrey, int begin, int end);

/** sums[i] += entering[i] - leaving[i]. */
void AddChange(std::uint16_t* __restrict sums, const std::uint8_t* __restrict entering,
  const std::uint8_t* __restrict leaving, int begin, int end);

/** The same for products of two factors. */
void AddChange(std::int32_t* __restrict sums, const std::uint8_t* __restrict enteringA,
  const std::uint8_t* __restrict enteringB, const std::uint8_t* __restrict leavingA,
  const std::uint8_t* __restrict leavingB, int begin, int end);

/** What CostsOfColumns needs to know. */
struct CostRule
{
  float MinCount;
  float ShareOfColor;
  float Noise;
};

/** Sums over the columns of each sort. */
struct ColumnSums
{
  const std::uint16_t* Count;
  const std::uint16_t* Reference;
  const std::uint16_t* Other;
  const std::uint16_t* Difference;
  const std::int32_t* Reference2;
  const std::int32_t* Other2;
  const std::int32_t* Product;
};

/** Costs of the windows of side `side` that begin at the columns [begin, end). */
void CostsOfColumns(
  const ColumnSums& sums, const CostRule& rule, int side, int begin, int end, std::int16_t* costs);
}

#endif
