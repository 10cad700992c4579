// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/OpenGLLibrary.h"

#include "core/Error.h"
#include "drawing/EglLibrary.h"
#include "drawing/OSMesaLibrary.h"

#include <atomic>
#include <string>

namespace novelview
{
namespace
{
std::atomic<RendererChoice> Choice = RendererChoice::Auto;
}

std::unique_ptr<OpenGLLibrary> OpenGLLibrary::Load(RendererChoice choice)
{
  switch (choice)
  {
    case RendererChoice::OSMesa:
      return LoadOSMesa();
    case RendererChoice::Egl:
      return LoadEgl(true);
    case RendererChoice::EglGpu:
      return LoadEgl(false);
    case RendererChoice::Auto:
      break;
  }
  try
  {
    return LoadOSMesa();
  }
  catch (const Error& noOSMesa)
  {
    try
    {
      return LoadEgl(true);
    }
    catch (const Error& noEgl)
    {
      throw Error("offscreen rendering",
        std::string("nothing draws: ") + noOSMesa.what() + "; " + noEgl.what());
    }
  }
}

void ChooseRenderer(RendererChoice choice)
{
  Choice = choice;
}

const OpenGLLibrary& ChosenOpenGLLibrary()
{
  // Never destroyed: windows of static objects may outlive it.
  static const OpenGLLibrary& library = *OpenGLLibrary::Load(Choice).release();
  return library;
}
}
