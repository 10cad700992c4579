// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/ManifoldRepair.h"

#include <algorithm>
#include <deque>

namespace novelview
{
namespace
{
/** How often the repair may relabel one tetrahedron. */
constexpr char MaximumTurns = 3;

/** The tetrahedra around one sample, grouped by side and connection. */
class Star
{
public:
  /** One connected group. */
  struct Piece
  {
    Side Label = Side::Unknown;
    double Volume = 0;
    bool Frozen = false; ///< contains a tetrahedron that may not be relabelled
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
}

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
}
