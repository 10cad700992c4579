// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/TsdfDeformation.h"

#include "core/FillHolesIteratively.h"
#include "deformation/NonOutlineDeformation.h"
#include "deformation/OutlineEnergy.h"
#include "fusion/RayMarcher.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/NovelProjection.h"
#include "geometry/Rasteriser.h"
#include "geometry/ViewSelection.h"
#include "geometry/Visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

double FootprintOf(const std::vector<View>& views, const TriangleMesh& mesh)
{
  const double footprint = MedianFootprint(views, mesh.Points);
  if (footprint <= 0)
  {
    throw Error("deformer", "the mesh is empty or lies behind every reference camera");
  }
  return footprint;
}

void RequireMaps(const std::vector<View>& views)
{
  for (const View& view : views)
  {
    if (view.DepthMap.Empty() || view.Confidence.Empty())
    {
      throw Error("view " + view.Name, "point array Depth or Confidence is missing");
    }
  }
}

// ---- the outline ----------------------------------------------------------------------------------

class FieldOutlineDeformer
{
public:
  FieldOutlineDeformer(const TriangleMesh& facing, const std::vector<std::uint8_t>& visible,
    const Camera& novel, const Image<float>& silhouette, const Execution& execution)
    : Start(facing)
    , Visible(visible)
    , Novel(novel)
    , Silhouette(silhouette)
    , Run(execution)
    , StartProjection(facing, novel)
    , Inside(facing.Points.size(), 0)
  {
    std::vector<std::uint8_t> used(facing.Points.size(), 0);
    for (const Eigen::Vector3i& t : facing.Triangles)
    {
      used[t[0]] = used[t[1]] = used[t[2]] = 1;
    }
    for (std::size_t ptId = 0; ptId < used.size(); ++ptId)
    {
      if (used[ptId])
      {
        this->Inside[ptId] = this->At(this->StartProjection.Pixels[ptId]);
        this->Deepest = std::min(this->Deepest, this->Inside[ptId]);
      }
    }
  }

  /** How far outside the contour the mesh reaches, pixels. */
  double Reach() const { return -this->Deepest; }

  /** The start mesh with its outline moved to the contour at `level` (below 0 = further out). */
  void MoveTo(double level, DeformationResult& result, DeformationState& state)
  {
    const std::size_t count = this->Start.Points.size();
    result.Mesh.Points = this->Start.Points;
    result.Mesh.Triangles.clear();
    result.Active.assign(count, 0);
    result.Energies.assign(count, PointEnergy());
    for (const Eigen::Vector3i& t : this->Start.Triangles)
    {
      if (this->Inside[t[0]] >= level || this->Inside[t[1]] >= level || this->Inside[t[2]] >= level)
      {
        result.Mesh.Triangles.push_back(t);
      }
    }
    const TrianglesOfPoints around(result.Mesh);
    NovelProjection projection = this->StartProjection;
    state.PointsMoved = 0;
    state.LargestMovePx = 0;
    for (int ptId = 0; ptId < static_cast<int>(count); ++ptId)
    {
      if (this->Inside[ptId] < level && !around.Triangles(ptId).empty())
      {
        const double moved = this->MovePoint(ptId, level, result.Mesh, around, projection);
        state.PointsMoved += moved > 0;
        state.LargestMovePx = std::max(state.LargestMovePx, moved);
      }
    }
    this->MarkOutline(around, projection, result);
  }

private:
  double At(const Vector2d& pixel) const
  {
    return SampleBilinear(this->Silhouette.Ref(), pixel.x(), pixel.y());
  }

  Vector2d Gradient(const Vector2d& pixel) const
  {
    const Vector2d gradient(this->At(pixel + Vector2d(0.5, 0)) - this->At(pixel - Vector2d(0.5, 0)),
      this->At(pixel + Vector2d(0, 0.5)) - this->At(pixel - Vector2d(0, 0.5)));
    const double length = gradient.norm();
    return length > 0 ? Vector2d(gradient / length) : Vector2d(0, 0);
  }

