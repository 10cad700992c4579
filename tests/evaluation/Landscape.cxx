// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/Landscape.h"

#include <algorithm>
#include <cmath>

namespace novelview::evaluation
{
namespace
{
double Median(std::vector<double> values)
{
  if (values.empty())
  {
    return 0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
}

double LeastOffset(const Offsets& offsets, const std::vector<double>& energies)
{
  const auto least = std::min_element(energies.begin(), energies.end());
  return offsets[static_cast<int>(least - energies.begin())];
}

double ValleyDepth(const Offsets& offsets, const std::vector<double>& energies, double sidePx)
{
  const auto least = std::min_element(energies.begin(), energies.end());
  const auto side = static_cast<std::ptrdiff_t>(sidePx / offsets.Step + 0.5);
  const double before =
    *std::max_element(least - std::min(side, least - energies.begin()), least + 1);
  const double after =
    *std::max_element(least, least + 1 + std::min(side, energies.end() - least - 1));
  return std::min(before, after) - *least;
}

void Landscape::Add(const std::vector<double>& energies)
{
  this->Points.push_back(energies);
}

LandscapeSummary Landscape::Summary() const
{
  constexpr double nearPx = 1;
  constexpr double sidePx = 4;
  LandscapeSummary summary;
  std::vector<double> least;
  std::vector<double> distances;
  std::vector<double> valleys;
  for (const std::vector<double>& energies : this->Points)
  {
    least.push_back(LeastOffset(this->Along, energies));
    distances.push_back(std::abs(least.back()));
    valleys.push_back(ValleyDepth(this->Along, energies, sidePx));
    summary.NearShare += distances.back() <= nearPx;
  }
  summary.Points = static_cast<int>(this->Points.size());
  summary.NearShare /= std::max(summary.Points, 1);
  summary.MedianOffset = Median(least);
  summary.MedianDistance = Median(distances);
  summary.MedianValley = Median(valleys);
  return summary;
}

std::vector<double> Landscape::Mean() const
{
  std::vector<double> mean(static_cast<std::size_t>(this->Along.Count()), 0);
  for (const std::vector<double>& energies : this->Points)
  {
    for (std::size_t i = 0; i < mean.size(); ++i)
    {
      mean[i] += energies[i] / static_cast<double>(this->Points.size());
    }
  }
  return mean;
}
}
