// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/EnergyScene.h"

#include "ViewAccess.h"
#include "core/ToInt.h"
#include "deformation/NonOutlineDeformation.h"
#include "deformation/OutlineEnergy.h"
#include "deformation/OutlineViews.h"
#include "geometry/NovelProjection.h"
#include "geometry/Rasteriser.h"
#include "geometry/ViewSelection.h"
#include "geometry/Visibility.h"
#include "mesh/ObjectMesh.h"
#include "silhouettes/SilhouetteField.h"
#include "synthesis/Synthesis.h"

#include <cmath>
#include <optional>
#include <utility>

namespace novelview::evaluation
{
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
std::vector<Vector3d> NeighboursOf(const TriangleMesh& mesh, const MeshNeighbours& neighbours,
  int ptId, const std::vector<std::uint8_t>& wanted)
{
  std::vector<Vector3d> around;
  for (const int other : neighbours.Points(ptId))
  {
    if (wanted.empty() || wanted[other])
    {
      around.push_back(mesh.Points[other]);
    }
  }
  return around;
}

/** The outline points of the true mesh in a novel view. */
class OutlineProbe
{
public:
  OutlineProbe(const EnergyScene& scene, const Camera& novel)
    : Scene(scene)
    , Novel(novel)
    , Mesh(NovelProjection::FacingPart(scene.Truth, novel))
    , Neighbours(this->Mesh)
    , Silhouette(Rasterise(this->Mesh, novel))
    , Outline(this->Mesh.Points.size(), 0)
    , Selector(scene.Truth, scene.Views, novel, this->Options)
    , Order(ViewsByAngle(scene.Views, novel.OpticalAxis()))
    , Nearest(NearestNeighbours(scene.Views, this->Options.Secondaries))
    , Contour(ContourViews(scene.Views, novel, this->Options))
  {
    const std::vector<std::uint8_t> visible = VisibleVertices(scene.Truth, novel);
    for (int ptId = 0; ptId < static_cast<int>(this->Outline.size()); ++ptId)
    {
      this->Outline[ptId] = visible[ptId] && !this->Neighbours.Triangles(ptId).empty() &&
        OnContour(this->Silhouette, novel.Project(this->Mesh.Points[ptId]));
    }
  }

  void AddTo(std::vector<Landscape>& landscapes) const
  {
    for (int ptId = 0; ptId < static_cast<int>(this->Outline.size()); ++ptId)
    {
      const auto direction = this->Outline[ptId]
        ? OutlineDirection(this->Silhouette, this->Novel.Project(this->Mesh.Points[ptId]))
        : std::nullopt;
      if (direction)
      {
        this->AddPoint(ptId, *direction, landscapes);
      }
    }
  }

private:
  void AddPoint(int ptId, const Vector2d& direction, std::vector<Landscape>& landscapes) const
  {
    const Vector3d here = this->Mesh.Points[ptId];
    const Vector2d pixel = this->Novel.Project(here);
    const double depth = this->Novel.Depth(here);
    const Vector3d step =
      this->Novel.Unproject(pixel + direction, depth) - this->Novel.Unproject(pixel, depth);
    const OutlineViews compared = this->Selector.Select(here, step);
    const int first = this->Order.front();
    const std::vector<Vector3d> around =
      NeighboursOf(this->Mesh, this->Neighbours, ptId, this->Outline);
    const Offsets& offsets = landscapes[0].Along;
    std::vector<double> energies[5];
    for (int i = 0; i < offsets.Count(); ++i)
    {
      const Vector3d point = here + offsets[i] * step;
      const double photo = compared.Key < 0
        ? 0
        : OutlinePhotoEnergy(point, this->Scene.Views, compared.Key, compared.Secondaries,
            this->Options.WindowRadius);
      const double contour =
        OutlineContourEnergy(point, this->Scene.Views, this->Contour, this->Options.SigmaPx);
      const double smooth = OutlineSmoothnessEnergy(point, step.normalized(), around);
      energies[0].push_back(photo);
      energies[1].push_back(photo + this->Options.Alpha * contour + this->Options.Beta * smooth);
      energies[2].push_back(OutlinePhotoEnergy(
        point, this->Scene.Views, first, this->Nearest[first], this->Options.WindowRadius));
      energies[3].push_back(contour);
      energies[4].push_back(smooth);
    }
    for (int i = compared.Key < 0 ? 3 : 0; i < 5; ++i) // E_s says nothing then
    {
      landscapes[i].Add(energies[i]);
    }
  }

