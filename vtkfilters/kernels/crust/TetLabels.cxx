// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/TetLabels.h"

#include "core/DisjointSets.h"
#include "core/ToInt.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <utility>

namespace novelview
{
namespace
{
/** How often the repair may change its mind about one tetrahedron. */
constexpr char MaximumTurns = 3;

Side Opposite(Side side)
{
  return side == Side::Inside ? Side::Outside : Side::Inside;
}

double Agreement(const DelaunayComplex& complex, int tetA, int tetB)
{
  return BallAgreement(
    complex.Centres[tetA], complex.Radii[tetA], complex.Centres[tetB], complex.Radii[tetB]);
}

//------------------------------------------------------------------------------
/** Per sample the points it shares a Delaunay edge with: Points[Start[s]] .. Points[Start[s + 1]]. */
struct EdgeLists
{
  std::vector<int> Start;
  std::vector<int> Points;
};

EdgeLists CollectEdges(const DelaunayComplex& complex, const Execution& execution)
{
  // The far corners surround every sample, so its link is a sphere of t triangles: Euler says that
  // this has t / 2 + 2 points.
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

  /** Poles lie before or behind their sample, as its outward normal tells. */
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
  /** Priorities, from -1 to 1, are told apart to this part of their range. */
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
  std::vector<Pole> Poles;             ///< in the order of their tetrahedra
  std::vector<Side> Labels;            ///< of the poles; apart, since most are asked for only that
  std::vector<int> LastSource;         ///< per sample the pole that told its poles last
  std::vector<std::vector<int>> Queue; ///< per level the poles, the last one first
  int Highest = -1;                    ///< no level above has a pole
};

//------------------------------------------------------------------------------
/** A facet over which a label can spread. */
struct WeightedEdge
{
  double Agreement = -2; ///< below any
  int From = -1;         ///< the tetrahedron that may take the label; -1 = none
  int To = -1;

  /** A strict order of the facets, the same from both sides. */
  bool StrongerThan(const WeightedEdge& other) const
  {
    return this->Agreement != other.Agreement
      ? this->Agreement > other.Agreement
      : std::minmax(this->From, this->To) < std::minmax(other.From, other.To);
  }
};

/** The strongest facet by which a tetrahedron joins another region. */
WeightedEdge StrongestEdge(const DelaunayComplex& complex, const std::vector<int>& regions, int tet)
{
  WeightedEdge strongest;
  for (int other : complex.Neighbors[tet])
  {
    if (other >= 0 && regions[other] != regions[tet])
    {
      const WeightedEdge edge{ Agreement(complex, tet, other), tet, other };
      strongest = edge.StrongerThan(strongest) ? edge : strongest;
    }
  }
  return strongest;
}

/**
 * Lets labels spread over facets to all that have none, deepest intersection of balls first.
 *
 * That is the strongest spanning forest whose trees each hold one tetrahedron with a label
 * (Boruvka): every region without one joins the region it is most strongly connected with.
 */
void SpreadLabels(
  const DelaunayComplex& complex, std::vector<Side>& labels, const Execution& execution)
{
  DisjointSets sets(complex.NumberOfTets());
  std::vector<int> regions(labels.size());
  std::iota(regions.begin(), regions.end(), 0);
  std::vector<int> open; // tetrahedra without a label
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    if (labels[tet] == Side::Unknown)
    {
      open.push_back(tet);
    }
  }
  std::vector<WeightedEdge> edges;
  std::vector<WeightedEdge> edgeOfRegion(labels.size());
  while (!open.empty())
  {
    edges.resize(open.size());
    execution.ForEach(static_cast<std::int64_t>(open.size()),
      [&](std::int64_t i) { edges[i] = StrongestEdge(complex, regions, open[i]); });
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      WeightedEdge& strongest = edgeOfRegion[regions[open[i]]];
      strongest = edges[i].StrongerThan(strongest) ? edges[i] : strongest;
    }
    for (int tet : open)
    {
      const WeightedEdge edge = std::exchange(edgeOfRegion[regions[tet]], WeightedEdge());
      if (edge.From >= 0)
      {
        const int from = sets.Find(edge.From);
        const int to = sets.Find(edge.To);
        const Side label = labels[from] != Side::Unknown ? labels[from] : labels[to];
        sets.Unite(from, to);
        labels[sets.Find(from)] = label;
      }
    }
    std::erase_if(open,
      [&](int tet)
      {
        regions[tet] = sets.Find(tet);
        return labels[regions[tet]] != Side::Unknown;
      });
  }
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    labels[tet] = labels[sets.Find(tet)];
  }
}

