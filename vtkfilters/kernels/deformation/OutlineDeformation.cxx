// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/OutlineDeformation.h"

#include "core/ToInt.h"
#include "deformation/OutlineEnergy.h"
#include "deformation/OutlineViews.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/NovelProjection.h"
#include "geometry/Rasteriser.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** An outline point with all that an iteration needs to know of it. */
struct OutlinePoint
{
  int Id = -1;
  OutlineViews Compared;
  Vector2d Direction = Vector2d::Zero(); ///< unit, in the picture; 0 = it has none
  Vector3d Step = Vector3d::Zero();      ///< world vector of one novel pixel along Direction
  double Offset = 0;                     ///< where the least energy is, novel pixels
};

class OutlineDeformer
{
public:
  OutlineDeformer(const TriangleMesh& mesh, const std::vector<std::uint8_t>& visible,
    const std::vector<View>& views, const Camera& novel, const OutlineOptions& options,
    const Execution& execution)
    : Mesh(NovelProjection::FacingPart(mesh, novel))
    , Neighbours(this->Mesh)
    , Projection(this->Mesh, novel)
    , Views(views)
    , NearViews(ContourViews(views, novel, options))
    , Novel(novel)
    , Options(options)
    , Run(execution)
    , Energies(mesh.Points.size())
    , Active(mesh.Points.size(), 0)
  {
    this->FindOutline(visible);
    this->ChooseViews();
  }

  DeformationResult Deform(const DeformationListener& listener)
  {
    DeformationState state;
    state.Mesh = &this->Mesh;
    state.Energies = &this->Energies;
    state.Active = &this->Active;
    double mean = this->Measure();
    const auto tell = [&]
    {
      if (listener)
      {
        listener(state);
      }
    };
    tell();
    bool converged = false;
    while (!converged && state.Iteration < this->Options.Iterations)
    {
      this->Run.Report(static_cast<double>(state.Iteration) / this->Options.Iterations);
      this->FindMinima();
      const double most =
        this->Options.MaxMovePx * std::pow(this->Options.MoveDecay, state.Iteration);
      converged = !this->LowerEnergy(most, mean, state);
      if (!converged)
      {
        ++state.Iteration;
        tell();
        converged = state.LargestMovePx < this->Options.ConvergencePx;
      }
    }
    return { std::move(this->Mesh), std::move(this->Energies), std::move(this->Active),
      state.Iteration, converged };
  }

private:
  /** The points of the outline, which stay the same ones. */
  void FindOutline(const std::vector<std::uint8_t>& visible)
  {
    const ItemBuffer silhouette = Rasterise(this->Mesh, this->Novel, this->Run);
    for (int ptId = 0; ptId < static_cast<int>(this->Mesh.Points.size()); ++ptId)
    {
      const Vector2d& pixel = this->Projection.Pixels[ptId];
      if ((visible.empty() || visible[ptId]) && !this->Neighbours.Triangles(ptId).empty() &&
        OnContour(silhouette, pixel) && OutlineDirection(silhouette, pixel))
      {
        this->Points.emplace_back().Id = ptId;
        this->Active[ptId] = 1;
      }
    }
    this->FindDirections(silhouette);
  }

  void FindDirections(const ItemBuffer& silhouette)
  {
    for (OutlinePoint& point : this->Points)
    {
      const Vector2d& pixel = this->Projection.Pixels[point.Id];
      point.Direction = OutlineDirection(silhouette, pixel).value_or(Vector2d::Zero());
      const double depth = this->Novel.Depth(this->Mesh.Points[point.Id]);
      point.Step =
        this->Novel.Unproject(pixel + point.Direction, depth) - this->Novel.Unproject(pixel, depth);
    }
  }

  void ChooseViews()
  {
    const OutlineViewSelector selector(
      this->Mesh, this->Views, this->Novel, this->Options, this->Run);
    this->Run.ForEach(static_cast<std::int64_t>(this->Points.size()),
      [&](std::int64_t i)
      {
        OutlinePoint& point = this->Points[i];
        point.Compared = selector.Select(this->Mesh.Points[point.Id], point.Step);
      });
  }

  std::vector<Vector3d> OutlineNeighbours(int ptId) const
  {
    std::vector<Vector3d> neighbours;
    for (const int other : this->Neighbours.Points(ptId))
    {
      if (this->Active[other])
      {
        neighbours.push_back(this->Mesh.Points[other]);
      }
    }
    return neighbours;
  }

  PointEnergy EnergyAt(const OutlinePoint& point, const Vector3d& position,
    const std::vector<Vector3d>& neighbours) const
  {
    PointEnergy energy;
    energy.Contour =
      OutlineContourEnergy(position, this->Views, this->NearViews, this->Options.SigmaPx);
    energy.Smooth = OutlineSmoothnessEnergy(position, point.Step.normalized(), neighbours);
    energy.Photo = point.Compared.Key < 0
      ? 0
      : OutlinePhotoEnergy(position, this->Views, point.Compared.Key, point.Compared.Secondaries,
          this->Options.WindowRadius);
    energy.Total =
      energy.Photo + this->Options.Alpha * energy.Contour + this->Options.Beta * energy.Smooth;
    return energy;
  }

  /** The energies where the points are; returns their mean. */
  double Measure()
  {
    this->Run.ForEach(static_cast<std::int64_t>(this->Points.size()),
      [&](std::int64_t i)
      {
        const OutlinePoint& point = this->Points[i];
        this->Energies[point.Id] =
          this->EnergyAt(point, this->Mesh.Points[point.Id], this->OutlineNeighbours(point.Id));
      });
    double sum = 0;
    for (const OutlinePoint& point : this->Points)
    {
      sum += this->Energies[point.Id].Total;
    }
    return this->Points.empty() ? 0 : sum / static_cast<double>(this->Points.size());
  }