  const EnergyScene& Scene;
  const Camera& Novel;
  const OutlineOptions Options;
  const TriangleMesh Mesh;
  const MeshNeighbours Neighbours;
  const ItemBuffer Silhouette;
  std::vector<std::uint8_t> Outline; ///< per point
  const OutlineViewSelector Selector;
  const std::vector<int> Order;
  const std::vector<std::vector<int>> Nearest;
  const std::vector<int> Contour;
};

/** Visible vertices of the true mesh that are no outline points, and the hull in front of them. */
class NonOutlineProbe
{
public:
  NonOutlineProbe(const EnergyScene& scene, const Camera& novel)
    : Scene(scene)
    , Novel(novel)
    , Neighbours(scene.Truth)
    , Visible(VisibleVertices(scene.Truth, novel))
    , TruePicture(Rasterise(scene.Truth, novel))
    , HullPicture(Rasterise(scene.Hull, novel))
    , HullNormals(VertexNormals(scene.Hull))
    , Field(scene.Views)
    , Nearest(NearestNeighbours(scene.Views, this->Options.Secondaries))
  {
    for (const View& view : scene.Views)
    {
      this->Depths.push_back(RasteriseDepth(scene.Hull, view.Cam));
    }
  }

  void AddTo(std::vector<Landscape>& landscapes, int stride) const
  {
    for (std::size_t ptId = 0; ptId < this->Visible.size();
         ptId += static_cast<std::size_t>(stride))
    {
      const Vector3d& truth = this->Scene.Truth.Points[ptId];
      const Vector2d pixel = this->Novel.Project(truth);
      if (this->Visible[ptId] && this->Novel.InFrame(pixel) && !OnContour(this->TruePicture, pixel))
      {
        this->AddPoint(static_cast<int>(ptId), pixel, landscapes);
      }
    }
  }

private:
  void AddPoint(int ptId, const Vector2d& pixel, std::vector<Landscape>& landscapes) const
  {
    const int x = RoundToInt(pixel.x());
    const int y = RoundToInt(pixel.y());
    const Vector3d& truth = this->Scene.Truth.Points[ptId];
    if (!this->HullPicture.Hit(x, y))
    {
      return;
    }
    const Vector3d start = this->Novel.Unproject(pixel, this->HullPicture.Depth(x, y));
    const Eigen::Vector3i& t = this->Scene.Hull.Triangles[this->HullPicture.CellId(x, y)];
    const Vector3d normal =
      this->HullNormals[t[0]] + this->HullNormals[t[1]] + this->HullNormals[t[2]];
    const int key = this->KeyOf(start, normal.normalized());
    if (key < 0)
    {
      return;
    }
    const Vector3d ray = (truth - this->Novel.Centre()).normalized();
    const double footprint = this->Novel.PixelFootprint(this->Novel.Depth(truth));
    const std::vector<Vector3d> around =
      NeighboursOf(this->Scene.Truth, this->Neighbours, ptId, {});
    const Offsets& offsets = landscapes[0].Along;
    std::vector<double> hull;
    std::vector<double> smooth;
    for (int i = 0; i < offsets.Count(); ++i)
    {
      const Vector3d point = truth + offsets[i] * footprint * ray;
      hull.push_back(std::abs(this->Field.Value(point)) / footprint);
      smooth.push_back(RaySmoothnessEnergy(point, ray, around, footprint));
    }
    for (const int from : { 0, 2 })
    {
      const std::vector<SubPoint> matches = MatchSecondaries(
        from == 0 ? start : truth, this->Scene.Views, key, this->Nearest[key], this->Options);
      const double beta = SubPointReliability(matches, this->Options.Secondaries);
      std::vector<double> photo;
      std::vector<double> whole;
      for (int i = 0; i < offsets.Count(); ++i)
      {
        photo.push_back(SubPointEnergy(
          truth + offsets[i] * footprint * ray, matches, this->Options.Secondaries, footprint));
        whole.push_back(photo[i] + (1 - beta) * hull[i] + this->Options.Alpha * smooth[i]);
      }
      landscapes[from].Add(photo);
      landscapes[from + 1].Add(whole);
    }
    landscapes[4].Add(hull);
    landscapes[5].Add(smooth);
  }

