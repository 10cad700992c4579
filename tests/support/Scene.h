// SPDX-License-Identifier: GPL-3.0-or-later
// Photographs of analytic shapes, ray cast pixel by pixel, and meshes of the same shapes: what the
// tests of the stages look at. Everything about such a scene is known in closed form.
#ifndef support_Scene_h
#define support_Scene_h

#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "silhouettes/ContourDistance.h"

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace support
{
using Eigen::Vector2d;
using Eigen::Vector3d;

// ---- shapes ------------------------------------------------------------------------------------

/** The least t > 0 at which origin + t direction meets the shape. */
using Shape =
  std::function<std::optional<double>(const Vector3d& origin, const Vector3d& direction)>;

/** Signed distance, negative inside (a lower bound outside is enough). */
using DistanceFunction = std::function<double(const Vector3d& point)>;

inline Shape Sphere(const Vector3d& centre, double radius)
{
  return [=](const Vector3d& origin, const Vector3d& direction) -> std::optional<double>
  {
    const Vector3d m = origin - centre;
    const double a = direction.squaredNorm();
    const double b = m.dot(direction);
    const double discriminant = b * b - a * (m.squaredNorm() - radius * radius);
    if (discriminant < 0)
    {
      return std::nullopt;
    }
    const double t = (-b - std::sqrt(discriminant)) / a;
    return t > 0 ? std::optional<double>(t) : std::nullopt;
  };
}

inline Shape Box(const Vector3d& low, const Vector3d& high)
{
  return [=](const Vector3d& origin, const Vector3d& direction) -> std::optional<double>
  {
    double enter = 0;
    double leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = (low[axis] - origin[axis]) / direction[axis];
      const double b = (high[axis] - origin[axis]) / direction[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter < leave && enter > 0 ? std::optional<double>(enter) : std::nullopt;
  };
}

/** The rectangle |x| <= halfX, |y| <= halfY in the plane z = height, seen from both sides. */
inline Shape Rectangle(double halfX, double halfY, double height = 0)
{
  return [=](const Vector3d& origin, const Vector3d& direction) -> std::optional<double>
  {
    const double t = (height - origin.z()) / direction.z();
    const Vector3d at = origin + t * direction;
    return t > 0 && std::abs(at.x()) <= halfX && std::abs(at.y()) <= halfY
      ? std::optional<double>(t)
      : std::nullopt;
  };
}

inline DistanceFunction TorusDistance(double ringRadius, double tubeRadius)
{
  return [=](const Vector3d& p)
  { return std::hypot(std::hypot(p.x(), p.z()) - ringRadius, p.y()) - tubeRadius; };
}

/** A sphere about the origin out of which a second ball is bitten. */
inline DistanceFunction DentedSphereDistance(double radius, const Vector3d& bite, double biteRadius)
{
  return [=](const Vector3d& p)
  { return std::max(p.norm() - radius, biteRadius - (p - bite).norm()); };
}

/**
 * Sphere tracing of a shape within a ball about the origin: steps of the distance to the surface
 * never jump over it.
 */
inline Shape Traced(const DistanceFunction& distance, double boundRadius)
{
  const Shape bound = Sphere(Vector3d::Zero(), boundRadius);
  return [=](const Vector3d& origin, const Vector3d& direction) -> std::optional<double>
  {
    const std::optional<double> enter = bound(origin, direction);
    const double length = direction.norm();
    double t = enter.value_or(0);
    for (int step = 0; step < 500 && enter && t < *enter + 2 * boundRadius / length; ++step)
    {
      const double d = distance(origin + t * direction);
      if (d < 1e-9 * boundRadius)
      {
        return t;
      }
      t += d / length;
    }
    return std::nullopt;
  };
}

inline Shape Union(std::vector<Shape> parts)
{
  return [parts = std::move(parts)](
           const Vector3d& origin, const Vector3d& direction) -> std::optional<double>
  {
    std::optional<double> nearest;
    for (const Shape& part : parts)
    {
      const std::optional<double> t = part(origin, direction);
      if (t && (!nearest || *t < *nearest))
      {
        nearest = t;
      }
    }
    return nearest;
  };
}

// ---- colours -----------------------------------------------------------------------------------

/** Red, green, blue, 0 to 255, of a point in space: a solid texture, so all views agree. */
using Texture = std::function<Vector3d(const Vector3d& point)>;

/** Smooth waves in three directions; amplitude at most 96 about 128. */
inline Texture Waves(double wavelength)
{
  return [=](const Vector3d& p) -> Vector3d
  {
    const double k = 2 * EIGEN_PI / wavelength;
    return Vector3d(128 + 60 * std::sin(k * p.x()) + 36 * std::sin(0.7 * k * (p.y() + p.z()) + 1),
      128 + 60 * std::sin(k * p.y() + 2) + 36 * std::sin(0.7 * k * (p.z() - p.x())),
      128 + 60 * std::sin(k * p.z() + 4) + 36 * std::sin(0.7 * k * (p.x() - p.y()) + 3));
  };
}

inline Texture Plain(double red, double green, double blue)
{
  return [=](const Vector3d&) -> Vector3d { return { red, green, blue }; };
}

// ---- cameras and photographs -------------------------------------------------------------------

/** 160 x 120 pixels; the default focal length shows a unit ball from four units away in 100 px. */
inline Eigen::Matrix3d SmallPictureK(double focal = 400)
{
  Eigen::Matrix3d k;
  k << focal, 0, 79.5, 0, focal, 59.5, 0, 0, 1;
  return k;
}

/** A camera on a ring about the origin, 0 degrees on the +z axis, looking at the origin. */
inline novelview::Camera OnRing(double angleDeg, double elevationDeg = 0, double distance = 4,
  const Eigen::Matrix3d& k = SmallPictureK(), int width = 160, int height = 120)
{
  const double a = angleDeg * EIGEN_PI / 180;
  const double e = elevationDeg * EIGEN_PI / 180;
  const Vector3d centre =
    distance * Vector3d(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
  return novelview::LookAt(centre, Vector3d::Zero(), Vector3d::UnitY(), k, width, height);
}

inline std::vector<novelview::Camera> Ring(int count, double stepDeg, double focal = 400)
{
  std::vector<novelview::Camera> cameras;
  for (int i = 0; i < count; ++i)
  {
    cameras.push_back(OnRing(i * stepDeg, 0, 4, SmallPictureK(focal)));
  }
  return cameras;
}

struct Photo
{
  std::string Name;
  novelview::Camera Cam;
  novelview::Image<std::uint8_t> Color;
  novelview::Image<std::uint8_t> Mask; ///< share of the pixel that is object, 0 to 255
  novelview::Image<float> ContourDistance;
  novelview::Image<float> TrueDepth; ///< at the pixel's centre, 0 = no object

  novelview::View AsView() const
  {
    novelview::View view;
    view.Name = this->Name;
    view.Cam = this->Cam;
    view.Color = this->Color.Ref();
    view.Mask = this->Mask.Ref();
    view.ContourDistance = this->ContourDistance.Ref();
    return view;
  }
};

/** Depth at which the ray of a pixel position meets the shape. */
inline std::optional<double> DepthAt(
  const Shape& shape, const novelview::Camera& camera, const Vector2d& pixel)
{
  // With a direction of unit depth the ray's parameter is the depth.
  const Vector3d centre = camera.Centre();
  return shape(centre, camera.Unproject(pixel, 1) - centre);
}

/** Colour at the pixels' centres (black where they miss), mask by `samples`^2 rays per pixel. */
inline Photo Take(const Shape& shape, const Texture& texture, const novelview::Camera& camera,
  const std::string& name, int samples = 4)
{
  Photo photo{ name, camera, { camera.Width, camera.Height, 3 }, { camera.Width, camera.Height },
    {}, { camera.Width, camera.Height } };
  for (int y = 0; y < camera.Height; ++y)
  {
    for (int x = 0; x < camera.Width; ++x)
    {
      int hits = 0;
      for (int n = 0; n < samples * samples; ++n)
      {
        const Vector2d offset((n % samples + 0.5) / samples, (n / samples + 0.5) / samples);
        hits += DepthAt(shape, camera, Vector2d(x - 0.5, y - 0.5) + offset).has_value();
      }
      photo.Mask(x, y) = static_cast<std::uint8_t>(hits * 255 / (samples * samples));
      if (const auto depth = DepthAt(shape, camera, Vector2d(x, y)))
      {
        photo.TrueDepth(x, y) = static_cast<float>(*depth);
        const Vector3d rgb = texture(camera.Unproject(Vector2d(x, y), *depth));
        for (int channel = 0; channel < 3; ++channel)
        {
          photo.Color(x, y, channel) =
            static_cast<std::uint8_t>(std::lround(std::clamp(rgb[channel], 0.0, 255.0)));
        }
      }
    }
  }
  photo.ContourDistance = novelview::SignedContourDistance(std::as_const(photo.Mask).Ref());
  return photo;
}

/**
 * Counts the mask's boundary again with more rays, where four by four leave an eighth of a pixel
 * open.
 */
inline void RefineRim(Photo& photo, const Shape& shape, int samples = 8)
{
  for (int y = 0; y < photo.Cam.Height; ++y)
  {
    for (int x = 0; x < photo.Cam.Width; ++x)
    {
      int hits = 0;
      for (int n = 0; n < samples * samples && std::abs(photo.ContourDistance(x, y)) < 1; ++n)
      {
        const Vector2d offset((n % samples + 0.5) / samples, (n / samples + 0.5) / samples);
        hits += DepthAt(shape, photo.Cam, Vector2d(x - 0.5, y - 0.5) + offset).has_value();
        photo.Mask(x, y) = static_cast<std::uint8_t>(hits * 255 / (samples * samples));
      }
    }
  }
  photo.ContourDistance = novelview::SignedContourDistance(std::as_const(photo.Mask).Ref());
}

inline std::vector<Photo> TakeAll(
  const Shape& shape, const Texture& texture, const std::vector<novelview::Camera>& cameras)
{
  std::vector<Photo> photos;
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    photos.push_back(Take(shape, texture, cameras[i], "p" + std::to_string(i)));
  }
  return photos;
}

/** Makes a silhouette reach less far, pixels; further when negative. */
inline void ShrinkSilhouette(Photo& photo, float by)
{
  for (std::size_t i = 0; i < photo.ContourDistance.Values.size(); ++i)
  {
    photo.ContourDistance.Values[i] -= by;
    photo.Mask.Values[i] = photo.ContourDistance.Values[i] > 0 ? 255 : 0;
  }
}

/** Photographs of a box, whose upper and lower edges every one of twelve views has in its contour. */
inline std::vector<Photo> BoxPhotos()
{
  return TakeAll(
    Box(Vector3d(-0.4, -0.3, -0.35), Vector3d(0.4, 0.3, 0.35)), Plain(200, 200, 200), Ring(12, 30));
}

/** The photographs as kernels take them; they must outlive the views. */
inline std::vector<novelview::View> ViewsOf(const std::vector<Photo>& photos)
{
  std::vector<novelview::View> views;
  for (const Photo& photo : photos)
  {
    views.push_back(photo.AsView());
  }
  return views;
}

// ---- meshes ------------------------------------------------------------------------------------

/** An octahedron subdivided and pushed onto a sphere: 8 * 4^levels triangles. */
inline novelview::TriangleMesh SphereMesh(const Vector3d& centre, double radius, int levels)
{
  novelview::TriangleMesh mesh;
  mesh.Points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  mesh.Triangles = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 }, { 2, 0, 5 }, { 1, 2, 5 },
    { 3, 1, 5 }, { 0, 3, 5 } };
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto [it, fresh] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.Points.size()));
      if (fresh)
      {
        mesh.Points.push_back((mesh.Points[a] + mesh.Points[b]).normalized());
      }
      return it->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& t : mesh.Triangles)
    {
      const int a = middle(t[0], t[1]);
      const int b = middle(t[1], t[2]);
      const int c = middle(t[2], t[0]);
      finer.insert(finer.end(), { { t[0], a, c }, { a, t[1], b }, { c, b, t[2] }, { a, b, c } });
    }
    mesh.Triangles = std::move(finer);
  }
  for (Vector3d& point : mesh.Points)
  {
    point = centre + radius * point;
  }
  return mesh;
}

