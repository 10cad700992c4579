// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/PointTracks.h"

#include "geometry/ViewSelection.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <optional>

namespace novelview
{
namespace
{
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Image<float> Grey(const View& view)
{
  Image<float> grey(view.Cam.Width, view.Cam.Height);
  for (int y = 0; y < grey.Height; ++y)
  {
    for (int x = 0; x < grey.Width; ++x)
    {
      const std::uint8_t* rgb = view.Color.Pixel(x, y);
      grey(x, y) = static_cast<float>(0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]);
    }
  }
  return grey;
}

/** A square of grey values without their mean, and their length. */
struct Patch
{
  std::vector<float> Values;
  double Norm = 0;
};

class TrackFinder
{
public:
  TrackFinder(
    const std::vector<View>& views, const PointTrackOptions& options, const Execution& execution)
    : Views(views)
    , Options(options)
    , Run(execution)
    , Neighbours(NearestNeighbours(views, options.Neighbours))
    , Greys(views.size())
  {
    this->Run.ForEach(static_cast<std::int64_t>(views.size()),
      [&](std::int64_t i) { this->Greys[i] = Grey(views[i]); });
  }

  std::vector<PointTrack> Find() const
  {
    std::vector<std::vector<PointTrack>> ofView(this->Views.size());
    this->Run.ForEach(static_cast<std::int64_t>(this->Views.size()),
      [&](std::int64_t i) { ofView[i] = this->TracksOf(static_cast<int>(i)); });
    std::vector<PointTrack> tracks;
    for (std::vector<PointTrack>& some : ofView)
    {
      tracks.insert(tracks.end(), some.begin(), some.end());
    }
    return tracks;
  }

private:
  std::vector<PointTrack> TracksOf(int viewId) const
  {
    std::vector<PointTrack> tracks;
    const View& view = this->Views[viewId];
    const int cell = this->Options.CellPx;
    for (int top = 0; top < view.Cam.Height; top += cell)
    {
      this->Run.CheckCancelled();
      for (int left = 0; left < view.Cam.Width; left += cell)
      {
        if (const auto corner = this->CornerIn(viewId, left, top))
        {
          PointTrack track = this->TrackOf(viewId, corner->x(), corner->y());
          if (track.Observations.size() > 1)
          {
            tracks.push_back(std::move(track));
          }
        }
      }
    }
    return tracks;
  }

  /** The pixel of the cell with the strongest corner, if any is strong enough to be found again. */
  std::optional<Eigen::Vector2i> CornerIn(int viewId, int left, int top) const
  {
    const View& view = this->Views[viewId];
    const int margin = this->Options.WindowRadius + 1;
    std::optional<Eigen::Vector2i> best;
    double strongest = this->Options.MinContrast * this->Options.MinContrast;
    const int right = std::min(left + this->Options.CellPx, view.Cam.Width - margin);
    const int bottom = std::min(top + this->Options.CellPx, view.Cam.Height - margin);
    for (int y = std::max(top, margin); y < bottom; y += 2)
    {
      for (int x = std::max(left, margin); x < right; x += 2)
      {
        if (view.DepthMap(x, y) > 0 && view.Confidence(x, y) > 0 && this->AllObject(view, x, y))
        {
          const double strength = this->Strength(this->Greys[viewId], x, y);
          if (strength > strongest)
          {
            strongest = strength;
            best = Eigen::Vector2i(x, y);
          }
        }
      }
    }
    return best;
  }

  bool AllObject(const View& view, int x, int y) const
  {
    const int r = this->Options.WindowRadius;
    return view.IsObject(x - r, y - r) && view.IsObject(x + r, y - r) &&
      view.IsObject(x - r, y + r) && view.IsObject(x + r, y + r);
  }

