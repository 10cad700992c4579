// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_EglLibrary_h
#define novelview_EglLibrary_h

#include "drawing/OpenGLLibrary.h"

namespace novelview
{
/**
 * The first device of EGL that is, or is not, marked as software, whatever DISPLAY and other
 * variables say. Throws Error when there is none.
 */
std::unique_ptr<OpenGLLibrary> LoadEgl(bool software);
}

#endif
