// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/OffscreenWindow.h"

#include "base/AddressSpace.h"
#include "core/Error.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkUnsignedCharArray.h>

#include <GL/osmesa.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>

extern "C"
{
  unsigned int glewInit();

  /**
   * GLEW calls this function for every OpenGL function after version 1.1. The one of GLX would
   * answer with functions that need a display; this one stands before it in the search order.
   */
  __attribute__((visibility("default"))) void (*glXGetProcAddressARB(const unsigned char* name))()
  {
    return reinterpret_cast<void (*)()>(OSMesaGetProcAddress(reinterpret_cast<const char*>(name)));
  }
}

namespace novelview
{
namespace
{
// Results of glewInit() when it has got everything but GLX, as it should be: with Mesa 22 it gets as
// far as to look for a display, the OSMesa of Mesa 25 has no function for that.
constexpr unsigned int GlewOk = 0;
constexpr unsigned int GlewNoGlx12 = 3;
constexpr unsigned int GlewNoGlxDisplay = 4;

/** The render window of VTK on an OSMesa context that it makes and destroys. */
class OSMesaRenderWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static OSMesaRenderWindow* New();
  vtkTypeMacro(OSMesaRenderWindow, vtkGenericOpenGLRenderWindow);

  /** False when OSMesa gives no context. */
  bool CreateContext()
  {
    const std::array<int, 13> attributes = { OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 24,
      OSMESA_STENCIL_BITS, 8, OSMESA_PROFILE, OSMESA_CORE_PROFILE, OSMESA_CONTEXT_MAJOR_VERSION, 3,
      OSMESA_CONTEXT_MINOR_VERSION, 2, 0 };
    this->Context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    return this->Context && this->BindContext();
  }

  bool HasOpenGL() const { return this->GlewInitValid; }

  void OpenGLInitContext() override
  {
    if (!this->Initialized)
    {
      const unsigned int result = glewInit();
      this->GlewInitValid = result == GlewOk || result == GlewNoGlx12 || result == GlewNoGlxDisplay;
      this->Initialized = this->GlewInitValid;
    }
  }

  void MakeCurrent() override
  {
    if (this->Context)
    {
      this->BindContext();
    }
  }

  bool IsCurrent() override { return this->Context && OSMesaGetCurrentContext() == this->Context; }

protected:
  OSMesaRenderWindow() = default;
  ~OSMesaRenderWindow() override
  {
    if (this->Context)
    {
      this->BindContext();
      // Renderers that live on must let go of their graphics while the context still exists.
      while (vtkRenderer* renderer = this->Renderers->GetFirstRenderer())
      {
        this->RemoveRenderer(renderer);
      }
      this->Finalize();
      OSMesaDestroyContext(this->Context);
      this->Context = nullptr;
    }
  }

private:
  // VTK draws into its own frame buffers, so that the one of the context may stay tiny.
  static constexpr int BufferSize = 8;

  bool BindContext()
  {
    return OSMesaMakeCurrent(this->Context, this->Buffer.data(), GL_UNSIGNED_BYTE, BufferSize,
             BufferSize) == GL_TRUE;
  }

  OSMesaContext Context = nullptr;
  std::array<unsigned char, 4 * BufferSize * BufferSize> Buffer{};
};
vtkStandardNewMacro(OSMesaRenderWindow);

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
  vtkNew<OSMesaRenderWindow> window;
  window->SetSize(width, height);
  if (!window->CreateContext())
  {
    throw Error(where, "OSMesa gives no OpenGL context (version 3.2, core profile)");
  }
  const std::string version = GLText(GL_VERSION);
  if (version.empty())
  {
    throw Error(where,
      "OpenGL reports no version: OSMesa is not the OpenGL library that the program has bound to");
  }
  GLint largest = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (width > largest || height > largest)
  {
    throw Error(where, "picture is larger than the driver can do", SizeText(width, height),
      "at most " + SizeText(largest, largest));
  }
  this->Name = GLText(GL_RENDERER) + ", OpenGL " + version;
  window->SetReadyForRendering(true);
  window->SetMultiSamples(0);
  window->OpenGLInit();
  if (!window->HasOpenGL())
  {
    throw Error(where, "the functions of OpenGL cannot be loaded from OSMesa");
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
