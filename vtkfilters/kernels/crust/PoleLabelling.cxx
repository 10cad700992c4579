// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/PoleLabelling.h"

#include "core/ToInt.h"
#include "crust/Poles.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
/** Per sample the points it shares a Delaunay edge with: Points[Start[s]] .. Points[Start[s + 1]]. */
struct EdgeLists
{
  std::vector<int> Start;
  std::vector<int> Points;
};

EdgeLists CollectEdges(const DelaunayComplex& complex, const Execution& execution)
{
  // The far corners surround every sample, so its link is a sphere of t triangles: by Euler's
  // formula, this has t / 2 + 2 points.
  EdgeLists edges;
  edges.Start.assign(static_cast<std::size_t>(complex.NumberOfSamples) + 1, 0);
  for (int s = 0; s < complex.NumberOfSamples; ++s)
  {
    const int triangles = complex.IncidenceStart[s + 1] - complex.IncidenceStart[s];
    edges.Start[s + 1] = edges.Start[s] + (triangles > 0 ? triangles / 2 + 2 : 0);
  }
  edges.Points.resize(static_cast<std::size_t>(edges.Start.back()));
  execution.ForEachWith(
    complex.NumberOfSamples, [&complex] { return std::vector<int>(complex.Points.size(), -1); },
    [&](std::vector<int>& seenBy, std::int64_t sample)
    {
      const int s = static_cast<int>(sample);
      seenBy[s] = s;
      int next = edges.Start[s];
      for (int i = complex.IncidenceStart[s]; i < complex.IncidenceStart[s + 1]; ++i)
      {
        for (int other : complex.Tets[complex.Incidence[i]])
        {
          if (seenBy[other] != s)
          {
            seenBy[other] = s;
            edges.Points[next++] = other;
          }
        }
      }
    });
  return edges;
}

//------------------------------------------------------------------------------
/** Collects evidence for both sides of every pole and labels the most certain first. */
class Labeller
{
public:
  Labeller(const DelaunayComplex& complex, const std::vector<std::array<int, 2>>& polesOfSample,
    const Execution& execution)
    : Complex(complex)
    , PolesOfSample(polesOfSample)
    , Edges(CollectEdges(complex, execution))
    , LastSource(complex.Points.size(), -1)
    , Queue(Levels)
  {
    std::vector<int> poleOfTet(complex.Tets.size(), -1);
    for (const std::array<int, 2>& pair : polesOfSample)
    {
      for (int tet : pair)
      {
        if (tet >= 0)
        {
          poleOfTet[tet] = 0;
        }
      }
    }
    for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
    {
      if (poleOfTet[tet] == 0)
      {
        poleOfTet[tet] = static_cast<int>(this->Poles.size());
        this->Poles.push_back({ complex.Centres[tet], complex.Radii[tet], tet });
      }
    }
    for (std::array<int, 2>& pair : this->PolesOfSample)
    {
      for (int& tet : pair)
      {
        tet = tet < 0 ? -1 : poleOfTet[tet];
      }
    }
    this->Labels.resize(this->Poles.size(), Side::Unknown);
  }

  /** What is known from the start: poles with a far corner are outside. */
  void AddCornerEvidence()
  {
    for (int pole = 0; pole < static_cast<int>(this->Poles.size()); ++pole)
    {
      if (this->Complex.TouchesCorner(this->Poles[pole].Tet))
      {
        this->AddEvidence(pole, Side::Outside, 1);
      }
    }
  }

  /** Poles lie before or behind their sample, by its outward normal. */
  void AddNormalEvidence(const std::vector<Eigen::Vector3d>& normals)
  {
    for (std::size_t s = 0; s < this->PolesOfSample.size(); ++s)
    {
      for (int pole : this->PolesOfSample[s])
      {
        if (pole >= 0)
        {
          const Eigen::Vector3d d = this->Poles[pole].Centre - this->Complex.Points[s];
          const double cosine = d.dot(normals[s]) / (d.norm() * normals[s].norm());
          this->AddEvidence(
            pole, cosine < 0 ? Side::Inside : Side::Outside, std::min(std::abs(cosine), 1.0));
        }
      }
    }
  }

  /** A label per tetrahedron; unknown for those that are neither poles nor touch a far corner. */
  std::vector<Side> Run(const Execution& execution)
  {
    int steps = 0;
    while (this->Highest >= 0)
    {
      if (++steps % 1024 == 0)
      {
        execution.CheckCancelled();
      }
      std::vector<int>& level = this->Queue[this->Highest];
      if (level.empty())
      {
        --this->Highest;
        continue;
      }
      const int id = level.back();
      level.pop_back();
      Pole& pole = this->Poles[id];
      if (this->Labels[id] != Side::Unknown || pole.Queued != this->Highest)
      {
        continue;
      }
      if (pole.Level() < this->Highest) // it has heard the contrary since
      {
        pole.Queued = -1;
        this->Enqueue(id);
        continue;
      }
      const bool inside =
        pole.Support[0] > pole.Support[1] && !this->Complex.TouchesCorner(pole.Tet);
      this->Labels[id] = inside ? Side::Inside : Side::Outside;
      this->PropagateToOppositePoles(id);
      this->PropagateToNeighbors(id);
    }
    return this->LabelsOfTets();
  }

private:
  /** Priorities, from -1 to 1, are distinguished to this part of their range. */
  static constexpr int Levels = 1 << 12;

