// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/NonOutlineDeformation.h"

#include "core/ToInt.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/Rasteriser.h"
#include "geometry/ViewSelection.h"
#include "silhouettes/SilhouetteField.h"
#include "stereo/PhotoConsistency.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

class NonOutlineDeformer
{
public:
  NonOutlineDeformer(const TriangleMesh& mesh, const std::vector<std::uint8_t>& active,
    const std::vector<View>& views, const Camera& novel, const NonOutlineOptions& options,
    const Execution& execution)
    : Mesh(mesh)
    , Active(active)
    , Neighbours(mesh)
    , Views(views)
    , Novel(novel)
    , Centre(novel.Centre())
    , Hull(views)
    , NeighbourViews(NearestNeighbours(views, options.Secondaries))
    , Options(options)
    , Matching(options)
    , Run(execution)
    , Energies(mesh.Points.size())
    , Moves(mesh.Points.size(), 0)
    , Moved(mesh.Points.size(), 1)
    , Partners(mesh.Points.size())
  {
    for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
    {
      // Of a point that no photograph shows nothing is known, not even its distance to the hull.
      this->Active[ptId] = this->Active[ptId] && novel.Depth(mesh.Points[ptId]) > 0 &&
        !this->Neighbours.Triangles(static_cast<int>(ptId)).empty() &&
        std::isfinite(this->Hull.Value(mesh.Points[ptId]));
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
      this->Matching.MatchRangePx = this->RangeIn(state.Iteration);
      this->Measure();
      if (listener)
      {
        listener(state);
      }
      if (converged || state.Iteration == this->Options.Iterations)
      {
        break;
      }
      this->Run.Report(static_cast<double>(state.Iteration) / this->Options.Iterations);
      this->Move(state);
      converged = state.LargestMovePx < this->Options.ConvergencePx;
    }
    return { std::move(this->Mesh), std::move(this->Energies), std::move(this->Active),
      state.Iteration, converged };
  }

private:
  /** How far to search along the epipolar line: less and less, as the points come nearer. */
  int RangeIn(int iteration) const
  {
    const NonOutlineOptions& options = this->Options;
    const int range = ToInt(options.MatchRangePx * std::pow(options.RangeDecay, iteration));
    return std::min(std::max(range, options.MinRangePx), options.MatchRangePx);
  }

  /** Energies where the points are, and the best move of each; the mesh stays as it is. */
  void Measure()
  {
    this->FindNormals();
    this->FindKeys();
    this->Run.ForEach(static_cast<std::int64_t>(this->Mesh.Points.size()),
      [&](std::int64_t ptId)
      {
        this->Moves[ptId] = 0;
        if (this->Active[ptId] && !this->IsSettled(static_cast<int>(ptId)))
        {
          this->MeasurePoint(static_cast<int>(ptId));
        }
      });
  }

  /** The normals, each as its neighbourhood has it. */
  void FindNormals()
  {
    this->Normals = VertexNormals(this->Mesh);
    for (int round = 0; round < this->Options.NormalRounds; ++round)
    {
      const std::vector<Vector3d> before = this->Normals;
      this->Run.ForEach(static_cast<std::int64_t>(before.size()),
        [&](std::int64_t ptId)
        {
          Vector3d sum = before[ptId];
          for (const int other : this->Neighbours.Points(static_cast<int>(ptId)))
          {
            sum += before[other];
          }
          this->Normals[ptId] = sum.norm() > 0 ? sum.normalized() : before[ptId];
        });
    }
  }

  /**
   * The key of every point: the reference that the normal points to most directly among those that
   * see the point. What a reference sees is made only when a point asks for it.
   */
  void FindKeys()
  {
    this->Keys.assign(this->Mesh.Points.size(), -1);
    std::vector<Image<float>> depths(this->Views.size());
    std::vector<int> pending;
    for (std::size_t ptId = 0; ptId < this->Mesh.Points.size(); ++ptId)
    {
      if (this->Active[ptId])
      {
        pending.push_back(static_cast<int>(ptId));
      }
    }
    std::vector<std::uint8_t> seen(this->Mesh.Points.size(), 0);
    while (!pending.empty())
    {
      this->Run.ForEach(static_cast<std::int64_t>(pending.size()),
        [&](std::int64_t i)
        { this->Keys[pending[i]] = this->NextFacing(pending[i], this->Keys[pending[i]]); });
      this->RasteriseFor(pending, depths);
      this->Run.ForEach(static_cast<std::int64_t>(pending.size()),
        [&](std::int64_t i)
        {
          const int key = this->Keys[pending[i]];
          seen[pending[i]] = key < 0 ||
            IsUnoccluded(std::as_const(depths[key]).Ref(), this->Views[key].Cam,
              this->Mesh.Points[pending[i]], 1.5);
        });
      std::erase_if(pending, [&seen](int ptId) { return seen[ptId] != 0; });
    }
  }

