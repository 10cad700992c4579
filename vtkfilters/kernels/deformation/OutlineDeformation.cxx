// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/OutlineDeformation.h"

#include "core/ToInt.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/NovelProjection.h"
#include "geometry/ViewSelection.h"
#include "stereo/PhotoConsistency.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

bool InFrameOf(const View& view, const Vector3d& point, Vector2d& pixel)
{
  if (view.Cam.Depth(point) <= 0)
  {
    return false;
  }
  pixel = view.Cam.Project(point);
  return view.Cam.InFrame(pixel);
}

/** An outline point with all that one iteration needs to know of it. */
struct OutlinePoint
{
  int Id;
  Vector2d Pixel;
  Vector2d Direction2; ///< unit, in the picture
  Vector3d Step;       ///< world vector of one novel pixel along Direction2
  PointEnergy Now;
  /** Candidates better than Now, best first: (offset px, energy). */
  std::vector<std::pair<double, PointEnergy>> Better;
};

class OutlineDeformer
{
public:
  OutlineDeformer(const TriangleMesh& mesh, const std::vector<std::uint8_t>& visible,
    const std::vector<View>& views, const Camera& novel, const OutlineOptions& options,
    const Execution& execution)
    : Mesh(NovelProjection::FacingPart(mesh, novel))
    , Visible(visible.empty() ? std::vector<std::uint8_t>(mesh.Points.size(), 1) : visible)
    , Neighbours(this->Mesh)
    , Projection(this->Mesh, novel)
    , Views(views)
    , Novel(novel)
    , Options(options)
    , Run(execution)
    , Energies(mesh.Points.size())
    , Active(mesh.Points.size(), 0)
  {
    const std::vector<int> order = ViewsByAngle(views, novel.OpticalAxis());
    this->Key = order.front();
    this->Secondaries = NearestNeighbours(views, options.Secondaries)[this->Key];
    const double minCosine = std::cos(options.NearAngleDeg * EIGEN_PI / 180);
    for (const int viewId : order)
    {
      if (static_cast<int>(this->NearViews.size()) < options.NearViews &&
        views[viewId].Cam.OpticalAxis().dot(novel.OpticalAxis()) >= minCosine)
      {
        this->NearViews.push_back(viewId);
      }
    }
  }

  DeformationResult Deform(const DeformationListener& listener)
  {
    DeformationState state;
    state.Mesh = &this->Mesh;
    state.Energies = &this->Energies;
    state.Active = &this->Active;
    bool converged = false;
    for (;; ++state.Iteration)
    {
      // The picture of iteration i is taken after its moves; iteration 0 only measures.
      std::vector<OutlinePoint> points = this->FindOutline();
      const bool last = converged || state.Iteration == this->Options.Iterations;
      this->Measure(points, last);
      if (listener)
      {
        listener(state);
      }
      if (last)
      {
        break;
      }
      this->Run.Report(static_cast<double>(state.Iteration) / this->Options.Iterations);
      this->Move(points, state);
      converged = state.LargestMovePx < this->Options.ConvergencePx;
    }
    return { std::move(this->Mesh), std::move(this->Energies), std::move(this->Active),
      state.Iteration, converged };
  }

private:
  std::vector<OutlinePoint> FindOutline()
  {
    const ItemBuffer silhouette = Rasterise(this->Mesh, this->Novel, this->Run);
    std::vector<OutlinePoint> points;
    std::fill(this->Active.begin(), this->Active.end(), 0);
    std::fill(this->Energies.begin(), this->Energies.end(), PointEnergy());
    for (int ptId = 0; ptId < static_cast<int>(this->Mesh.Points.size()); ++ptId)
    {
      if (!this->Visible[ptId] || this->Neighbours.Triangles(ptId).empty() ||
        !OnContour(silhouette, this->Projection.Pixels[ptId]))
      {
        continue;
      }
      OutlinePoint point;
      point.Id = ptId;
      point.Pixel = this->Projection.Pixels[ptId];
      const auto direction = OutlineDirection(silhouette, point.Pixel);
      if (!direction)
      {
        continue;
      }
      point.Direction2 = *direction;
      const double depth = this->Novel.Depth(this->Mesh.Points[ptId]);
      point.Step = this->Novel.Unproject(point.Pixel + point.Direction2, depth) -
        this->Novel.Unproject(point.Pixel, depth);
      this->Active[ptId] = 1;
      points.push_back(std::move(point));
    }
    return points;
  }

