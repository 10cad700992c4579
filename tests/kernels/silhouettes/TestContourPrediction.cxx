// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/ContourPrediction.h"
#include "silhouettes/SilhouetteField.h"
#include "support/Expect.h"
#include "support/Scene.h"

using namespace novelview;
using namespace support;

namespace
{
constexpr double Radius = 0.5;
constexpr double Footprint = 0.01; ///< 4 units away, focal length 400
/**
 * Coverage is counted by 16 x 16 rays, so a contour lies right to 1/32 pixel; what the fit makes of
 * four such contours is of the same size.
 */
constexpr double ContourError = 0.05 * Footprint;
constexpr int Samples = 16;

/** An endless upright cylinder about the y axis. */
Shape UprightCylinder(double radius)
{
  const Shape circle = Sphere(Vector3d::Zero(), radius);
  return [=](const Vector3d& origin, const Vector3d& direction)
  {
    const Vector3d flat(1, 0, 1);
    return circle(origin.cwiseProduct(flat), direction.cwiseProduct(flat));
  };
}

/** A camera of OnRing() that shows fifteen rows about the equator: all that these tests look at. */
Camera Strip(double angleDeg)
{
  Eigen::Matrix3d k = SmallPictureK();
  k(1, 2) = 7;
  return OnRing(angleDeg, 0, 4, k, 160, 15);
}

std::vector<Photo> StripsOf(const Shape& shape, const std::vector<double>& anglesDeg)
{
  std::vector<Photo> photos;
  for (const double angleDeg : anglesDeg)
  {
    photos.push_back(
      Take(shape, Plain(200, 200, 200), Strip(angleDeg), std::to_string(angleDeg), Samples));
  }
  return photos;
}

/** `count` angles from `first` on. */
std::vector<double> Angles(int count, double first, double stepDeg)
{
  std::vector<double> anglesDeg;
  for (int i = 0; i < count; ++i)
  {
    anglesDeg.push_back(first + i * stepDeg);
  }
  return anglesDeg;
}

/** A point on a novel ray that passes an upright line at a distance, to the right of it. */
struct NearLine
{
  Vector3d Point;
  Vector3d Ray;
  Vector3d Normal;

  /** @param along how far the point lies behind the place where the ray passes the line. */
  NearLine(const Camera& novel, const Vector3d& line, double distance, double along = 0)
  {
    const Vector3d towards = line - novel.Centre();
    const Vector3d straight = towards.normalized();
    const Vector3d right = Vector3d::UnitY().cross(straight) *
      (Vector3d::UnitY().cross(straight).dot(novel.R.row(0).transpose()) > 0 ? 1 : -1);
    const double sine = distance / towards.norm();
    const double cosine = std::sqrt(1 - sine * sine);
    this->Ray = cosine * straight + sine * right;
    this->Normal = cosine * right - sine * straight;
    this->Point = line + distance * this->Normal + along * this->Ray;
  }

  std::optional<PredictedContour> Predict(
    const std::vector<View>& views, const ContourPredictionOptions& options = {}) const
  {
    return PredictContour(views, this->Point, this->Ray, this->Normal, options);
  }
};

/** Twelve photographs all around a round thing, and a novel camera half-way between two. */
struct RoundCase
{
  explicit RoundCase(const Shape& shape)
    : Photos(StripsOf(shape, Angles(12, 0, 30)))
    , Views(ViewsOf(Photos))
  {
  }
  /** The six in front: those behind, which see the contour from the other side, left out. */
  std::vector<View> FrontViews() const
  {
    return { Views[10], Views[11], Views[0], Views[1], Views[2], Views[3] };
  }
  std::vector<Photo> Photos;
  std::vector<View> Views;
  Camera Novel = Strip(15);
};

const RoundCase& Cylinder()
{
  static const RoundCase round(UprightCylinder(Radius));
  return round;
}

const RoundCase& Ball()
{
  static const RoundCase round(Sphere(Vector3d::Zero(), Radius));
  return round;
}

class Round : public testing::TestWithParam<const RoundCase& (*)()>
{
};

/** Twelve photographs, twenty degrees apart, of which the middle ones see the edge (0.4, 0.4). */
struct EdgeCase
{
  Vector3d Edge{ 0.4, 0, 0.4 };
  std::vector<Photo> Photos =
    StripsOf(Box(Vector3d(-0.4, -1, -0.4), Vector3d(0.4, 1, 0.4)), Angles(12, -160, 20));
  std::vector<View> Views = ViewsOf(Photos);
  Camera Novel = Strip(-30);
};

const EdgeCase& TheEdge()
{
  static const EdgeCase edge;
  return edge;
}
}

INSTANTIATE_TEST_SUITE_P(ContourPrediction, Round, testing::Values(&Cylinder, &Ball),
  [](const auto& which) { return which.index ? "Ball" : "Cylinder"; });

TEST_P(Round, TheContourIsFoundBetweenTheCameras)
{
  const RoundCase& round = GetParam()();
  for (const auto& views : { round.Views, round.FrontViews() })
  {
    for (const double offPx : { -1.5, 0.0, 1.5 })
    {
      for (const double alongPx : { -3.0, 0.0, 3.0 })
      {
        const NearLine at(
          round.Novel, Vector3d::Zero(), Radius + offPx * Footprint, alongPx * Footprint);
        const auto predicted = at.Predict(views);
        ASSERT_TRUE(predicted);
        EXPECT_NEAR(predicted->Distance, offPx * Footprint, ContourError);
        // The tangent furthest off, at 30 to 45 degrees, leaves that of the foremost point by an
        // eighth of R: the error of a contour comes back eight times as large.
        EXPECT_NEAR(predicted->Radius, Radius, 8 * ContourError);
        EXPECT_LT(predicted->Residual, ContourError);
      }
    }
  }
}