//------------------------------------------------------------------------------
/** The tetrahedra around one sample, grouped by side and connection. */
class Star
{
public:
  /** One connected group. */
  struct Piece
  {
    Side Label = Side::Unknown;
    double Volume = 0;
    bool Frozen = false; ///< holds a tetrahedron that may not be turned over
    std::vector<int> Tets;
  };

  explicit Star(const DelaunayComplex& complex)
    : Complex(complex)
    , Mark(complex.Tets.size(), -1)
  {
  }

  /** Groups the star of `point`; the pieces have neither volumes nor are they frozen yet. */
  const std::vector<Piece>& Group(int point, const std::vector<Side>& labels)
  {
    this->Pieces.clear();
    ++this->Stamp;
    const int begin = this->Complex.IncidenceStart[point];
    const int end = this->Complex.IncidenceStart[point + 1];
    for (int i = begin; i < end; ++i)
    {
      const int seed = this->Complex.Incidence[i];
      if (this->Mark[seed] != this->Stamp)
      {
        this->Pieces.push_back(this->Grow(point, seed, labels));
      }
    }
    return this->Pieces;
  }

  /** Adds to the pieces what a repair needs. */
  const std::vector<Piece>& Measure(const std::vector<char>& turns)
  {
    for (Piece& piece : this->Pieces)
    {
      for (int tet : piece.Tets)
      {
        piece.Volume += this->Complex.Volume(tet);
        piece.Frozen |= turns[tet] >= MaximumTurns || this->Complex.TouchesCorner(tet);
      }
    }
    return this->Pieces;
  }

private:
  Piece Grow(int point, int seed, const std::vector<Side>& labels)
  {
    Piece piece;
    piece.Label = labels[seed];
    piece.Tets.push_back(seed);
    this->Mark[seed] = this->Stamp;
    for (std::size_t head = 0; head < piece.Tets.size(); ++head)
    {
      const int tet = piece.Tets[head];
      for (int k = 0; k < 4; ++k)
      {
        const int other = this->Complex.Neighbors[tet][k];
        if (other >= 0 && this->Complex.Tets[tet][k] != point && this->Mark[other] != this->Stamp &&
          labels[other] == piece.Label)
        {
          this->Mark[other] = this->Stamp;
          piece.Tets.push_back(other);
        }
      }
    }
    return piece;
  }

  const DelaunayComplex& Complex;
  std::vector<int> Mark;
  std::vector<Piece> Pieces;
  int Stamp = 0;
};

//------------------------------------------------------------------------------
/** What it takes to leave one piece of a side: the volume to turn, and the piece that stays. */
struct Turnover
{
  int Count = 0;
  int Kept = -1;
  double Cost = 0;
  bool Possible = true;
};

Turnover PlanTurnover(const std::vector<Star::Piece>& pieces, Side side)
{
  Turnover plan;
  // A frozen piece has to stay; two of them cannot be helped from this side.
  for (int i = 0; i < static_cast<int>(pieces.size()); ++i)
  {
    const Star::Piece& piece = pieces[i];
    if (piece.Label != side)
    {
      continue;
    }
    ++plan.Count;
    plan.Cost += piece.Volume;
    if (plan.Kept < 0)
    {
      plan.Kept = i;
      continue;
    }
    const Star::Piece& kept = pieces[plan.Kept];
    plan.Possible &= !(piece.Frozen && kept.Frozen);
    if (piece.Frozen != kept.Frozen ? piece.Frozen : piece.Volume > kept.Volume)
    {
      plan.Kept = i;
    }
  }
  if (plan.Kept >= 0)
  {
    plan.Cost -= pieces[plan.Kept].Volume;
  }
  return plan;
}

