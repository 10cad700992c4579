// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset/ExifDecision.h"

#include "core/Error.h"
#include "images/ExifOrientation.h"
#include "images/ImageFile.h"
#include "images/MaskImage.h"
#include "images/Metrics.h"
#include "masks/Silhouette.h"

#include <cmath>
#include <filesystem>

namespace novelview
{
namespace
{
/** A reason to apply a tag (positive), to ignore it (negative), or none. */
struct Evidence
{
  int Vote = 0;
  std::string Reason;
};

Evidence BySize(int width, int height, const PictureSize& stored, const std::string& reason)
{
  const bool asStored = width == stored.Width && height == stored.Height;
  const bool turned = width == stored.Height && height == stored.Width;
  return asStored == turned ? Evidence() : Evidence{ turned ? 1 : -1, reason };
}

/** Which frame has the principal point nearer to its middle. */
Evidence ByPrincipalPoint(const Eigen::Matrix3d& K, const PictureSize& stored)
{
  const auto off = [&K](int width, int height)
  { return std::abs(2 * K(0, 2) - width) + std::abs(2 * K(1, 2) - height); };
  const double asStored = off(stored.Width, stored.Height);
  const double turned = off(stored.Height, stored.Width);
  return asStored == turned ? Evidence()
                            : Evidence{ turned < asStored ? 1 : -1,
                                "the principal points are in the middle of that frame" };
}

/** Which way the mask fits what the photograph shows. */
Evidence ByMask(const Photograph& photograph, int orientation)
{
  constexpr double clearly = 0.05; // of IoU
  const Image<std::uint8_t> mask = ReadMaskFile(photograph.Mask);
  const auto fit = [&](int turn)
  {
    const auto seen = ExtractSilhouette(ReadColorFile(photograph.File, { turn }).Ref());
    return seen.Width == mask.Width && seen.Height == mask.Height ? MaskIou(seen, mask) : 0;
  };
  const double gain = fit(orientation) - fit(1);
  return std::abs(gain) < clearly
    ? Evidence()
    : Evidence{ gain > 0 ? 1 : -1, "the masks fit the photographs that way" };
}

Evidence EvidenceOf(const Photograph& photograph, int orientation)
{
  const PictureSize stored = ReadPictureSize(photograph.File);
  const Camera& camera = photograph.Cam;
  Evidence evidence;
  if (SwapsSides(orientation) && camera.Width > 0)
  {
    evidence = BySize(camera.Width, camera.Height, stored, "the calibration is for that size");
  }
  if (SwapsSides(orientation) && evidence.Vote == 0 && !photograph.Mask.empty())
  {
    const PictureSize mask = ReadPictureSize(photograph.Mask);
    evidence = BySize(mask.Width, mask.Height, stored, "the masks have that size");
  }
  if (SwapsSides(orientation) && evidence.Vote == 0 && camera.Width == 0)
  {
    evidence = ByPrincipalPoint(camera.K, stored);
  }
  return evidence.Vote == 0 && !photograph.Mask.empty() ? ByMask(photograph, orientation)
                                                        : evidence;
}

/** The tag of a photograph that can be read; else 1, and whoever reads it says why. */
int TagOf(const Photograph& photograph)
{
  std::error_code failure;
  return std::filesystem::is_regular_file(photograph.File, failure)
    ? ReadExifOrientation(photograph.File)
    : 1;
}

/** What most of some tagged photographs say. */
Evidence Judge(const std::vector<Photograph>& photographs, const std::vector<int>& tags)
{
  constexpr int enough = 3; // looking at masks takes a while
  Evidence sum;
  for (std::size_t i = 0; i < tags.size() && std::abs(sum.Vote) < enough; ++i)
  {
    if (tags[i] == 1)
    {
      continue;
    }
    try
    {
      const Evidence one = EvidenceOf(photographs[i], tags[i]);
      sum.Vote += one.Vote;
      sum.Reason = one.Vote != 0 ? one.Reason : sum.Reason;
    }
    catch (const Error&)
    {
      continue; // an unreadable file is told of where it is read
    }
  }
  return sum;
}
}

void DecideExifOrientation(
  const std::string& wanted, std::vector<Photograph>& photographs, std::vector<ReadingNote>& notes)
{
  std::vector<int> tags;
  int tagged = 0;
  int example = 1;
  for (const Photograph& photograph : photographs)
  {
    tags.push_back(TagOf(photograph));
    tagged += tags.back() != 1;
    example = tags.back() != 1 ? tags.back() : example;
  }
  if (tagged == 0)
  {
    return;
  }
  Evidence evidence{ wanted == "apply" ? 1 : -1, "--exif-orientation " + wanted };
  if (wanted == "auto")
  {
    evidence = Judge(photographs, tags);
  }
  for (std::size_t i = 0; i < tags.size() && evidence.Vote > 0; ++i)
  {
    photographs[i].Reading.Orientation = tags[i];
  }
  const std::string what = std::to_string(tagged) + " of " + std::to_string(tags.size()) +
    " photographs have an EXIF orientation tag (" + std::to_string(example) + "), which is ";
  const bool known = evidence.Vote != 0;
  notes.push_back({ "exif-orientation",
    what + (evidence.Vote > 0 ? "applied" : "ignored") +
      (known ? ": " + evidence.Reason
             : "; if the calibration is of turned pictures, use --exif-orientation apply"),
    !known });
}
}
