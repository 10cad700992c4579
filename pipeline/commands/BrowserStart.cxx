// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/BrowserStart.h"

#include <array>
#include <cstdlib>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
bool IsSet(const char* variable)
{
  const char* const value = std::getenv(variable);
  return value && *value;
}

/** A new file that only this user can read; empty when that is impossible. */
fs::path WritePrivate(const std::string& text)
{
  std::error_code failure;
  const fs::path folder = IsSet("XDG_RUNTIME_DIR") ? fs::path(std::getenv("XDG_RUNTIME_DIR"))
                                                   : fs::temp_directory_path(failure);
  const fs::path page = folder / ("novelview-" + std::to_string(::getpid()) + ".html");
  const int file = ::open(page.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file < 0)
  {
    return {};
  }
  const bool whole = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(file);
  if (!whole)
  {
    fs::remove(page, failure);
  }
  return whole ? page : fs::path();
}

/** Starts xdg-open; its messages are thrown away. */
bool Spawn(const fs::path& page)
{
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (const int stream : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
  {
    ::posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  }
  std::string program = "xdg-open";
  std::string argument = page.string();
  const std::array<char*, 3> arguments{ program.data(), argument.data(), nullptr };
  pid_t child = 0;
  const bool started =
    ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ) == 0;
  ::posix_spawn_file_actions_destroy(&actions);
  return started;
}
}

bool BrowserStart::HasDisplay()
{
  return IsSet("DISPLAY") || IsSet("WAYLAND_DISPLAY");
}

BrowserStart::BrowserStart(const std::string& address)
  : Page(WritePrivate(
      "<!DOCTYPE html><meta http-equiv=\"refresh\" content=\"0; url=" + address + "\">\n"))
  , Running(!this->Page.empty() && Spawn(this->Page))
{
}

BrowserStart::~BrowserStart()
{
  std::error_code failure;
  if (!this->Page.empty())
  {
    fs::remove(this->Page, failure);
  }
}
}