  /** What the keys of the pending points see of the mesh, unless it is there. */
  void RasteriseFor(const std::vector<int>& pending, std::vector<Image<float>>& depths) const
  {
    std::vector<char> noted(this->Views.size(), 0);
    std::vector<int> wanted;
    for (const int ptId : pending)
    {
      const int key = this->Keys[ptId];
      if (key >= 0 && depths[key].Values.empty() && !std::exchange(noted[key], 1))
      {
        wanted.push_back(key);
      }
    }
    this->Run.ForEach(static_cast<std::int64_t>(wanted.size()),
      [&](std::int64_t i)
      { depths[wanted[i]] = RasteriseDepth(this->Mesh, this->Views[wanted[i]].Cam); });
  }

  double FacingOf(int ptId, std::size_t viewId) const
  {
    const Vector3d towards = this->Views[viewId].Cam.Centre() - this->Mesh.Points[ptId];
    return this->Normals[ptId].dot(towards.normalized());
  }

  /**
   * The view in whose frame the point is and that the normal points to most directly, after
   * `before` (-1 = none was before); -1 when there is none.
   */
  int NextFacing(int ptId, int before) const
  {
    const double limit =
      before < 0 ? std::numeric_limits<double>::infinity() : this->FacingOf(ptId, before);
    int best = -1;
    double bestCosine = 0;
    for (int viewId = 0; viewId < static_cast<int>(this->Views.size()); ++viewId)
    {
      const Camera& camera = this->Views[viewId].Cam;
      const Vector3d& point = this->Mesh.Points[ptId];
      const double cosine = this->FacingOf(ptId, viewId);
      const bool comes = cosine < limit || (cosine == limit && viewId > before);
      if (comes && cosine > bestCosine && camera.Depth(point) > 0 &&
        camera.InFrame(camera.Project(point)))
      {
        best = viewId;
        bestCosine = cosine;
      }
    }
    return best;
  }

  /**
   * Whether all that the point's energies depend on is as it was when they were last measured, but for
   * the range of the search: its matches have been found.
   */
  bool IsSettled(int ptId) const
  {
    const std::span<const int> around = this->Neighbours.Points(ptId);
    return !this->Moved[ptId] && this->Keys[ptId] == this->Partners[ptId].Key &&
      std::none_of(
        around.begin(), around.end(), [&](int other) { return this->Moved[other] != 0; });
  }

  void MeasurePoint(int ptId)
  {
    const Vector3d here = this->Mesh.Points[ptId];
    const double footprint = this->Novel.PixelFootprint(this->Novel.Depth(here));
    const Vector3d ray = (here - this->Centre).normalized();
    const int key = this->Keys[ptId];
    // A point that stayed where it was, with the same key, has the same partners.
    std::vector<SubPoint>& subPoints = this->Partners[ptId].SubPoints;
    if (key != this->Partners[ptId].Key || this->Moved[ptId])
    {
      this->Partners[ptId].Key = key;
      subPoints.clear();
      if (key >= 0)
      {
        subPoints =
          MatchSecondaries(here, this->Views, key, this->NeighbourViews[key], this->Matching);
      }
    }
    std::vector<Vector3d> neighbours;
    for (const int other : this->Neighbours.Points(ptId))
    {
      neighbours.push_back(this->Mesh.Points[other]);
    }
    SilhouetteField hull;
    this->Hull.RestrictTo(here, (this->Options.SearchPx + this->Options.StepPx) * footprint, hull);
    const double beta = SubPointReliability(subPoints, this->Options.Secondaries);
    // Only what is less than `least` need be exact.
    const auto energyAt = [&](const Vector3d& point, double least)
    {
      PointEnergy energy;
      energy.Photo = SubPointEnergy(point, subPoints, this->Options.Secondaries, footprint);
      energy.Smooth = RaySmoothnessEnergy(point, ray, neighbours, footprint);
      energy.Total = energy.Photo + this->Options.Alpha * energy.Smooth;
      if (energy.Total < least)
      {
        energy.Contour = std::abs(hull.Value(point)) / footprint;
        energy.Total =
          energy.Photo + (1 - beta) * energy.Contour + this->Options.Alpha * energy.Smooth;
      }
      return energy;
    };
    this->Energies[ptId] = energyAt(here, std::numeric_limits<double>::infinity());
    double least = this->Energies[ptId].Total;
    const int steps = ToInt(this->Options.SearchPx / this->Options.StepPx + 0.5);
    for (int step = -steps; step <= steps; ++step)
    {
      const double offset = step * this->Options.StepPx;
      const double total = step ? energyAt(here + offset * footprint * ray, least).Total : least;
      if (total < least)
      {
        least = total;
        this->Moves[ptId] = offset;
      }
    }
  }

  void Move(DeformationState& state)
  {
    state.PointsMoved = 0;
    state.LargestMovePx = 0;
    for (std::size_t ptId = 0; ptId < this->Mesh.Points.size(); ++ptId)
    {
      this->Moved[ptId] = this->Moves[ptId] != 0;
      if (!this->Moved[ptId])
      {
        continue;
      }
      Vector3d& point = this->Mesh.Points[ptId];
      const double footprint = this->Novel.PixelFootprint(this->Novel.Depth(point));
      point += this->Moves[ptId] * footprint * (point - this->Centre).normalized();
      ++state.PointsMoved;
      state.LargestMovePx = std::max(state.LargestMovePx, std::abs(this->Moves[ptId]));
    }
  }