  /** Only what is less than `least` need be exact. */
  PointEnergy EnergyAt(const OutlinePoint& point, const Vector3d& position,
    const std::vector<Vector3d>& outlineNeighbours, double least) const
  {
    PointEnergy energy;
    energy.Contour =
      OutlineContourEnergy(position, this->Views, this->NearViews, this->Options.SigmaPx);
    energy.Smooth = OutlineSmoothnessEnergy(position, point.Step.normalized(), outlineNeighbours);
    energy.Total = this->Options.Alpha * energy.Contour + this->Options.Beta * energy.Smooth;
    if (energy.Total < least)
    {
      energy.Photo = OutlinePhotoEnergy(
        position, this->Views, this->Key, this->Secondaries, this->Options.WindowRadius);
      energy.Total += energy.Photo;
    }
    return energy;
  }

  /** Energies of all outline points where they are and, unless `only`, of their candidates. */
  void Measure(std::vector<OutlinePoint>& points, bool onlyHere)
  {
    this->Run.ForEach(static_cast<std::int64_t>(points.size()),
      [&](std::int64_t i)
      {
        OutlinePoint& point = points[i];
        const Vector3d here = this->Mesh.Points[point.Id];
        std::vector<Vector3d> neighbours;
        for (const int other : this->Neighbours.Points(point.Id))
        {
          if (this->Active[other])
          {
            neighbours.push_back(this->Mesh.Points[other]);
          }
        }
        point.Now =
          this->EnergyAt(point, here, neighbours, std::numeric_limits<double>::infinity());
        this->Energies[point.Id] = point.Now;
        const int steps = onlyHere ? 0 : ToInt(this->Options.SearchPx / this->Options.StepPx + 0.5);
        for (int step = -steps; step <= steps; ++step)
        {
          const double offset = step * this->Options.StepPx;
          if (step == 0)
          {
            continue;
          }
          const PointEnergy energy =
            this->EnergyAt(point, here + offset * point.Step, neighbours, point.Now.Total);
          if (energy.Total < point.Now.Total)
          {
            point.Better.emplace_back(offset, energy);
          }
        }
        std::stable_sort(point.Better.begin(), point.Better.end(),
          [](const auto& a, const auto& b) { return a.second.Total < b.second.Total; });
      });
  }

  /** One after the other, since each move decides which moves of its neighbours would fold. */
  void Move(const std::vector<OutlinePoint>& points, DeformationState& state)
  {
    state.PointsMoved = 0;
    state.LargestMovePx = 0;
    for (const OutlinePoint& point : points)
    {
      for (const auto& [offset, energy] : point.Better)
      {
        const Vector2d pixel = point.Pixel + offset * point.Direction2;
        if (this->Projection.KeepsOrientation(this->Mesh, this->Neighbours, point.Id, pixel))
        {
          this->Mesh.Points[point.Id] += offset * point.Step;
          this->Projection.Pixels[point.Id] = pixel;
          ++state.PointsMoved;
          state.LargestMovePx = std::max(state.LargestMovePx, std::abs(offset));
          break;
        }
      }
    }
  }

