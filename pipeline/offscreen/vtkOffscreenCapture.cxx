// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkOffscreenCapture.h"

#include "core/Error.h"
#include "drawing/OffscreenWindow.h"

#include <vtkImageData.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>

#include <spdlog/spdlog.h>

#include <algorithm>

vtkStandardNewMacro(vtkOffscreenCapture);

//------------------------------------------------------------------------------
vtkOffscreenCapture::vtkOffscreenCapture()
{
  // The program logs which driver it draws with; a library keeps quiet.
  spdlog::set_level(std::max(spdlog::get_level(), spdlog::level::warn));
}

//------------------------------------------------------------------------------
bool vtkOffscreenCapture::Capture(vtkRenderer* renderer, int width, int height, vtkImageData* image)
{
  try
  {
    if (!renderer || !image)
    {
      throw novelview::Error("offscreen rendering", "no renderer or no image given");
    }
    image->ShallowCopy(novelview::RenderOffscreen(renderer, width, height));
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< novelview::ErrorText(error));
    return false;
  }
}
