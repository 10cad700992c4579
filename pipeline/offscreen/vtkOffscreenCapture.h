// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkOffscreenCapture
 * @brief Images of a vtkRenderer without a display.
 *
 * Draws with software OpenGL in memory (OSMesa, see OffscreenWindow.h); DISPLAY is never read.
 * The renderer may not belong to a window.
 *
 * Errors: no renderer, a size that is not positive or more than the driver can do, and an OpenGL
 * that the process has bound to another library than OSMesa.
 */
#ifndef vtkOffscreenCapture_h
#define vtkOffscreenCapture_h

#include "vtkNovelViewOffscreenModule.h"
#include <vtkObject.h>

class vtkImageData;
class vtkRenderer;

class VTKNOVELVIEWOFFSCREEN_EXPORT vtkOffscreenCapture : public vtkObject
{
public:
  static vtkOffscreenCapture* New();
  vtkTypeMacro(vtkOffscreenCapture, vtkObject);

  /**
   * Draws the renderer into `image`, which gets the point array `Color` (uint8 x 3). On an error
   * (ErrorEvent) the image is left alone and false returned.
   */
  bool Capture(vtkRenderer* renderer, int width, int height, vtkImageData* image);

protected:
  vtkOffscreenCapture();
  ~vtkOffscreenCapture() override = default;

private:
  vtkOffscreenCapture(const vtkOffscreenCapture&) = delete;
  void operator=(const vtkOffscreenCapture&) = delete;
};

#endif
