// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OpenCvStorageYaml_h
#define novelview_OpenCvStorageYaml_h

#include "formats/StorageNode.h"

#include <string>

namespace novelview
{
/** The root of a text in YAML. Throws Error, naming `where` and the line. */
StorageNode ParseStorageYaml(const std::string& text, const std::string& where);
}

#endif