  struct Pole
  {
    Eigen::Vector3d Centre;
    double Radius;
    int Tet;
    int Queued = -1;               ///< highest level in the queue
    double Evidence[2] = { 0, 0 }; ///< inside, outside: the strongest
    double Support[2] = { 0, 0 };  ///< inside, outside: sum of the cubes of all

    int Level() const
    {
      const auto [in, out] = this->Evidence;
      const double priority = in > 0 && out > 0 ? std::abs(in - out) - 1 : std::max(in, out);
      return ToInt(ClampedNumber(0.5 * (priority + 1), 0, 1) * (Levels - 1));
    }
  };

  void AddEvidence(int id, Side side, double amount)
  {
    if (this->Labels[id] != Side::Unknown || !(amount > 0))
    {
      return;
    }
    Pole& pole = this->Poles[id];
    pole.Support[side == Side::Outside] += amount * amount * amount;
    double& old = pole.Evidence[side == Side::Outside];
    if (amount > old)
    {
      old = amount;
      this->Enqueue(id);
    }
  }

  /** A pole in the queue at a higher level than its own is found out when it comes up. */
  void Enqueue(int id)
  {
    Pole& pole = this->Poles[id];
    const int level = pole.Level();
    if (level > pole.Queued)
    {
      pole.Queued = level;
      this->Queue[level].push_back(id);
      this->Highest = std::max(this->Highest, level);
    }
  }

  void PropagateToOppositePoles(int id)
  {
    const Pole& pole = this->Poles[id];
    for (int sample : this->Complex.Tets[pole.Tet])
    {
      if (sample >= this->Complex.NumberOfSamples)
      {
        continue;
      }
      const std::array<int, 2>& pair = this->PolesOfSample[sample];
      const int other = pair[0] == id ? pair[1] : (pair[1] == id ? pair[0] : -1);
      if (other >= 0)
      {
        const Eigen::Vector3d& p = this->Complex.Points[sample];
        const Eigen::Vector3d a = pole.Centre - p;
        const Eigen::Vector3d b = this->Poles[other].Centre - p;
        this->AddEvidence(other, Opposite(this->Labels[id]), -a.dot(b) / (a.norm() * b.norm()));
      }
    }
  }

  /** Tells the poles of all samples that share a Delaunay edge with one of this pole's. */
  void PropagateToNeighbors(int id)
  {
    for (int sample : this->Complex.Tets[this->Poles[id].Tet])
    {
      if (sample >= this->Complex.NumberOfSamples ||
        (this->PolesOfSample[sample][0] != id && this->PolesOfSample[sample][1] != id))
      {
        continue;
      }
      for (int i = this->Edges.Start[sample]; i < this->Edges.Start[sample + 1]; ++i)
      {
        const int other = this->Edges.Points[i];
        if (other < this->Complex.NumberOfSamples && this->LastSource[other] != id)
        {
          this->LastSource[other] = id;
          this->PropagateToPoles(id, this->PolesOfSample[other]);
        }
      }
    }
  }

  void PropagateToPoles(int id, const std::array<int, 2>& poles)
  {
    const Pole& teller = this->Poles[id];
    for (int other : poles)
    {
      if (other >= 0 && this->Labels[other] == Side::Unknown)
      {
        const Pole& pole = this->Poles[other];
        this->AddEvidence(other, this->Labels[id],
          BallAgreement(teller.Centre, teller.Radius, pole.Centre, pole.Radius));
      }
    }
  }

  std::vector<Side> LabelsOfTets() const
  {
    std::vector<Side> labels(this->Complex.Tets.size());
    for (int tet = 0; tet < this->Complex.NumberOfTets(); ++tet)
    {
      labels[tet] = this->Complex.TouchesCorner(tet) ? Side::Outside : Side::Unknown;
    }
    for (std::size_t id = 0; id < this->Poles.size(); ++id)
    {
      labels[this->Poles[id].Tet] = this->Labels[id];
    }
    return labels;
  }

  const DelaunayComplex& Complex;
  std::vector<std::array<int, 2>> PolesOfSample; ///< places in Poles, -1 = none
  const EdgeLists Edges;
  std::vector<Pole> Poles;     ///< in the order of their tetrahedra
  std::vector<Side> Labels;    ///< of the poles; separate, since most accesses need only that
  std::vector<int> LastSource; ///< per sample the pole that last propagated its label
  std::vector<std::vector<int>> Queue; ///< per level the poles, the last one first
  int Highest = -1;                    ///< no level above has a pole
};
}

std::vector<Side> LabelPoles(const DelaunayComplex& complex,
  const std::vector<std::array<int, 2>>& polesOfSample, const std::vector<Eigen::Vector3d>* normals,
  const Execution& execution)
{
  Labeller labeller(complex, polesOfSample, execution);
  labeller.AddCornerEvidence();
  if (normals)
  {
    labeller.AddNormalEvidence(*normals);
  }
  return labeller.Run(execution);
}
}
