// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_BrowserStart_h
#define novelview_BrowserStart_h

#include <filesystem>
#include <string>

namespace novelview
{
/**
 * Opens an address in the user's browser with xdg-open, without waiting for it.
 *
 * The address has a token that other users must not see, and command lines are public: what is opened
 * is a file that only this user can read and that leads on to the address. It is removed at the end.
 */
class BrowserStart
{
public:
  /** Whether there is a display to show a browser on. */
  static bool HasDisplay();

  explicit BrowserStart(const std::string& address);
  ~BrowserStart();
  BrowserStart(const BrowserStart&) = delete;
  BrowserStart& operator=(const BrowserStart&) = delete;

  bool Started() const { return this->Running; }

private:
  std::filesystem::path Page;
  bool Running = false;
};
}

#endif
