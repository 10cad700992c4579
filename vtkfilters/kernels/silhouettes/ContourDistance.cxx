// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/ContourDistance.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Mask = ImageRef<const std::uint8_t>;

/** How far a soft edge may reach to either side of its crossing. */
constexpr int SoftEdgePx = 3;
/** How far around each segment the distances to it are taken directly. */
constexpr int SeedPx = 2;

/** A straight bit of the contour, inside the cell between four pixel centres. */
struct Segment
{
  Vector2d From;
  Vector2d To;
  int X = 0; ///< the cell's top-left pixel
  int Y = 0;

  double SquaredDistanceTo(const Vector2d& point) const
  {
    const Vector2d along = this->To - this->From;
    const Vector2d offset = point - this->From;
    const double squaredLength = along.squaredNorm();
    const double t =
      squaredLength > 0 ? std::clamp(offset.dot(along) / squaredLength, 0.0, 1.0) : 0.0;
    return (offset - t * along).squaredNorm();
  }
};

bool IsInside(const Mask& mask, int x, int y)
{
  return mask(x, y) > 127;
}

/** Coverage along the line through two opposite pixels, rising: 0 = the last one outside. */
class Profile
{
public:
  Profile(const Mask& mask, int x, int y, int stepX, int stepY)
    : Source(mask)
    , X(x)
    , Y(y)
    , StepX(stepX)
    , StepY(stepY)
  {
  }

  /** Where the coverage crosses 0.5, from the pixel outside (0) to the one inside (1). */
  double Crossing() const
  {
    const double outside = this->At(0);
    const double inside = this->At(1);
    const int low = this->Follow(0, -1, 0.0);
    const int high = this->Follow(1, 1, 1.0);
    if (low > 0 || high < 1)
    {
      return (0.5 - outside) / (inside - outside);
    }
    // The same area under a step from 0 to 1 puts the step here.
    double area = 0;
    for (int i = low; i <= high; ++i)
    {
      area += this->At(i);
    }
    return std::clamp(high + 0.5 - area, 0.0, 1.0);
  }

private:
  bool Contains(int i) const
  {
    return this->Source.Contains(this->X + i * this->StepX, this->Y + i * this->StepY);
  }
  double At(int i) const
  {
    return this->Source(this->X + i * this->StepX, this->Y + i * this->StepY) / 255.0;
  }
  /** Walks monotonically to the plateau; returns its index, or start - step without one. */
  int Follow(int start, int step, double plateau) const
  {
    double last = this->At(start);
    for (int i = start; std::abs(i - start) <= SoftEdgePx && this->Contains(i); i += step)
    {
      const double value = this->At(i);
      if (value == plateau)
      {
        return i;
      }
      if ((value - last) * step < 0)
      {
        break;
      }
      last = value;
    }
    return start - step;
  }

  const Mask& Source;
  int X;
  int Y;
  int StepX;
  int StepY;
};

/** Where the contour crosses between a pixel and its right (or lower) neighbour. */
Vector2d CrossingBetween(const Mask& mask, int x, int y, bool vertical)
{
  const int axis = vertical ? 1 : 0;
  const bool rising = !IsInside(mask, x, y);
  const int step = rising ? 1 : -1;
  const Profile profile(mask, rising || vertical ? x : x + 1, rising || !vertical ? y : y + 1,
    vertical ? 0 : step, vertical ? step : 0);
  const double crossing = profile.Crossing();
  Vector2d point(x, y);
  point[axis] += rising ? crossing : 1 - crossing;
  return point;
}

/** Marching squares on the cell below and to the right of a pixel centre. */
void AppendCell(const Mask& mask, int x, int y, std::vector<Segment>& segments)
{
  const bool inside[4] = { IsInside(mask, x, y), IsInside(mask, x + 1, y),
    IsInside(mask, x + 1, y + 1), IsInside(mask, x, y + 1) };
  // Sides in the same order: top, right, bottom, left.
  Vector2d crossing[4];
  int crossed[4];
  int count = 0;
  for (int side = 0; side < 4; ++side)
  {
    if (inside[side] != inside[(side + 1) % 4])
    {
      crossing[side] =
        CrossingBetween(mask, side == 1 ? x + 1 : x, side == 2 ? y + 1 : y, side % 2);
      crossed[count++] = side;
    }
  }
  if (count == 2)
  {
    segments.push_back({ crossing[crossed[0]], crossing[crossed[1]], x, y });
  }
  else if (count == 4)
  {
    // A saddle: the pair of corners that the middle belongs to stays connected.
    const int sum = mask(x, y) + mask(x + 1, y) + mask(x, y + 1) + mask(x + 1, y + 1);
    const int first = (sum > 2 * 255) == inside[0] ? 0 : 3;
    segments.push_back({ crossing[first], crossing[(first + 1) % 4], x, y });
    segments.push_back({ crossing[(first + 2) % 4], crossing[(first + 3) % 4], x, y });
  }
}

