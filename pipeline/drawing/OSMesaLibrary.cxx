// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/OSMesaLibrary.h"

#include "core/Error.h"
#include "drawing/SharedLibrary.h"

#include <array>

namespace novelview
{
namespace
{
constexpr int BufferSize = 8; ///< pixels; VTK draws into its own frame buffers

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
      throw Error(
        "offscreen rendering", "OSMesa gives no OpenGL context (version 3.2, core profile)");
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
    this->Library.Bind(this->Interface.CreateContextAttribs, "OSMesaCreateContextAttribs");
    this->Library.Bind(this->Interface.DestroyContext, "OSMesaDestroyContext");
    this->Library.Bind(this->Interface.MakeCurrent, "OSMesaMakeCurrent");
    this->Library.Bind(this->Interface.GetCurrentContext, "OSMesaGetCurrentContext");
    this->Library.Bind(this->Interface.GetProcAddress, "OSMesaGetProcAddress");
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
}

std::unique_ptr<OpenGLLibrary> LoadOSMesa()
{
  return std::make_unique<OSMesaLibrary>();
}
}