  /** The smaller eigenvalue of the mean structure tensor of the window. */
  double Strength(const Image<float>& grey, int x, int y) const
  {
    double xx = 0;
    double xy = 0;
    double yy = 0;
    const int r = this->Options.WindowRadius;
    for (int j = -r; j <= r; ++j)
    {
      for (int i = -r; i <= r; ++i)
      {
        const double dx = 0.5 * (grey(x + i + 1, y + j) - grey(x + i - 1, y + j));
        const double dy = 0.5 * (grey(x + i, y + j + 1) - grey(x + i, y + j - 1));
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
      }
    }
    const double count = (2 * r + 1) * (2 * r + 1);
    return ((xx + yy) / 2 - std::hypot((xx - yy) / 2, xy)) / count;
  }

  PointTrack TrackOf(int viewId, int x, int y) const
  {
    PointTrack track;
    const View& view = this->Views[viewId];
    const Vector2d pixel(x, y);
    Vector3d normal;
    if (!this->TangentPlane(view, x, y, track.Position, normal))
    {
      return track;
    }
    track.Observations.push_back({ viewId, pixel });
    const Patch reference = this->PatchAt(
      [&](int i, int j) { return this->Greys[viewId](x + i, y + j); }, this->Options.WindowRadius);
    for (const int other : this->Neighbours[viewId])
    {
      Vector2d found;
      if (this->Sees(this->Views[other], track.Position, normal) &&
        this->Search(reference, view, pixel, track.Position, normal, other, found))
      {
        track.Observations.push_back({ other, found });
      }
    }
    return track;
  }

  /** The point of the surface at a pixel, and its normal, towards the camera. */
  bool TangentPlane(const View& view, int x, int y, Vector3d& point, Vector3d& normal) const
  {
    const double depth = view.DepthMap(x, y);
    point = view.Cam.Unproject(Vector2d(x, y), depth);
    const double reach = 8 * view.Cam.PixelFootprint(depth);
    std::vector<Vector3d> around;
    for (int j = -6; j <= 6; j += 2)
    {
      for (int i = -6; i <= 6; i += 2)
      {
        const double other =
          view.DepthMap.Contains(x + i, y + j) ? view.DepthMap(x + i, y + j) : 0.f;
        if (other > 0 && std::abs(other - depth) < reach)
        {
          around.push_back(view.Cam.Unproject(Vector2d(x + i, y + j), other));
        }
      }
    }
    if (around.size() < 25)
    {
      return false;
    }
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& p : around)
    {
      mean += p / static_cast<double>(around.size());
    }
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const Vector3d& p : around)
    {
      scatter += (p - mean) * (p - mean).transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(scatter);
    normal = solver.eigenvectors().col(0);
    const Vector3d towards = (view.Cam.Centre() - point).normalized();
    normal = normal.dot(towards) < 0 ? Vector3d(-normal) : normal;
    // On the plane, not on one noisy depth.
    point += (mean - point).dot(normal) / normal.dot(towards) * towards;
    return normal.dot(towards) > this->Options.MinCosine;
  }

  bool Sees(const View& view, const Vector3d& point, const Vector3d& normal) const
  {
    const double depth = view.Cam.Depth(point);
    if (depth <= 0 ||
      normal.dot((view.Cam.Centre() - point).normalized()) < this->Options.MinCosine)
    {
      return false;
    }
    const Vector2d pixel = view.Cam.Project(point);
    if (!view.Cam.InFrame(pixel))
    {
      return false;
    }
    const double seen = view.DepthMap(FloorToInt(pixel.x() + 0.5), FloorToInt(pixel.y() + 0.5));
    return seen > 0 && std::abs(seen - depth) < 8 * view.Cam.PixelFootprint(depth);
  }

  template <class At>
  static Patch PatchAt(const At& at, int radius)
  {
    Patch patch;
    double sum = 0;
    for (int j = -radius; j <= radius; ++j)
    {
      for (int i = -radius; i <= radius; ++i)
      {
        patch.Values.push_back(at(i, j));
        sum += patch.Values.back();
      }
    }
    const float mean = static_cast<float>(sum / static_cast<double>(patch.Values.size()));
    for (float& value : patch.Values)
    {
      value -= mean;
      patch.Norm += value * value;
    }
    patch.Norm = std::sqrt(patch.Norm);
    return patch;
  }

