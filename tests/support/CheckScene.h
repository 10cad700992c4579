// SPDX-License-Identifier: GPL-3.0-or-later
/** A small clean data set to plant mistakes in. */
#ifndef novelview_tests_CheckScene_h
#define novelview_tests_CheckScene_h

#include "cameras/CameraConvention.h"
#include "support/CalibrationCases.h"
#include "support/Scene.h"

namespace novelview::testing_support
{
/**
 * Twelve photographs of a lopsided object (no two ways to turn or mirror it look alike) from two
 * heights, 160 x 120, before black.
 */
inline const std::vector<support::Photo>& CleanPhotos()
{
  static const std::vector<support::Photo> photos = []
  {
    const support::Shape object = support::Union(
      { support::Sphere({ 0.02, -0.05, 0.03 }, 0.3), support::Sphere({ 0.25, 0.2, 0.1 }, 0.14),
        support::Box({ -0.45, -0.3, -0.12 }, { -0.1, -0.12, 0.2 }),
        support::Sphere({ 0.05, 0.12, -0.35 }, 0.1) });
    std::vector<Camera> cameras;
    for (int i = 0; i < 12; ++i)
    {
      cameras.push_back(support::OnRing(30.0 * i + 3, i % 2 == 0 ? 12 : 30));
    }
    std::vector<support::Photo> taken = support::TakeAll(object, support::Waves(0.12), cameras);
    for (support::Photo& photo : taken)
    {
      photo.Name += ".png";
    }
    return taken;
  }();
  return photos;
}

/** The convention of a format's own. */
inline CameraConvention ConventionOf(const std::string& format)
{
  if (format == "nerf")
  {
    return { "opengl", "camera-to-world", "row", 0.5, false, false };
  }
  CameraConvention convention = ProjectConvention();
  convention.PixelCentre = format == "colmap" ? 0.5 : 0;
  return convention;
}

/** How a data set is written: what the file states its cameras in, by default the format's own. */
struct WrittenAs
{
  std::string Format = "middlebury";
  CameraConvention Convention = ConventionOf(Format);
  bool Masks = true;
};

/** Writes photographs, masks/ and a calibration that states the cameras in this convention. */
inline void WriteDataset(const std::filesystem::path& folder,
  const std::vector<support::Photo>& photos, const WrittenAs& as = {})
{
  const std::filesystem::path photoFolder = folder / FormatOf(as.Format).PhotoFolder;
  CameraConvention own = ConventionOf(as.Format);
  std::vector<Photograph> photographs;
  for (const support::Photo& photo : photos)
  {
    WriteImageFile(photoFolder / photo.Name, std::as_const(photo.Color).Ref());
    if (as.Masks && !photo.Mask.Values.empty())
    {
      Image<std::uint8_t> mask = photo.Mask;
      for (std::uint8_t& value : mask.Values)
      {
        value = as.Convention.InvertMasks ? static_cast<std::uint8_t>(255 - value) : value;
      }
      WriteImageFile(folder / "mask" / photo.Name, mask.Ref());
    }
    Photograph photograph;
    photograph.Name = photo.Name;
    photograph.Cam = photo.Cam;
    if (as.Convention.FlipY)
    {
      // Flipping is its own inverse.
      std::vector<Photograph> flipped{ photograph };
      CameraConvention flip = ProjectConvention();
      flip.FlipY = true;
      ApplyConvention(flip, flipped);
      photograph = flipped.front();
    }
    photograph.Cam = InConvention(as.Convention, photograph.Cam);
    photographs.push_back(photograph);
  }
  // The writer states them in the format's convention, which puts these numbers into the file.
  ApplyConvention(own, photographs);
  WriteCalibration(folder, as.Format, photographs);
}
}

#endif
