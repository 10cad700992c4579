// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/TextureAtlas.h"

#include "core/Error.h"
#include "core/FillHolesIteratively.h"
#include "core/ToInt.h"
#include "geometry/MeshNeighbours.h"
#include "texture/AtlasCharts.h"
#include "texture/PhotoBlender.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;
using Rgb = std::array<std::uint8_t, 3>;

Rgb Rounded(const double rgb[3])
{
  Rgb colour;
  for (int channel = 0; channel < 3; ++channel)
  {
    colour[channel] = static_cast<std::uint8_t>(RoundToInt(ClampedNumber(rgb[channel], 0, 255)));
  }
  return colour;
}

/** What the colour of the surface is made of. */
struct Surface
{
  const TriangleMesh& Mesh;
  std::vector<Vector3d> Normals;
  std::vector<BlendReference> References;
  const TextureOptions& Options;
};

/** Colours of the points; `known` tells which some photograph sees. */
std::vector<Rgb> SeenColours(
  const Surface& surface, std::vector<std::uint8_t>& known, const Execution& execution)
{
  std::vector<Rgb> colours(surface.Mesh.Points.size(), Rgb{ 128, 128, 128 });
  known.assign(surface.Mesh.Points.size(), 0);
  execution.ForEachWith(
    static_cast<std::int64_t>(colours.size()),
    [&] { return PhotoBlender(surface.References, surface.Options); },
    [&](PhotoBlender& blender, std::int64_t ptId)
    {
      double rgb[3];
      known[ptId] = blender.Blend(surface.Mesh.Points[ptId], -surface.Normals[ptId], rgb);
      colours[ptId] = known[ptId] ? Rounded(rgb) : colours[ptId];
    });
  return colours;
}

/** Fills what is not known with the mean of the known neighbours, a layer at a time. */
void FillUnknown(
  const TriangleMesh& mesh, std::vector<Rgb>& colours, std::vector<std::uint8_t> known)
{
  const MeshNeighbours neighbours(mesh);
  std::vector<int> open;
  for (std::size_t ptId = 0; ptId < known.size(); ++ptId)
  {
    if (!known[ptId])
    {
      open.push_back(static_cast<int>(ptId));
    }
  }
  FillHolesIteratively(
    std::move(open),
    [&](int ptId)
    {
      double sum[3] = { 0, 0, 0 };
      int count = 0;
      for (const int other : neighbours.Points(ptId))
      {
        for (int channel = 0; channel < 3 && known[other]; ++channel)
        {
          sum[channel] += colours[other][channel];
        }
        count += known[other];
      }
      for (double& each : sum)
      {
        each /= std::max(count, 1);
      }
      colours[ptId] = count ? Rounded(sum) : colours[ptId];
      return count > 0;
    },
    [&](int ptId) { known[ptId] = 1; });
}

Surface SurfaceOf(const TriangleMesh& mesh, const std::vector<View>& views,
  const TextureOptions& options, const Execution& execution)
{
  return { mesh, VertexNormals(mesh), MakeBlendReferences(mesh, views, nullptr, options, execution),
    options };
}

/** Paints the charts; each writes its own rectangle only. */
class AtlasPainter
{
public:
  AtlasPainter(const Surface& surface, const std::vector<Rgb>& pointColours,
    const AtlasLayout& layout, Image<std::uint8_t>& picture)
    : Textured(surface)
    , PointColours(pointColours)
    , Layout(layout)
    , Picture(picture)
    , Blender(surface.References, surface.Options)
  {
  }

