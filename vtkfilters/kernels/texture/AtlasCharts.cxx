// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/AtlasCharts.h"

#include "core/DisjointSets.h"
#include "core/Error.h"
#include "core/ToInt.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Of every triangle those it shares an edge with, three at most; -1 = none. */
std::vector<std::array<int, 3>> TriangleNeighbours(const TriangleMesh& mesh)
{
  struct Side
  {
    int Low, High, Cell, Edge;
  };
  std::vector<Side> sides;
  for (std::size_t cellId = 0; cellId < mesh.Triangles.size(); ++cellId)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const int a = mesh.Triangles[cellId][edge];
      const int b = mesh.Triangles[cellId][(edge + 1) % 3];
      sides.push_back({ std::min(a, b), std::max(a, b), static_cast<int>(cellId), edge });
    }
  }
  std::sort(sides.begin(), sides.end(),
    [](const Side& a, const Side& b)
    { return std::tie(a.Low, a.High, a.Cell) < std::tie(b.Low, b.High, b.Cell); });
  std::vector<std::array<int, 3>> neighbours(mesh.Triangles.size(), { -1, -1, -1 });
  for (std::size_t i = 0; i + 1 < sides.size(); ++i)
  {
    const Side& a = sides[i];
    const Side& b = sides[i + 1];
    if (a.Low == b.Low && a.High == b.High)
    {
      neighbours[a.Cell][a.Edge] = b.Cell;
      neighbours[b.Cell][b.Edge] = a.Cell;
    }
  }
  return neighbours;
}

/** Gives every triangle to a photograph. */
class PhotographChoice
{
public:
  PhotographChoice(const TriangleMesh& mesh, const std::vector<BlendReference>& references,
    const TextureAtlasOptions& options, const Execution& execution)
    : Mesh(mesh)
    , References(references)
    , Options(options)
    , Views(static_cast<int>(references.size()))
    , Quality(mesh.Triangles.size() * references.size())
    , Label(mesh.Triangles.size())
    , Neighbours(TriangleNeighbours(mesh))
  {
    execution.ForEach(static_cast<std::int64_t>(mesh.Triangles.size()),
      [this](std::int64_t cellId) { this->Rate(static_cast<int>(cellId)); });
    this->Smooth();
  }

  /** The photograph of a triangle, or that number plus the number of views when none sees it. */
  const std::vector<int>& Labels() const { return this->Label; }
  const std::vector<std::array<int, 3>>& Adjacent() const { return this->Neighbours; }

private:
  float* QualityOf(int cellId)
  {
    return this->Quality.data() + static_cast<std::size_t>(cellId) * this->Views;
  }

  void Rate(int cellId)
  {
    const Eigen::Vector3i& t = this->Mesh.Triangles[cellId];
    const Vector3d p[3] = { this->Mesh.Points[t[0]], this->Mesh.Points[t[1]],
      this->Mesh.Points[t[2]] };
    const Vector3d cross = (p[1] - p[0]).cross(p[2] - p[0]);
    const Vector3d middle = (p[0] + p[1] + p[2]) / 3;
    float* quality = this->QualityOf(cellId);
    int facing = 0;
    double straightest = -2;
    for (int viewId = 0; viewId < this->Views; ++viewId)
    {
      const BlendReference& reference = this->References[viewId];
      const Camera& camera = reference.Photo->Cam;
      const Vector3d ray = middle - reference.Centre;
      const double cosine = cross.norm() > 0 ? -cross.normalized().dot(ray.normalized()) : 0;
      // A chart's texture coordinates need all its points in front of the camera.
      const bool inFront =
        camera.Depth(p[0]) > 0 && camera.Depth(p[1]) > 0 && camera.Depth(p[2]) > 0;
      if (inFront && cosine > straightest)
      {
        straightest = cosine;
        facing = viewId;
      }
      quality[viewId] = inFront && cosine > 0 && this->Sees(reference, p, middle)
        ? static_cast<float>(cosine * cross.norm() * cosine /
            std::pow(camera.PixelFootprint(camera.Depth(middle)), 2))
        : 0.f;
    }
    if (straightest < -1)
    {
      throw Error("texture atlas", "a triangle is behind every camera");
    }
    const float best = *std::max_element(quality, quality + this->Views);
    for (int viewId = 0; viewId < this->Views && best > 0; ++viewId)
    {
      quality[viewId] /= best;
    }
    this->Label[cellId] = best > 0
      ? static_cast<int>(std::max_element(quality, quality + this->Views) - quality)
      : this->Views + facing;
  }

  bool Sees(const BlendReference& reference, const Vector3d p[3], const Vector3d& middle) const
  {
    Vector2d pixel;
    constexpr double half = 0.5; // of what can be seen of a point
    const auto hidden = [&](const Vector3d& point)
    { return BlendShare(reference, point, this->Hard, pixel) < half; };
    return !hidden(p[0]) && !hidden(p[1]) && !hidden(p[2]) && !hidden(middle);
  }

  /** Iterated conditional modes, in the order of the ids, so that the result is one. */
  void Smooth()
  {
    bool changed = true;
    for (int round = 0; round < this->Options.SmoothingRounds && changed; ++round)
    {
      changed = false;
      for (std::size_t cellId = 0; cellId < this->Label.size(); ++cellId)
      {
        int& own = this->Label[cellId];
        const int best = own < this->Views ? this->BestLabel(static_cast<int>(cellId)) : own;
        changed = changed || best != own;
        own = best;
      }
    }
  }

