// SPDX-License-Identifier: GPL-3.0-or-later
/** Text of unknown origin (names of files, words of files) as part of one line for people. */
#ifndef novelview_PrintableText_h
#define novelview_PrintableText_h

#include <cstddef>
#include <string>
#include <string_view>

namespace novelview
{
/** The length of the character at `at` in bytes; 0 when the bytes there are no valid UTF-8. */
std::size_t Utf8Length(std::string_view text, std::size_t at);

/** Whether a text is valid UTF-8. */
bool IsUtf8(std::string_view text);

/** The text with bytes that are no UTF-8 written as \\xNN. */
std::string ValidUtf8(std::string_view text);

/**
 * The text as one line of valid UTF-8: line breaks and tabs become blanks, bytes that are no UTF-8
 * and characters that control a terminal are written as \\xNN.
 */
std::string Printable(std::string_view text);

/**
 * A printable text of at most `most` bytes: longer ones have "..." in place of their middle, between
 * whole characters. The end, which is the most informative part of a path, keeps more than the
 * beginning.
 */
std::string Shortened(const std::string& text, std::size_t most);

/** Printable and shortened, for a line that has nothing else. */
std::string PrintableLine(std::string_view text);

/** A word of a file in quotes, for messages: of a long one the beginning, strange bytes as "?". */
std::string Quoted(std::string_view word);

/** The most bytes of a line for people. */
constexpr std::size_t MaxInLine = 300;
}

#endif
