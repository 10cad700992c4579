// SPDX-License-Identifier: GPL-3.0-or-later
#include "PoleLabels.h"

#include "DisjointSets.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace novelview
{
namespace
{
/** Circumspheres that differ by less than this part of their radius are one. */
constexpr double SameSphereTolerance = 1e-7;

/** Per tetrahedron the lowest one with the same circumsphere that facets connect it to. */
std::vector<int> MergeCospherical(const DelaunayComplex& complex)
{
  DisjointSets sets(complex.NumberOfTets());
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    for (int other : complex.Neighbors[tet])
    {
      const double tolerance = SameSphereTolerance * complex.Radii[tet];
      if (other > tet &&
        (complex.Centres[tet] - complex.Centres[other]).squaredNorm() < tolerance * tolerance)
      {
        sets.Unite(tet, other);
      }
    }
  }
  std::vector<int> roots(static_cast<std::size_t>(complex.NumberOfTets()));
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    roots[tet] = sets.Find(tet);
  }
  return roots;
}

/**
 * The direction the second pole must lie away from: that of the first pole; for a sample on the
 * convex hull the mean of those of all its spheres through far corners, which in the limit is the
 * mean normal of its hull facets (at a sharp corner a single one can lean far over).
 */
Eigen::Vector3d AwayDirection(const DelaunayComplex& complex, int sample, int firstPole)
{
  const Eigen::Vector3d& p = complex.Points[sample];
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = complex.IncidenceStart[sample]; i < complex.IncidenceStart[sample + 1]; ++i)
  {
    const int tet = complex.Incidence[i];
    if (complex.TouchesCorner(tet))
    {
      mean += (complex.Centres[tet] - p) / complex.Radii[tet];
    }
  }
  return complex.TouchesCorner(firstPole) ? mean : complex.Centres[firstPole] - p;
}

/** The tetrahedra whose circumcentres are the sample's poles; -1 where there is none. */
std::array<int, 2> PolesOfSample(
  const DelaunayComplex& complex, const std::vector<int>& roots, int sample)
{
  const int begin = complex.IncidenceStart[sample];
  const int end = complex.IncidenceStart[sample + 1];
  const Eigen::Vector3d& p = complex.Points[sample];
  std::array<int, 2> poles = { -1, -1 };
  double farthest = -1;
  for (int i = begin; i < end; ++i)
  {
    // All circumspheres of a sample pass through it: the radius is the distance.
    const int tet = complex.Incidence[i];
    if (complex.Radii[tet] > farthest)
    {
      farthest = complex.Radii[tet];
      poles[0] = tet;
    }
  }
  if (poles[0] < 0)
  {
    return poles;
  }
  const Eigen::Vector3d direction = AwayDirection(complex, sample, poles[0]);
  farthest = -1;
  for (int i = begin; i < end; ++i)
  {
    const int tet = complex.Incidence[i];
    if (complex.Radii[tet] > farthest && direction.dot(complex.Centres[tet] - p) < 0)
    {
      farthest = complex.Radii[tet];
      poles[1] = tet;
    }
  }
  poles[0] = roots[poles[0]];
  poles[1] = poles[1] < 0 ? -1 : roots[poles[1]];
  return poles;
}

/** Evidence for both sides, and the queue that is ordered by it. */
class Labeller
{
public:
  Labeller(const DelaunayComplex& complex, const Poles& poles, const PowerDiagram& diagram)
    : Complex(complex)
    , AllPoles(poles)
    , Diagram(diagram)
    , Labels(poles.Tets.size(), Side::Unknown)
    , Evidence(poles.Tets.size(), { 0, 0 })
    , Visited(poles.Tets.size(), -1)
  {
    this->CollectSamplesOfPoles();
  }

  /** More evidence counts, less does not. */
  void AddEvidence(int pole, Side side, double amount)
  {
    double& old = this->Evidence[pole][side == Side::Outside];
    if (this->Labels[pole] == Side::Unknown && amount > old)
    {
      old = amount;
      this->Queue.push({ this->Priority(pole), pole });
    }
  }

  std::vector<Side> Run()
  {
    while (!this->Queue.empty())
    {
      const Entry entry = this->Queue.top();
      this->Queue.pop();
      if (this->Labels[entry.Pole] != Side::Unknown || entry.Priority != this->Priority(entry.Pole))
      {
        continue; // labelled already, or superseded by a later entry
      }
      const std::array<double, 2>& evidence = this->Evidence[entry.Pole];
      this->Labels[entry.Pole] = evidence[0] > evidence[1] ? Side::Inside : Side::Outside;
      this->TellOppositePoles(entry.Pole);
      this->TellNeighbors(entry.Pole);
    }
    return this->Labels;
  }

private:
  struct Entry
  {
    double Priority;
    int Pole;
    bool operator<(const Entry& other) const
    {
      return this->Priority != other.Priority ? this->Priority < other.Priority
                                              : this->Pole > other.Pole;
    }
  };

  double Priority(int pole) const
  {
    const auto [in, out] = this->Evidence[pole];
    return in > 0 && out > 0 ? std::abs(in - out) - 1 : std::max(in, out);
  }

