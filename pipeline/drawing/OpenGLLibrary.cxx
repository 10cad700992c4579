// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/OpenGLLibrary.h"

#include "core/Error.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <atomic>
#include <cstring>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include <dlfcn.h>

namespace novelview
{
namespace
{
const char* const Where = "offscreen rendering";
constexpr int BufferSize = 8; ///< VTK draws into its own frame buffers

/** A shared library that stays loaded: drivers do not survive being unloaded. */
class SharedLibrary
{
public:
  SharedLibrary(const std::vector<const char*>& names, const char* package)
  {
    for (const char* name : names)
    {
      this->Handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      if (this->Handle)
      {
        return;
      }
    }
    const char* const reason = dlerror();
    throw Error(Where,
      std::string(names.front()) + " cannot be loaded (" + (reason ? reason : "no reason given") +
        "); Debian's package " + package + " has it");
  }

  template <class Signature>
  Signature* Function(const char* name) const
  {
    return reinterpret_cast<Signature*>(dlsym(this->Handle, name));
  }

  template <class Signature>
  Signature* Needed(const char* name) const
  {
    Signature* const function = this->Function<Signature>(name);
    if (!function)
    {
      throw Error(Where, std::string("the OpenGL library has no function ") + name);
    }
    return function;
  }

private:
  void* Handle = nullptr;
};

// ---- OSMesa ------------------------------------------------------------------------------------

/** The part of GL/osmesa.h that is used; that file is gone from systems without the library. */
struct OSMesaInterface
{
  using Context = void*;
  Context (*CreateContextAttribs)(const int*, Context);
  void (*DestroyContext)(Context);
  unsigned char (*MakeCurrent)(Context, void*, unsigned int, int, int);
  Context (*GetCurrentContext)();
  void* (*GetProcAddress)(const char*);
};

class OSMesaContextOf : public OpenGLContext
{
public:
  explicit OSMesaContextOf(const OSMesaInterface& interface)
    : Interface(interface)
  {
    constexpr int format = 0x22;
    constexpr int rgba = 0x1908; // GL_RGBA
    constexpr int depthBits = 0x30;
    constexpr int stencilBits = 0x31;
    constexpr int profile = 0x33;
    constexpr int coreProfile = 0x34;
    constexpr int majorVersion = 0x36;
    constexpr int minorVersion = 0x37;
    const std::array<int, 13> attributes = { format, rgba, depthBits, 24, stencilBits, 8, profile,
      coreProfile, majorVersion, 3, minorVersion, 2, 0 };
    this->Context = interface.CreateContextAttribs(attributes.data(), nullptr);
    if (!this->Context)
    {
      throw Error(Where, "OSMesa gives no OpenGL context (version 3.2, core profile)");
    }
  }
  ~OSMesaContextOf() override { this->Interface.DestroyContext(this->Context); }
  OSMesaContextOf(const OSMesaContextOf&) = delete;
  OSMesaContextOf& operator=(const OSMesaContextOf&) = delete;

  bool MakeCurrent() override
  {
    constexpr unsigned int unsignedByte = 0x1401; // GL_UNSIGNED_BYTE
    return this->Interface.MakeCurrent(
             this->Context, this->Buffer.data(), unsignedByte, BufferSize, BufferSize) != 0;
  }
  bool IsCurrent() const override { return this->Interface.GetCurrentContext() == this->Context; }

private:
  const OSMesaInterface& Interface;
  OSMesaInterface::Context Context = nullptr;
  std::array<unsigned char, 4 * BufferSize * BufferSize> Buffer{};
};

class OSMesaLibrary : public OpenGLLibrary
{
public:
  OSMesaLibrary()
    : Library({ "libOSMesa.so.8", "libOSMesa.so" }, "libosmesa6")
  {
    const auto bind = [this](auto*& function, const char* name) {
      function =
        this->Library.Needed<std::remove_pointer_t<std::decay_t<decltype(function)>>>(name);
    };
    bind(this->Interface.CreateContextAttribs, "OSMesaCreateContextAttribs");
    bind(this->Interface.DestroyContext, "OSMesaDestroyContext");
    bind(this->Interface.MakeCurrent, "OSMesaMakeCurrent");
    bind(this->Interface.GetCurrentContext, "OSMesaGetCurrentContext");
    bind(this->Interface.GetProcAddress, "OSMesaGetProcAddress");
  }

  std::string Name() const override { return "OSMesa"; }
  void* Function(const char* name) const override { return this->Interface.GetProcAddress(name); }
  std::unique_ptr<OpenGLContext> NewContext() const override
  {
    return std::make_unique<OSMesaContextOf>(this->Interface);
  }

private:
  const SharedLibrary Library;
  OSMesaInterface Interface{};
};

// ---- EGL ---------------------------------------------------------------------------------------

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
      throw Error(Where, "EGL gives no OpenGL context (version 3.2, core profile)");
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
    const auto bind = [this](auto& function, const char* name) {
      function =
        this->Library.Needed<std::remove_pointer_t<std::decay_t<decltype(function)>>>(name);
    };
    bind(this->Interface.GetProcAddress, "eglGetProcAddress");
    bind(this->Interface.Initialize, "eglInitialize");
    bind(this->Interface.BindApi, "eglBindAPI");
    bind(this->Interface.ChooseConfig, "eglChooseConfig");
    bind(this->Interface.CreatePbufferSurface, "eglCreatePbufferSurface");
    bind(this->Interface.CreateContext, "eglCreateContext");
    bind(this->Interface.MakeCurrent, "eglMakeCurrent");
    bind(this->Interface.GetCurrentContext, "eglGetCurrentContext");
    bind(this->Interface.DestroySurface, "eglDestroySurface");
    bind(this->Interface.DestroyContext, "eglDestroyContext");
    this->Display = this->FindDisplay();
    if (!this->Display || !this->Interface.Initialize(this->Display, nullptr, nullptr) ||
      !this->Interface.BindApi(EGL_OPENGL_API))
    {
      throw Error(Where,
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

std::atomic<RendererChoice> Choice = RendererChoice::Auto;
}

std::unique_ptr<OpenGLLibrary> OpenGLLibrary::Load(RendererChoice choice)
{
  switch (choice)
  {
    case RendererChoice::OSMesa:
      return std::make_unique<OSMesaLibrary>();
    case RendererChoice::Egl:
      return std::make_unique<EglLibrary>(true);
    case RendererChoice::EglGpu:
      return std::make_unique<EglLibrary>(false);
    case RendererChoice::Auto:
      break;
  }
  try
  {
    return std::make_unique<OSMesaLibrary>();
  }
  catch (const Error& noOSMesa)
  {
    try
    {
      return std::make_unique<EglLibrary>(true);
    }
    catch (const Error& noEgl)
    {
      throw Error(Where, std::string("nothing draws: ") + noOSMesa.what() + "; " + noEgl.what());
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