  /** Moves a point in the image plane towards the contour; returns by how many pixels. */
  double MovePoint(int ptId, double level, TriangleMesh& mesh, const TrianglesOfPoints& around,
    NovelProjection& projection) const
  {
    const Vector2d start = projection.Pixels[ptId];
    Vector2d target = start;
    for (int step = 0; step < 4; ++step)
    {
      target += (level - this->At(target)) * this->Gradient(target);
    }
    for (double part = 1; part > 0.05; part *= 0.6)
    {
      const Vector2d pixel = start + part * (target - start);
      if (projection.KeepsOrientation(mesh, around, ptId, pixel))
      {
        const double depth = this->Novel.Depth(mesh.Points[ptId]);
        mesh.Points[ptId] = this->Novel.Unproject(pixel, depth);
        projection.Pixels[ptId] = pixel;
        return (pixel - start).norm();
      }
    }
    return 0;
  }

  /** Outline points: on an open edge, near the contour of the mesh's silhouette. */
  void MarkOutline(const TrianglesOfPoints& around, const NovelProjection& projection,
    DeformationResult& result) const
  {
    const ItemBuffer silhouette = Rasterise(result.Mesh, this->Novel, this->Run);
    const auto isOutline = [&](int ptId)
    {
      return (this->Visible.empty() || this->Visible[ptId]) && !around.Triangles(ptId).empty() &&
        OnContour(silhouette, projection.Pixels[ptId]);
    };
    for (int ptId = 0; ptId < static_cast<int>(result.Active.size()); ++ptId)
    {
      if (isOutline(ptId))
      {
        result.Active[ptId] = 1;
        PointEnergy& energy = result.Energies[ptId];
        energy.Photo = std::abs(this->At(projection.Pixels[ptId]));
        energy.Total = energy.Photo;
      }
    }
  }

  const TriangleMesh& Start;
  const std::vector<std::uint8_t>& Visible;
  const Camera& Novel;
  const Image<float>& Silhouette;
  const Execution& Run;
  NovelProjection StartProjection;
  std::vector<double> Inside; ///< signed distance of each point's projection to the contour
  double Deepest = 0;
};

// ---- the other points -----------------------------------------------------------------------------

class FieldRayDeformer
{
public:
  FieldRayDeformer(const TriangleMesh& mesh, const std::vector<std::uint8_t>& active,
    const Camera& novel, const TsdfDeformationOptions& options)
    : Mesh(mesh)
    , Active(active)
    , Neighbours(mesh)
    , Novel(novel)
    , Options(options)
    , Start(mesh.Points.size(), 0)
    , Target(mesh.Points.size(), 0)
    , Goal(mesh.Points.size(), 0)
  {
    for (int ptId = 0; ptId < static_cast<int>(mesh.Points.size()); ++ptId)
    {
      this->Start[ptId] = novel.Depth(mesh.Points[ptId]);
      this->Active[ptId] =
        this->Active[ptId] && this->Start[ptId] > 0 && !this->Neighbours.Triangles(ptId).empty();
    }
  }

  /** The depth of the field's surface on each active point's ray; 0 = it meets none. */
  void FindSurface(const TsdfField& field, double footprint, const Execution& execution)
  {
    const RayMarcher marcher(field, this->Novel, BoundingDiagonal(this->Mesh.Points),
      this->Options.Silhouette.StepPx * footprint);
    execution.ForEach(static_cast<std::int64_t>(this->Target.size()),
      [&](std::int64_t ptId)
      {
        if (this->Active[ptId])
        {
          // A neighbour may be nearer: points that moved in the plane kept their old depth.
          double front = this->Start[ptId];
          for (const int other : this->Neighbours.Points(static_cast<int>(ptId)))
          {
            front = std::min(front, this->Start[other]);
          }
          const Vector2d pixel = this->Novel.Project(this->Mesh.Points[ptId]);
          this->Target[ptId] =
            marcher.FindFirstCrossing(pixel, front - 1.5 * footprint).Surface.value_or(0);
        }
      });
  }

