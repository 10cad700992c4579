// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's sources: what writers of calibrations have in common.
#ifndef novelview_WriteChecks_h
#define novelview_WriteChecks_h

#include "base/NumberText.h"
#include "cameras/Photograph.h"
#include "core/Error.h"
#include "core/PrintableText.h"

#include <Eigen/Dense>

#include <string>

namespace novelview
{
/** For formats that have no number for a skew. */
inline void RefuseSkew(const Photograph& photograph, const std::string& format)
{
  const double skew = photograph.Cam.K(0, 1);
  if (skew != 0)
  {
    throw Error("view " + photograph.Name,
      "K has a skew, which the format " + format + " cannot represent", NumberText(skew), "0");
  }
}

/** For formats whose texts must be UTF-8. */
inline void RequireUtf8Name(const Photograph& photograph, const std::string& format)
{
  if (!IsUtf8(photograph.Name) || !IsUtf8(photograph.Mask.string()))
  {
    throw Error("view " + photograph.Name,
      "the format " + format + " cannot represent a file name that is not UTF-8");
  }
}

/** For formats whose writers garble other characters. */
inline void RequireAsciiName(const Photograph& photograph, const std::string& format)
{
  for (const char c : photograph.Name + photograph.Mask.string())
  {
    if (c < ' ' || c > '~')
    {
      throw Error("view " + photograph.Name,
        "the format " + format + " cannot represent a file name with characters beyond ASCII");
    }
  }
}
}

#endif