  TriangleMesh Mesh;
  std::vector<std::uint8_t> Active;
  MeshNeighbours Neighbours;
  const std::vector<View>& Views;
  const Camera& Novel;
  const Vector3d Centre;
  const SilhouetteField Hull;
  const std::vector<std::vector<int>> NeighbourViews;
  const NonOutlineOptions& Options;
  NonOutlineOptions Matching; ///< with the range of the iteration
  const Execution& Run;
  std::vector<PointEnergy> Energies;
  std::vector<double> Moves;       ///< of each point, pixel footprints along its ray
  std::vector<std::uint8_t> Moved; ///< whether the last move was one; at first all count as moved
  struct PointPartners
  {
    int Key = -1;
    std::vector<SubPoint> SubPoints;
  };
  std::vector<PointPartners> Partners;
  std::vector<Vector3d> Normals;
  std::vector<int> Keys; ///< per point, -1 = no photograph sees it
};

/** Unit direction of the epipolar line at the projection of a point, in the other picture. */
bool EpipolarDirection(
  const Camera& key, const Camera& other, const Vector3d& point, Vector2d& direction)
{
  const Vector3d further = point + 1e-3 * (point - key.Centre());
  if (other.Depth(point) <= 0 || other.Depth(further) <= 0)
  {
    return false;
  }
  direction = other.Project(further) - other.Project(point);
  const double length = direction.norm();
  direction /= length;
  return length > 0;
}
}

double SubPointEnergy(
  const Vector3d& point, const std::vector<SubPoint>& subPoints, int secondaries, double footprint)
{
  double sum = 0;
  for (const SubPoint& sub : subPoints)
  {
    sum += sub.Weight * (sub.Position - point).norm();
  }
  return sum / (footprint * secondaries);
}

double SubPointReliability(const std::vector<SubPoint>& subPoints, int secondaries)
{
  double sum = 0;
  for (const SubPoint& sub : subPoints)
  {
    sum += sub.Weight;
  }
  return sum / secondaries;
}

double RaySmoothnessEnergy(const Vector3d& point, const Vector3d& ray,
  const std::vector<Vector3d>& neighbours, double footprint)
{
  double sum = 0;
  for (const Vector3d& neighbour : neighbours)
  {
    sum += (neighbour - point).dot(ray);
  }
  return neighbours.empty() ? 0
                            : std::abs(sum) / (footprint * static_cast<double>(neighbours.size()));
}

std::vector<SubPoint> MatchSecondaries(const Vector3d& point, const std::vector<View>& views,
  int key, const std::vector<int>& secondaries, const NonOutlineOptions& options)
{
  std::vector<SubPoint> subPoints;
  const Camera& keyCamera = views[key].Cam;
  const Vector2d keyPixel = keyCamera.Project(point);
  const WindowMatcher matcher(views[key], keyPixel, options.WindowRadius);
  for (const int viewId : secondaries)
  {
    const Camera& camera = views[viewId].Cam;
    Vector2d along;
    if (!EpipolarDirection(keyCamera, camera, point, along))
    {
      continue;
    }
    const Vector2d start = camera.Project(point);
    const Vector2d across(-along.y(), along.x());
    double best = 0;
    int bestAlong = 0;
    Vector2d bestPixel;
    const auto look = [&](int i, int j)
    {
      const Vector2d pixel = start + i * along + j * across;
      const double similarity =
        camera.InFrame(pixel) ? matcher.Similarity(views[viewId], pixel) : 0;
      if (similarity > best)
      {
        best = similarity;
        bestAlong = i;
        bestPixel = pixel;
      }
    };
    const int stride = options.MatchStridePx;
    const int last = options.MatchRangePx / stride * stride;
    for (int i = -last; i <= last; i += stride)
    {
      look(i, 0);
    }
    const int coarse = bestAlong;
    for (int i = coarse - stride + 1; i < coarse + stride; ++i)
    {
      look(i, 0);
    }
    const int onLine = bestAlong;
    for (int j = 1; j <= options.MatchAcrossPx; ++j)
    {
      for (int i = onLine - 1; i <= onLine + 1; ++i)
      {
        look(i, -j);
        look(i, j);
      }
    }
    SubPoint sub;
    if (best > 0 && Triangulate(keyCamera, keyPixel, camera, bestPixel, sub.Position))
    {
      sub.Weight = std::min(best, 1.0);
      subPoints.push_back(sub);
    }
  }
  return subPoints;
}

DeformationResult DeformNonOutline(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& active, const std::vector<View>& views, const Camera& novel,
  const NonOutlineOptions& options, const DeformationListener& listener, const Execution& execution)
{
  return NonOutlineDeformer(mesh, active, views, novel, options, execution).Deform(listener);
}
}
