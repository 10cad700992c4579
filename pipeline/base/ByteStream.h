// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ByteStream_h
#define novelview_ByteStream_h

#include "core/Error.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace novelview
{
/** Appends values to a string of bytes, in this machine's byte order. */
class ByteWriter
{
public:
  template <class T>
  void Add(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    this->AddBytes(&value, sizeof(T));
  }
  void AddBytes(const void* bytes, std::size_t count)
  {
    this->Written.append(static_cast<const char*>(bytes), count);
  }
  /** The length, then the text. */
  void AddText(std::string_view text)
  {
    this->Add<std::uint64_t>(text.size());
    this->AddBytes(text.data(), text.size());
  }

  std::string Written;
};

/** A number from its bytes, which with `swap` are in the other order than this machine's. */
template <class T>
T NumberFrom(const char* bytes, bool swap = false)
{
  static_assert(std::is_trivially_copyable_v<T>);
  char raw[sizeof(T)];
  std::memcpy(raw, bytes, sizeof(T));
  if (swap)
  {
    std::reverse(raw, raw + sizeof(T));
  }
  T number;
  std::memcpy(&number, raw, sizeof(T));
  return number;
}

/** A place in bytes, which must outlive it, and what is taken from there on. */
class ByteCursor
{
public:
  explicit ByteCursor(std::string_view bytes, std::size_t position = 0)
    : Bytes(bytes)
    , At(position)
  {
  }

  /** The next `count` things of `size` bytes; nothing, and it stays, when there are fewer. */
  std::optional<std::string_view> Take(std::uint64_t count, std::size_t size = 1)
  {
    if (count > this->Left() / size)
    {
      return std::nullopt;
    }
    const std::string_view taken = this->Bytes.substr(this->At, count * size);
    this->At += taken.size();
    return taken;
  }

  std::size_t Position() const { return this->At; }
  std::size_t Left() const { return this->Bytes.size() - this->At; }
  std::string_view Rest() const { return this->Bytes.substr(this->At); }

private:
  std::string_view Bytes;
  std::size_t At;
};

/** Takes values off the front of bytes, which must outlive it. Throws Error when they are too few. */
class ByteReader
{
public:
  /** @param where names the bytes in errors. */
  ByteReader(std::string_view bytes, const std::string& where)
    : Cursor(bytes)
    , Where(where)
  {
  }
  template <class T>
  T Take()
  {
    return NumberFrom<T>(this->TakeBytes(sizeof(T)).data());
  }
  std::string_view TakeBytes(std::uint64_t count)
  {
    if (const auto taken = this->Cursor.Take(count))
    {
      return *taken;
    }
    throw Error(
      this->Where, "is too short", std::to_string(this->Left()) + " bytes", std::to_string(count));
  }
  std::string TakeText() { return std::string(this->TakeBytes(this->Take<std::uint64_t>())); }

  std::size_t Left() const { return this->Cursor.Left(); }
  void RequireEnd() const
  {
    if (this->Left() > 0)
    {
      throw Error(this->Where, "is too long, by " + std::to_string(this->Left()) + " bytes");
    }
  }

private:
  ByteCursor Cursor;
  std::string Where;
};
}

#endif