  /** Where the least energy of every point is, if it is distinct, and the median about it. */
  void FindMinima()
  {
    std::vector<double> offsets(this->Mesh.Points.size(), 0);
    this->Run.ForEach(static_cast<std::int64_t>(this->Points.size()),
      [&](std::int64_t i)
      {
        const OutlinePoint& point = this->Points[i];
        offsets[point.Id] = point.Compared.Key < 0 ? 0 : this->MinimumOf(point);
      });
    this->Run.ForEach(static_cast<std::int64_t>(this->Points.size()),
      [&](std::int64_t i)
      { this->Points[i].Offset = this->MedianOverOutline(this->Points[i].Id, offsets); });
  }

  double MinimumOf(const OutlinePoint& point) const
  {
    const OutlineOptions& options = this->Options;
    const Vector3d here = this->Mesh.Points[point.Id];
    const std::vector<Vector3d> neighbours = this->OutlineNeighbours(point.Id);
    const auto energyAt = [&](double offset)
    { return this->EnergyAt(point, here + offset * point.Step, neighbours); };
    const int steps = ToInt(options.SearchPx / options.StepPx + 0.5);
    const PointEnergy& now = this->Energies[point.Id];
    double least = now.Total - options.Margin;
    const double maxPhoto = std::min(options.MaxPhoto, options.MaxPhotoShare * now.Photo);
    double best = 0;
    for (int step = -steps; step <= steps; ++step)
    {
      const PointEnergy energy = energyAt(step * options.StepPx);
      if (energy.Total < least && energy.Photo <= maxPhoto)
      {
        least = energy.Total;
        best = step * options.StepPx;
      }
    }
    const auto rises = [&](double side)
    {
      for (double away = 2 * options.StepPx; away <= options.RisePx; away += 2 * options.StepPx)
      {
        if (energyAt(best + side * away).Total > least + options.Rise)
        {
          return true;
        }
      }
      return false;
    };
    return best != 0 && rises(-1) && rises(1) ? best : 0;
  }

  /** Over the point and the outline points up to two edges away. */
  double MedianOverOutline(int ptId, const std::vector<double>& offsets) const
  {
    std::vector<double> values{ offsets[ptId] };
    for (const int other : this->Neighbours.Points(ptId))
    {
      if (this->Active[other])
      {
        values.push_back(offsets[other]);
      }
      for (const int next : this->Neighbours.Points(other))
      {
        if (this->Active[next] && next != ptId)
        {
          values.push_back(offsets[next]);
        }
      }
    }
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  }

  /** Moves towards the minima as far as that lowers the mean energy; returns whether it did. */
  bool LowerEnergy(double most, double& mean, DeformationState& state)
  {
    constexpr int halvings = 3;
    const std::vector<Vector3d> points = this->Mesh.Points;
    const std::vector<Vector2d> pixels = this->Projection.Pixels;
    const std::vector<PointEnergy> energies = this->Energies;
    const std::vector<OutlinePoint> outline = this->Points;
    for (int halving = 0; halving < halvings; ++halving)
    {
      this->Move(most / (1 << halving), state);
      if (state.PointsMoved == 0)
      {
        return false;
      }
      this->FindDirections(Rasterise(this->Mesh, this->Novel, this->Run));
      if (const double now = this->Measure(); now < mean)
      {
        mean = now;
        return true;
      }
      this->Mesh.Points = points;
      this->Projection.Pixels = pixels;
      this->Energies = energies;
      this->Points = outline;
    }
    return false;
  }

  void Move(double most, DeformationState& state)
  {
    std::vector<Vector2d> moves(this->Mesh.Points.size(), Vector2d::Zero());
    for (const OutlinePoint& point : this->Points)
    {
      moves[point.Id] = std::clamp(point.Offset, -most, most) * point.Direction;
    }
    SpreadMoves(this->Neighbours, this->Active, this->Options.Membrane, moves, this->Run);
    ShortenFoldingMoves(this->Mesh, this->Projection.Pixels, moves);
    state.PointsMoved = 0;
    state.LargestMovePx = 0;
    for (std::size_t ptId = 0; ptId < moves.size(); ++ptId)
    {
      constexpr double nothing = 1e-3; // pixels
      const double length = moves[ptId].norm();
      if (length < nothing || this->Neighbours.Triangles(static_cast<int>(ptId)).empty())
      {
        continue;
      }
      const double depth = this->Novel.Depth(this->Mesh.Points[ptId]);
      this->Projection.Pixels[ptId] += moves[ptId];
      this->Mesh.Points[ptId] = this->Novel.Unproject(this->Projection.Pixels[ptId], depth);
      if (this->Active[ptId])
      {
        ++state.PointsMoved;
        state.LargestMovePx = std::max(state.LargestMovePx, length);
      }
    }
  }

  TriangleMesh Mesh;
  MeshNeighbours Neighbours;
  NovelProjection Projection;
  const std::vector<View>& Views;
  const std::vector<int> NearViews; ///< of the contour energy
  const Camera& Novel;
  const OutlineOptions& Options;
  const Execution& Run;
  std::vector<PointEnergy> Energies;
  std::vector<std::uint8_t> Active;
  std::vector<OutlinePoint> Points;
};
}

DeformationResult DeformOutline(const TriangleMesh& mesh, const std::vector<std::uint8_t>& visible,
  const std::vector<View>& views, const Camera& novel, const OutlineOptions& options,
  const DeformationListener& listener, const Execution& execution)
{
  return OutlineDeformer(mesh, visible, views, novel, options, execution).Deform(listener);
}
}
