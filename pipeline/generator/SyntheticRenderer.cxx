// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/SyntheticRenderer.h"

#include "ViewAccess.h"
#include "core/Error.h"
#include "drawing/OffscreenWindow.h"
#include "vtkPinholeCamera.h"

#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>

namespace novelview
{
namespace
{
/** Largest side of a rendered tile, in samples. */
constexpr int TileSamples = 2048;

/** The part [x0, x0 + width) x [y0, y0 + height) of a camera's frame, `scale` samples per pixel. */
Camera TileCamera(const Camera& camera, int x0, int y0, int width, int height, int scale)
{
  // The left edge of pixel x0 is at x0 - 0.5 and becomes the left edge of sample 0, at -0.5.
  Eigen::Matrix3d toSamples;
  toSamples << scale, 0, scale * (0.5 - x0) - 0.5, 0, scale, scale * (0.5 - y0) - 0.5, 0, 0, 1;
  Camera tile = camera;
  tile.K = toSamples * camera.K;
  tile.Width = width * scale;
  tile.Height = height * scale;
  return tile;
}

/** Box-filters the samples of a tile (RGBA) into the photograph, as far as it reaches. */
void Downsample(
  const ImageRef<const std::uint8_t>& samples, int scale, int x0, int y0, RenderedPhotograph& out)
{
  const int width = std::min(samples.Width / scale, out.Color.Width - x0);
  const int height = std::min(samples.Height / scale, out.Color.Height - y0);
  const int count = scale * scale;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      std::array<int, 4> sum{};
      for (int sy = 0; sy < scale; ++sy)
      {
        const std::uint8_t* sample = samples.Pixel(x * scale, y * scale + sy);
        for (int sx = 0; sx < 4 * scale; ++sx)
        {
          sum[sx % 4] += sample[sx];
        }
      }
      for (int c = 0; c < 3; ++c)
      {
        out.Color(x0 + x, y0 + y, c) = static_cast<std::uint8_t>((sum[c] + count / 2) / count);
      }
      out.Coverage(x0 + x, y0 + y) = static_cast<std::uint8_t>((sum[3] + count / 2) / count);
    }
  }
}
}

//------------------------------------------------------------------------------
class SyntheticRenderer::Internals
{
public:
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkSmartPointer<vtkActor> Actor;
  Eigen::Vector3d Centre;
  int Scale = 1;
  vtkNew<vtkRenderer> Renderer;
  std::unique_ptr<OffscreenWindow> Window;
  std::string Name;

  /** A window for a tile of this many pixels, reused for all photographs. */
  void OpenWindow(int width, int height)
  {
    width *= this->Scale;
    height *= this->Scale;
    if (this->Window && this->Window->Width() == width && this->Window->Height() == height)
    {
      return;
    }
    this->CloseWindow();
    this->Window = std::make_unique<OffscreenWindow>(width, height);
    this->Name = this->Window->RendererName();
    this->Window->Window()->AddRenderer(this->Renderer);
  }

  void CloseWindow()
  {
    if (this->Window)
    {
      this->Window->Window()->RemoveRenderer(this->Renderer);
      this->Window.reset();
    }
  }

  /** Nearest and farthest depth of the mesh, with a margin. */
  std::array<double, 2> DepthRange(const Camera& camera) const
  {
    double nearest = VTK_DOUBLE_MAX;
    double farthest = VTK_DOUBLE_MIN;
    for (vtkIdType ptId = 0; ptId < this->Mesh->GetNumberOfPoints(); ++ptId)
    {
      const double depth = camera.Depth(Eigen::Vector3d(this->Mesh->GetPoint(ptId)));
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
    if (!(nearest > 0))
    {
      throw Error("photograph", "the object is not wholly in front of the camera",
        "nearest depth " + std::to_string(nearest), "more than 0");
    }
    return { 0.95 * nearest, 1.05 * farthest };
  }
};

//------------------------------------------------------------------------------
SyntheticRenderer::SyntheticRenderer(vtkPolyData* mesh, const SurfaceLook& look, int supersampling)
  : Impl(std::make_unique<Internals>())
{
  this->Impl->Mesh = mesh;
  this->Impl->Actor = NewTexturedActor(mesh, look, this->Impl->Centre.data());
  this->Impl->Scale = supersampling;
  this->Impl->Renderer->SetBackground(0, 0, 0);
  this->Impl->Renderer->AddActor(this->Impl->Actor);
  this->Impl->OpenWindow(8, 8);
}

//------------------------------------------------------------------------------
SyntheticRenderer::~SyntheticRenderer()
{
  this->Impl->CloseWindow();
}

//------------------------------------------------------------------------------
const std::string& SyntheticRenderer::RendererName() const
{
  return this->Impl->Name;
}

//------------------------------------------------------------------------------
RenderedPhotograph SyntheticRenderer::Take(const Camera& camera, double shadow)
{
  ValidateCamera(camera, "photograph");
  const std::array<double, 2> range = this->Impl->DepthRange(camera);
  SetShadow(this->Impl->Actor, shadow);
  const Eigen::Vector3d eye = camera.Centre() - this->Impl->Centre;
  SetEye(this->Impl->Actor, eye.data());

  const int tileSide = std::max(1, TileSamples / this->Impl->Scale);
  const int tileWidth = std::min(tileSide, camera.Width);
  const int tileHeight = std::min(tileSide, camera.Height);
  this->Impl->OpenWindow(tileWidth, tileHeight);

  // The actor's geometry has the box's centre as its origin, so the camera moves along.
  Camera centred = camera;
  centred.T = camera.ToCamera(this->Impl->Centre);
  RenderedPhotograph photograph;
  photograph.Color = Image<std::uint8_t>(camera.Width, camera.Height, 3);
  photograph.Coverage = Image<std::uint8_t>(camera.Width, camera.Height, 1);
  for (int y0 = 0; y0 < camera.Height; y0 += tileHeight)
  {
    for (int x0 = 0; x0 < camera.Width; x0 += tileWidth)
    {
      NewPinholeCamera(TileCamera(centred, x0, y0, tileWidth, tileHeight, this->Impl->Scale))
        ->CopyToVTKCamera(this->Impl->Renderer->GetActiveCamera(), range[0], range[1]);
      vtkSmartPointer<vtkImageData> samples = this->Impl->Window->Capture(/*withAlpha=*/true);
      Downsample(TopDownArray<const std::uint8_t>(samples, arrays::Color, 4, "photograph", true),
        this->Impl->Scale, x0, y0, photograph);
    }
  }
  return photograph;
}
}