  /** Where each point shall go: its surface balanced with its neighbours. */
  void Balance(const Execution& execution)
  {
    this->Goal = this->Target;
    this->FillFromNeighbours();
    const double weight = this->Options.Smoothing;
    for (int step = 0; step < this->Options.SmoothingSteps && weight > 0; ++step)
    {
      const std::vector<double> before = this->Goal;
      execution.ForEach(static_cast<std::int64_t>(this->Goal.size()),
        [&](std::int64_t ptId)
        {
          double sum = 0;
          int count = 0;
          for (const int other : this->Neighbours.Points(static_cast<int>(ptId)))
          {
            sum += this->Active[other] ? before[other] : 0;
            count += this->Active[other];
          }
          if (this->Active[ptId] && count)
          {
            const double own = this->Target[ptId] > 0 ? this->Target[ptId] : before[ptId];
            this->Goal[ptId] = (own + weight * sum / count) / (1 + weight);
          }
        });
    }
  }

  /** The mesh a fraction of the way there. */
  void MoveTo(double fraction, double footprint, DeformationResult& result, DeformationState& state)
  {
    result.Mesh = this->Mesh;
    result.Active = this->Active;
    result.Energies.assign(this->Goal.size(), PointEnergy());
    state.PointsMoved = 0;
    state.LargestMovePx = 0;
    const Vector3d centre = this->Novel.Centre();
    for (std::size_t ptId = 0; ptId < this->Goal.size(); ++ptId)
    {
      if (!this->Active[ptId])
      {
        continue;
      }
      const double depth = this->Start[ptId] + fraction * (this->Goal[ptId] - this->Start[ptId]);
      result.Mesh.Points[ptId] =
        centre + depth / this->Start[ptId] * (this->Mesh.Points[ptId] - centre);
      const double moved = std::abs(depth - this->Start[ptId]) / footprint;
      state.PointsMoved += moved > 1e-3;
      state.LargestMovePx = std::max(state.LargestMovePx, moved);
    }
    this->Measure(footprint, result);
  }

private:
  /** Points whose ray meets nothing take the mean of those around, ring by ring. */
  void FillFromNeighbours()
  {
    std::vector<int> open;
    std::vector<std::uint8_t> known(this->Goal.size());
    for (int ptId = 0; ptId < static_cast<int>(this->Goal.size()); ++ptId)
    {
      known[ptId] = this->Goal[ptId] > 0;
      if (this->Active[ptId] && !known[ptId])
      {
        open.push_back(ptId);
      }
    }
    FillHolesIteratively(
      open,
      [&](int ptId)
      {
        double sum = 0;
        int count = 0;
        for (const int other : this->Neighbours.Points(ptId))
        {
          sum += known[other] ? this->Goal[other] : 0;
          count += known[other];
        }
        this->Goal[ptId] = count ? sum / count : this->Goal[ptId];
        return count > 0;
      },
      [&](int ptId) { known[ptId] = 1; });
    for (const int ptId : open)
    {
      if (!known[ptId])
      {
        this->Goal[ptId] = this->Start[ptId]; // nothing is known anywhere around: stay on the hull
      }
    }
  }

  void Measure(double footprint, DeformationResult& result) const
  {
    const Vector3d centre = this->Novel.Centre();
    std::vector<Vector3d> around;
    for (int ptId = 0; ptId < static_cast<int>(this->Goal.size()); ++ptId)
    {
      if (!this->Active[ptId])
      {
        continue;
      }
      around.clear();
      for (const int other : this->Neighbours.Points(ptId))
      {
        around.push_back(result.Mesh.Points[other]);
      }
      const Vector3d& point = result.Mesh.Points[ptId];
      const double depth = this->Novel.Depth(point);
      PointEnergy& energy = result.Energies[ptId];
      energy.Photo = this->Target[ptId] > 0 ? std::abs(depth - this->Target[ptId]) / footprint : 0;
      energy.Contour = std::abs(depth - this->Start[ptId]) / footprint;
      energy.Smooth = RaySmoothnessEnergy(point, (point - centre).normalized(), around, footprint);
      energy.Total = energy.Photo + this->Options.Smoothing * energy.Smooth;
    }
  }

