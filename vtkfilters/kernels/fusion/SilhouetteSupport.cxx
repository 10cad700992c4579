// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/SilhouetteSupport.h"

#include "geometry/DepthImage.h"

#include <cmath>
#include <utility>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Follows the rays of one photograph's contour. */
class ContourFollower
{
public:
  ContourFollower(const View& view, const TsdfField& field, const TriangleMesh& hull,
    double footprint, const SilhouetteSupportOptions& options)
    : Source(view)
    , Field(field)
    , Footprint(footprint)
    , Options(options)
    , Hull(RasteriseRange(hull, view.Cam))
    , Centre(view.Cam.Centre())
    , Looked(view.Cam.Width, view.Cam.Height)
    , Depths(view.Cam.Width, view.Cam.Height)
  {
  }

  std::vector<SupportPoint> Find(const Execution& execution)
  {
    for (int y = 0; y < this->Looked.Height; ++y)
    {
      execution.CheckCancelled();
      for (int x = 0; x < this->Looked.Width; ++x)
      {
        const double inside = this->Source.ContourDistance(x, y) - this->Options.FirstPx;
        if (inside >= 0 && inside < this->Options.RingPx)
        {
          this->LookFrom(x, y);
        }
      }
    }
    return this->AgreeingPoints();
  }

private:
  /** Looks at a pixel and, while pixels miss the object, at those around them. */
  void LookFrom(int x, int y)
  {
    this->Open.assign(1, { x, y });
    while (!this->Open.empty())
    {
      const auto [i, j] = this->Open.back();
      this->Open.pop_back();
      if (std::exchange(this->Looked(i, j), 1) || !this->Misses(i, j))
      {
        continue;
      }
      for (const auto& [di, dj] : { std::pair(-1, 0), { 1, 0 }, { 0, -1 }, { 0, 1 } })
      {
        if (this->Looked.Ref().Contains(i + di, j + dj))
        {
          const double inside = this->Source.ContourDistance(i + di, j + dj);
          if (inside >= this->Options.FirstPx && inside <= this->Options.LastPx)
          {
            this->Open.emplace_back(i + di, j + dj);
          }
        }
      }
    }
  }

  /** Whether the ray of a pixel misses the object; then a point on it may be asked for. */
  bool Misses(int x, int y)
  {
    const double front = this->Hull.Nearest(x, y);
    if (!std::isfinite(front))
    {
      return false;
    }
    const Vector3d direction = this->Source.Cam.Unproject(Vector2d(x, y), 1) - this->Centre;
    const double from = front - 1.5 * this->Footprint;
    const double to = this->Hull.Farthest(x, y) + 1.5 * this->Footprint;
    const double step = 2 * this->Footprint;
    if (this->Field.FindFirstCrossing(this->Centre, direction, from, to, step).Min < 0)
    {
      return false;
    }
    if (this->Field.PriorNeeded(this->Centre, direction, from, to, step, 0) <=
      this->Options.MaxPrior)
    {
      this->Depths(x, y) = static_cast<float>(
        this->Field.FindClosestApproach(this->Centre, direction, from, to, this->Footprint).At);
    }
    return true;
  }

  std::vector<SupportPoint> AgreeingPoints() const
  {
    std::vector<SupportPoint> points;
    for (int y = 0; y < this->Depths.Height; ++y)
    {
      for (int x = 0; x < this->Depths.Width; ++x)
      {
        if (this->Depths(x, y) > 0 && this->Agrees(x, y))
        {
          points.push_back({ this->Source.Cam.Unproject(Vector2d(x, y), this->Depths(x, y)),
            this->Source.ContourDistance(x, y) });
        }
      }
    }
    return points;
  }

  /** Whether enough of the points of the pixels around lie about as deep, and half of them. */
  bool Agrees(int x, int y) const
  {
    int count = 0;
    int agree = 0;
    for (int j = y - 1; j <= y + 1; ++j)
    {
      for (int i = x - 1; i <= x + 1; ++i)
      {
        if ((i != x || j != y) && this->Depths.Ref().Contains(i, j) && this->Depths(i, j) > 0)
        {
          ++count;
          agree += std::abs(this->Depths(i, j) - this->Depths(x, y)) <
            this->Options.AgreementPx * this->Footprint;
        }
      }
    }
    return agree >= this->Options.MinAgreeing && 2 * agree >= count;
  }

  const View& Source;
  const TsdfField& Field;
  const double Footprint;
  const SilhouetteSupportOptions& Options;
  const DepthRange Hull;
  const Vector3d Centre;
  Image<std::uint8_t> Looked;
  std::vector<std::pair<int, int>> Open;
  Image<float> Depths; ///< of the points asked for; 0 = none
};
}

std::vector<SupportPoint> FindSilhouetteSupport(const std::vector<View>& views,
  const TsdfField& field, const TriangleMesh& hull, double footprint,
  const SilhouetteSupportOptions& options, const Execution& execution)
{
  std::vector<std::vector<SupportPoint>> ofView(views.size());
  execution.ForEach(static_cast<std::int64_t>(views.size()),
    [&](std::int64_t i)
    { ofView[i] = ContourFollower(views[i], field, hull, footprint, options).Find(execution); });
  std::vector<SupportPoint> points;
  for (const std::vector<SupportPoint>& some : ofView)
  {
    points.insert(points.end(), some.begin(), some.end());
  }
  return points;
}
}