  TriangleMesh Mesh;
  std::vector<std::uint8_t> Visible;
  MeshNeighbours Neighbours;
  NovelProjection Projection;
  const std::vector<View>& Views;
  const Camera& Novel;
  const OutlineOptions& Options;
  const Execution& Run;
  std::vector<PointEnergy> Energies;
  std::vector<std::uint8_t> Active;
  int Key = 0;
  std::vector<int> Secondaries;
  std::vector<int> NearViews;
};
}

std::optional<Vector2d> OutlineDirection(const ItemBuffer& silhouette, const Vector2d& projection)
{
  const int x = RoundToInt(projection.x());
  const int y = RoundToInt(projection.y());
  Vector2d sum = Vector2d::Zero();
  int background = 0;
  int model = 0;
  const auto cells = silhouette.CellId.Ref();
  for (int j = y - 2; j <= y + 2; ++j)
  {
    for (int i = x - 2; i <= x + 2; ++i)
    {
      if (!cells.Contains(i, j))
      {
        continue;
      }
      if (silhouette.Hit(i, j))
      {
        ++model;
        continue;
      }
      sum += Vector2d(i, j);
      ++background;
    }
  }
  if (background == 0 || model == 0)
  {
    return std::nullopt;
  }
  const Vector2d towards = sum / background - projection;
  const double length = towards.norm();
  if (length < 1e-9)
  {
    return std::nullopt;
  }
  return towards / length;
}

bool OnContour(const ItemBuffer& silhouette, const Vector2d& projection)
{
  const int x = RoundToInt(projection.x());
  const int y = RoundToInt(projection.y());
  const auto cells = silhouette.CellId.Ref();
  bool background = false;
  bool model = false;
  for (int j = y - 1; j <= y + 1; ++j)
  {
    for (int i = x - 1; i <= x + 1; ++i)
    {
      if (cells.Contains(i, j))
      {
        (silhouette.Hit(i, j) ? model : background) = true;
      }
    }
  }
  return background && model;
}

double OutlinePhotoEnergy(const Vector3d& point, const std::vector<View>& views, int key,
  const std::vector<int>& secondaries, int windowRadius)
{
  Vector2d keyPixel;
  if (secondaries.empty() || !InFrameOf(views[key], point, keyPixel))
  {
    return 1;
  }
  const WindowMatcher window(views[key], keyPixel, windowRadius);
  double sum = 0;
  for (const int viewId : secondaries)
  {
    Vector2d pixel;
    sum += InFrameOf(views[viewId], point, pixel) ? window.Difference(views[viewId], pixel) : 1;
  }
  return sum / static_cast<double>(secondaries.size());
}

double OutlineContourEnergy(const Vector3d& point, const std::vector<View>& views,
  const std::vector<int>& nearViews, double sigmaPx)
{
  double sum = 0;
  int count = 0;
  for (const int viewId : nearViews)
  {
    Vector2d pixel;
    if (InFrameOf(views[viewId], point, pixel))
    {
      const double distance =
        std::abs(SampleBilinear(views[viewId].ContourDistance, pixel.x(), pixel.y()));
      sum += std::min(distance, sigmaPx) / sigmaPx;
      ++count;
    }
  }
  return count ? sum / count : 0;
}

double OutlineSmoothnessEnergy(
  const Vector3d& point, const Vector3d& direction, const std::vector<Vector3d>& neighbours)
{
  double sum = 0;
  for (const Vector3d& neighbour : neighbours)
  {
    const Vector3d towards = neighbour - point;
    const double length = towards.norm();
    sum += length > 0 ? std::abs(direction.dot(towards)) / length : 0;
  }
  return neighbours.empty() ? 0 : sum / static_cast<double>(neighbours.size());
}

DeformationResult DeformOutline(const TriangleMesh& mesh, const std::vector<std::uint8_t>& visible,
  const std::vector<View>& views, const Camera& novel, const OutlineOptions& options,
  const DeformationListener& listener, const Execution& execution)
{
  return OutlineDeformer(mesh, visible, views, novel, options, execution).Deform(listener);
}
}
