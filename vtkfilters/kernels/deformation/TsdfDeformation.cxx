// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/TsdfDeformation.h"

#include "core/FillHolesIteratively.h"
#include "deformation/FieldEnergy.h"
#include "deformation/OutlineEnergy.h"
#include "deformation/RayRelaxation.h"
#include "fusion/RayMarcher.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/NovelProjection.h"
#include "geometry/Rasteriser.h"
#include "geometry/ViewSelection.h"
#include "geometry/Visibility.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

// ---- the outline ----------------------------------------------------------------------------------

class FieldOutlineDeformer
{
public:
  FieldOutlineDeformer(const TriangleMesh& facing, const std::vector<std::uint8_t>& visible,
    const Camera& novel, const Image<float>& silhouette, const TsdfDeformationOptions& options,
    const Execution& execution)
    : Mesh(facing)
    , Visible(visible)
    , Novel(novel)
    , Silhouette(silhouette)
    , Options(options)
    , Run(execution)
    , Projection(facing, novel)
    , Start(facing.Points.size(), 0)
  {
    this->Rim.Points.resize(facing.Points.size()); // where they lie does not matter
    std::vector<std::uint8_t> used(facing.Points.size(), 0);
    for (const Eigen::Vector3i& t : facing.Triangles)
    {
      used[t[0]] = used[t[1]] = used[t[2]] = 1;
    }
    for (std::size_t ptId = 0; ptId < used.size(); ++ptId)
    {
      if (used[ptId])
      {
        this->Start[ptId] = this->At(this->Projection.Pixels[ptId]);
        this->Level = std::min(this->Level, this->Start[ptId]);
      }
    }
    std::copy_if(facing.Triangles.begin(), facing.Triangles.end(),
      std::back_inserter(this->Rim.Triangles),
      [this](const Eigen::Vector3i& t)
      { return this->Start[t[0]] < 0 || this->Start[t[1]] < 0 || this->Start[t[2]] < 0; });
    for (int ptId = 0; ptId < static_cast<int>(this->Start.size()); ++ptId)
    {
      if (this->Start[ptId] < 0)
      {
        this->Outside.push_back(ptId);
      }
    }
    // The last iteration but one shall leave no more than ConvergencePx to go.
    const int steps = options.Iterations - 1;
    this->Decay = options.LevelDecay;
    if (steps > 0 && this->Level < -options.ConvergencePx)
    {
      this->Decay =
        std::min(this->Decay, std::pow(options.ConvergencePx / -this->Level, 1.0 / steps));
    }
  }

  /** Moves the outline to the next contour; returns whether it has arrived. */
  bool Step(DeformationState& state)
  {
    const bool last =
      state.Iteration == this->Options.Iterations || this->Level >= -this->Options.ConvergencePx;
    this->Level = last ? 0 : this->Decay * this->Level;
    this->Cut(this->Rim);
    const TrianglesOfPoints around(this->Rim);
    state.PointsMoved = 0;
    state.LargestMovePx = 0;
    for (const int ptId : this->Outside)
    {
      if (this->Start[ptId] < this->Level && !around.Triangles(ptId).empty())
      {
        constexpr double nothing = 1e-3; // pixels
        const double moved = this->MovePoint(ptId, around);
        state.PointsMoved += moved > nothing;
        state.LargestMovePx = std::max(state.LargestMovePx, moved);
      }
    }
    return last && state.LargestMovePx < this->Options.ConvergencePx;
  }