  void CollectSamplesOfPoles()
  {
    this->SampleStart.assign(this->AllPoles.Tets.size() + 1, 0);
    for (const std::array<int, 2>& pair : this->AllPoles.OfSample)
    {
      for (int pole : pair)
      {
        if (pole >= 0)
        {
          ++this->SampleStart[pole + 1];
        }
      }
    }
    for (std::size_t i = 1; i < this->SampleStart.size(); ++i)
    {
      this->SampleStart[i] += this->SampleStart[i - 1];
    }
    this->Samples.resize(static_cast<std::size_t>(this->SampleStart.back()));
    std::vector<int> next(this->SampleStart.begin(), this->SampleStart.end() - 1);
    for (std::size_t s = 0; s < this->AllPoles.OfSample.size(); ++s)
    {
      for (int pole : this->AllPoles.OfSample[s])
      {
        if (pole >= 0)
        {
          this->Samples[next[pole]++] = static_cast<int>(s);
        }
      }
    }
  }

  void TellOppositePoles(int pole)
  {
    const Side opposite = this->Labels[pole] == Side::Inside ? Side::Outside : Side::Inside;
    for (int i = this->SampleStart[pole]; i < this->SampleStart[pole + 1]; ++i)
    {
      const int sample = this->Samples[i];
      const std::array<int, 2>& pair = this->AllPoles.OfSample[sample];
      const int other = pair[0] == pole ? pair[1] : pair[0];
      if (other < 0 || other == pole)
      {
        continue;
      }
      const Eigen::Vector3d& p = this->Complex.Points[sample];
      const Eigen::Vector3d a = this->AllPoles.Balls.Centres[pole] - p;
      const Eigen::Vector3d b = this->AllPoles.Balls.Centres[other] - p;
      this->AddEvidence(other, opposite, -a.dot(b) / (a.norm() * b.norm()));
    }
  }

  void TellNeighbors(int pole)
  {
    const Balls& balls = this->AllPoles.Balls;
    for (int i = this->Diagram.IncidenceStart[pole]; i < this->Diagram.IncidenceStart[pole + 1];
         ++i)
    {
      for (int other : this->Diagram.Tets[this->Diagram.Incidence[i]])
      {
        if (this->Visited[other] == pole || this->Labels[other] != Side::Unknown)
        {
          continue;
        }
        this->Visited[other] = pole;
        this->AddEvidence(other, this->Labels[pole],
          BallAgreement(
            balls.Centres[pole], balls.Radii[pole], balls.Centres[other], balls.Radii[other]));
      }
    }
  }

  const DelaunayComplex& Complex;
  const Poles& AllPoles;
  const PowerDiagram& Diagram;
  std::vector<Side> Labels;
  std::vector<std::array<double, 2>> Evidence; ///< inside, outside
  std::vector<int> Visited;                    ///< the pole that last told this one
  std::vector<int> SampleStart;                ///< pole p's samples: Samples[SampleStart[p]] ..
  std::vector<int> Samples;
  std::priority_queue<Entry> Queue;
};
}

double BallAgreement(
  const Eigen::Vector3d& centreA, double radiusA, const Eigen::Vector3d& centreB, double radiusB)
{
  const double cosine =
    (radiusA * radiusA + radiusB * radiusB - (centreA - centreB).squaredNorm()) /
    (2 * radiusA * radiusB);
  return std::clamp(cosine, -1.0, 1.0);
}

Poles FindPoles(const DelaunayComplex& complex, bool allCertain, const Execution& execution)
{
  const std::vector<int> roots = MergeCospherical(complex);
  Poles poles;
  poles.OfSample.resize(static_cast<std::size_t>(complex.NumberOfSamples));
  execution.ForEach(complex.NumberOfSamples,
    [&](std::int64_t sample)
    { poles.OfSample[sample] = PolesOfSample(complex, roots, static_cast<int>(sample)); });

  // A merged pole is certainly outside when any of its tetrahedra is.
  std::vector<char> certain(complex.Tets.size(), 0);
  std::vector<int> idOfTet(complex.Tets.size(), -1);
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    certain[roots[tet]] |= complex.TouchesCorner(tet);
    idOfTet[roots[tet]] = allCertain && certain[roots[tet]] ? 0 : -1;
  }
  for (const std::array<int, 2>& pair : poles.OfSample)
  {
    for (int tet : pair)
    {
      if (tet >= 0)
      {
        idOfTet[tet] = 0;
      }
    }
  }
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    if (idOfTet[tet] == 0)
    {
      idOfTet[tet] = static_cast<int>(poles.Tets.size());
      poles.Tets.push_back(tet);
      poles.Balls.Centres.push_back(complex.Centres[tet]);
      poles.Balls.Radii.push_back(complex.Radii[tet]);
      poles.Certain.push_back(certain[tet]);
    }
  }
  for (std::array<int, 2>& pair : poles.OfSample)
  {
    for (int& tet : pair)
    {
      tet = tet >= 0 ? idOfTet[tet] : -1;
    }
  }
  return poles;
}

std::vector<Side> LabelPoles(const DelaunayComplex& complex, const Poles& poles,
  const PowerDiagram& diagram, const std::vector<Eigen::Vector3d>* normals)
{
  Labeller labeller(complex, poles, diagram);
  for (std::size_t pole = 0; pole < poles.Tets.size(); ++pole)
  {
    if (poles.Certain[pole])
    {
      labeller.AddEvidence(static_cast<int>(pole), Side::Outside, 1);
    }
  }
  for (std::size_t s = 0; normals && s < poles.OfSample.size(); ++s)
  {
    for (int pole : poles.OfSample[s])
    {
      if (pole < 0)
      {
        continue;
      }
      const Eigen::Vector3d d = poles.Balls.Centres[pole] - complex.Points[s];
      const double cosine = d.dot((*normals)[s]) / (d.norm() * (*normals)[s].norm());
      labeller.AddEvidence(
        pole, cosine < 0 ? Side::Inside : Side::Outside, std::min(std::abs(cosine), 1.0));
    }
  }
  return labeller.Run();
}
}