  const TriangleMesh& Mesh;
  std::vector<std::uint8_t> Active;
  MeshNeighbours Neighbours;
  const Camera& Novel;
  const TsdfDeformationOptions& Options;
  std::vector<double> Start;  ///< depth before
  std::vector<double> Target; ///< depth of the surface on the ray; 0 = none
  std::vector<double> Goal;   ///< depth to go to
};

/** Calls move(fraction) for every iteration, the first with 0, and tells the listener. */
template <class Move>
int Iterate(const TsdfDeformationOptions& options, DeformationResult& result,
  const DeformationListener& listener, const Execution& execution, const Move& move)
{
  const int iterations = options.Iterations;
  DeformationState state;
  for (state.Iteration = options.LastOnly ? iterations : 0; state.Iteration <= iterations;
       ++state.Iteration)
  {
    const bool last = state.Iteration == iterations;
    if (listener || last)
    {
      move(iterations ? static_cast<double>(state.Iteration) / iterations : 0.0, state);
      state.Mesh = &result.Mesh;
      state.Energies = &result.Energies;
      state.Active = &result.Active;
    }
    if (listener)
    {
      listener(state);
    }
    execution.Report(0.5 + 0.5 * state.Iteration / std::max(iterations, 1));
  }
  return iterations;
}
}

TsdfDeformationOptions OptionsForNoise(double noise)
{
  TsdfDeformationOptions options;
  options.Surface.TruncationPx = std::clamp(2.5 + 4 * noise, 3.0, 6.0);
  options.Surface.SurfacePrior = std::clamp(0.25 * noise, 0.05, 0.3);
  options.Outline.TruncationPx = std::clamp(1.5 + 4 * noise, 2.0, 5.0);
  options.Silhouette.SmoothingPx = std::clamp(noise, 0.0, 1.0);
  return options;
}

DeformationResult DeformOutlineByField(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& visible, const std::vector<View>& views, const Camera& novel,
  const TsdfDeformationOptions& options, const DeformationListener& listener,
  const Execution& execution)
{
  RequireMaps(views);
  const double footprint = FootprintOf(views, mesh);
  const TsdfField field(views, options.Outline, footprint);
  const TriangleMesh facing = NovelProjection::FacingPart(mesh, novel);
  const Image<float> silhouette =
    FusedSilhouette(facing, views, field, novel, footprint, options.Silhouette, execution);
  FieldOutlineDeformer deformer(facing, visible, novel, silhouette, execution);
  DeformationResult result;
  result.Converged = true;
  result.Iterations = Iterate(options, result, listener, execution,
    [&](double fraction, DeformationState& state)
    { deformer.MoveTo((fraction - 1) * deformer.Reach(), result, state); });
  return result;
}

DeformationResult DeformNonOutlineByField(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& active, const std::vector<View>& views, const Camera& novel,
  const TsdfDeformationOptions& options, const DeformationListener& listener,
  const Execution& execution)
{
  RequireMaps(views);
  const double footprint = FootprintOf(views, mesh);
  const TsdfField field(views, options.Surface, footprint);
  FieldRayDeformer deformer(mesh, active, novel, options);
  deformer.FindSurface(field, footprint, execution);
  deformer.Balance(execution);
  DeformationResult result;
  result.Converged = true;
  result.Iterations = Iterate(options, result, listener, execution,
    [&](double fraction, DeformationState& state)
    { deformer.MoveTo(fraction, footprint, result, state); });
  return result;
}
}
