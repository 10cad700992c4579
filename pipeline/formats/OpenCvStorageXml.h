// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OpenCvStorageXml_h
#define novelview_OpenCvStorageXml_h

#include "formats/StorageNode.h"

#include <string>

namespace novelview
{
/** The root of a text in XML. Throws Error, naming `where`. */
StorageNode ParseStorageXml(const std::string& text, const std::string& where);
}

#endif
