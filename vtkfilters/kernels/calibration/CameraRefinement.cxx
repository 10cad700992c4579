// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/CameraRefinement.h"

#include "calibration/EpipolarDistance.h"
#include "core/Quantile.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** What is added to a pose: a rotation vector in the camera's frame, then a translation in it. */
using PoseUpdate = std::array<double, 6>;

struct ReprojectionError
{
  template <class T>
  bool operator()(const T* update, const T* point, T* residual) const
  {
    const Camera& camera = *this->Cam;
    T given[3];
    for (int i = 0; i < 3; ++i)
    {
      given[i] = camera.R(i, 0) * point[0] + camera.R(i, 1) * point[1] + camera.R(i, 2) * point[2] +
        camera.T[i];
    }
    T moved[3];
    ceres::AngleAxisRotatePoint(update, given, moved);
    for (int i = 0; i < 3; ++i)
    {
      moved[i] += update[3 + i];
    }
    const Eigen::Matrix3d& k = camera.K;
    residual[0] = (k(0, 0) * moved[0] + k(0, 1) * moved[1]) / moved[2] + k(0, 2) - this->Pixel.x();
    residual[1] = k(1, 1) * moved[1] / moved[2] + k(1, 2) - this->Pixel.y();
    return true;
  }
  const Camera* Cam;
  Vector2d Pixel;
};

/** How far a camera is turned and moved, in units of the deviation that is expected. */
struct PoseError
{
  template <class T>
  bool operator()(const T* update, T* residual) const
  {
    for (int i = 0; i < 3; ++i)
    {
      residual[i] = this->PerRadian * update[i];
      residual[3 + i] = this->PerUnit * update[3 + i];
    }
    return true;
  }
  double PerRadian;
  double PerUnit;
};

Camera Updated(const Camera& given, const PoseUpdate& update)
{
  const Vector3d turn(update[0], update[1], update[2]);
  Camera camera = given;
  if (turn.norm() > 0)
  {
    const Eigen::Matrix3d r = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    camera.R = r * camera.R;
    camera.T = r * camera.T;
  }
  camera.T += Vector3d(update[3], update[4], update[5]);
  return camera;
}

/** Ends the solver when somebody asks to stop. */
class StopCallback : public ceres::IterationCallback
{
public:
  explicit StopCallback(const Execution& execution)
    : Run(execution)
  {
  }
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override
  {
    return this->Run.StopRequested() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

private:
  const Execution& Run;
};

class Adjuster
{
public:
  Adjuster(const std::vector<Camera>& given, const std::vector<PointTrack>& tracks,
    const CameraRefinementOptions& options, const Execution& execution)
    : Given(given)
    , Tracks(tracks)
    , Options(options)
    , Run(execution)
    , Middle(Vector3d::Zero())
  {
    for (const PointTrack& track : tracks)
    {
      this->Middle += track.Position / static_cast<double>(tracks.size());
    }
  }

  /** The cameras refined; the given ones are expected to be off by `deviationPx`. */
  std::vector<Camera> Adjust(double deviationPx) const
  {
    std::vector<PoseUpdate> updates(this->Given.size(), PoseUpdate{});
    std::vector<PointTrack> tracks = this->Tracks;
    ceres::Problem problem;
    for (std::size_t viewId = 0; viewId < this->Given.size(); ++viewId)
    {
      const Camera& camera = this->Given[viewId];
      const double focal = camera.FocalLength() / deviationPx;
      problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PoseError, 6, 6>(new PoseError{
                                 focal, focal / std::abs(camera.Depth(this->Middle)) }),
        new ceres::CauchyLoss(this->Options.DeviationLoss), updates[viewId].data());
    }
    for (PointTrack& track : tracks)
    {
      for (const PointObservation& seen : track.Observations)
      {
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ReprojectionError, 2, 6, 3>(
                                   new ReprojectionError{ &this->Given[seen.View], seen.Pixel }),
          new ceres::CauchyLoss(this->Options.LossPx), updates[seen.View].data(),
          track.Position.data());
      }
    }
    this->Solve(problem);
    std::vector<Camera> refined;
    for (std::size_t viewId = 0; viewId < this->Given.size(); ++viewId)
    {
      refined.push_back(Updated(this->Given[viewId], updates[viewId]));
    }
    return refined;
  }

  /** RMS over the tracks' points of how far `refined` has moved them in the image of `given`. */
  double ShiftPx(const Camera& given, const Camera& refined) const
  {
    double sum = 0;
    for (const PointTrack& track : this->Tracks)
    {
      const Vector3d& point = track.Position;
      sum += given.Depth(point) > 0 && refined.Depth(point) > 0
        ? (refined.Project(point) - given.Project(point)).squaredNorm()
        : 0;
    }
    return std::sqrt(sum / static_cast<double>(this->Tracks.size()));
  }

