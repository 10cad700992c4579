// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OffscreenWindow_h
#define novelview_OffscreenWindow_h

#include <vtkImageData.h>
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <string>

class vtkRenderer;

namespace novelview
{
/**
 * A VTK render window without a display, in an OpenGL context of its own (OpenGLLibrary.h).
 *
 * Several windows may exist at the same time, of any size that the driver supports. DISPLAY is
 * never read. Windows are used from one thread. A renderer belongs to one window at a time and must
 * be removed (or die) before it is added to another.
 */
class OffscreenWindow
{
public:
  /**
   * Opens a window of this many pixels and verifies that it draws: OpenGL must report its version,
   * and a cleared image must read back in the colour it was cleared to.
   *
   * Throws Error when the size is not positive or more than the driver can do, when no context can
   * be made, or when the proof fails.
   */
  OffscreenWindow(int width, int height);
  ~OffscreenWindow();
  OffscreenWindow(const OffscreenWindow&) = delete;
  OffscreenWindow& operator=(const OffscreenWindow&) = delete;

  int Width() const { return this->Size[0]; }
  int Height() const { return this->Size[1]; }

  /** What draws: "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 ...". The first window logs it. */
  const std::string& RendererName() const { return this->Name; }

  /** The window itself, to which renderers are added. Borrowed. */
  vtkRenderWindow* Window() const { return this->Render; }

  /**
   * Draws all renderers that were added. The image has a point array of 3 components (RGB, uint8),
   * or of 4 with `withAlpha`: alpha is then 0 where nothing was drawn. Bottom-up rows, as VTK has
   * them.
   */
  vtkSmartPointer<vtkImageData> Capture(bool withAlpha = false);

private:
  void ProveItDraws();

  vtkSmartPointer<vtkRenderWindow> Render;
  std::string Name;
  int Size[2];
};

/** One renderer in its own window: the image as Capture() gives it. */
vtkSmartPointer<vtkImageData> RenderOffscreen(vtkRenderer* renderer, int width, int height);
}

#endif