  /** Finds the reference's window in another view around where the cameras project it. */
  bool Search(const Patch& reference, const View& view, const Vector2d& pixel,
    const Vector3d& point, const Vector3d& normal, int other, Vector2d& found) const
  {
    const Camera& camera = this->Views[other].Cam;
    const auto onPlane = [&](const Vector2d& at)
    {
      const Vector3d centre = view.Cam.Centre();
      const Vector3d ray = view.Cam.RayDirection(at);
      return Vector3d(centre + (point - centre).dot(normal) / ray.dot(normal) * ray);
    };
    const Vector2d centre = camera.Project(point);
    Matrix2d warp;
    warp.col(0) = camera.Project(onPlane(pixel + Vector2d(1, 0))) - centre;
    warp.col(1) = camera.Project(onPlane(pixel + Vector2d(0, 1))) - centre;
    const int radius = this->Options.WindowRadius + this->Options.SearchPx;
    const Matrix2d reach = warp.cwiseAbs() * (radius + 1);
    const Vector2d margin = reach.rowwise().sum();
    if (!warp.allFinite() || !camera.InFrame(centre - margin) || !camera.InFrame(centre + margin))
    {
      return false;
    }
    Image<float> warped(2 * radius + 1, 2 * radius + 1);
    const ImageRef<const float> grey = this->Greys[other].Ref();
    for (int j = -radius; j <= radius; ++j)
    {
      for (int i = -radius; i <= radius; ++i)
      {
        const Vector2d at = centre + warp * Vector2d(i, j);
        warped(i + radius, j + radius) = static_cast<float>(SampleBilinear(grey, at.x(), at.y()));
      }
    }
    Vector2d offset;
    if (!this->BestOffset(reference, warped, offset))
    {
      return false;
    }
    found = centre + warp * offset;
    return camera.InFrame(found) &&
      this->Views[other].IsObject(FloorToInt(found.x() + 0.5), FloorToInt(found.y() + 0.5));
  }

  bool BestOffset(const Patch& reference, const Image<float>& warped, Vector2d& offset) const
  {
    const int search = this->Options.SearchPx;
    const int side = 2 * search + 1;
    Image<float> score(side, side);
    int bestX = 0;
    int bestY = 0;
    for (int v = 0; v < side; ++v)
    {
      for (int u = 0; u < side; ++u)
      {
        score(u, v) = this->Correlation(reference, warped, u, v);
        if (score(u, v) > score(bestX, bestY))
        {
          bestX = u;
          bestY = v;
        }
      }
    }
    const double best = score(bestX, bestY);
    if (best < this->Options.MinSimilarity || bestX == 0 || bestY == 0 || bestX == side - 1 ||
      bestY == side - 1)
    {
      return false;
    }
    const auto vertex = [best](double before, double after)
    { return 0.5 * (before - after) / (before - 2 * best + after); };
    offset = Vector2d(bestX - search + vertex(score(bestX - 1, bestY), score(bestX + 1, bestY)),
      bestY - search + vertex(score(bestX, bestY - 1), score(bestX, bestY + 1)));
    return offset.allFinite();
  }

  float Correlation(const Patch& reference, const Image<float>& warped, int u, int v) const
  {
    const int side = 2 * this->Options.WindowRadius + 1;
    float sum = 0;
    float squares = 0;
    float product = 0;
    for (int j = 0; j < side; ++j)
    {
      const float* row = &warped(u, v + j);
      const float* key = &reference.Values[static_cast<std::size_t>(j) * side];
      for (int i = 0; i < side; ++i)
      {
        sum += row[i];
        squares += row[i] * row[i];
        product += row[i] * key[i];
      }
    }
    const float variance = squares - sum * sum / static_cast<float>(side * side);
    return variance > 1 ? product / static_cast<float>(reference.Norm * std::sqrt(variance)) : 0.f;
  }

  const std::vector<View>& Views;
  const PointTrackOptions& Options;
  const Execution& Run;
  const std::vector<std::vector<int>> Neighbours;
  std::vector<Image<float>> Greys;
};
}

std::vector<PointTrack> FindPointTracks(
  const std::vector<View>& views, const PointTrackOptions& options, const Execution& execution)
{
  return TrackFinder(views, options, execution).Find();
}
}