  /** Outline points, visible and near the contour of the mesh's silhouette, and their energies. */
  void Measure(DeformationResult& result)
  {
    this->Cut(this->Mesh);
    result.Mesh = this->Mesh;
    result.Active.assign(this->Start.size(), 0);
    result.Energies.assign(this->Start.size(), PointEnergy());
    const ItemBuffer silhouette = Rasterise(this->Mesh, this->Novel, this->Run);
    std::vector<std::uint8_t> used(this->Start.size(), 0);
    for (const Eigen::Vector3i& t : this->Mesh.Triangles)
    {
      used[t[0]] = used[t[1]] = used[t[2]] = 1;
    }
    for (std::size_t ptId = 0; ptId < used.size(); ++ptId)
    {
      const Vector2d& pixel = this->Projection.Pixels[ptId];
      if (used[ptId] && (this->Visible.empty() || this->Visible[ptId]) &&
        OnContour(silhouette, pixel))
      {
        result.Active[ptId] = 1;
        result.Energies[ptId] = FieldOutlineEnergy(this->Silhouette, pixel);
      }
    }
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

  /** Drops the triangles that lie beyond the level. */
  void Cut(TriangleMesh& mesh) const
  {
    const auto beyond = [this](int ptId) { return this->Start[ptId] < this->Level; };
    std::erase_if(mesh.Triangles,
      [&](const Eigen::Vector3i& t) { return beyond(t[0]) && beyond(t[1]) && beyond(t[2]); });
  }

  /** Moves a point in the image plane to the contour at the level; returns by how many pixels. */
  double MovePoint(int ptId, const TrianglesOfPoints& around)
  {
    const Vector2d start = this->Projection.Pixels[ptId];
    Vector2d target = start;
    for (int step = 0; step < 4; ++step)
    {
      target += (this->Level - this->At(target)) * this->Gradient(target);
    }
    for (double part = 1; part > 0.05; part *= 0.6)
    {
      const Vector2d pixel = start + part * (target - start);
      if (this->Projection.KeepsOrientation(this->Rim, around, ptId, pixel))
      {
        Vector3d& point = this->Mesh.Points[ptId];
        point = this->Novel.Unproject(pixel, this->Novel.Depth(point));
        this->Projection.Pixels[ptId] = pixel;
        return (pixel - start).norm();
      }
    }
    return 0;
  }

  TriangleMesh Mesh;
  TriangleMesh Rim;         ///< its triangles that reach out of the contour
  std::vector<int> Outside; ///< points out of the contour at the start
  const std::vector<std::uint8_t>& Visible;
  const Camera& Novel;
  const Image<float>& Silhouette;
  const TsdfDeformationOptions& Options;
  const Execution& Run;
  NovelProjection Projection;
  std::vector<double> Start; ///< signed distance of each point's first projection to the contour
  double Level = 0;          ///< of the contour gone to; below 0 = outside
  double Decay = 0;
};

// ---- the other points -----------------------------------------------------------------------------

class FieldRayDeformer
{
public:
  FieldRayDeformer(const TriangleMesh& mesh, const std::vector<std::uint8_t>& active,
    const Camera& novel, const TsdfDeformationOptions& options, double footprint)
    : Mesh(mesh)
    , Active(active)
    , Neighbours(mesh)
    , Novel(novel)
    , Options(options)
    , Footprint(footprint)
    , Start(mesh.Points.size(), 0)
    , Surface(mesh.Points.size(), 0)
  {
    for (int ptId = 0; ptId < static_cast<int>(mesh.Points.size()); ++ptId)
    {
      this->Start[ptId] = novel.Depth(mesh.Points[ptId]);
      this->Active[ptId] =
        this->Active[ptId] && this->Start[ptId] > 0 && !this->Neighbours.Triangles(ptId).empty();
    }
  }

  /** Finds the surface that draws each point: the field's, or the one its neighbours have. */
  RayRelaxation Prepare(const TsdfField& field, const Execution& execution)
  {
    this->FindSurface(field, execution);
    this->FillFromNeighbours();
    return { this->Neighbours, this->Novel, this->Mesh.Points, this->Surface, this->Active,
      this->Options.Smoothing, this->Footprint };
  }

  void Measure(
    const RayRelaxation& relaxation, DeformationResult& result, const Execution& execution) const
  {
    result.Mesh.Triangles = this->Mesh.Triangles;
    result.Active = this->Active;
    relaxation.Measure(result.Mesh.Points, result.Energies, execution);
  }

private:
  /** The depth of the field's surface on each active point's ray; 0 = it meets none. */
  void FindSurface(const TsdfField& field, const Execution& execution)
  {
    const RayMarcher marcher(field, this->Novel, BoundingDiagonal(this->Mesh.Points),
      this->Options.Silhouette.StepPx * this->Footprint);
    execution.ForEach(static_cast<std::int64_t>(this->Surface.size()),
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
          this->Surface[ptId] =
            marcher.FindFirstCrossing(pixel, front - 1.5 * this->Footprint).Surface.value_or(0);
        }
      });
  }

  /** Points whose ray meets nothing take the mean of those around, ring by ring. */
  void FillFromNeighbours()
  {
    std::vector<int> open;
    std::vector<std::uint8_t> known(this->Surface.size());
    for (int ptId = 0; ptId < static_cast<int>(this->Surface.size()); ++ptId)
    {
      known[ptId] = this->Surface[ptId] > 0;
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
          sum += known[other] ? this->Surface[other] : 0;
          count += known[other];
        }
        this->Surface[ptId] = count ? sum / count : 0;
        return count > 0;
      },
      [&](int ptId) { known[ptId] = 1; });
  }

  const TriangleMesh& Mesh;
  std::vector<std::uint8_t> Active;
  MeshNeighbours Neighbours;
  const Camera& Novel;
  const TsdfDeformationOptions& Options;
  const double Footprint;
  std::vector<double> Start;   ///< depth before
  std::vector<double> Surface; ///< depth of what draws the point; 0 = nothing does
};