TEST_P(Round, TheHullAloneWouldBeFurtherOut)
{
  const RoundCase& round = GetParam()();
  const auto views = round.FrontViews();
  // The polygon of tangents 30 degrees apart has its corners at R / cos 15 = R + 1.76 footprints.
  const NearLine at(round.Novel, Vector3d::Zero(), Radius + 1.2 * Footprint);
  const SilhouetteField hull(views);
  double deepest = -1;
  for (double alongPx = -30; alongPx <= 30; ++alongPx)
  {
    deepest = std::max(deepest, hull.Value(at.Point + alongPx * Footprint * at.Ray));
  }
  EXPECT_GT(deepest, 0.4 * Footprint) << "the ray passes through the hull";
  EXPECT_NEAR(at.Predict(views)->Distance, 1.2 * Footprint, ContourError)
    << "but not through the object";
}

TEST(ContourPrediction, AnUprightEdgeHasNoRadiusAndIsExact)
{
  const EdgeCase& box = TheEdge();
  for (const double offPx : { -1.5, 0.0, 1.5 })
  {
    const NearLine at(box.Novel, box.Edge, offPx * Footprint, Footprint);
    const auto predicted = at.Predict(box.Views);
    ASSERT_TRUE(predicted);
    EXPECT_NEAR(predicted->Distance, offPx * Footprint, ContourError);
    // Tangents at 10 and 30 degrees: a contour's error comes back up to 1 / (1 - cos 30) = 7.5 fold.
    EXPECT_GE(predicted->Radius, 0);
    EXPECT_LT(predicted->Radius, 10 * ContourError);
    EXPECT_LT(predicted->Residual, ContourError);
  }
}

TEST(ContourPrediction, TheResidualTellsWhereTwoEdgesAreNoCircle)
{
  // Of photographs 30 degrees apart those at 15 degrees see the near edge, the one at -45 another.
  const auto photos =
    StripsOf(Box(Vector3d(-0.4, -1, -0.4), Vector3d(0.4, 1, 0.4)), { -90, -60, -30, 0 });
  const NearLine at(Strip(-45), TheEdge().Edge, 0);
  const auto views = ViewsOf(photos);
  const auto predicted = at.Predict(views);
  ASSERT_TRUE(predicted);
  // The other edge stands 0.8 nearer to its camera, 8 pixels further out; a quarter of the weight of
  // four equations is its own, which three unknowns leave one to disagree with.
  EXPECT_GT(predicted->Residual, 0.5 * Footprint);
  const auto alone = at.Predict({ views[1], views[2], views[3] });
  ASSERT_TRUE(alone);
  EXPECT_NEAR(alone->Distance, 0, ContourError) << "without it the edge is found";
}

TEST(ContourPrediction, NothingWithoutCamerasOnBothSides)
{
  const RoundCase& round = Cylinder();
  const NearLine at(round.Novel, Vector3d::Zero(), Radius);
  const auto& all = round.Views;
  EXPECT_FALSE(at.Predict({ all[1], all[2], all[3] }));
  EXPECT_FALSE(at.Predict({ all[0], all[11], all[10] }));
  EXPECT_TRUE(at.Predict({ all[0], all[1], all[2] }));
}

TEST(ContourPrediction, NothingFromFewerThanThree)
{
  const RoundCase& round = Cylinder();
  const NearLine at(round.Novel, Vector3d::Zero(), Radius);
  EXPECT_FALSE(at.Predict({ round.Views[0], round.Views[1] }));
  EXPECT_FALSE(at.Predict({}));
  // The nearest are turned by 15 degrees, the next by 45.
  ContourPredictionOptions narrow;
  narrow.MaxAngleDeg = 40;
  EXPECT_FALSE(at.Predict(round.FrontViews(), narrow));
}

TEST(ContourPrediction, NothingFarFromTheContours)
{
  const RoundCase& round = Cylinder();
  ContourPredictionOptions near;
  near.MaxDistancePx = 2;
  EXPECT_TRUE(NearLine(round.Novel, Vector3d::Zero(), Radius).Predict(round.Views));
  EXPECT_FALSE(
    NearLine(round.Novel, Vector3d::Zero(), Radius + 3 * Footprint).Predict(round.Views, near));
}

TEST(ContourPrediction, CamerasSeeNothingBehindThem)
{
  const auto photos = StripsOf(UprightCylinder(Radius), { -1.5, -0.7, 0.7, 1.5 });
  const auto views = ViewsOf(photos);
  const Camera novel = Strip(0);
  const NearLine at(novel, Vector3d::Zero(), Radius);
  EXPECT_TRUE(PredictContour(views, at.Point, at.Ray, at.Normal));
  // Mirrored in the centre of projection a point has the same picture.
  const Vector3d behind = 2 * novel.Centre() - at.Point;
  EXPECT_FALSE(PredictContour(views, behind, -at.Ray, -at.Normal));
}