  /** Counts the chart's texels, and those of them that a photograph sees. */
  void Paint(const AtlasChart& chart, std::int64_t& texels, std::int64_t& seen)
  {
    this->Done = Image<std::uint8_t>(chart.Width, chart.Height);
    this->Seen = 0;
    for (const int cellId : chart.Cells)
    {
      this->PaintTriangle(chart, cellId);
    }
    for (const int cellId : chart.Cells)
    {
      this->PaintCorners(chart, cellId);
    }
    texels = std::count(this->Done.Values.begin(), this->Done.Values.end(), 1);
    seen = this->Seen;
    for (int layer = 0; layer < this->Layout.PaddingPx; ++layer)
    {
      this->Dilate(chart);
    }
  }

private:
  void PaintTriangle(const AtlasChart& chart, int cellId)
  {
    const Eigen::Vector3i& t = this->Textured.Mesh.Triangles[cellId];
    Vector2d p[3]; // in the chart's rectangle
    for (int corner = 0; corner < 3; ++corner)
    {
      p[corner] = this->Layout.InChart(chart, this->Textured.Mesh.Points[t[corner]]);
    }
    const double area = Cross(p[1] - p[0], p[2] - p[0]);
    if (area == 0)
    {
      return;
    }
    const auto [xMin, xMax] = std::minmax({ p[0].x(), p[1].x(), p[2].x() });
    const auto [yMin, yMax] = std::minmax({ p[0].y(), p[1].y(), p[2].y() });
    for (int y = std::max(0, CeilToInt(yMin));
         y <= std::min<double>(std::floor(yMax), chart.Height - 1); ++y)
    {
      for (int x = std::max(0, CeilToInt(xMin));
           x <= std::min<double>(std::floor(xMax), chart.Width - 1); ++x)
      {
        const Vector2d at(x, y);
        const Vector3d w(Cross(p[1] - at, p[2] - at) / area, Cross(p[2] - at, p[0] - at) / area,
          Cross(p[0] - at, p[1] - at) / area);
        if (w.minCoeff() >= 0 && !this->Done(x, y))
        {
          // Renderers interpolate texture coordinates on the triangle, not in the photograph.
          this->PaintTexel(chart, x, y, t, w);
        }
      }
    }
  }

  /** A triangle between the texels, or seen from its edge, has colours at its corners at least. */
  void PaintCorners(const AtlasChart& chart, int cellId)
  {
    const Eigen::Vector3i& t = this->Textured.Mesh.Triangles[cellId];
    for (int corner = 0; corner < 3; ++corner)
    {
      const Vector2d p = this->Layout.InChart(chart, this->Textured.Mesh.Points[t[corner]]);
      const int x = RoundToInt(p.x());
      const int y = RoundToInt(p.y());
      if (!this->Done(x, y))
      {
        this->PaintTexel(chart, x, y, t, Vector3d::Unit(corner));
      }
    }
  }

  void PaintTexel(
    const AtlasChart& chart, int x, int y, const Eigen::Vector3i& t, const Vector3d& w)
  {
    Vector3d point = Vector3d::Zero();
    Vector3d normal = Vector3d::Zero();
    double filled[3] = { 0, 0, 0 };
    for (int corner = 0; corner < 3; ++corner)
    {
      point += w[corner] * this->Textured.Mesh.Points[t[corner]];
      normal += w[corner] * this->Textured.Normals[t[corner]];
      for (int channel = 0; channel < 3; ++channel)
      {
        filled[channel] += w[corner] * this->PointColours[t[corner]][channel];
      }
    }
    double rgb[3];
    const bool seen = normal.norm() > 0 && this->Blender.Blend(point, -normal.normalized(), rgb);
    this->Set(chart, x, y, Rounded(seen ? rgb : filled));
    this->Seen += seen;
    this->Done(x, y) = 1;
  }

  void Set(const AtlasChart& chart, int x, int y, const Rgb& colour)
  {
    std::copy(colour.begin(), colour.end(), this->Picture.Ref().Pixel(chart.X + x, chart.Y + y));
  }

  /** Every texel beside done ones takes their mean. */
  void Dilate(const AtlasChart& chart)
  {
    const Image<std::uint8_t> before = this->Done;
    const auto known = before.Ref();
    for (int y = 0; y < chart.Height; ++y)
    {
      for (int x = 0; x < chart.Width; ++x)
      {
        double sum[3] = { 0, 0, 0 };
        int count = 0;
        for (int n = 0; n < 9 && !before(x, y); ++n)
        {
          const int i = x + n % 3 - 1;
          const int j = y + n / 3 - 1;
          if (known.Contains(i, j) && known(i, j))
          {
            ++count;
            for (int channel = 0; channel < 3; ++channel)
            {
              sum[channel] += this->Picture(chart.X + i, chart.Y + j, channel);
            }
          }
        }
        if (count > 0)
        {
          const double mean[3] = { sum[0] / count, sum[1] / count, sum[2] / count };
          this->Set(chart, x, y, Rounded(mean));
          this->Done(x, y) = 1;
        }
      }
    }
  }