std::vector<Segment> FindSegments(const Mask& mask)
{
  std::vector<Segment> segments;
  for (int y = 0; y + 1 < mask.Height; ++y)
  {
    for (int x = 0; x + 1 < mask.Width; ++x)
    {
      AppendCell(mask, x, y, segments);
    }
  }
  return segments;
}

/** Per pixel the nearest segment found so far, and the squared distance to it. */
class NearestSegments
{
public:
  NearestSegments(const std::vector<Segment>& segments, int width, int height)
    : Segments(segments)
    , Nearest(width, height, 1, -1)
    , Squared(width, height, 1, std::numeric_limits<double>::infinity())
  {
  }

  /** The exact answer next to the contour. */
  void Seed()
  {
    for (std::size_t i = 0; i < this->Segments.size(); ++i)
    {
      const Segment& segment = this->Segments[i];
      for (int y = segment.Y - SeedPx; y <= segment.Y + 1 + SeedPx; ++y)
      {
        for (int x = segment.X - SeedPx; x <= segment.X + 1 + SeedPx; ++x)
        {
          if (x >= 0 && y >= 0 && x < this->Nearest.Width && y < this->Nearest.Height)
          {
            this->Try(x, y, static_cast<int>(i));
          }
        }
      }
    }
  }

  /**
   * Hands the nearest segments on from pixel to pixel, down and up the rows (Danielsson 1980, with
   * eight neighbours and distances to the segments themselves).
   */
  void Spread()
  {
    for (int y = 0; y < this->Nearest.Height; ++y)
    {
      this->SpreadRow(y, -1);
    }
    for (int y = this->Nearest.Height - 1; y >= 0; --y)
    {
      this->SpreadRow(y, 1);
    }
  }

  double Distance(int x, int y) const { return std::sqrt(this->Squared(x, y)); }

private:
  void Try(int x, int y, int segmentId)
  {
    if (segmentId < 0 || segmentId == this->Nearest(x, y))
    {
      return;
    }
    const double squared = this->Segments[segmentId].SquaredDistanceTo(Vector2d(x, y));
    if (squared < this->Squared(x, y))
    {
      this->Squared(x, y) = squared;
      this->Nearest(x, y) = segmentId;
    }
  }
  /** One row, from the row at y + dy and then along itself both ways. */
  void SpreadRow(int y, int dy)
  {
    const int width = this->Nearest.Width;
    if (y + dy >= 0 && y + dy < this->Nearest.Height)
    {
      const int* before = &this->Nearest(0, y + dy);
      for (int x = 0; x < width; ++x)
      {
        const int left = before[std::max(x - 1, 0)];
        const int right = before[std::min(x + 1, width - 1)];
        this->Try(x, y, left);
        if (before[x] != left)
        {
          this->Try(x, y, before[x]);
        }
        if (right != before[x])
        {
          this->Try(x, y, right);
        }
      }
    }
    const int* row = &this->Nearest(0, y);
    for (int x = 1; x < width; ++x)
    {
      this->Try(x, y, row[x - 1]);
    }
    for (int x = width - 2; x >= 0; --x)
    {
      this->Try(x, y, row[x + 1]);
    }
  }

  const std::vector<Segment>& Segments;
  Image<int> Nearest;
  Image<double> Squared;
};
}

Image<float> SignedContourDistance(const ImageRef<const std::uint8_t>& mask)
{
  const std::vector<Segment> segments = FindSegments(mask);
  NearestSegments nearest(segments, mask.Width, mask.Height);
  nearest.Seed();
  nearest.Spread();
  const double diagonal = std::hypot(mask.Width, mask.Height);
  Image<float> distance(mask.Width, mask.Height);
  for (int y = 0; y < mask.Height; ++y)
  {
    for (int x = 0; x < mask.Width; ++x)
    {
      const double here = segments.empty() ? diagonal : nearest.Distance(x, y);
      distance(x, y) = static_cast<float>(IsInside(mask, x, y) ? here : -here);
    }
  }
  return distance;
}
}