/** The rectangle of Rectangle() as cells x cells squares of two triangles each, facing +z. */
inline novelview::TriangleMesh RectangleMesh(
  double halfX, double halfY, double height = 0, int cells = 1)
{
  novelview::TriangleMesh mesh;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      mesh.Points.emplace_back(
        halfX * (2.0 * i / cells - 1), halfY * (2.0 * j / cells - 1), height);
    }
  }
  for (int j = 0; j < cells; ++j)
  {
    for (int i = 0; i < cells; ++i)
    {
      const int a = j * (cells + 1) + i;
      const int c = a + cells + 2;
      mesh.Triangles.emplace_back(a, a + 1, c);
      mesh.Triangles.emplace_back(a, c, c - 1);
    }
  }
  return mesh;
}

/** Unconnected triangles with corners anywhere in the cube [-1, 1]^3. */
inline novelview::TriangleMesh TriangleSoup(int count, double size, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  novelview::TriangleMesh mesh;
  for (int cellId = 0; cellId < count; ++cellId)
  {
    const Vector3d centre(uniform(random), uniform(random), uniform(random));
    for (int corner = 0; corner < 3; ++corner)
    {
      mesh.Points.push_back(
        centre + size * Vector3d(uniform(random), uniform(random), uniform(random)));
    }
    mesh.Triangles.emplace_back(3 * cellId, 3 * cellId + 1, 3 * cellId + 2);
  }
  return mesh;
}
}

#endif
