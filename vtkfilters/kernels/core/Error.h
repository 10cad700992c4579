// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Error_h
#define novelview_Error_h

#include <exception>
#include <stdexcept>
#include <string>

namespace novelview
{
/**
 * The one exception of the project: what went wrong and where, and, where it makes sense, what was
 * found and what was expected. `what()` reads
 *
 *     view 3 (b0003.png): mask has the wrong size (got 640x480, expected 1280x960)
 *
 * It is one printable line of at most 300 bytes, whatever the parts hold: see PrintableText.h. Where
 * that is too short, the longest parts lose their middle.
 */
class Error : public std::runtime_error
{
public:
  Error(const std::string& where, const std::string& what);
  Error(const std::string& where, const std::string& what, const std::string& got,
    const std::string& expected);
};

/** Thrown when the progress callback of an Execution requests a stop. Not an error of the input. */
class Interrupted : public Error
{
public:
  Interrupted();
};

/**
 * The message for an exception, in the project's words: an Error's own line; for others what to
 * do, never the text of a library.
 */
std::string ErrorText(const std::exception& error);

/** "640x480" */
std::string SizeText(int width, int height);
}

#endif
