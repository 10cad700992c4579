// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OSMesaLibrary_h
#define novelview_OSMesaLibrary_h

#include "drawing/OpenGLLibrary.h"

namespace novelview
{
/** Mesa's software renderer in memory. Throws Error when it is not installed. */
std::unique_ptr<OpenGLLibrary> LoadOSMesa();
}

#endif