/** Turns over what makes the star irregular. Returns the tetrahedra turned; none: it cannot. */
std::vector<int> RepairStar(
  const std::vector<Star::Piece>& pieces, std::vector<Side>& labels, std::vector<char>& turns)
{
  std::vector<int> turned;
  const Turnover inside = PlanTurnover(pieces, Side::Inside);
  const Turnover outside = PlanTurnover(pieces, Side::Outside);
  const bool insideHelps = inside.Count > 1 && inside.Possible;
  const bool outsideHelps = outside.Count > 1 && outside.Possible;
  if (!insideHelps && !outsideHelps)
  {
    return turned;
  }
  const bool turnInside = insideHelps && (!outsideHelps || inside.Cost <= outside.Cost);
  const Side side = turnInside ? Side::Inside : Side::Outside;
  const int kept = turnInside ? inside.Kept : outside.Kept;
  for (int i = 0; i < static_cast<int>(pieces.size()); ++i)
  {
    if (pieces[i].Label == side && i != kept)
    {
      for (int tet : pieces[i].Tets)
      {
        labels[tet] = Opposite(side);
        ++turns[tet];
        turned.push_back(tet);
      }
    }
  }
  return turned;
}

bool IsRegular(const std::vector<Star::Piece>& pieces)
{
  return pieces.size() <= 1 || (pieces.size() == 2 && pieces[0].Label != pieces[1].Label);
}

//------------------------------------------------------------------------------
/** True when all tetrahedra of the sample are on one side. */
bool IsInterior(const DelaunayComplex& complex, const std::vector<Side>& labels, int sample)
{
  const int begin = complex.IncidenceStart[sample];
  const int end = complex.IncidenceStart[sample + 1];
  for (int i = begin + 1; i < end; ++i)
  {
    if (labels[complex.Incidence[i]] != labels[complex.Incidence[begin]])
    {
      return false;
    }
  }
  return begin < end;
}

/**
 * How flat the pyramid is that replaces facet `facet` of a tetrahedron by the three others: the
 * least cos of the angle between the normals of the new facets and of the old one.
 */
double PyramidFlatness(const DelaunayComplex& complex, int tet, int facet)
{
  auto normalOf = [&](int k) -> Eigen::Vector3d
  {
    const std::array<int, 3> f = complex.Facet(tet, k);
    const Eigen::Vector3d& a = complex.Points[f[0]];
    return (complex.Points[f[1]] - a).cross(complex.Points[f[2]] - a).stableNormalized();
  };
  const Eigen::Vector3d base = normalOf(facet);
  double least = 1;
  for (int k = 0; k < 4; ++k)
  {
    if (k != facet)
    {
      least = std::min(least, -base.dot(normalOf(k)));
    }
  }
  return least;
}

/** New facets may lean at most this far from the facet they replace: cos of 75 degrees. */
constexpr double ShallowCosine = 0.26;

/** The tetrahedron whose turning over brings a buried sample out best; -1 when none does. */
int BestPyramid(const DelaunayComplex& complex, const std::vector<Side>& labels, int sample)
{
  int best = -1;
  double flattest = ShallowCosine;
  for (int i = complex.IncidenceStart[sample]; i < complex.IncidenceStart[sample + 1]; ++i)
  {
    const int tet = complex.Incidence[i];
    const std::array<int, 4>& t = complex.Tets[tet];
    const int facet = static_cast<int>(std::find(t.begin(), t.end(), sample) - t.begin());
    const int other = complex.Neighbors[tet][facet];
    if (complex.TouchesCorner(tet) || other < 0 || labels[other] == labels[tet])
    {
      continue;
    }
    const double flatness = PyramidFlatness(complex, tet, facet);
    if (flatness > flattest)
    {
      flattest = flatness;
      best = tet;
    }
  }
  return best;
}

/** Pieces of equal label connected through facets: per tetrahedron the piece's lowest one. */
std::vector<int> FindComponents(const DelaunayComplex& complex, const std::vector<Side>& labels)
{
  DisjointSets sets(complex.NumberOfTets());
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    for (int other : complex.Neighbors[tet])
    {
      if (other > tet && labels[other] == labels[tet])
      {
        sets.Unite(tet, other);
      }
    }
  }
  std::vector<int> roots(complex.Tets.size());
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    roots[tet] = sets.Find(tet);
  }
  return roots;
}

/** Per piece root, how many different points its tetrahedra have. */
std::vector<int> CountPiecePoints(const DelaunayComplex& complex, const std::vector<int>& roots)
{
  std::vector<int> counts(complex.Tets.size(), 0);
  std::vector<int> seen;
  for (std::size_t p = 0; p < complex.Points.size(); ++p)
  {
    seen.clear();
    for (int i = complex.IncidenceStart[p]; i < complex.IncidenceStart[p + 1]; ++i)
    {
      const int root = roots[complex.Incidence[i]];
      if (std::find(seen.begin(), seen.end(), root) == seen.end())
      {
        seen.push_back(root);
        ++counts[root];
      }
    }
  }
  return counts;
}
}

