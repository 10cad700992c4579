// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_DisjointSets_h
#define novelview_DisjointSets_h

#include <numeric>
#include <vector>

namespace novelview
{
/** Union-find over 0 .. count-1. A set's representative is its smallest member. */
class DisjointSets
{
public:
  explicit DisjointSets(int count)
    : Parent(static_cast<std::size_t>(count))
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }

  int Find(int i)
  {
    while (this->Parent[i] != i)
    {
      this->Parent[i] = this->Parent[this->Parent[i]];
      i = this->Parent[i];
    }
    return i;
  }

  void Unite(int a, int b)
  {
    a = this->Find(a);
    b = this->Find(b);
    if (a < b)
    {
      this->Parent[b] = a;
    }
    else
    {
      this->Parent[a] = b;
    }
  }

private:
  std::vector<int> Parent;
};
}

#endif