/**
 * Calls step(state), which moves the points and returns whether they have arrived, until then or to the
 * iterations' limit; measure() and the listener before it and after each.
 */
template <class Step, class Measure>
DeformationResult Iterate(const TsdfDeformationOptions& options,
  const DeformationListener& listener, const Execution& execution, const Step& step,
  const Measure& measure)
{
  DeformationResult result;
  DeformationState state;
  state.Mesh = &result.Mesh;
  state.Energies = &result.Energies;
  state.Active = &result.Active;
  for (;; ++state.Iteration)
  {
    result.Converged = state.Iteration > 0 && step(state);
    const bool last = result.Converged || state.Iteration == options.Iterations;
    const bool told = listener && (last || !options.LastOnly);
    if (last || told)
    {
      measure(result);
    }
    if (told)
    {
      listener(state);
    }
    execution.Report(0.5 + 0.5 * state.Iteration / std::max(options.Iterations, 1));
    if (last)
    {
      result.Iterations = state.Iteration;
      return result;
    }
  }
}
}

TsdfDeformationOptions OptionsForNoise(double noise)
{
  TsdfDeformationOptions options;
  options.Surface.TruncationPx = std::clamp(2.5 + 4 * noise, 3.0, 6.0);
  options.Surface.SurfacePrior = std::clamp(0.25 * noise, 0.05, 1.0);
  options.Outline.TruncationPx = std::clamp(1.5 + 4 * noise, 2.0, 5.0);
  options.Silhouette.SmoothingPx = std::clamp(noise, 0.0, 1.0);
  options.Smoothing += std::clamp(noise - 1, 0.0, 3.0);
  return options;
}

DeformationResult DeformOutlineByField(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& visible, const std::vector<View>& views, const Camera& novel,
  const TsdfDeformationOptions& options, const DeformationListener& listener,
  const Execution& execution)
{
  RequireDepthMaps(views);
  const double footprint = FootprintOf(views, mesh);
  const TsdfField field(views, options.Outline, footprint);
  const TriangleMesh facing = NovelProjection::FacingPart(mesh, novel);
  const Image<float> silhouette =
    FusedSilhouette(facing, views, field, novel, footprint, options.Silhouette, execution);
  FieldOutlineDeformer deformer(facing, visible, novel, silhouette, options, execution);
  return Iterate(
    options, listener, execution, [&](DeformationState& state) { return deformer.Step(state); },
    [&](DeformationResult& result) { deformer.Measure(result); });
}

DeformationResult DeformNonOutlineByField(const TriangleMesh& mesh,
  const std::vector<std::uint8_t>& active, const std::vector<View>& views, const Camera& novel,
  const TsdfDeformationOptions& options, const DeformationListener& listener,
  const Execution& execution)
{
  RequireDepthMaps(views);
  const double footprint = FootprintOf(views, mesh);
  const TsdfField field(views, options.Surface, footprint);
  FieldRayDeformer deformer(mesh, active, novel, options, footprint);
  RayRelaxation relaxation = deformer.Prepare(field, execution);
  return Iterate(
    options, listener, execution,
    [&](DeformationState& state)
    {
      const RayRelaxation::Moves moves = relaxation.Step(execution);
      state.PointsMoved = moves.Moved;
      state.LargestMovePx = moves.Largest;
      return moves.Largest < options.ConvergencePx;
    },
    [&](DeformationResult& result) { deformer.Measure(relaxation, result, execution); });
}
}
