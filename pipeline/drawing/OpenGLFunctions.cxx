// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * OpenGL's functions as the whole program sees them.
 *
 * VTK up to 9.3 is linked against the system's OpenGL, which needs a display. The functions here stand
 * before those in the search order of the dynamic linker and pass every call on to the library that
 * was chosen at run time: the functions of OpenGL 1.1 that VTK calls by name, and the one by which
 * GLEW asks for all others. A test compares the list with what VTK's libraries need.
 */
#include "drawing/OpenGLLibrary.h"

#include <GL/gl.h>

#include <cstring>

namespace
{
/** Calls a function of the chosen library; the static variable is one per function and call site. */
template <class Signature>
Signature* Chosen(const char* name)
{
  return reinterpret_cast<Signature*>(novelview::ChosenOpenGLLibrary().Function(name));
}
}

// NOLINTBEGIN(bugprone-macro-parentheses): types, parameters and arguments
#define NOVELVIEW_FORWARD(Result, Name, Parameters, Arguments)                                     \
  __attribute__((visibility("default"))) Result Name Parameters                                    \
  {                                                                                                \
    static auto* const chosen = Chosen<Result Parameters>(#Name);                                  \
    return chosen Arguments;                                                                       \
  }
// NOLINTEND(bugprone-macro-parentheses)

extern "C"
{
  __attribute__((visibility("default"))) void (*glXGetProcAddressARB(const GLubyte* name))()
  {
    // What asks for a display would be answered by EGL with functions that do nothing.
    const char* const text = reinterpret_cast<const char*>(name);
    return std::strncmp(text, "glX", 3) == 0 ? nullptr : Chosen<void()>(text);
  }

  NOVELVIEW_FORWARD(void, glBindTexture, (GLenum target, GLuint texture), (target, texture))
  NOVELVIEW_FORWARD(void, glBlendFunc, (GLenum sfactor, GLenum dfactor), (sfactor, dfactor))
  NOVELVIEW_FORWARD(void, glClear, (GLbitfield mask), (mask))
  NOVELVIEW_FORWARD(void, glClearColor,
    (GLclampf red, GLclampf green, GLclampf blue, GLclampf alpha), (red, green, blue, alpha))
  NOVELVIEW_FORWARD(void, glClearDepth, (GLclampd depth), (depth))
  NOVELVIEW_FORWARD(void, glClearStencil, (GLint s), (s))
  NOVELVIEW_FORWARD(void, glColorMask,
    (GLboolean red, GLboolean green, GLboolean blue, GLboolean alpha), (red, green, blue, alpha))
  NOVELVIEW_FORWARD(void, glCopyTexImage2D,
    (GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei width, GLsizei height,
      GLint border),
    (target, level, format, x, y, width, height, border))
  NOVELVIEW_FORWARD(void, glCopyTexSubImage2D,
    (GLenum target, GLint level, GLint xoffset, GLint yoffset, GLint x, GLint y, GLsizei width,
      GLsizei height),
    (target, level, xoffset, yoffset, x, y, width, height))
  NOVELVIEW_FORWARD(void, glCullFace, (GLenum mode), (mode))
  NOVELVIEW_FORWARD(void, glDeleteTextures, (GLsizei n, const GLuint* textures), (n, textures))
  NOVELVIEW_FORWARD(void, glDepthFunc, (GLenum func), (func))
  NOVELVIEW_FORWARD(void, glDepthMask, (GLboolean flag), (flag))
  NOVELVIEW_FORWARD(void, glDepthRange, (GLclampd nearest, GLclampd farthest), (nearest, farthest))
  NOVELVIEW_FORWARD(void, glDisable, (GLenum cap), (cap))
  NOVELVIEW_FORWARD(
    void, glDrawArrays, (GLenum mode, GLint first, GLsizei count), (mode, first, count))
  NOVELVIEW_FORWARD(void, glDrawBuffer, (GLenum mode), (mode))
  NOVELVIEW_FORWARD(void, glDrawElements,
    (GLenum mode, GLsizei count, GLenum type, const GLvoid* indices), (mode, count, type, indices))
  NOVELVIEW_FORWARD(void, glEnable, (GLenum cap), (cap))
  NOVELVIEW_FORWARD(void, glFinish, (), ())
  NOVELVIEW_FORWARD(void, glFlush, (), ())
  NOVELVIEW_FORWARD(void, glFrontFace, (GLenum mode), (mode))
  NOVELVIEW_FORWARD(void, glGenTextures, (GLsizei n, GLuint* textures), (n, textures))
  NOVELVIEW_FORWARD(void, glGetBooleanv, (GLenum name, GLboolean* params), (name, params))
  NOVELVIEW_FORWARD(void, glGetDoublev, (GLenum name, GLdouble* params), (name, params))
  NOVELVIEW_FORWARD(GLenum, glGetError, (), ())
  NOVELVIEW_FORWARD(void, glGetFloatv, (GLenum name, GLfloat* params), (name, params))
  NOVELVIEW_FORWARD(void, glGetIntegerv, (GLenum name, GLint* params), (name, params))
  NOVELVIEW_FORWARD(const GLubyte*, glGetString, (GLenum name), (name))
  NOVELVIEW_FORWARD(void, glGetTexImage,
    (GLenum target, GLint level, GLenum format, GLenum type, GLvoid* pixels),
    (target, level, format, type, pixels))
  NOVELVIEW_FORWARD(void, glGetTexLevelParameteriv,
    (GLenum target, GLint level, GLenum name, GLint* params), (target, level, name, params))
  NOVELVIEW_FORWARD(void, glHint, (GLenum target, GLenum mode), (target, mode))
  NOVELVIEW_FORWARD(GLboolean, glIsEnabled, (GLenum cap), (cap))
  NOVELVIEW_FORWARD(GLboolean, glIsTexture, (GLuint texture), (texture))
  NOVELVIEW_FORWARD(void, glLineWidth, (GLfloat width), (width))
  NOVELVIEW_FORWARD(void, glPixelStorei, (GLenum name, GLint param), (name, param))
  NOVELVIEW_FORWARD(void, glPointSize, (GLfloat size), (size))
  NOVELVIEW_FORWARD(void, glPolygonMode, (GLenum face, GLenum mode), (face, mode))
  NOVELVIEW_FORWARD(void, glPolygonOffset, (GLfloat factor, GLfloat units), (factor, units))
  NOVELVIEW_FORWARD(void, glReadBuffer, (GLenum mode), (mode))
  NOVELVIEW_FORWARD(void, glReadPixels,
    (GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, GLvoid* pixels),
    (x, y, width, height, format, type, pixels))
  NOVELVIEW_FORWARD(
    void, glScissor, (GLint x, GLint y, GLsizei width, GLsizei height), (x, y, width, height))
  NOVELVIEW_FORWARD(void, glStencilFunc, (GLenum func, GLint ref, GLuint mask), (func, ref, mask))
  NOVELVIEW_FORWARD(void, glStencilMask, (GLuint mask), (mask))
  NOVELVIEW_FORWARD(
    void, glStencilOp, (GLenum fail, GLenum zfail, GLenum zpass), (fail, zfail, zpass))
  NOVELVIEW_FORWARD(
    void, glTexEnvi, (GLenum target, GLenum name, GLint param), (target, name, param))
  NOVELVIEW_FORWARD(void, glTexImage1D,
    (GLenum target, GLint level, GLint components, GLsizei width, GLint border, GLenum format,
      GLenum type, const GLvoid* pixels),
    (target, level, components, width, border, format, type, pixels))
  NOVELVIEW_FORWARD(void, glTexImage2D,
    (GLenum target, GLint level, GLint components, GLsizei width, GLsizei height, GLint border,
      GLenum format, GLenum type, const GLvoid* pixels),
    (target, level, components, width, height, border, format, type, pixels))
  NOVELVIEW_FORWARD(
    void, glTexParameterf, (GLenum target, GLenum name, GLfloat param), (target, name, param))
  NOVELVIEW_FORWARD(void, glTexParameterfv, (GLenum target, GLenum name, const GLfloat* params),
    (target, name, params))
  NOVELVIEW_FORWARD(
    void, glTexParameteri, (GLenum target, GLenum name, GLint param), (target, name, param))
  NOVELVIEW_FORWARD(void, glTexSubImage2D,
    (GLenum target, GLint level, GLint xoffset, GLint yoffset, GLsizei width, GLsizei height,
      GLenum format, GLenum type, const GLvoid* pixels),
    (target, level, xoffset, yoffset, width, height, format, type, pixels))
  NOVELVIEW_FORWARD(
    void, glViewport, (GLint x, GLint y, GLsizei width, GLsizei height), (x, y, width, height))
}
