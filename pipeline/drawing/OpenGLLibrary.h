// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OpenGLLibrary_h
#define novelview_OpenGLLibrary_h

#include <memory>
#include <string>

namespace novelview
{
/** Where OpenGL comes from. */
enum class RendererChoice
{
  Auto,   ///< OSMesa where it is installed, otherwise Egl
  OSMesa, ///< Mesa's software renderer in memory
  Egl,    ///< the software device of EGL
  EglGpu  ///< the first other device of EGL: a graphics card
};

/** An OpenGL context (3.2, core profile) with a tiny buffer of its own. */
class OpenGLContext
{
public:
  virtual ~OpenGLContext() = default;
  virtual bool MakeCurrent() = 0;
  virtual bool IsCurrent() const = 0;
};

/** A library of the system that draws without a display, loaded at run time. */
class OpenGLLibrary
{
public:
  virtual ~OpenGLLibrary() = default;

  /**
   * Loads the library. Throws Error, with what was looked for and the Debian package that has it,
   * when it is not there.
   */
  static std::unique_ptr<OpenGLLibrary> Load(RendererChoice choice);

  virtual std::string Name() const = 0;
  /** Null when there is no such function. */
  virtual void* Function(const char* name) const = 0;
  /** Throws Error when the library gives none. */
  virtual std::unique_ptr<OpenGLContext> NewContext() const = 0;
};

/** Chooses for the whole process; counts until the first window is opened. Default: Auto. */
void ChooseRenderer(RendererChoice choice);

/** The library chosen, loaded at the first call. Throws as Load() does. */
const OpenGLLibrary& ChosenOpenGLLibrary();
}

#endif
