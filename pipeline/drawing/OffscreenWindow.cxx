// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/OffscreenWindow.h"

#include "base/AddressSpace.h"
#include "core/Error.h"
#include "drawing/OpenGLLibrary.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVersion.h>

#include <GL/gl.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>

// Up to 9.3, VTK has OpenGL's functions from GLEW; later versions load them themselves.
#define NOVELVIEW_VTK_USES_GLEW (VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0))
#if NOVELVIEW_VTK_USES_GLEW
extern "C" unsigned int glewInit();
#endif

namespace novelview
{
namespace
{
/** The render window of VTK on a context that it owns. */
class ContextRenderWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static ContextRenderWindow* New();
  vtkTypeMacro(ContextRenderWindow, vtkGenericOpenGLRenderWindow);

  /** Throws Error when there is none. */
  void CreateContext()
  {
    this->Context = ChosenOpenGLLibrary().NewContext();
    if (!this->Context->MakeCurrent())
    {
      throw Error("offscreen rendering",
        ChosenOpenGLLibrary().Name() + "'s OpenGL context cannot be made current");
    }
  }

  bool HasOpenGL() const { return this->Loaded; }

  void OpenGLInitContext() override
  {
    if (this->Loaded)
    {
      return;
    }
#if NOVELVIEW_VTK_USES_GLEW
    // Results of glewInit() when it has got everything but GLX, as it should be: with Mesa 22 it gets
    // as far as to look for a display, the OSMesa of Mesa 25 has no function for that.
    constexpr unsigned int ok = 0;
    constexpr unsigned int noGlx12 = 3;
    constexpr unsigned int noGlxDisplay = 4;
    const unsigned int result = glewInit();
    this->Loaded = result == ok || result == noGlx12 || result == noGlxDisplay;
    this->GlewInitValid = this->Loaded; // VTK's own two
    this->Initialized = this->Loaded;
#else
    this->SetOpenGLSymbolLoader([](void*, const char* name)
      { return reinterpret_cast<VTKOpenGLAPIProc>(ChosenOpenGLLibrary().Function(name)); },
      nullptr);
    this->Superclass::OpenGLInitContext();
    this->Loaded = true;
#endif
  }

  void MakeCurrent() override
  {
    if (this->Context)
    {
      this->Context->MakeCurrent();
    }
  }

  bool IsCurrent() override
  {
    return this->Context && this->Context->IsCurrent();
  }

protected:
  ContextRenderWindow() = default;
  ~ContextRenderWindow() override
  {
    if (this->Context)
    {
      this->Context->MakeCurrent();
      // Renderers that live on must let go of their graphics while the context still exists.
      while (vtkRenderer* renderer = this->Renderers->GetFirstRenderer())
      {
        this->RemoveRenderer(renderer);
      }
      this->Finalize();
      this->Context.reset();
    }
  }

private:
  bool Loaded = false;
  std::unique_ptr<OpenGLContext> Context;
};
vtkStandardNewMacro(ContextRenderWindow);

/** llvmpipe crashes or hangs without memory, so the memory is reserved before. */
void RequireMemoryToDraw(int width, int height)
{
  constexpr std::size_t MiB = std::size_t(1) << 20;
  // Measured: shaders' code and threads of the first window; of each further image its frame
  // buffers, and what it is read back into.
  static std::atomic<bool> first = true;
  const std::size_t fixed = first ? 448 * MiB : 16 * MiB;
  const std::size_t pixels =
    std::min(static_cast<std::size_t>(width) * height, std::size_t(1) << 32); // no driver has more
  RequireAddressSpace("offscreen rendering", fixed + 12 * pixels);
  first = false;
}

std::string GLText(GLenum name)
{
  const GLubyte* text = glGetString(name);
  return text ? reinterpret_cast<const char*>(text) : std::string();
}
}

//------------------------------------------------------------------------------
OffscreenWindow::OffscreenWindow(int width, int height)
  : Size{ width, height }
{
  const char* const where = "offscreen rendering";
  if (width <= 0 || height <= 0)
  {
    throw Error(where, "picture size is not positive", SizeText(width, height), "at least 1x1");
  }
  RequireMemoryToDraw(width, height);
  vtkNew<ContextRenderWindow> window;
  window->SetSize(width, height);
  window->CreateContext();
  const std::string version = GLText(GL_VERSION);
  if (version.empty())
  {
    throw Error(where,
      "OpenGL reports no version: the program has bound to another OpenGL library than " +
        ChosenOpenGLLibrary().Name());
  }
  GLint largest = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (width > largest || height > largest)
  {
    throw Error(where, "picture is larger than the driver can do", SizeText(width, height),
      "at most " + SizeText(largest, largest));
  }
  this->Name = ChosenOpenGLLibrary().Name() + ": " + GLText(GL_RENDERER) + ", OpenGL " + version;
  window->SetReadyForRendering(true);
  window->SetMultiSamples(0);
  window->OpenGLInitContext(); // VTK 9.4 and later want it before OpenGLInit()
  window->OpenGLInit();
  if (!window->HasOpenGL())
  {
    throw Error(
      where, "the functions of OpenGL cannot be loaded from " + ChosenOpenGLLibrary().Name());
  }
  this->Render = window;
  this->ProveItDraws();
  static std::once_flag told;
  std::call_once(told, [this] { spdlog::info("offscreen rendering with {}", this->Name); });
}

//------------------------------------------------------------------------------
OffscreenWindow::~OffscreenWindow() = default;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> OffscreenWindow::Capture(bool withAlpha)
{
  RequireMemoryToDraw(this->Size[0], this->Size[1]);
  this->Render->MakeCurrent();
  this->Render->Render();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(this->Size[0], this->Size[1], 1);
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetName("Color");
  const int right = this->Size[0] - 1;
  const int top = this->Size[1] - 1;
  const int read = withAlpha
    ? this->Render->GetRGBACharPixelData(0, 0, right, top, /*front=*/0, pixels)
    : this->Render->GetPixelData(0, 0, right, top, /*front=*/0, pixels);
  if (!read || pixels->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw Error("offscreen rendering", "the picture cannot be read back");
  }
  image->GetPointData()->SetScalars(pixels);
  return image;
}

//------------------------------------------------------------------------------
void OffscreenWindow::ProveItDraws()
{
  // A render window that is not current draws nothing and reports no error, so pixels are checked.
  const double background[3] = { 0.2, 0.4, 0.8 };
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(background[0], background[1], background[2]);
  this->Render->AddRenderer(renderer);
  vtkSmartPointer<vtkImageData> image = this->Capture();
  this->Render->RemoveRenderer(renderer);
  for (const vtkIdType ptId : { vtkIdType(0), image->GetNumberOfPoints() - 1 })
  {
    double pixel[3];
    image->GetPointData()->GetScalars()->GetTuple(ptId, pixel);
    for (int c = 0; c < 3; ++c)
    {
      if (std::abs(pixel[c] - 255 * background[c]) > 1.5)
      {
        throw Error("offscreen rendering",
          "a cleared picture reads back in another colour (" + this->Name + ")",
          std::to_string(pixel[c]), std::to_string(255 * background[c]));
      }
    }
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> RenderOffscreen(vtkRenderer* renderer, int width, int height)
{
  OffscreenWindow window(width, height);
  window.Window()->AddRenderer(renderer);
  vtkSmartPointer<vtkImageData> image = window.Capture();
  window.Window()->RemoveRenderer(renderer);
  return image;
}
}
