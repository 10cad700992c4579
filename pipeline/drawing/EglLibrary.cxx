// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/EglLibrary.h"

#include "core/Error.h"
#include "drawing/SharedLibrary.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>
#include <vector>

namespace novelview
{
namespace
{
constexpr int BufferSize = 8; ///< pixels; VTK draws into its own frame buffers

struct EglInterface
{
  decltype(&eglGetProcAddress) GetProcAddress;
  decltype(&eglInitialize) Initialize;
  decltype(&eglBindAPI) BindApi;
  decltype(&eglChooseConfig) ChooseConfig;
  decltype(&eglCreatePbufferSurface) CreatePbufferSurface;
  decltype(&eglCreateContext) CreateContext;
  decltype(&eglMakeCurrent) MakeCurrent;
  decltype(&eglGetCurrentContext) GetCurrentContext;
  decltype(&eglDestroySurface) DestroySurface;
  decltype(&eglDestroyContext) DestroyContext;
};

class EglContextOf : public OpenGLContext
{
public:
  EglContextOf(const EglInterface& interface, EGLDisplay display)
    : Interface(interface)
    , Display(display)
  {
    const std::array<EGLint, 17> wanted = { EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
      EGL_PBUFFER_BIT, EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_ALPHA_SIZE, 8,
      EGL_DEPTH_SIZE, 24, EGL_STENCIL_SIZE, 8, EGL_NONE };
    const std::array<EGLint, 7> attributes = { EGL_CONTEXT_MAJOR_VERSION, 3,
      EGL_CONTEXT_MINOR_VERSION, 2, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
    const std::array<EGLint, 5> size = { EGL_WIDTH, BufferSize, EGL_HEIGHT, BufferSize, EGL_NONE };
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (interface.ChooseConfig(display, wanted.data(), &config, 1, &count) && count > 0)
    {
      this->Surface = interface.CreatePbufferSurface(display, config, size.data());
      this->Context = interface.CreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    }
    if (!this->Context)
    {
      throw Error("offscreen rendering", "EGL gives no OpenGL context (version 3.2, core profile)");
    }
  }
  ~EglContextOf() override
  {
    if (this->IsCurrent())
    {
      this->Interface.MakeCurrent(this->Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    this->Interface.DestroySurface(this->Display, this->Surface);
    this->Interface.DestroyContext(this->Display, this->Context);
  }
  EglContextOf(const EglContextOf&) = delete;
  EglContextOf& operator=(const EglContextOf&) = delete;

  bool MakeCurrent() override
  {
    return this->Interface.BindApi(EGL_OPENGL_API) &&
      this->Interface.MakeCurrent(this->Display, this->Surface, this->Surface, this->Context);
  }
  bool IsCurrent() const override { return this->Interface.GetCurrentContext() == this->Context; }

private:
  const EglInterface& Interface;
  EGLDisplay Display;
  EGLSurface Surface = EGL_NO_SURFACE;
  EGLContext Context = EGL_NO_CONTEXT;
};

class EglLibrary : public OpenGLLibrary
{
public:
  explicit EglLibrary(bool software)
    : Library({ "libEGL.so.1", "libEGL.so" }, "libegl1")
    , Software(software)
  {
    this->Library.Bind(this->Interface.GetProcAddress, "eglGetProcAddress");
    this->Library.Bind(this->Interface.Initialize, "eglInitialize");
    this->Library.Bind(this->Interface.BindApi, "eglBindAPI");
    this->Library.Bind(this->Interface.ChooseConfig, "eglChooseConfig");
    this->Library.Bind(this->Interface.CreatePbufferSurface, "eglCreatePbufferSurface");
    this->Library.Bind(this->Interface.CreateContext, "eglCreateContext");
    this->Library.Bind(this->Interface.MakeCurrent, "eglMakeCurrent");
    this->Library.Bind(this->Interface.GetCurrentContext, "eglGetCurrentContext");
    this->Library.Bind(this->Interface.DestroySurface, "eglDestroySurface");
    this->Library.Bind(this->Interface.DestroyContext, "eglDestroyContext");
    this->Display = this->FindDisplay();
    if (!this->Display || !this->Interface.Initialize(this->Display, nullptr, nullptr) ||
      !this->Interface.BindApi(EGL_OPENGL_API))
    {
      throw Error("offscreen rendering",
        software ? "EGL has no software device; Debian's package libegl-mesa0 brings it"
                 : "EGL has no device of a graphics card");
    }
  }

  std::string Name() const override { return this->Software ? "EGL" : "EGL, graphics card"; }
  void* Function(const char* name) const override
  {
    return reinterpret_cast<void*>(this->Interface.GetProcAddress(name));
  }
  std::unique_ptr<OpenGLContext> NewContext() const override
  {
    return std::make_unique<EglContextOf>(this->Interface, this->Display);
  }

private:
  /** The first device that is, or is not, marked as software; whatever DISPLAY and others say. */
  EGLDisplay FindDisplay() const
  {
    const auto queryDevices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(this->Function("eglQueryDevicesEXT"));
    const auto queryString =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(this->Function("eglQueryDeviceStringEXT"));
    const auto platformDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(this->Function("eglGetPlatformDisplayEXT"));
    EGLint count = 0;
    if (!queryDevices || !queryString || !platformDisplay || !queryDevices(0, nullptr, &count) ||
      count <= 0)
    {
      return EGL_NO_DISPLAY;
    }
    std::vector<EGLDeviceEXT> devices(count);
    queryDevices(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices)
    {
      const char* const extensions = queryString(device, EGL_EXTENSIONS);
      const bool software = extensions && std::strstr(extensions, "EGL_MESA_device_software");
      if (software == this->Software)
      {
        return platformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
      }
    }
    return EGL_NO_DISPLAY;
  }

  const SharedLibrary Library;
  const bool Software;
  EglInterface Interface{};
  EGLDisplay Display = EGL_NO_DISPLAY;
};
}

std::unique_ptr<OpenGLLibrary> LoadEgl(bool software)
{
  return std::make_unique<EglLibrary>(software);
}
}