private:
  void Solve(ceres::Problem& problem) const
  {
    StopCallback stop(this->Run);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.max_num_iterations = this->Options.MaxIterations;
    options.num_threads = 1; // with more, sums depend on their order
    options.logging_type = ceres::SILENT;
    options.callbacks.push_back(&stop);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    this->Run.CheckCancelled();
  }

  const std::vector<Camera>& Given;
  const std::vector<PointTrack>& Tracks;
  const CameraRefinementOptions& Options;
  const Execution& Run;
  Vector3d Middle;
};

/**
 * For each camera the median distance from the epipolar line over all pairs of observations that it
 * takes part in; 0 without any.
 */
std::vector<double> ErrorsOf(
  const std::vector<PointTrack>& tracks, const std::vector<Camera>& cameras)
{
  std::vector<std::vector<double>> distances(cameras.size());
  for (const PointTrack& track : tracks)
  {
    const PointObservation& first = track.Observations.front();
    for (std::size_t i = 1; i < track.Observations.size(); ++i)
    {
      const PointObservation& other = track.Observations[i];
      const double distance =
        EpipolarDistance(cameras[first.View], first.Pixel, cameras[other.View], other.Pixel);
      distances[first.View].push_back(distance);
      distances[other.View].push_back(distance);
    }
  }
  std::vector<double> errors;
  for (std::vector<double>& some : distances)
  {
    errors.push_back(Quantile(std::move(some), 0.5));
  }
  return errors;
}

double Mean(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/** How far the given cameras are off, from the medians of their errors before and after. */
double DeviationOf(
  const std::vector<double>& before, const std::vector<double>& after, double least)
{
  const double b = Quantile(before, 0.5);
  const double a = Quantile(after, 0.5);
  return std::sqrt(std::max(b * b - a * a, least * least));
}
}

CameraRefinement RefineCameras(const std::vector<View>& views,
  const CameraRefinementOptions& options, const Execution& execution)
{
  CameraRefinement result;
  for (const View& view : views)
  {
    result.Cameras.push_back(view.Cam);
  }
  result.ShiftsPx.assign(views.size(), 0);
  std::vector<PointTrack> training;
  std::vector<PointTrack> judges;
  std::size_t number = 0;
  for (PointTrack& track : FindPointTracks(views, options.Tracks, execution))
  {
    (number++ % options.HoldOut ? training : judges).push_back(std::move(track));
  }
  execution.Report(0.5);
  const std::vector<Camera> given = result.Cameras;
  const std::vector<double> before = ErrorsOf(judges, given);
  result.ErrorBeforePx = result.ErrorAfterPx = Mean(before);
  const double acceptable = (1 - options.MinGain) * result.ErrorBeforePx;
  if (static_cast<int>(judges.size()) < options.MinJudges)
  {
    return result;
  }
  const Adjuster adjuster(given, training, options, execution);
  const std::vector<double> reachable = ErrorsOf(judges, adjuster.Adjust(options.FirstDeviationPx));
  execution.Report(0.75);
  if (Mean(reachable) > acceptable)
  {
    return result;
  }
  const std::vector<Camera> refined =
    adjuster.Adjust(DeviationOf(before, reachable, options.MinDeviationPx));
  const double after = Mean(ErrorsOf(judges, refined));
  if (after <= acceptable)
  {
    result.Accepted = true;
    result.ErrorAfterPx = after;
    result.Cameras = refined;
    for (std::size_t viewId = 0; viewId < views.size(); ++viewId)
    {
      result.ShiftsPx[viewId] = adjuster.ShiftPx(given[viewId], refined[viewId]);
    }
  }
  execution.Report(1);
  return result;
}
}
