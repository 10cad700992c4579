// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the rasteriser.
#ifndef novelview_RowTiles_h
#define novelview_RowTiles_h

#include "core/Execution.h"
#include "geometry/Camera.h"
#include "geometry/PixelBox.h"
#include "geometry/ProjectedTriangle.h"
#include "geometry/TriangleMesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace novelview
{
/** The triangles of a mesh, projected and sorted into bands of rows that are drawn in parallel. */
class RowTiles
{
public:
  /** Number of rows of a band. */
  static constexpr int BandRows = 32;

  RowTiles(const TriangleMesh& mesh, const Camera& camera, const Execution& execution);

  /**
   * Calls draw(cellId, box) for every triangle of a band in the order of their ids; box has the
   * pixels of the band of which the triangle may cover a part. A `draw` that is to be compiled with
   * its caller's clones must be inlined.
   */
  template <class Draw>
  [[gnu::always_inline]] inline void ForBand(std::int64_t band, const Draw& draw) const
  {
    for (const std::vector<std::vector<Entry>>& part : this->Bands)
    {
      for (const Entry& entry : part[band])
      {
        draw(entry.CellId, entry.Box);
      }
    }
  }

  /** Calls draw(scratch, band) for all, in parallel; make() makes the scratch of a thread. */
  template <class Make, class Draw>
  void ForEachWith(const Make& make, const Draw& draw) const
  {
    this->Run.ForEachWith(this->NumberOfBands(), make, draw);
  }

  /** Calls draw(band) for all, in parallel. */
  template <class Draw>
  void ForEach(const Draw& draw) const
  {
    this->Run.ForEach(this->NumberOfBands(), draw);
  }

  ProjectedTriangle Projected(std::size_t cellId) const
  {
    const Eigen::Vector3i& t = this->Mesh.Triangles[cellId];
    return ProjectedTriangle(this->Points[t[0]], this->Points[t[1]], this->Points[t[2]]);
  }

  static int RowBegin(std::int64_t band) { return static_cast<int>(band) * BandRows; }
  int RowEnd(std::int64_t band) const
  {
    return std::min(RowTiles::RowBegin(band) + BandRows, this->Height);
  }

  const int Width;
  const int Height;

private:
  /** The triangles are sorted in this many parts in parallel; each keeps the order of their ids. */
  static constexpr int Parts = 16;

  struct Entry
  {
    int CellId;
    PixelBox Box;
  };

  int NumberOfBands() const { return (this->Height + BandRows - 1) / BandRows; }

  void Sort(int cellId, std::vector<std::vector<Entry>>& bands) const;

  const TriangleMesh& Mesh;
  const Execution& Run;
  std::vector<ProjectedPoint> Points;
  std::array<std::vector<std::vector<Entry>>, Parts> Bands; ///< by part and band
};
}

#endif
