// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/ModelRefinement.h"

#include "core/Error.h"
#include "geometry/MeshNeighbours.h"
#include "geometry/ViewSelection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double Unknown = std::numeric_limits<double>::infinity();

/** Mean of each point and its neighbours, normalised, some times over. */
std::vector<Vector3d> SmoothNormals(
  const TriangleMesh& mesh, const MeshNeighbours& neighbours, const Execution& execution)
{
  constexpr int steps = 8;
  std::vector<Vector3d> normals = VertexNormals(mesh);
  for (int step = 0; step < steps; ++step)
  {
    const std::vector<Vector3d> before = normals;
    execution.ForEach(static_cast<std::int64_t>(normals.size()),
      [&](std::int64_t ptId)
      {
        Vector3d sum = before[ptId];
        for (const int other : neighbours.Points(static_cast<int>(ptId)))
        {
          sum += before[other];
        }
        normals[ptId] = sum.norm() > 0 ? Vector3d(sum.normalized()) : sum;
      });
  }
  return normals;
}

/** Ways unlike those around them become the median of these. */
void RejectOutliers(std::vector<double>& ways, const MeshNeighbours& neighbours, double most,
  const Execution& execution)
{
  const std::vector<double> before = ways;
  execution.ForEach(static_cast<std::int64_t>(ways.size()),
    [&](std::int64_t ptId)
    {
      std::vector<double> around;
      for (const int other : neighbours.Points(static_cast<int>(ptId)))
      {
        // Two rings, since outliers come in groups.
        for (const int next : neighbours.Points(other))
        {
          if (before[next] < Unknown)
          {
            around.push_back(before[next]);
          }
        }
      }
      if (!around.empty())
      {
        const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
        std::nth_element(around.begin(), middle, around.end());
        ways[ptId] = std::abs(before[ptId] - *middle) <= most ? before[ptId] : *middle;
      }
    });
}

/** Balances the ways of points with their neighbours'; unknown ones take what these have. */
void SmoothWays(std::vector<double>& ways, const MeshNeighbours& neighbours,
  const ModelRefinementOptions& options, const Execution& execution)
{
  const std::vector<double> own = ways;
  for (int step = 0; step < options.SmoothingSteps; ++step)
  {
    const std::vector<double> before = ways;
    execution.ForEach(static_cast<std::int64_t>(ways.size()),
      [&](std::int64_t ptId)
      {
        double sum = 0;
        int count = 0;
        for (const int other : neighbours.Points(static_cast<int>(ptId)))
        {
          sum += before[other] < Unknown ? before[other] : 0;
          count += before[other] < Unknown;
        }
        if (count > 0)
        {
          const double mean = sum / count;
          ways[ptId] = own[ptId] < Unknown
            ? (own[ptId] + options.Smoothing * mean) / (1 + options.Smoothing)
            : mean;
        }
      });
  }
  std::replace(ways.begin(), ways.end(), Unknown, 0.0);
}

/** The points of triangles that look against the mesh around them. */
std::vector<std::uint8_t> FoldedPoints(
  const TriangleMesh& mesh, const std::vector<Vector3d>& normals)
{
  std::vector<std::uint8_t> folded(mesh.Points.size(), 0);
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const Vector3d& a = mesh.Points[t[0]];
    const Vector3d cross = (mesh.Points[t[1]] - a).cross(mesh.Points[t[2]] - a);
    const bool over = cross.dot(normals[t[0]] + normals[t[1]] + normals[t[2]]) < 0;
    for (int corner = 0; corner < 3 && over; ++corner)
    {
      folded[t[corner]] = 1;
    }
  }
  return folded;
}

/** Moves folded points, and those around them, to the middle of their neighbours. */
void Unfold(
  TriangleMesh& mesh, const MeshNeighbours& neighbours, int steps, const Execution& execution)
{
  for (int step = 0; step < steps; ++step)
  {
    const std::vector<std::uint8_t> folded =
      FoldedPoints(mesh, SmoothNormals(mesh, neighbours, execution));
    if (std::find(folded.begin(), folded.end(), 1) == folded.end())
    {
      return;
    }
    const std::vector<Vector3d> before = mesh.Points;
    execution.ForEach(static_cast<std::int64_t>(before.size()),
      [&](std::int64_t ptId)
      {
        const auto around = neighbours.Points(static_cast<int>(ptId));
        const bool near = folded[ptId] ||
          std::any_of(around.begin(), around.end(), [&](int other) { return folded[other]; });
        if (near && !around.empty())
        {
          Vector3d sum = Vector3d::Zero();
          for (const int other : around)
          {
            sum += before[other];
          }
          mesh.Points[ptId] = sum / static_cast<double>(around.size());
        }
      });
  }
}

/** Moves every point along its normal onto the field's surface, from so far outside to inside. */
void MoveOntoSurface(TriangleMesh& mesh, const MeshNeighbours& neighbours, const TsdfField& field,
  const ModelRefinementOptions& options, double footprint, const Vector2d& range,
  const Execution& execution)
{
  const std::vector<Vector3d> normals = SmoothNormals(mesh, neighbours, execution);
  std::vector<double> ways(mesh.Points.size(), Unknown);
  const double outside = range[0] * footprint;
  const auto count = static_cast<std::int64_t>(mesh.Points.size());
  execution.ForEach(count,
    [&](std::int64_t ptId)
    {
      if (normals[ptId].squaredNorm() > 0)
      {
        // From a little outside, so that a point that went too far comes back.
        const TsdfField::RayResult hit =
          field.FindFirstCrossing(mesh.Points[ptId] + outside * normals[ptId], -normals[ptId], 0,
            outside + range[1] * footprint, options.StepPx * footprint);
        ways[ptId] = hit.Surface ? *hit.Surface - outside : Unknown;
      }
    });
  RejectOutliers(ways, neighbours, options.OutlierPx * footprint, execution);
  SmoothWays(ways, neighbours, options, execution);
  execution.ForEach(
    count, [&](std::int64_t ptId) { mesh.Points[ptId] -= ways[ptId] * normals[ptId]; });
  Unfold(mesh, neighbours, options.UnfoldingSteps, execution);
}
}

TriangleMesh RefineModel(const TriangleMesh& mesh, const std::vector<View>& views,
  const ModelRefinementOptions& options, const Execution& execution)
{
  for (const View& view : views)
  {
    if (view.DepthMap.Empty() || view.Confidence.Empty())
    {
      throw Error("view " + view.Name, "point array Depth or Confidence is missing");
    }
  }
  const double footprint = MedianFootprint(views, mesh.Points);
  if (footprint <= 0)
  {
    throw Error("model", "the mesh is empty or lies behind every reference camera");
  }
  const TsdfField field(views, options.Fusion, footprint);
  const MeshNeighbours neighbours(mesh);
  TriangleMesh model = mesh;
  MoveOntoSurface(model, neighbours, field, options, footprint,
    Vector2d(options.OutsidePx, options.InsidePx), execution);
  for (int round = 0; round < options.NearRounds; ++round)
  {
    execution.Report((round + 1.0) / (options.NearRounds + 1));
    MoveOntoSurface(
      model, neighbours, field, options, footprint, Vector2d::Constant(options.NearPx), execution);
  }
  execution.Report(1);
  return model;
}
}
