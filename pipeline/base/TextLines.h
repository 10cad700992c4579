// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TextLines_h
#define novelview_TextLines_h

#include <cstddef>
#include <string>
#include <string_view>

namespace novelview
{
/**
 * The lines of a text one after the other, and the words of the line, without a copy of either. Lines
 * end with LF or CRLF; blanks separate words. The text must outlive the object.
 */
class TextLines
{
public:
  /** `file` is the name for messages. */
  TextLines(std::string_view text, std::string file);

  /** Goes to the next line; false at the end of the text. */
  bool Next();

  /** Goes to the next line that has a word; false at the end of the text. */
  bool NextWithWords();

  /** The next word of the line; empty at its end. */
  std::string_view Word();

  /** What is left of the line, without blanks around. */
  std::string_view Rest() const;

  /** The byte behind the line and its end. */
  std::size_t Position() const { return this->After; }

  /** "FILE, line 7" */
  std::string Where() const;

  const std::string& File() const { return this->Name; }

private:
  std::string_view Text;
  std::string Name;
  std::string_view Line; ///< what is left of it
  std::size_t After = 0;
  std::size_t Number = 0;
};
}

#endif
