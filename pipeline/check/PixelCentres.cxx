// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/PixelCentres.h"

#include "check/AgreementSurvey.h"
#include "silhouettes/HullConsistency.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
/** Mean disagreement of contour rays per view, px, with all principal points shifted by this. */
std::vector<double> ContourLoss(const std::vector<View>& views,
  const std::vector<SilhouetteRay>& rays, double shiftPx, const Execution& execution)
{
  constexpr double MaxPx = 3; // what is further off says nothing about half pixels
  std::vector<View> shifted = views;
  for (View& view : shifted)
  {
    view.Cam.K.block<2, 1>(0, 2).array() += shiftPx;
  }
  std::vector<double> loss(views.size(), 0);
  std::vector<double> count(views.size(), 0);
  const auto agreements = FollowSilhouetteRays(shifted, rays, {}, execution);
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    loss[rays[i].ViewId] += std::clamp(-static_cast<double>(agreements[i].Residual), 0.0, MaxPx);
    count[rays[i].ViewId] += 1;
  }
  for (std::size_t v = 0; v < loss.size(); ++v)
  {
    loss[v] /= std::max(count[v], 1.0);
  }
  return loss;
}

/** Mean over standard error of the mean of b - a. */
double Significance(const std::vector<double>& a, const std::vector<double>& b)
{
  const double n = static_cast<double>(a.size());
  double sum = 0;
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += b[i] - a[i];
    squares += (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double variance = (squares - sum * sum / n) / std::max(n - 1, 1.0);
  return variance > 0 ? sum / n / std::sqrt(variance / n) : 0;
}
}

PixelCentreVerdict ComparePixelCentres(
  const std::vector<View>& views, const std::vector<double>& shiftsPx, const Execution& execution)
{
  constexpr int Rays = 120;
  PixelCentreVerdict verdict;
  const std::vector<SilhouetteRay> rays = AllRays(views, Rays, ContourRays);
  std::vector<std::vector<double>> losses;
  for (const double shift : shiftsPx)
  {
    losses.push_back(ContourLoss(views, rays, shift, execution));
    verdict.LossPx.push_back(MeanOf(losses.back()));
  }
  verdict.Sigmas = Significance(losses[1], losses[0]);
  return verdict;
}
}
