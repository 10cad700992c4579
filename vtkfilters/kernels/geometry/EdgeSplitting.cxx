// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/EdgeSplitting.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace novelview
{
namespace
{
class EdgeSplitter
{
public:
  EdgeSplitter(const TriangleMesh& mesh, const Camera& camera, double longest)
    : Longest(longest)
    , InFront(mesh.Points.size())
    , Pixels(mesh.Points.size())
  {
    this->Result.Mesh.Points = mesh.Points;
    for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
    {
      this->InFront[ptId] = camera.Depth(mesh.Points[ptId]) > 0;
      this->Pixels[ptId] =
        this->InFront[ptId] ? camera.Project(mesh.Points[ptId]) : Eigen::Vector2d::Zero();
    }
    this->Result.Mesh.Triangles.reserve(4 * mesh.Triangles.size());
    for (const Eigen::Vector3i& triangle : mesh.Triangles)
    {
      this->Split(triangle);
    }
  }

  SplitMesh Result;

private:
  /** The middle of an edge; -1 when it stays whole. */
  int Middle(int a, int b)
  {
    if (!this->InFront[a] || !this->InFront[b] ||
      !((this->Pixels[a] - this->Pixels[b]).norm() > this->Longest))
    {
      return -1;
    }
    const auto [low, high] = std::minmax(a, b);
    std::vector<Eigen::Vector3d>& points = this->Result.Mesh.Points;
    const auto [place, fresh] = this->Middles.try_emplace(
      static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high),
      static_cast<int>(points.size()));
    if (fresh)
    {
      points.push_back(0.5 * (points[low] + points[high]));
      this->Result.Ends.push_back({ low, high });
    }
    return place->second;
  }

  void Add(int a, int b, int c) { this->Result.Mesh.Triangles.emplace_back(a, b, c); }

  void Split(const Eigen::Vector3i& t)
  {
    int middles[3]; // of the edges from each corner to the next
    int cuts = 0;
    for (int k = 0; k < 3; ++k)
    {
      middles[k] = this->Middle(t[k], t[(k + 1) % 3]);
      cuts += middles[k] >= 0;
    }
    if (cuts == 0)
    {
      this->Add(t[0], t[1], t[2]);
      return;
    }
    if (cuts == 3)
    {
      this->Add(t[0], middles[0], middles[2]);
      this->Add(middles[0], t[1], middles[1]);
      this->Add(middles[2], middles[1], t[2]);
      this->Add(middles[0], middles[1], middles[2]);
      return;
    }
    // Turned so that the odd one, the only cut or the only whole edge, is the first.
    const bool odd = cuts == 1;
    const int first = static_cast<int>(
      std::find_if(middles, middles + 3, [odd](int middle) { return (middle >= 0) == odd; }) -
      middles);
    const int a = t[first];
    const int b = t[(first + 1) % 3];
    const int c = t[(first + 2) % 3];
    if (cuts == 1)
    {
      this->Add(a, middles[first], c);
      this->Add(middles[first], b, c);
      return;
    }
    const int bc = middles[(first + 1) % 3];
    const int ca = middles[(first + 2) % 3];
    this->Add(ca, bc, c);
    const std::vector<Eigen::Vector3d>& points = this->Result.Mesh.Points;
    if ((points[a] - points[bc]).squaredNorm() <= (points[b] - points[ca]).squaredNorm())
    {
      this->Add(a, b, bc);
      this->Add(a, bc, ca);
    }
    else
    {
      this->Add(a, b, ca);
      this->Add(b, bc, ca);
    }
  }

  const double Longest;
  std::vector<char> InFront;
  std::vector<Eigen::Vector2d> Pixels;
  std::unordered_map<std::uint64_t, int> Middles; ///< by the two ends
};
}

SplitMesh SplitLongEdges(const TriangleMesh& mesh, const Camera& camera, double longest)
{
  return std::move(EdgeSplitter(mesh, camera, longest).Result);
}
}