//------------------------------------------------------------------------------
std::vector<Side> LabelTets(const DelaunayComplex& complex,
  const std::vector<std::array<int, 2>>& polesOfSample, const std::vector<Eigen::Vector3d>* normals,
  const Execution& execution)
{
  Labeller labeller(complex, polesOfSample, execution);
  labeller.AddCornerEvidence();
  if (normals)
  {
    labeller.AddNormalEvidence(*normals);
  }
  std::vector<Side> labels = labeller.Run(execution);
  SpreadLabels(complex, labels, execution);
  return labels;
}

//------------------------------------------------------------------------------
int RemoveSmallComponents(
  const DelaunayComplex& complex, int minimumSamples, std::vector<Side>& labels)
{
  const std::vector<int> roots = FindComponents(complex, labels);
  const std::vector<int> counts = CountPiecePoints(complex, roots);
  int largest = -1; // of the inside; the outside's is the one with the far corners
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    const bool root = roots[tet] == tet && labels[tet] == Side::Inside;
    largest = root && (largest < 0 || counts[tet] > counts[largest]) ? tet : largest;
  }
  std::vector<char> small(complex.Tets.size(), 0);
  int removed = 0;
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    small[tet] = roots[tet] == tet && tet != largest && counts[tet] < minimumSamples;
  }
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    if (complex.TouchesCorner(tet))
    {
      small[roots[tet]] = 0;
    }
  }
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    removed += small[tet];
    labels[tet] = small[roots[tet]] ? Opposite(labels[tet]) : labels[tet];
  }
  return removed;
}

//------------------------------------------------------------------------------
int MakeManifold(
  const DelaunayComplex& complex, std::vector<Side>& labels, const Execution& execution)
{
  std::vector<char> turns(complex.Tets.size(), 0);
  const std::size_t numberOfSamples = static_cast<std::size_t>(complex.NumberOfSamples);
  std::vector<char> irregular(numberOfSamples, 0);
  execution.ForEachWith(
    complex.NumberOfSamples, [&complex] { return Star(complex); },
    [&](Star& around, std::int64_t sample)
    {
      const int s = static_cast<int>(sample);
      irregular[s] = !IsInterior(complex, labels, s) && !IsRegular(around.Group(s, labels));
    });
  std::deque<int> queue;
  for (int s = 0; s < complex.NumberOfSamples; ++s)
  {
    if (irregular[s])
    {
      queue.push_back(s);
    }
  }
  std::vector<char> queued = irregular;
  Star star(complex);
  while (!queue.empty())
  {
    execution.CheckCancelled();
    const int sample = queue.front();
    queue.pop_front();
    queued[sample] = 0;
    irregular[sample] = 0;
    if (IsRegular(star.Group(sample, labels)))
    {
      continue;
    }
    const std::vector<int> turned = RepairStar(star.Measure(turns), labels, turns);
    irregular[sample] = turned.empty();
    for (int tet : turned)
    {
      for (int p : complex.Tets[tet])
      {
        if (!queued[p])
        {
          queued[p] = 1;
          queue.push_back(p);
        }
      }
    }
  }
  return static_cast<int>(std::count(irregular.begin(), irregular.end(), 1));
}

//------------------------------------------------------------------------------
int RecoverSamples(const DelaunayComplex& complex, std::vector<Side>& labels)
{
  std::deque<int> queue;
  for (int s = 0; s < complex.NumberOfSamples; ++s)
  {
    if (IsInterior(complex, labels, s))
    {
      queue.push_back(s);
    }
  }
  // Samples under samples: once more around as long as that brings some out.
  int recovered = 0;
  for (bool progress = true; progress;)
  {
    progress = false;
    std::deque<int> left;
    for (int sample : queue)
    {
      const int tet = BestPyramid(complex, labels, sample);
      if (tet < 0)
      {
        left.push_back(sample);
        continue;
      }
      labels[tet] = Opposite(labels[tet]);
      ++recovered;
      progress = true;
    }
    queue.swap(left);
  }
  return recovered;
}
}
