// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/RowTiles.h"

namespace novelview
{
RowTiles::RowTiles(const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
  : Width(camera.Width)
  , Height(camera.Height)
  , Mesh(mesh)
  , Run(execution)
  , Points(ProjectPoints(mesh, camera, execution))
{
  execution.ForEach(Parts,
    [&](std::int64_t part)
    {
      std::vector<std::vector<Entry>>& bands = this->Bands[part];
      bands.resize(this->NumberOfBands());
      const std::size_t count = mesh.Triangles.size();
      for (std::size_t cellId = part * count / Parts; cellId < (part + 1) * count / Parts; ++cellId)
      {
        this->Sort(static_cast<int>(cellId), bands);
      }
    });
}

void RowTiles::Sort(int cellId, std::vector<std::vector<Entry>>& bands) const
{
  const ProjectedTriangle triangle = this->Projected(cellId);
  if (!triangle.Drawn())
  {
    return;
  }
  constexpr double halfPixel = 0.5;
  const PixelBox box = triangle.Box(halfPixel, this->Width, this->Height);
  for (int begin = box.YBegin, end = 0; begin < box.YEnd && !box.Empty(); begin = end)
  {
    const int band = begin / BandRows;
    end = std::min(box.YEnd, (band + 1) * BandRows);
    bands[band].push_back({ cellId, { box.XBegin, box.XEnd, begin, end } });
  }
}
}