  static double Cross(const Vector2d& a, const Vector2d& b)
  {
    return a.x() * b.y() - a.y() * b.x();
  }

  const Surface& Textured;
  const std::vector<Rgb>& PointColours;
  const AtlasLayout& Layout;
  Image<std::uint8_t>& Picture;
  PhotoBlender Blender;
  Image<std::uint8_t> Done; ///< of the chart's rectangle
  std::int64_t Seen = 0;
};

/** The mesh with a point of its own for every chart that uses it. */
void SplitPoints(const TriangleMesh& mesh, const AtlasLayout& layout, TextureAtlas& atlas)
{
  atlas.Mesh.Triangles.resize(mesh.Triangles.size());
  std::vector<int> lastChart(mesh.Points.size(), -1);
  std::vector<int> copy(mesh.Points.size());
  for (std::size_t chartId = 0; chartId < layout.Charts.size(); ++chartId)
  {
    const AtlasChart& chart = layout.Charts[chartId];
    for (const int cellId : chart.Cells)
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const int ptId = mesh.Triangles[cellId][corner];
        if (lastChart[ptId] != static_cast<int>(chartId))
        {
          lastChart[ptId] = static_cast<int>(chartId);
          copy[ptId] = static_cast<int>(atlas.Mesh.Points.size());
          atlas.Mesh.Points.push_back(mesh.Points[ptId]);
          atlas.PointOf.push_back(ptId);
          // Texel centres are half a texel from the picture's border.
          const Vector2d at =
            layout.InChart(chart, mesh.Points[ptId]) + Vector2d(chart.X + 0.5, chart.Y + 0.5);
          atlas.TexCoords.emplace_back(at.x() / layout.Width, at.y() / layout.Height);
        }
        atlas.Mesh.Triangles[cellId][corner] = copy[ptId];
      }
    }
  }
}
}

std::vector<Rgb> ColourPoints(const TriangleMesh& mesh, const std::vector<View>& views,
  const TextureOptions& options, const Execution& execution)
{
  const Surface surface = SurfaceOf(mesh, views, options, execution);
  std::vector<std::uint8_t> known;
  std::vector<Rgb> colours = SeenColours(surface, known, execution);
  FillUnknown(mesh, colours, std::move(known));
  return colours;
}

TextureAtlas MakeTextureAtlas(const TriangleMesh& mesh, const std::vector<View>& views,
  const TextureAtlasOptions& options, const Execution& execution)
{
  if (mesh.Triangles.empty())
  {
    throw Error("texture atlas", "the mesh has no triangles");
  }
  const Surface surface = SurfaceOf(mesh, views, options.Texture, execution);
  execution.Report(0.2);
  const AtlasLayout layout = LayOutCharts(mesh, surface.References, views, options, execution);
  execution.Report(0.4);
  std::vector<std::uint8_t> known;
  std::vector<Rgb> pointColours = SeenColours(surface, known, execution);
  FillUnknown(mesh, pointColours, std::move(known));
  execution.Report(0.5);

  TextureAtlas atlas;
  atlas.Charts = static_cast<int>(layout.Charts.size());
  atlas.Scale = layout.Scale;
  atlas.Picture = Image<std::uint8_t>(layout.Width, layout.Height, 3, 128);
  std::vector<std::int64_t> texels(layout.Charts.size());
  std::vector<std::int64_t> seen(layout.Charts.size());
  execution.ForEachWith(
    static_cast<std::int64_t>(layout.Charts.size()),
    [&] { return AtlasPainter(surface, pointColours, layout, atlas.Picture); },
    [&](AtlasPainter& painter, std::int64_t chartId)
    { painter.Paint(layout.Charts[chartId], texels[chartId], seen[chartId]); });
  double all = 0;
  for (std::size_t chartId = 0; chartId < texels.size(); ++chartId)
  {
    all += static_cast<double>(texels[chartId]);
    atlas.SeenShare += static_cast<double>(seen[chartId]);
  }
  atlas.SeenShare /= std::max(all, 1.0);
  atlas.UsedShare = all / (static_cast<double>(layout.Width) * layout.Height);
  SplitPoints(mesh, layout, atlas);
  execution.Report(1);
  return atlas;
}
}
