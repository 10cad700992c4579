// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/FusedSilhouette.h"
#include "geometry/ViewSelection.h"
#include "support/DentCase.h"
#include "support/Expect.h"

#include <numeric>

using namespace novelview;
using namespace support;

namespace
{
const FusionOptions Outline{ 2, 0.05, 0.12 }; ///< as TsdfDeformationOptions has it

Image<float> SilhouetteOf(const TriangleMesh& mesh, const std::vector<View>& views,
  const Camera& novel, const FusedSilhouetteOptions& options, const Execution& execution = {})
{
  const double footprint = MedianFootprint(views, Vector3d::Zero());
  const TsdfField field(views, Outline, footprint);
  return FusedSilhouette(mesh, views, field, novel, footprint, options, execution);
}

FusedSilhouetteOptions WithoutPrediction(double smoothingPx = 0)
{
  FusedSilhouetteOptions options;
  options.UsePrediction = false;
  options.SmoothingPx = smoothingPx;
  return options;
}

FusedSilhouetteOptions WithPrediction()
{
  FusedSilhouetteOptions options;
  options.UsePrediction = true;
  return options;
}

/** How far contours lie apart: the differences of the distances near the true one, pixels. */
std::vector<double> Apart(const Image<float>& found, const Image<float>& truth)
{
  std::vector<double> differences;
  for (std::size_t i = 0; i < truth.Values.size(); ++i)
  {
    if (std::abs(truth.Values[i]) < 1)
    {
      differences.push_back(found.Values[i] - truth.Values[i]);
    }
  }
  return differences;
}

double Largest(const std::vector<double>& differences)
{
  double largest = 0;
  for (const double difference : differences)
  {
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

double RootMeanSquare(const std::vector<double>& differences)
{
  return std::sqrt(
    std::inner_product(differences.begin(), differences.end(), differences.begin(), 0.0) /
    static_cast<double>(differences.size()));
}

/** The dent faces the novel camera: its contour is that of the whole sphere, a circle. */
Image<float> TrueContour()
{
  const Camera& novel = TheDent().Novel;
  const double radiusPx = novel.FocalLength() * std::tan(std::asin(0.5 / 4));
  Image<float> distance(novel.Width, novel.Height);
  for (int y = 0; y < novel.Height; ++y)
  {
    for (int x = 0; x < novel.Width; ++x)
    {
      distance(x, y) =
        static_cast<float>(radiusPx - std::hypot(x - novel.K(0, 2), y - novel.K(1, 2)));
    }
  }
  return distance;
}

/** The dent's views with normal noise on their depths. */
struct NoisyViews
{
  explicit NoisyViews(double sigmaPx)
    : Views(TheDent().Views)
  {
    const double footprint = MedianFootprint(this->Views, Vector3d::Zero());
    std::mt19937 random(11);
    std::normal_distribution<double> normal(0, sigmaPx * footprint);
    for (const Photo& photo : TheDent().Photos)
    {
      this->Depths.push_back(photo.TrueDepth);
      for (float& depth : this->Depths.back().Values)
      {
        depth += depth > 0 ? static_cast<float>(normal(random)) : 0.f;
      }
    }
    for (std::size_t i = 0; i < this->Views.size(); ++i)
    {
      this->Views[i].DepthMap = std::as_const(this->Depths[i]).Ref();
    }
  }
  std::vector<View> Views;
  std::vector<Image<float>> Depths;
};
}

TEST(FusedSilhouette, WithTrueMapsTheContourIsRightToATenthOfAPixel)
{
  const DentCase& dent = TheDent();
  const Image<float> truth = TrueContour();
  for (const auto& options : { WithPrediction(), WithoutPrediction() })
  {
    const auto apart = Apart(SilhouetteOf(dent.Mesh, dent.Views, dent.Novel, options), truth);
    ASSERT_GT(apart.size(), 400u); // 2 pi 50 pixels of contour, two pixels wide
    // The maps are read at the nearest pixel and the prior takes 0.04 footprints: a tenth together.
    EXPECT_LT(RootMeanSquare(apart), 0.11);
    // One way or the other a few pixels are worse: a map seen at a slant is off by more than a
    // footprint, and the prediction takes planes turned out of its own for planes in it, which for a
    // ball of 50 pixels is up to 0.3 pixels at the largest tilt of 0.2.
    EXPECT_LT(Largest(apart), 0.4);
  }
}

TEST(FusedSilhouette, PlanesWithLittleTiltMakeItRightToAQuarterPixelAllAround)
{
  const DentCase& dent = TheDent();
  FusedSilhouetteOptions upright = WithPrediction();
  upright.Prediction.MaxTilt = 0.1; // a quarter of the error that 0.2 lets pass: below 0.1 pixels
  const auto apart = Apart(SilhouetteOf(dent.Mesh, dent.Views, dent.Novel, upright), TrueContour());
  EXPECT_LT(Largest(apart), 0.25); // that of the maps, of which the prediction leaves 1 / 11
}

TEST(FusedSilhouette, ThePredictionMakesUpForNoisyMaps)
{
  const DentCase& dent = TheDent();
  const Image<float> truth = TrueContour();
  const auto error = [&](double sigmaPx, const FusedSilhouetteOptions& options)
  {
    const NoisyViews noisy(sigmaPx);
    return RootMeanSquare(Apart(SilhouetteOf(dent.Mesh, noisy.Views, dent.Novel, options), truth));
  };
  EXPECT_LT(error(1.5, WithPrediction()), error(1.5, WithoutPrediction()));
  // It has no part in the noise; but where the field is off by more than the gate of a pixel, it is
  // not believed, which leaves some of the error.
  EXPECT_LT(error(3, WithPrediction()), 0.6 * error(3, WithoutPrediction()));
}

TEST(FusedSilhouette, SmoothingKeepsAStraightContourInPlace)
{
  // An upright box; the novel camera sees its edges half-way between two photographs.
  const Vector3d half(0.35, 0.4, 0.35);
  const auto photos = TakeAll(Box(-half, half), Plain(200, 200, 200), Ring(12, 30));
  const Image<float> confidence(160, 120, 1, 1.f);
  auto views = ViewsOf(photos);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].DepthMap = photos[i].TrueDepth.Ref();
    views[i].Confidence = confidence.Ref();
  }
  const TriangleMesh mesh = SphereMesh(Vector3d::Zero(), 0.65, 4);
  const Camera novel = OnRing(15);
  const auto sharp = SilhouetteOf(mesh, views, novel, WithoutPrediction(0));
  const auto smooth = SilhouetteOf(mesh, views, novel, WithoutPrediction(1));
  double shift = 0;
  int count = 0;
  for (int y = 40; y <= 80; ++y) // the box is 80 pixels high: well away from its corners
  {
    for (int x = 0; x < 160; ++x)
    {
      if (std::abs(sharp(x, y)) < 1)
      {
        shift += smooth(x, y) - sharp(x, y);
        // No place moves by more than the unevenness of the traced contour.
        EXPECT_LT(std::abs(smooth(x, y) - sharp(x, y)), 0.5);
        ++count;
      }
    }
  }
  ASSERT_GT(count, 120);
  // A Gaussian takes a straight line of even distances to itself; what is left is that the distances
  // end at the band's border, at 3 on one side and at the truncation of 2 on the other.
  EXPECT_LT(std::abs(shift / count), 0.05);
}

TEST(FusedSilhouette, SameBitsWithOneAndMoreThreads)
{
  const DentCase& dent = TheDent();
  FusedSilhouetteOptions options = WithPrediction();
  options.SmoothingPx = 0.5;
  EXPECT_EQ(SilhouetteOf(dent.Mesh, dent.Views, dent.Novel, options).Values,
    SilhouetteOf(dent.Mesh, dent.Views, dent.Novel, options, InThreads(3)).Values);
}
