// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ByteStream_h
#define novelview_ByteStream_h

#include "core/Error.h"

#include <cstdint>
#include <cstring>
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

/** Takes values off the front of bytes, which must outlive it. Throws Error when they are too few. */
class ByteReader
{
public:
  /** @param where names the bytes in errors. */
  ByteReader(std::string_view bytes, const std::string& where)
    : Rest(bytes)
    , Where(where)
  {
  }
  template <class T>
  T Take()
  {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, this->TakeBytes(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string_view TakeBytes(std::uint64_t count)
  {
    if (count > this->Rest.size())
    {
      throw Error(this->Where, "is too short", std::to_string(this->Rest.size()) + " bytes",
        std::to_string(count));
    }
    const std::string_view taken = this->Rest.substr(0, count);
    this->Rest.remove_prefix(count);
    return taken;
  }
  std::string TakeText() { return std::string(this->TakeBytes(this->Take<std::uint64_t>())); }

  std::size_t Left() const { return this->Rest.size(); }
  void RequireEnd() const
  {
    if (!this->Rest.empty())
    {
      throw Error(this->Where, "is too long, by " + std::to_string(this->Rest.size()) + " bytes");
    }
  }

private:
  std::string_view Rest;
  std::string Where;
};
}

#endif