  int BestLabel(int cellId)
  {
    const float* quality = this->QualityOf(cellId);
    const auto worth = [&](int label)
    {
      double sum = quality[label];
      for (const int other : this->Neighbours[cellId])
      {
        sum += other >= 0 && this->Label[other] == label ? this->Options.Loyalty : 0;
      }
      return sum;
    };
    int best = this->Label[cellId];
    double most = worth(best);
    for (const int other : this->Neighbours[cellId])
    {
      const int label = other >= 0 ? this->Label[other] : this->Views;
      if (label < this->Views && quality[label] > 0 && worth(label) > most)
      {
        most = worth(label);
        best = label;
      }
    }
    return best;
  }

  const TriangleMesh& Mesh;
  const std::vector<BlendReference>& References;
  const TextureAtlasOptions& Options;
  const TextureOptions Hard{ 1, 1, 1e-3, 1.5, 0, false, false, 1 };
  const int Views;
  std::vector<float> Quality; ///< per triangle and view, 1 = the best
  std::vector<int> Label;
  std::vector<std::array<int, 3>> Neighbours;
};

/** Connected triangles of one label, in the order of their lowest ids. */
std::vector<AtlasChart> ConnectedCharts(const PhotographChoice& choice, int views)
{
  const std::vector<int>& labels = choice.Labels();
  DisjointSets sets(static_cast<int>(labels.size()));
  for (std::size_t cellId = 0; cellId < labels.size(); ++cellId)
  {
    for (const int other : choice.Adjacent()[cellId])
    {
      if (other >= 0 && labels[other] == labels[cellId])
      {
        sets.Unite(static_cast<int>(cellId), other);
      }
    }
  }
  std::vector<AtlasChart> charts;
  std::vector<int> chartOf(labels.size(), -1);
  for (std::size_t cellId = 0; cellId < labels.size(); ++cellId)
  {
    const int root = sets.Find(static_cast<int>(cellId));
    if (chartOf[root] < 0)
    {
      chartOf[root] = static_cast<int>(charts.size());
      charts.emplace_back().View = labels[cellId] % views;
    }
    charts[chartOf[root]].Cells.push_back(static_cast<int>(cellId));
  }
  return charts;
}

/** The rectangle of every chart at the layout's scale. */
void Measure(const TriangleMesh& mesh, AtlasLayout& layout)
{
  for (AtlasChart& chart : layout.Charts)
  {
    chart.Origin = Vector2d::Zero();
    Eigen::AlignedBox2d box;
    for (const int cellId : chart.Cells)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        box.extend(layout.InChart(chart, mesh.Points[mesh.Triangles[cellId][corner]]));
      }
    }
    chart.Origin = box.min().array().floor() - layout.PaddingPx;
    const Vector2d extent = box.max().array().ceil() - chart.Origin.array();
    chart.Width = ToInt(extent.x()) + 1 + layout.PaddingPx;
    chart.Height = ToInt(extent.y()) + 1 + layout.PaddingPx;
  }
}

/** Packs the rectangles in rows, tallest first. */
void Pack(AtlasLayout& layout)
{
  std::vector<int> order(layout.Charts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&](int a, int b) { return layout.Charts[a].Height > layout.Charts[b].Height; });
  double area = 0;
  int widest = 0;
  for (const AtlasChart& chart : layout.Charts)
  {
    area += static_cast<double>(chart.Width) * chart.Height;
    widest = std::max(widest, chart.Width);
  }
  layout.Width = std::max(widest, CeilToInt(std::sqrt(area)));
  int x = 0;
  int y = 0;
  int rowHeight = 0;
  for (const int chartId : order)
  {
    AtlasChart& chart = layout.Charts[chartId];
    if (x + chart.Width > layout.Width)
    {
      x = 0;
      y += rowHeight;
      rowHeight = 0;
    }
    chart.X = x;
    chart.Y = y;
    x += chart.Width;
    rowHeight = std::max(rowHeight, chart.Height);
  }
  layout.Height = y + rowHeight;
}
}

AtlasLayout LayOutCharts(const TriangleMesh& mesh, const std::vector<BlendReference>& references,
  const std::vector<View>& views, const TextureAtlasOptions& options, const Execution& execution)
{
  const PhotographChoice choice(mesh, references, options, execution);
  AtlasLayout layout{ views, ConnectedCharts(choice, static_cast<int>(views.size())) };
  layout.PaddingPx = options.PaddingPx;
  constexpr double least = 0.01; // texels per pixel: less is no texture
  for (;;)
  {
    Measure(mesh, layout);
    Pack(layout);
    const int largest = std::max(layout.Width, layout.Height);
    if (largest <= options.LargestSidePx)
    {
      return layout;
    }
    // Paddings do not shrink, so a little more than in proportion.
    layout.Scale *= 0.95 * options.LargestSidePx / largest;
    if (layout.Scale < least)
    {
      throw Error("texture atlas", "the charts do not fit into the picture",
        std::to_string(layout.Charts.size()) + " charts in " +
          SizeText(options.LargestSidePx, options.LargestSidePx),
        "a larger picture");
    }
  }
}
}
