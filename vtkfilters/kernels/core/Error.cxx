// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/Error.h"

#include "core/PrintableText.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

namespace novelview
{
namespace
{
/** The length that the longest of the parts are cut to for their sum to be at most `most`. */
template <std::size_t Count>
std::size_t CommonLength(const std::array<std::string, Count>& parts, std::size_t most)
{
  std::array<std::size_t, Count> lengths;
  std::transform(parts.begin(), parts.end(), lengths.begin(),
    [](const std::string& part) { return part.size(); });
  std::sort(lengths.begin(), lengths.end());
  std::size_t left = most;
  for (std::size_t i = 0; i < Count; ++i)
  {
    const std::size_t share = left / (Count - i);
    if (lengths[i] > share)
    {
      return share;
    }
    left -= lengths[i];
  }
  return most;
}

/** The parts, all printable, with fixed texts behind them; at most MaxInLine bytes. */
template <std::size_t Count>
std::string LineOf(
  const std::array<std::string, Count>& parts, const std::array<const char*, Count>& behind)
{
  std::array<std::string, Count> shown;
  std::size_t fixed = 0;
  for (std::size_t i = 0; i < Count; ++i)
  {
    shown[i] = PrintableLine(parts[i]);
    fixed += std::string(behind[i]).size();
  }
  const std::size_t length = CommonLength(shown, MaxInLine - fixed);
  std::string line;
  for (std::size_t i = 0; i < Count; ++i)
  {
    line += Shortened(shown[i], length) + behind[i];
  }
  return line;
}

/** OpenCV has a separate exception for it, which is unknown here. */
bool IsOutOfMemory(const std::exception& error)
{
  return dynamic_cast<const std::bad_alloc*>(&error) ||
    std::string_view(error.what()).find("Insufficient memory") != std::string_view::npos;
}

/** A thread cannot be started, mostly for lack of room for its stack; TBB has but a text for that. */
bool IsOutOfThreads(const std::exception& error)
{
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return (system && system->code() == std::errc::resource_unavailable_try_again) ||
    std::string_view(error.what()).starts_with("pthread_create has failed");
}
}

Error::Error(const std::string& where, const std::string& what)
  : std::runtime_error(LineOf<2>({ where, what }, { ": ", "" }))
{
}

Error::Error(const std::string& where, const std::string& what, const std::string& got,
  const std::string& expected)
  : std::runtime_error(
      LineOf<4>({ where, what, got, expected }, { ": ", " (got ", ", expected ", ")" }))
{
}

Interrupted::Interrupted()
  : Error("interrupted", "stopped on request")
{
}

std::string ErrorText(const std::exception& error)
{
  if (dynamic_cast<const Error*>(&error))
  {
    return error.what();
  }
  if (IsOutOfMemory(error))
  {
    return "out of memory: smaller photographs or a larger hull spacing need less";
  }
  if (IsOutOfThreads(error))
  {
    return "out of memory, or no more threads are allowed";
  }
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
  {
    return Error(file->path1().string(), file->code().message()).what();
  }
  if (const auto* system = dynamic_cast<const std::system_error*>(&error))
  {
    return Error("the system refuses something", system->code().message()).what();
  }
  return "internal error: this should not happen, please report it with what led to it";
}

std::string SizeText(int width, int height)
{
  return std::to_string(width) + "x" + std::to_string(height);
}
}