  /** The view that the normal points to most directly among those that see the point; -1 = none. */
  int KeyOf(const Vector3d& point, const Vector3d& normal) const
  {
    int key = -1;
    double most = 0;
    for (int viewId = 0; viewId < static_cast<int>(this->Scene.Views.size()); ++viewId)
    {
      const Camera& camera = this->Scene.Views[viewId].Cam;
      const double cosine = normal.dot((camera.Centre() - point).normalized());
      if (cosine > most && camera.Depth(point) > 0 && camera.InFrame(camera.Project(point)) &&
        IsUnoccluded(this->Depths[viewId].Ref(), camera, point, 1.5))
      {
        key = viewId;
        most = cosine;
      }
    }
    return key;
  }

  const EnergyScene& Scene;
  const Camera& Novel;
  const NonOutlineOptions Options;
  const MeshNeighbours Neighbours;
  const std::vector<std::uint8_t> Visible;
  const ItemBuffer TruePicture;
  const ItemBuffer HullPicture;
  const std::vector<Vector3d> HullNormals;
  const SilhouetteField Field;
  const std::vector<std::vector<int>> Nearest;
  std::vector<Image<float>> Depths; ///< of the hull, per view
};
}

EnergyScene::EnergyScene(const std::filesystem::path& folder)
  : Photographs(ReadDataset(ReadDatasetIndex(folder)))
  , Views(ReadColouredViews(this->Photographs.Views, 2))
  , Truth(ToTriangleMesh(LoadObject((folder / "truth.ply").string()), "truth.ply"))
{
  Synthesis synthesis(this->Photographs.Views, PresetOptions("paper"));
  this->Hull = ToTriangleMesh(synthesis.Crust(), "crust");
  for (const Photograph& photograph : ReadViewCameras(folder / "test" / "test_par.txt"))
  {
    Camera& novel = this->Novel.emplace_back(photograph.Cam);
    novel.Width = this->Views.front().Cam.Width; // the file does not tell
    novel.Height = this->Views.front().Cam.Height;
  }
}

std::vector<Landscape> OutlineLandscapes(const EnergyScene& scene)
{
  constexpr Offsets offsets{ 8, 0.25 };
  std::vector<Landscape> landscapes;
  for (const char* name : { "E_s", "E", "E_s, nearest views", "E_c", "E_r" })
  {
    landscapes.emplace_back(name, offsets);
  }
  for (const Camera& novel : scene.Novel)
  {
    OutlineProbe(scene, novel).AddTo(landscapes);
  }
  return landscapes;
}

std::vector<Landscape> NonOutlineLandscapes(const EnergyScene& scene, int stride)
{
  constexpr Offsets offsets{ 12, 0.5 };
  std::vector<Landscape> landscapes;
  for (const char* name : { "beta E_s from the hull", "E from the hull", "beta E_s from the truth",
         "E from the truth", "E_vh", "E_r" })
  {
    landscapes.emplace_back(name, offsets);
  }
  for (const Camera& novel : scene.Novel)
  {
    NonOutlineProbe(scene, novel).AddTo(landscapes, stride);
  }
  return landscapes;
}
}
